"""Hostile text and workbooks."""

import pickle
import zipfile

from hostile.place import TIME, Hostile, Program


def pickle_as_text(place):
    """A pickle by the name of a text file: runs a program."""
    path = place.folder / "r.csv"
    path.write_bytes(pickle.dumps(Program(place.victim), protocol=0))
    return Hostile(path)


def workbook_entity(place):
    """calamine: an entity that is another file, and one that swells."""
    path = place.folder / "r.xlsx"
    spread = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))
    secret = (place.secrets / "secret.txt").as_uri()
    main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    package = "http://schemas.openxmlformats.org/package/2006/relationships"
    rows = "".join(f'<row r="{n}"><c r="A{n}"><v>{n}</v></c><c r="B{n}"><v>&s;&e9;</v></c></row>' for n in range(1, 50))
    sheet = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{secret}"><!ENTITY e0 "1">{spread}]>'
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr(
            "_rels/.rels",
            f'<Relationships xmlns="{package}"><Relationship Id="r0" Type="{relations}/officeDocument" '
            'Target="xl/workbook.xml"/></Relationships>',
        )
        archive.writestr(
            "xl/workbook.xml",
            f'<workbook xmlns="{main}" xmlns:r="{relations}"><sheets><sheet name="a" sheetId="1" r:id="r1"/></sheets>'
            "</workbook>",
        )
        archive.writestr(
            "xl/_rels/workbook.xml.rels",
            f'<Relationships xmlns="{package}"><Relationship Id="r1" Type="{relations}/worksheet" '
            'Target="worksheets/sheet1.xml"/></Relationships>',
        )
        text = f'{sheet}<worksheet xmlns="{main}"><sheetData>{rows}</sheetData></worksheet>'
        archive.writestr("xl/worksheets/sheet1.xml", text)
    return Hostile(path)


def open_document_entity(place):
    """calamine, OpenDocument: an entity that is another file."""
    path = place.folder / "r.ods"
    secret = (place.secrets / "secret.txt").as_uri()
    content = (
        f'<!DOCTYPE x [<!ENTITY s SYSTEM "{secret}">]><office:document-content '
        'xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" '
        'xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" '
        'xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"><office:body><office:spreadsheet>'
        '<table:table table:name="a"><table:table-row><table:table-cell office:value-type="string"><text:p>&s;</text:p>'
        "</table:table-cell></table:table-row></table:table></office:spreadsheet></office:body></office:document-content>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", content)
    return Hostile(path)


def workbook_of_97(place):
    """calamine, Excel 97: sound, to be damaged."""
    import xlwt

    path = place.folder / "r.xls"
    book = xlwt.Workbook()
    sheet = book.add_sheet("a")
    for row, value in enumerate(TIME):
        sheet.write(row, 0, float(value))
        sheet.write(row, 1, xlwt.Formula(f"A{row + 1}*2"))
    book.save(str(path))
    return Hostile(path)


def text_formulas(place):
    """pandas and own parsers of text: cells, names and units that are programs."""
    path = place.folder / "r.txt"
    program = f"__import__('os').mkdir('{place.victim}')"
    units = ["9**9**9**9", "m^9^9^9^9", "@" + str(place.secrets / "secret.txt")]
    rows = [f"{n};{n * 0.5};=1+1;{program if n == 20 else n}" for n in range(200)]
    path.write_text("\n".join([f"t [s];a [{units[0]}];b [{units[1]}];c [{units[2]}]", *rows, ""]), encoding="utf-8")
    return Hostile(path)
