"""What the pages need where scripts run: the scripts, and the samples of each test."""
