"""Photos of a test: JPEG or PNG, decoded where strangers' files are read, upright and no larger than a page needs."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from colonnade.errors import ReadError
from colonnade.readers.files import irregular

LARGEST_SIDE = 1600
"""Pixels of the longer side of what the report shows."""
MOST_PIXELS = 120_000_000
"""Pixels of a photo; more is refused before it is unpacked."""
MOST_BYTES = 60_000_000
"""Bytes of a photo's file."""
KINDS = ("JPEG", "PNG")
"""As Pillow calls them; no other decoder is tried."""
MODULES = ("PIL.Image", "PIL.ImageOps", "PIL.JpegImagePlugin", "PIL.PngImagePlugin")
"""What decoding imports; the bounded process imports it before it opens a photo."""

Pixels = NDArray[np.uint8]
"""Red, green and blue, shape (height, width, 3)."""


def read_photo(path: Path, *, within: Path) -> Pixels:
    """
    Decode a photo in the bounded process.

    Parameters
    ----------
    path : Path
        JPEG or PNG; neither it nor a folder on its way may be a link.
    within : Path
        Folder of the campaign, resolved.

    Returns
    -------
    pixels : ndarray of uint8, shape (height, width, 3)
        Upright, at most `LARGEST_SIDE` a side, without what else the file holds (place, camera, comments, thumbnail).

    Raises
    ------
    ReadError
        If it is missing, a link, too large, damaged, or neither JPEG nor PNG.
    """
    from colonnade.readers.bounded.process import run_bounded

    if Path(os.path.realpath(path)) != Path(os.path.normpath(path)):
        raise ReadError(f"{path.name}: this is a link, or in a folder that is one. Copy the photo itself there.")
    if kind := irregular(path):
        raise ReadError(f"{path.name}: this is {kind}; a photo was expected.")
    try:
        size = path.stat().st_size
    except OSError:
        raise ReadError(f"{path.name}: photo not found in {path.parent.name}/. Check the path.") from None
    if size > MOST_BYTES:
        raise ReadError(f"{path.name}: {size / 1e6:.0f} MB is too large. At most {MOST_BYTES / 1e6:.0f} MB is shown.")
    return run_bounded(
        "colonnade.readers.photo:photo_here", path, {}, _taken, kind="photo", within=within, modules=MODULES
    )


def _taken(header: object, arrays: list[Pixels]) -> Pixels:
    (pixels,) = arrays
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or max(pixels.shape) > LARGEST_SIDE:
        raise ValueError("the pixels of a photo were expected")
    return pixels


def photo_here(path: Path) -> tuple[None, list[Pixels]]:
    """Decode a photo in this process, for another one; `read_photo` says the rest."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    Image.MAX_IMAGE_PIXELS = None  # the number of pixels is checked here, with a sentence of its own
    try:
        with Image.open(path, formats=KINDS) as photo:
            width, height = photo.size
            if width * height > MOST_PIXELS:
                raise ReadError(
                    f"{path.name}: {width} × {height} pixels are too many; at most {MOST_PIXELS / 1e6:.0f} million "
                    "are shown. Make it smaller."
                )
            photo.draft("RGB", (LARGEST_SIDE, LARGEST_SIDE))  # JPEG is decoded at half or a quarter of its size
            upright = ImageOps.exif_transpose(photo)
            if upright.has_transparency_data:
                white = Image.new("RGBA", upright.size, "white")
                upright = Image.alpha_composite(white, upright.convert("RGBA"))
            upright = upright.convert("RGB")
            upright.thumbnail((LARGEST_SIDE, LARGEST_SIDE), Image.Resampling.LANCZOS)
            return None, [np.asarray(upright)]
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        found = "neither JPEG nor PNG" if isinstance(error, UnidentifiedImageError) else f"damaged ({error})"
        raise ReadError(f"{path.name}: it is {found}. Save the photo again as JPEG or PNG.") from error
