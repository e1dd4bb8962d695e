"""Results that another program altered, found by reading all of them."""

from __future__ import annotations

from colonnade.errors import StoreError
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.layout import Layout


def remove_altered(layout: Layout) -> list[str]:
    """Remove the results of tests and specimens that are not as they were written; return a sentence on each."""
    told = []
    for path in layout.results_there():
        expect_none()
        try:
            files.read(path)
        except StoreError:
            files.remove(path)
            told.append(f"{path.relative_to(layout.home).as_posix()}: it was altered or damaged; it is made again.")
    return told
