"""The fault atlas: campaigns of the virtual laboratory with one planted fault each."""
