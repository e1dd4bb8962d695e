"""Many runs of one motion over what is not known exactly."""
