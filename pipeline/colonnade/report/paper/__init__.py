"""The report on paper: the pages as they are, typeset as one PDF."""
