"""Workbooks of Excel, Excel 97 and OpenDocument, with a table of names, units and samples or other rows."""

from __future__ import annotations

import datetime as dt
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
import xlwt

HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>'
MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
OPEN_DOCUMENT = "urn:oasis:names:tc:opendocument"
DATE_STYLE = 1

ROWS = [["Versuch 7", 26.4], [], ["Zeit", "Weg oben", "Beschl."], ["s", "mm", "g"]]
SAMPLES = [[k * 0.005, float(np.sin(k / 9)), k / 10] for k in range(50)]


def letters(column: int) -> str:
    return (letters(column // 26 - 1) if column >= 26 else "") + chr(65 + column % 26)


def cell(value: Any, reference: str) -> str:
    if isinstance(value, dt.datetime):
        days = (value - dt.datetime(1899, 12, 30)) / dt.timedelta(days=1)
        return f'<c r="{reference}" s="{DATE_STYLE}"><v>{days!r}</v></c>'
    if isinstance(value, str) and value.startswith("="):
        formula, _, cached = value[1:].partition("→")
        return f'<c r="{reference}"><f>{escape(formula)}</f><v>{cached}</v></c>'
    if isinstance(value, str):
        return f'<c r="{reference}" t="inlineStr"><is><t>{escape(value)}</t></is></c>'
    return f'<c r="{reference}"><v>{value!r}</v></c>'


def sheet_xml(rows: Sequence[Sequence[Any]]) -> str:
    body = []
    for number, row in enumerate(rows, 1):
        cells = [cell(value, f"{letters(k)}{number}") for k, value in enumerate(row) if value is not None]
        body.append(f'<row r="{number}">{"".join(cells)}</row>')
    return f'<worksheet xmlns="{MAIN}"><sheetData>{"".join(body)}</sheetData></worksheet>'


def xlsx(path: Path, **sheets: Sequence[Sequence[Any]] | str) -> Path:
    """Write a workbook of the sheets that are given, as rows or in XML."""
    listed = "".join(f'<sheet name="{name}" sheetId="{k}" r:id="worksheet{k}"/>' for k, name in enumerate(sheets, 1))
    styles = '<cellXfs><xf numFmtId="0"/><xf numFmtId="22"/></cellXfs>'
    targets = {f"worksheet{k}": f"worksheets/sheet{k}.xml" for k in range(1, len(sheets) + 1)}
    members = {
        "[Content_Types].xml": f'<Types xmlns="{PACKAGE}/content-types"/>',
        "_rels/.rels": related({"officeDocument": "xl/workbook.xml"}),
        "xl/workbook.xml": f'<workbook xmlns="{MAIN}" xmlns:r="{RELATIONS}"><sheets>{listed}</sheets></workbook>',
        "xl/_rels/workbook.xml.rels": related({**targets, "styles": "styles.xml"}),
        "xl/styles.xml": f'<styleSheet xmlns="{MAIN}">{styles}</styleSheet>',
    }
    for target, sheet in zip(targets.values(), sheets.values(), strict=True):
        members[f"xl/{target}"] = sheet if isinstance(sheet, str) else sheet_xml(sheet)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, HEAD + content)
    return path


def related(targets: dict[str, str]) -> str:
    """Refer to parts of a workbook, each by its kind and number."""
    links = [
        f'<Relationship Id="{key}" Type="{RELATIONS}/{key.rstrip("0123456789")}" Target="{target}"/>'
        for key, target in targets.items()
    ]
    return f'<Relationships xmlns="{PACKAGE}/relationships">{"".join(links)}</Relationships>'


def ods(path: Path, rows: Sequence[Sequence[Any]], *, head: str = HEAD) -> Path:
    body = ""
    for row in rows:
        body += "<table:table-row>"
        for value in row:
            if isinstance(value, str):
                body += f'<table:table-cell office:value-type="string"><text:p>{value}</text:p></table:table-cell>'
            else:
                body += f'<table:table-cell office:value-type="float" office:value="{value!r}"/>'
        body += "</table:table-row>"
    names = "".join(f' xmlns:{name}="{OPEN_DOCUMENT}:xmlns:{name}:1.0"' for name in ("office", "table", "text"))
    content = (
        f"<office:document-content{names}><office:body><office:spreadsheet>"
        f'<table:table table:name="Blatt">{body}</table:table>'
        "</office:spreadsheet></office:body></office:document-content>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("META-INF/manifest.xml", "<manifest/>")
        archive.writestr("content.xml", head + content, zipfile.ZIP_DEFLATED)
    return path


def xls(path: Path, rows: Sequence[Sequence[Any]]) -> Path:
    book = xlwt.Workbook()
    sheet = book.add_sheet("Blatt")
    for number, row in enumerate(rows):
        for column, value in enumerate(row):
            sheet.write(number, column, value)
    book.save(str(path))
    return path
