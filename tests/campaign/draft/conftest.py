"""Raw files in a folder, as laboratories leave them."""

import tomllib

import numpy as np
import pytest

from colonnade.campaign.draft.write import draft


@pytest.fixture
def folder(tmp_path):
    """A folder, and how a delimited file is written into it."""

    class Folder:
        path = tmp_path

        def write(self, name, columns, *, delimiter=",", clock="Time [s]"):
            heads = ([clock] if clock else []) + list(columns)
            columns = {name: np.asarray(values) for name, values in columns.items()}
            time = 0.01 * np.arange(len(next(iter(columns.values()))))
            values = ([time] if clock else []) + list(columns.values())
            rows = [delimiter.join(f"{value:.6f}" for value in row) for row in zip(*values, strict=True)]
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("\n".join([delimiter.join(heads), *rows, ""]), encoding="utf-8")

        def draft(self):
            """The drafted file as read by any TOML reader, and the draft."""
            drafted = draft(tmp_path)
            return tomllib.loads(drafted.text), drafted

    return Folder()
