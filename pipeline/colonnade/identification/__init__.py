"""What the recordings say of the specimen, on plain arrays."""
