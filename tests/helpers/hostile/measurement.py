"""Hostile files of measurement systems: TDMS, DIAdem."""

from hostile.place import COUNTS, SECRET, Hostile


def tdms_index(place):
    """npTDMS: has the index of another file beside it, and text, timestamps and a property."""
    from nptdms import ChannelObject, TdmsWriter

    path = place.folder / "r.tdms"
    with TdmsWriter(path) as writer:
        values = {"wf_increment": 0.01, "unit_string": "mm", "description": "__import__('os')"}
        writer.write_segment([ChannelObject("g", "a", COUNTS.copy(), values), ChannelObject("g", "s", ["a", "b"], {})])
    other = place.secrets / "other.tdms"
    with TdmsWriter(str(other), index_file=True) as writer:
        writer.write_segment([ChannelObject("g", "other", SECRET.copy(), {})])
    (place.secrets / "other.tdms_index").rename(place.folder / "r.tdms_index")
    return Hostile(path)


def diadem_entity(place):
    """expat, in the header of a DIAdem data set: an entity that is another file."""
    path = place.folder / "r.TDM"
    secret = (place.secrets / "secret.txt").as_uri()
    path.write_text(
        f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY s SYSTEM "{secret}">]><usi:tdm xmlns:usi="x"><usi:data>'
        "<tdm_channel><name>&s;</name></tdm_channel></usi:data></usi:tdm>",
        encoding="utf-8",
    )
    return Hostile(path)


def diadem_elsewhere(place):
    """Own parser of DIAdem: values in a file elsewhere."""
    path = place.folder / "elsewhere.TDM"
    files, channels = "", ""
    for number, file in enumerate((str(place.secrets / "secret"), "../secrets/secret")):
        files += f'<file byteOrder="littleEndian" url="{file}"><block byteOffset="0" id="i{number}" length="100" '
        files += 'valueType="eInt32Usi"/></file>'
        channels += f'<tdm_channel id="c{number}"><local_columns>id("l{number}")</local_columns></tdm_channel>'
        channels += f'<localcolumn id="l{number}"><values>id("s{number}")</values></localcolumn>'
        channels += f'<long_sequence id="s{number}"><values external="i{number}"/></long_sequence>'
    path.write_text(
        f'<?xml version="1.0"?><usi:tdm xmlns:usi="x"><usi:include>{files}</usi:include>'
        f"<usi:data>{channels}</usi:data></usi:tdm>",
        encoding="utf-8",
    )
    return Hostile(path)
