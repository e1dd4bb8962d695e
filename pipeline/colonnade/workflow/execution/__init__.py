"""Where work is computed: processes, a Dask cluster, resumable blocks, one run at a time."""
