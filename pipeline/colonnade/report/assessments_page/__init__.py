"""The page of the real columns: whether each will stand, what that rests on, and what it does not cover."""
