"""The Monte-Carlo study of the identified restitution: truth, design, bound, and what became of the records."""
