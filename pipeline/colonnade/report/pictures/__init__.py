"""Every figure of a test, a specimen or a campaign by its name: pages and the command `figure` draw the same."""
