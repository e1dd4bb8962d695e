"""The steps of one test: what one has made, the next one takes from memory."""

from __future__ import annotations

import numpy as np

from colonnade.store import files


def types(dataset):
    """Types of variables; text is text, whether its length is fixed or not."""
    return {name: "text" if each.dtype.kind in "OU" else each.dtype for name, each in dataset.variables.items()}


def plain(attributes):
    return {name: np.asarray(value).tolist() for name, value in attributes.items() if name != "warnings"}


def test_what_a_step_hands_on_is_what_its_file_holds(untouched, monkeypatch):
    handed = {}
    write = files.write

    def spy(dataset, path, *, attributes):
        handed[path] = write(dataset, path, attributes=attributes)
        return handed[path]

    monkeypatch.setattr(files, "write", spy)
    untouched.run()
    assert len(handed) == len(untouched.contents())
    for path, given in handed.items():
        stored = files.read(path)
        assert given.equals(stored), path.name
        assert set(given.coords) == set(stored.coords)
        assert types(given) == types(stored)
        assert plain(given.attrs) == plain(stored.attrs)
        assert given.attrs["warnings"] == stored.attrs["warnings"]
        for name, variable in stored.variables.items():
            assert plain(given[name].attrs) == plain(variable.attrs)
