"""From columns to channels that can be used: clocks, quality, zeros, plausibility."""
