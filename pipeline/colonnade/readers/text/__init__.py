"""Text of recorders: delimited, LabVIEW and MTS, and what is found in its head."""
