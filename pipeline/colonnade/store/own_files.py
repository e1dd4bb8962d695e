"""The files in a folder of results, without following a link out of it."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from colonnade.errors import StoreError


def own_files(folder: Path) -> list[Path]:
    """
    List the files of a folder of results, and of the folders in it.

    Parameters
    ----------
    folder : Path
        It need not exist.

    Returns
    -------
    files : list of Path
        A link to a file counts as one: results are put in its place, never through it.

    Raises
    ------
    StoreError
        If the folder or one in it is a link, which would let results be written or removed elsewhere, or if an entry
        is neither a file nor a folder.
    """
    if folder.is_symlink():
        raise _refused(folder)
    found, waiting = [], [folder]
    while waiting:
        try:
            with os.scandir(waiting.pop()) as entries:
                for entry in entries:
                    if entry.is_dir(follow_symlinks=False):
                        waiting.append(Path(entry.path))
                    elif entry.is_file(follow_symlinks=False) or _leads_to_a_file(entry):
                        found.append(Path(entry.path))
                    else:
                        raise _refused(Path(entry.path))
        except (FileNotFoundError, NotADirectoryError):  # not made yet, or taken away by a run that ends
            continue
        except OSError as error:
            raise StoreError(
                f"{error.filename}: this folder of results cannot be read ({error.strerror}). Check its permissions."
            ) from error
    return found


def _leads_to_a_file(link: os.DirEntry[str]) -> bool:
    """Whether a link is one to a file, or to nothing; a pipe or a device would be waited for."""
    if not link.is_symlink():
        return False
    try:
        return stat.S_ISREG(link.stat().st_mode)
    except FileNotFoundError:
        return True
    except OSError:
        return False


def _refused(path: Path) -> StoreError:
    if path.is_symlink():
        return StoreError(
            f"{path}: this is a link, to {path.readlink()}. Results are not written or removed through links. Remove "
            "it; to keep results on another disk, give its folder with --results."
        )
    return StoreError(f"{path}: this is neither a file nor a folder. Only results were expected here; remove it.")
