"""LabVIEW TDMS."""
