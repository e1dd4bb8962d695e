"""The study of the contact model, part by part."""
