"""NI DIAdem data sets."""
