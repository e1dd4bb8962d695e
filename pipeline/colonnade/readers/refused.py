"""Formats that are not read here: recognised by how they start, and refused by name with what to do instead."""

from __future__ import annotations

import re

from colonnade.readers.head import Head

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

NETWORKS = {
    "BHRC (Iran)": r"\* VOL\w*\s+FILE:",
    # A number and the kind of the file; or an asterisk there, and on line 11.
    "SMC (United States Geological Survey)": r"\s*\d\s+(?:un)?corrected accelerogram\s*\n"
    r"|\s*(?:\*|\d\s+(?:velocity|displacement|response spectr\w+))\s*\n(?:.*\n){9}\s*\*",
    # USC writes the words of CSMIP, and numbers the lines of its header in columns 73 and 74.
    "USC (University of Southern California)": r"(?=(?:.*\n)?.*corrected accelerogram)"
    r"(?:.*\n){3,4}(?:.{72}(?:[ \d]\d|\d ).*\n){7}",
    "GeoNet (New Zealand)": r".*corrected accelerogram.*(?:GNS|Geological (?:&|and) Nuclear)\b",
    # From volume 2 on the lines below the first repeat those of the volumes that it is made of.
    "CSMIP/DMG (California Strong Motion Instrumentation Program)": r".*uncorrected accelerogram data"
    r"|.*(?:corrected accelerogram|response (?:and|spectr)).*\n(?:.*\n)?.*accelerogram",
    "ESM/ITACA (DYNA, Engineering Strong Motion database)": r"EVENT_NAME:(?:.*\n)+?SAMPLING_INTERVAL_S:",
    "CWA/CWB (Central Weather Administration of Taiwan)": r"#\s*(?:Earthquake Information|StationCode)",
    "NSMN/AFAD (Turkey)": r".*STRONG GROUND MOTION RECORDS? OF T",
    "UNAM (Mexico, Archivo Estándar de Aceleración)": r"(?:.*\n){0,11}.*ARCHIVO EST.{1,2}NDAR DE ACELERACI",
    "RENADIC (Universidad de Chile)": r"(?:.*\n){0,11}.*UNIVERSIDAD DE CHILE\s*-\s*RENADIC",
}
"""Networks by name, and how the head of their files starts whatever its case; USC before CSMIP, whose words it has."""


def foreign_format(head: Head) -> str:
    """Say which known format a file has that is not read here, and what to do; empty if it has none."""
    if reason := next((reason for mark, reason in MARKS.items() if head.content.startswith(mark)), ""):
        return reason
    text = "\n".join(line[:200] for line in head.lines)
    network = next((name for name, start in NETWORKS.items() if re.match(start, text, re.IGNORECASE)), "")
    return _record(network) if network else ""


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
