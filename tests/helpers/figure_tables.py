"""What a figure shows, as lists that compare equal."""

from colonnade.figures.files.table import columns_of


def table_of(figure):
    return {heading: list(column) for heading, column in columns_of(figure).items()}
