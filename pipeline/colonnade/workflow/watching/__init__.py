"""Between two tests of a campaign: new raw files, a line on each, the rest of the work behind it."""
