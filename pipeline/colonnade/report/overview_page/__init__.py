"""What the overview shows, a module each part."""
