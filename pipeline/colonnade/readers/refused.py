"""Formats that are not read here: recognised by how they start, and refused by name with what to do instead."""

from __future__ import annotations

import re
from collections.abc import Callable

from colonnade.readers.head import Head
from colonnade.readers.text.layout import header_claims

LINE_NUMBER = slice(72, 74)
"""Columns in which USC numbers the lines of its header."""

MDF = (
    "this is an ASAM MDF file, which is not read here. Export it as CSV or MATLAB (.mat), with names and units, from "
    "the recorder's program or with asammdf."
)
DAT = (
    "this is a DIAdem .DAT header, which is not read here. Save the data set from DIAdem as .TDM or .TDMS, or export "
    "it as CSV."
)
MARKS = {b"MDF     ": MDF, b"UnFinMF ": MDF, b"DIAEXTENDED": DAT, "\ufeffDIAEXTENDED".encode("utf-16-le"): DAT}
"""Sentences on the recorders' formats, by the bytes that their files start with."""

SPECTRA = re.compile(r"response (?:and|spectr)", re.IGNORECASE)


def foreign_format(head: Head) -> str:
    """
    Say which known format a file has that is not read here, and what to do; empty if it has none.

    Parameters
    ----------
    head : Head

    Returns
    -------
    reason : str
        Of a strong-motion record with what the header says of interval and unit, which an export has to keep.
    """
    if reason := next((reason for mark, reason in MARKS.items() if head.content.startswith(mark)), ""):
        return reason
    lines = head.lines
    if len(lines) < 2:
        return ""
    network = next((name for name, looks in NETWORKS.items() if looks(lines)), "")
    if not network:
        return ""
    if SPECTRA.search(lines[0]):
        return (
            f"this is a strong-motion file in the format of {network} with response spectra but no motion. Download "
            "volume 1 or 2 of the same record."
        )
    claims = header_claims("\n".join(lines))
    says = [f"an interval of {claims.step:g} s"] if claims.step else []
    says += [f"accelerations in {claims.unit}"] if claims.unit else []
    kept = f" Its header gives {' and '.join(says)}: keep these." if says else ""
    return _record(network) + kept


def _record(network: str) -> str:
    return (
        f"this is a strong-motion record in the format of {network}, which is not read here. Download the record "
        "as COSMOS V1 or V2, miniSEED or SAC if the network offers it; or convert it (gmprocess of the USGS reads this "
        "format), or export it as text with a column of times and one of accelerations, with names and units above."
    )


def retired(name: object) -> str:
    """What to export instead of a format that was read once, after a blank; empty for any other name."""
    reason = {"mdf": MDF, "bhrc": _record("BHRC (Iran)")}.get(str(name), "")
    return f" {reason[0].upper()}{reason[1:]}" if reason else ""


def _starts(pattern: str) -> Callable[[list[str]], bool]:
    """Whether the first line starts so, whatever its case."""
    expression = re.compile(pattern, re.IGNORECASE)
    return lambda lines: expression.match(lines[0]) is not None


def _holds(pattern: str, within: int) -> Callable[[list[str]], bool]:
    """Whether one of the first lines holds a text, whatever its case."""
    expression = re.compile(pattern, re.IGNORECASE)
    return lambda lines: any(expression.search(line) for line in lines[:within])


def _is_usc(lines: list[str]) -> bool:
    """USC writes the words of CSMIP and numbers the lines of its header."""
    numbered = sum(line[LINE_NUMBER].strip().isdigit() for line in lines[3:11])
    return numbered >= 7 and _holds(r"corrected accelerogram", 2)(lines)


def _is_csmip(lines: list[str]) -> bool:
    """The first line names the volume; from volume 2 on the lines below repeat those of the volumes it is made of."""
    first, below = lines[0].casefold(), " ".join(lines[1:3]).casefold()
    if "uncorrected accelerogram data" in first:
        return True
    return ("corrected accelerogram" in first or SPECTRA.search(first) is not None) and "accelerogram" in below


def _is_smc(lines: list[str]) -> bool:
    """A number and the kind of the file, or an asterisk there and on line 11."""
    if re.fullmatch(r"\s*\d\s+(?:un)?corrected accelerogram\s*", lines[0], re.IGNORECASE):
        return True
    kind = re.fullmatch(r"\s*(?:\*|\d\s+(?:velocity|displacement|response spectr\w+))\s*", lines[0], re.IGNORECASE)
    return kind is not None and len(lines) > 10 and lines[10].strip().startswith("*")


def _is_esm(lines: list[str]) -> bool:
    """Lines of `KEY: value`."""
    return lines[0].startswith("EVENT_NAME:") and any(line.startswith("SAMPLING_INTERVAL_S:") for line in lines)


NETWORKS: dict[str, Callable[[list[str]], bool]] = {
    "BHRC (Iran)": _starts(r"\* VOL\w*\s+FILE:"),
    "SMC (United States Geological Survey)": _is_smc,
    "USC (University of Southern California)": _is_usc,
    "GeoNet (New Zealand)": _starts(r".*corrected accelerogram.*(?:GNS|Geological (?:&|and) Nuclear)\b"),
    "CSMIP/DMG (California Strong Motion Instrumentation Program)": _is_csmip,
    "ESM/ITACA (DYNA, Engineering Strong Motion database)": _is_esm,
    "CWA/CWB (Central Weather Administration of Taiwan)": _starts(r"#\s*(?:Earthquake Information|StationCode)"),
    "NSMN/AFAD (Turkey)": _starts(r".*STRONG GROUND MOTION RECORDS? OF T"),
    "UNAM (Mexico, Archivo Estándar de Aceleración)": _holds(r"ARCHIVO EST.{1,2}NDAR DE ACELERACI", 12),
    "RENADIC (Universidad de Chile)": _holds(r"UNIVERSIDAD DE CHILE\s*-\s*RENADIC", 12),
}
"""Common name, and the test on the lines of the head; in this order, as USC writes more than CSMIP."""
