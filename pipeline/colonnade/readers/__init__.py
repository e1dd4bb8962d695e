"""From a raw file to a recording, as recorded. No other part of the package knows the formats."""
