"""From a raw file to a recording, as recorded. Nothing else in the package knows a format."""
