"""Names that must exist and ids that must differ: checked on the file as written, so that all are reported at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from colonnade.campaign.channel import MAIN
from colonnade.campaign.syntax.fields import shown
from colonnade.campaign.syntax.identifier import clashes
from colonnade.campaign.syntax.places import Place
from colonnade.errors import nearest

Problem = tuple[Place, str]


def dangling(document: Mapping[str, Any]) -> Iterator[Problem]:
    """
    Find names that refer to nothing and ids that clash.

    Parameters
    ----------
    document : mapping
        The campaign file as written; anything may have the wrong type, which is reported elsewhere.

    Yields
    ------
    problem : (place, str)
    """
    specimens, setups = _table(document.get("specimens")), _table(document.get("setups"))
    yield from _clashing(("specimens",), specimens)
    yield from _clashing(("setups",), setups)
    for name, setup in setups.items():
        yield from _setup(("setups", name), _table(setup))
    tests = document.get("tests")
    listed = tests if isinstance(tests, list) else []
    yield from _assessments(_table(document.get("assessments")), _table(document.get("prototype")), specimens)
    yield from _tests(listed, specimens, setups)
    yield from _faces(listed, specimens, setups)


def _table(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _clashing(place: Place, table: Mapping[str, Any], *, as_variables: bool = False) -> Iterator[Problem]:
    for _, name, earlier in clashes(table, as_variables=as_variables):
        same = "case or in '.', '-' and '_'" if as_variables else "upper and lower case"
        yield (*place, name), f'This id differs from "{earlier}" only in {same}. Choose another.'


def _setup(place: Place, setup: Mapping[str, Any]) -> Iterator[Problem]:
    channels, recorders = _table(setup.get("channels")), _table(setup.get("recorders"))
    yield from _clashing((*place, "channels"), channels, as_variables=True)
    yield from _clashing((*place, "recorders"), recorders)
    for name, channel in channels.items():
        recorder = _table(channel).get("recorder", MAIN)
        if isinstance(recorder, str) and recorder not in {MAIN, *recorders}:
            hint = nearest(recorder, [MAIN, *recorders])
            yield (*place, "channels", name, "recorder"), f"Unknown recorder {shown(recorder)} in this set-up.{hint}"
    for name, recorder in recorders.items():
        named = _table(_table(recorder).get("clock")).get("align")
        if isinstance(named, list) and len(named) == 2:
            for channel, owner in zip(named, (MAIN, name), strict=True):
                yield from _aligned((*place, "recorders", name, "clock", "align"), channel, owner, channels)


def _aligned(place: Place, channel: object, owner: str, channels: Mapping[str, Any]) -> Iterator[Problem]:
    if not isinstance(channel, str):
        return
    own = [name for name, each in channels.items() if _table(each).get("recorder", MAIN) == owner]
    if channel not in channels:
        yield place, f"Unknown channel {shown(channel)} in this set-up.{nearest(channel, own)}"
    elif channel not in own:
        yield place, f'{shown(channel)} is not a channel of recorder "{owner}".{nearest(channel, own)}'


def _assessments(
    assessments: Mapping[str, Any], prototypes: Mapping[str, Any], specimens: Mapping[str, Any]
) -> Iterator[Problem]:
    yield from _clashing(("assessments",), assessments)
    for name in prototypes:
        if name not in specimens:
            yield ("prototype", name), f"Unknown specimen {shown(name)}.{nearest(name, specimens)}"
    for name, assessment in assessments.items():
        specimen = _table(assessment).get("specimen")
        if not isinstance(specimen, str):
            continue
        place = ("assessments", name, "specimen")
        if specimen not in specimens:
            yield place, f"Unknown specimen {shown(specimen)}.{nearest(specimen, specimens)}"
        elif specimen not in prototypes:
            yield (
                place,
                f"[prototype.{specimen}] is missing. It says what is assumed of the real column; its `restitution` at "
                'least was expected: a number, "rigid-body", or "identified" to take that of the model.',
            )


def _tests(tests: list[Any], specimens: Mapping[str, Any], setups: Mapping[str, Any]) -> Iterator[Problem]:
    ids = [
        test.get("id") if isinstance(_table(test).get("id"), str) else f"\0{index}" for index, test in enumerate(tests)
    ]
    for index, name, earlier in clashes(ids):
        same = (
            "This id is used twice" if name == earlier else f'It differs from "{earlier}" only in upper and lower case'
        )
        yield ("tests", index, "id"), f"{shown(name)}: {same}. Give every test its own id."
    for index, test in enumerate(map(_table, tests)):
        for key, known in (("specimen", specimens), ("setup", setups)):
            called = test.get(key)
            if isinstance(called, str) and called not in known:
                yield ("tests", index, key), f"Unknown {key} {shown(called)}.{nearest(called, known)}"
        setup = _table(setups.get(test["setup"])) if isinstance(test.get("setup"), str) else {}
        if setup:
            recorders = [MAIN, *_table(setup.get("recorders"))]
            for recorder in _table(test.get("file")):
                if recorder not in recorders:
                    hint = nearest(recorder, recorders)
                    yield (
                        ("tests", index, "file", recorder),
                        f'Unknown recorder in set-up "{test["setup"]}".{hint}',
                    )


def _faces(tests: list[Any], specimens: Mapping[str, Any], setups: Mapping[str, Any]) -> Iterator[Problem]:
    """Find transducers that look at the face of a specimen that is not round, without its normal."""
    found = set()
    for test in map(_table, tests):
        setup_name, specimen_name = test.get("setup"), test.get("specimen")
        if not isinstance(setup_name, str) or not isinstance(specimen_name, str):
            continue
        if _table(specimens.get(specimen_name)).get("shape") not in ("prism", "measured"):
            continue
        for name, channel in _table(_table(setups.get(setup_name)).get("channels")).items():
            place = ("setups", setup_name, "channels", name, "normal")
            if _table(channel).get("sensing") == "surface" and "normal" not in channel and place not in found:
                found.add(place)
                yield (
                    place,
                    f'It is missing. Specimen "{specimen_name}" is not round, so a "surface" transducer '
                    "needs the outward normal of the face that it looks at, such as [1, 0, 0].",
                )
