"""What figures are made of: curves, panels and their scales."""
