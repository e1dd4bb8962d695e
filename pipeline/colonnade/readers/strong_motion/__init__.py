"""Strong-motion records as networks publish them."""
