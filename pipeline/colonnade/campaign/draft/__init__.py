"""A draft of campaign.toml from the raw files: what is known, what is guessed and why, and what is asked."""
