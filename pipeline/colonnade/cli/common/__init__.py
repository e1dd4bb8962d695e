"""What several commands share: output, options, progress, findings."""
