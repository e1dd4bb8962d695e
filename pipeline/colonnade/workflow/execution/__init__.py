"""Execution: processes, a Dask cluster, resumable blocks, and a lock for one run at a time."""
