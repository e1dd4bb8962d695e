"""Parts of the study of fragility curves: populations of records with known truth, trials, the page."""
