"""What happens to files: kinds of damage, each seeded, to the bytes of a file or of a member of an archive."""

import io
import re
import struct
import zipfile

JUNK = (b"OVERFLOW", b"\0\0\0\0", b'"', b"\r", b"\n\n", b"\x1a", b"nan", b"--", b"#", "θ".encode(), b"\xff\xfe", b"]]>")
JUNK += (b"NaN;;", b"1.234,5", b"\r\n\r\n", "µ°".encode(), b"=SUM(A1)", b"1e999", b"[[")
DELIMITERS = (b",", b";", b"\t", b" ", b"|", b":", b".")
NUMBER = re.compile(rb"[-+]?\d+(?:[.,]\d*)?(?:[eE][-+]?\d+)?")
MANGLED = (b"", b"-", b"1.2.3", b"1,2,3", b"1e", b"0x1F", b"++4", b"NaN", b"inf", b"1_000", b"\xd9\xa3", b"12 34", b"0")
HUGE = (b"1e999", b"9" * 400, b"-" + b"9" * 30, b"1e308", b"9" * 11, b"2147483648", b"4294967295", b"1" + b"0" * 5000)
HUGE_FIELDS = (
    *(struct.pack("<I", value) for value in (0x7FFFFFFF, 0xFFFFFFFF, 0x80000000, 0x00FFFFFF)),
    *(struct.pack(">I", value) for value in (0x7FFFFFFE, 0x00FFFFFF)),
    *(struct.pack("<Q", value) for value in (0x7FFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF, 1 << 40)),
    *(struct.pack("<d", value) for value in (float("inf"), float("nan"), 1e308, -1e308)),
)
"""What stands in place of a binary count, offset or sample."""


def flips(data, chance):
    """Flip bits."""
    for _ in range(chance.randint(1, 30)):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return data


def head(data, chance):
    """Write other bytes into the head."""
    for _ in range(chance.randint(1, 6)):
        data[chance.randrange(min(len(data), 1500))] = chance.choice([0, 1, 32, 127, 255])
    return data


def truncation(data, chance):
    """End the file too early."""
    return data[: chance.randrange(len(data))]


def deletion(data, chance):
    """Take a piece out."""
    place = chance.randrange(len(data))
    del data[place : place + chance.randint(1, 200)]
    return data


def repetition(data, chance):
    """Have a piece twice."""
    place = chance.randrange(len(data))
    return data[:place] + data[max(0, place - chance.randint(1, 400)) :]


def junk(data, chance):
    """Put something in that does not belong there."""
    for _ in range(chance.randint(1, 6)):
        place = chance.randrange(len(data))
        data[place:place] = chance.choice(JUNK)
    return data


def lines(data, chance):
    """Swap lines; of a file without them, blocks of bytes."""
    parts = bytes(data).splitlines(keepends=True)
    if len(parts) < 4:
        size = max(8, len(data) // 20)
        parts = [bytes(data[place : place + size]) for place in range(0, len(data), size)]
    for _ in range(chance.randint(1, 5)):
        one, other = chance.randrange(len(parts)), chance.randrange(len(parts))
        parts[one], parts[other] = parts[other], parts[one]
    return bytearray(b"".join(parts))


def delimiters(data, chance):
    """Take another delimiter, from a place on or here and there."""
    before, after = chance.sample(DELIMITERS, 2)
    place = chance.randrange(len(data))
    if chance.random() < 0.5:
        return data[:place] + data[place:].replace(before, after)
    return data[:place] + data[place:].replace(before, after, chance.randint(1, 20))


def numbers(data, chance):
    """Mangle numbers in text, or bytes where there are none."""
    return _replaced(data, chance, MANGLED, (b"\0" * 4, b"\xff" * 4, b"\x01\0\0\0", b"\0\0\0\x01", b"\0" * 8))


def huge(data, chance):
    """Put huge numbers in place of others, as text or as binary fields."""
    return _replaced(data, chance, HUGE, HUGE_FIELDS)


def _replaced(data, chance, texts, fields):
    found = [match.span() for match in NUMBER.finditer(data)]
    is_text = data.count(0) == 0
    for _ in range(chance.randint(1, 4)):
        if is_text and found:
            start, stop = found.pop(chance.randrange(len(found)))
            found = [(low, high) for low, high in found if high <= start]
            data[start:stop] = chance.choice(texts)
        else:
            field = chance.choice(fields)
            place = chance.randrange(len(data)) // 4 * 4
            data[place : place + len(field)] = field
    return data


def zeros(data, chance):
    """Zeros from a place on, as a power failure leaves them."""
    return data[: chance.randrange(len(data))] + bytearray(chance.randint(1, 3000))


def noise(data, chance):
    """Any bytes, behind the marks that a file starts with or in their place."""
    return data[: chance.choice((0, 60))] + bytearray(chance.randbytes(chance.randint(0, 3000)))


KINDS = {
    kind.__name__: kind
    for kind in (zeros, noise, flips, head, truncation, deletion, repetition, junk, lines, delimiters, numbers, huge)
}


def damaged(content, kind, chance):
    """
    Damage a file's content.

    Of an archive one member is damaged half of the time, and packed again, since damage to packed bytes is found by
    their checksum; what lies behind that has to stand it, too.
    """
    if content.startswith(b"PK") and chance.random() < 0.5:
        return _with_a_damaged_member(content, kind, chance)
    return bytes(KINDS[kind](bytearray(content), chance)) if content else content


def _with_a_damaged_member(content, kind, chance):
    packed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as archive, zipfile.ZipFile(packed, "w") as written:
        chosen = chance.choice([name for name in archive.namelist() if archive.read(name)])
        for name in archive.namelist():
            member = archive.read(name)
            written.writestr(name, bytes(KINDS[kind](bytearray(member), chance)) if name == chosen else member)
    return packed.getvalue()
