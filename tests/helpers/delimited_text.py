"""Text written to a file and read as delimited."""

from colonnade.readers.registry import read


def recorded(tmp_path, text, **options):
    path = tmp_path / "record.csv"
    path.write_bytes(text.encode())
    return read(path, "delimited", options)


def values(recording, column):
    return recording.channel(column).values.tolist()
