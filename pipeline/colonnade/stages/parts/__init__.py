"""What several stages share, and the steps of conditioning: clocks, zeros, plausibility."""
