"""
Fuzz a reader: `python tests/drill/fuzz.py FORMAT --minutes N`.

Needs atheris, which is no dependency of colonnade: `pip install atheris`. Starts from whole files of that format, keeps
what reaches new code in a folder, and stops at the first exception other than a refusal, with the input in the folder.
What is found is mended and kept in tests/readers/test_findings.py.
"""

import argparse
import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import whole_files

GUARDED = ("c3d", "excel", "matlab", "netcdf", "tdms")
"""Formats parsed with other people's packages: their exceptions are refusals, by the registry. Others raise none."""
TIMEOUT = 20
"""Seconds for one input."""
MEMORY = 2048
"""MB for one input."""


def main():
    """Parse what was asked for and fuzz."""
    parser = argparse.ArgumentParser(description="Fuzz a reader with atheris.")
    parser.add_argument("format", help="name of a format, as `colonnade show formats` lists them")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--folder", type=Path, help="where inputs are kept; a temporary folder by default")
    chosen = parser.parse_args()
    try:
        import atheris
    except ImportError:
        sys.exit("atheris is not installed here. Install it: pip install atheris")
    with atheris.instrument_imports(include=["colonnade.readers", "nptdms"]):  # before anything else imports them
        from colonnade.readers.registry import formats

        format = formats().get(chosen.format)
    if format is None:
        sys.exit(f'Unknown format "{chosen.format}". There is: {", ".join(formats())}')
    folder = chosen.folder or Path(tempfile.mkdtemp(prefix=f"fuzz-{chosen.format}-"))
    corpus = folder / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    seeds = seed(folder / "whole", corpus, format.name)
    if not seeds:
        sys.exit(f'There is no whole file of format "{format.name}" to start from.')
    take = target(format, folder / seeds[0].name)
    print(f"{format.name}: {len(seeds)} whole files, inputs are kept in {folder}")
    limits = [f"-max_total_time={int(60 * chosen.minutes)}", f"-timeout={TIMEOUT}", f"-rss_limit_mb={MEMORY}"]
    atheris.Setup([sys.argv[0], str(corpus), *limits, f"-artifact_prefix={folder}/", "-print_final_stats=1"], take)
    atheris.Fuzz()


def seed(whole, corpus, format):
    """Put whole files of a format into the corpus."""
    shutil.rmtree(whole, ignore_errors=True)
    seeds = [whole_files.write(name, whole) for name in whole_files.DRILLED if whole_files.format_of(name) == format]
    for number, path in enumerate(seeds):
        (corpus / f"whole-{number}").write_bytes(path.read_bytes())
    return seeds


def target(format, path):
    """Build what is fuzzed: a file is recognised and read."""
    from colonnade.errors import ReadError
    from colonnade.readers.bounded.messages import recording_of
    from colonnade.readers.registry import read_here

    warnings.simplefilter("ignore")
    options = format.options()

    def take(data):
        path.write_bytes(data)
        if not format.recognise(path).yes:
            return
        try:
            if format.name in GUARDED:
                recording = recording_of(path, *read_here(path, format.name, {}, None))
            else:
                recording = format.read(path, options)
        except ReadError:
            return
        for channel in recording.channels:
            assert channel.time is None or channel.time.size == channel.values.size
            assert channel.values.size <= 1000 * max(len(data), 1000)

    return take


if __name__ == "__main__":
    main()
