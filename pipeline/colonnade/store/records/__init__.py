"""The records of tests and specimens, taken from the results once; summary, report and `show` are views of them."""
