"""The elastic body of the contact model: finite elements, reduced to a few modes."""
