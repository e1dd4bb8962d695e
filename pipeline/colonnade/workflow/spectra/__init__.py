"""`spectrum`: the column and the base motion that are asked about, their spectra, and what is printed of them."""
