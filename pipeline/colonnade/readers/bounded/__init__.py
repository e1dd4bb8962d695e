"""A stranger's binary file is read in a process of its own, which may take so much and touch so much, and no more."""
