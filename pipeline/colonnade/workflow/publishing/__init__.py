"""What a run makes for people: the report's pages, photos, PDF and zip file, and single figures."""
