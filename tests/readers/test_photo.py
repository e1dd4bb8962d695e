"""Photos: upright, small and bare; what is no photo, a bomb, a link or damaged is refused in a sentence."""

import struct
import zlib
from io import BytesIO

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from colonnade.errors import ReadError
from colonnade.readers import photo
from colonnade.readers.photo import LARGEST_SIDE, photo_here, read_photo
from every import every

RED, BLUE = (200, 20, 20), (20, 20, 200)


def decoded(path):
    return photo_here(path)[1][0]


def two_halves(size=(400, 200)):
    """Red on the left, blue on the right."""
    image = Image.new("RGB", size, RED)
    image.paste(BLUE, (size[0] // 2, 0, size[0], size[1]))
    return image


def saved(path, image, kind="JPEG", **more):
    image.save(path, kind, **more)
    return path


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def bomb(side):
    """Claim a huge picture in a small file."""
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    rows = zlib.compress(bytes(1_000_000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def near(pixel, colour):
    return np.abs(pixel.astype(int) - colour).max() < 30


@every(("kind", "name"), [("JPEG", "a.jpg"), ("PNG", "a.png")])
def test_a_photo_is_read_in_the_bounded_process(tmp_path, kind, name):
    pixels = read_photo(saved(tmp_path / name, two_halves(), kind), within=tmp_path.resolve())
    assert (pixels.shape, pixels.dtype) == ((200, 400, 3), np.uint8)
    assert near(pixels[100, 50], RED)
    assert near(pixels[100, 350], BLUE)


# The orientation of EXIF, and where the left half of the file is when it is upright.
@every(("orientation", "red"), [(1, "left"), (2, "right"), (3, "right"), (6, "top"), (8, "bottom")])
def test_a_photo_is_turned_upright(tmp_path, orientation, red):
    exif = Image.Exif()
    exif[0x0112] = orientation
    pixels = decoded(saved(tmp_path / "a.jpg", two_halves(), exif=exif))
    height, width, _ = pixels.shape
    at = {"left": (height // 2, 20), "right": (height // 2, width - 20)}
    at |= {"top": (20, width // 2), "bottom": (height - 20, width // 2)}
    assert near(pixels[at[red]], RED)
    assert (height > width) == (orientation in (6, 8))


@given(st.integers(1, 5000), st.integers(1, 5000))
@settings(max_examples=15, deadline=None)
def test_no_side_is_longer_than_a_page_needs(tmp_path_factory, width, height):
    path = saved(tmp_path_factory.mktemp("photo") / "a.png", Image.new("L", (width, height), 128), "PNG")
    shape = decoded(path).shape
    assert max(shape[:2]) == min(max(width, height), LARGEST_SIDE)
    assert min(shape[:2]) == pytest.approx(
        max(1, min(width, height) * min(1, LARGEST_SIDE / max(width, height))), abs=1
    )


@every("mode", ["L", "LA", "RGBA", "P", "CMYK", "1"])
def test_every_kind_of_pixel_becomes_red_green_and_blue(tmp_path, mode):
    image = Image.new("RGBA", (20, 10), (0, 0, 0, 0)) if mode in ("LA", "RGBA") else Image.new("L", (20, 10), 255)
    kind = "JPEG" if mode == "CMYK" else "PNG"
    pixels = decoded(saved(tmp_path / "a", image.convert(mode), kind))
    assert pixels.shape == (10, 20, 3)
    assert pixels.min() > 250, "what can be seen through is white"


@every(
    ("content", "told"),
    [
        (bomb(60_000), "60000 × 60000 pixels are too many"),
        (b"GIF89a" + bytes(100), "neither JPEG nor PNG"),
        (b"", "neither JPEG nor PNG"),
        (b"<svg onload='alert(1)'/>", "neither JPEG nor PNG"),
        (bomb(2000)[:-60], "damaged"),
    ],
)
def test_what_is_no_photo_is_refused(path, content, told):
    path.write_bytes(content)
    with pytest.raises(ReadError, match=told):
        decoded(path)


def test_what_is_missing_a_link_or_too_large_is_not_opened(tmp_path, monkeypatch):
    within = tmp_path.resolve()
    original = saved(tmp_path / "a.jpg", two_halves())
    (tmp_path / "link.jpg").symlink_to(original)
    (tmp_path / "folder").mkdir()
    (tmp_path / "other").symlink_to(tmp_path / "folder")
    saved(tmp_path / "folder" / "a.jpg", two_halves())
    refusals = {"missing.jpg": "not found", "link.jpg": "is a link", "other/a.jpg": "is a link", "folder": "a folder"}
    for name, told in refusals.items():
        with pytest.raises(ReadError, match=told):
            read_photo(within / name, within=within)
    monkeypatch.setattr(photo, "MOST_BYTES", 100)
    with pytest.raises(ReadError, match="too large"):
        read_photo(original, within=within)


@given(
    st.lists(st.tuples(st.integers(0, 5000), st.integers(0, 255)), min_size=1, max_size=8),
    st.sampled_from(["JPEG", "PNG"]),
)
@settings(max_examples=60, deadline=None)
def test_a_damaged_photo_is_shown_or_refused(tmp_path_factory, changes, kind):
    written = BytesIO()
    two_halves((60, 40)).save(written, kind)
    content = bytearray(written.getvalue())
    for place, byte in changes:
        content[place % len(content)] = byte
    path = tmp_path_factory.mktemp("photo") / "a"
    path.write_bytes(content)
    try:
        assert decoded(path).ndim == 3
    except ReadError as error:
        assert str(error).startswith("a: ")  # noqa: PT017
