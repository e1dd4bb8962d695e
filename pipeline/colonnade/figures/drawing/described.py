"""What a campaign file, or the draft of one, says of specimens and transducers, as it is drawn."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from colonnade import units
from colonnade.campaign import Campaign
from colonnade.campaign.assembly import Whole
from colonnade.campaign.channel import Channel
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.errors import CampaignError, UnitError, count
from colonnade.figures.drawing.body import words_of_angle
from colonnade.figures.drawing.setup import Drawn, setup_drawings
from colonnade.figures.drawing.view import MARKER, Body, Point, Rocking, Transducer
from colonnade.figures.files.output import Picture
from colonnade.units.text import listed, quantity

SIGNS = (
    "● displacement  ■ acceleration",
    "△ velocity  ◆ rotation: its axis",
    "blue: relative to the table",
    "orange: relative to the ground",
    "⊙ towards the viewer, ⊗ away",
)
"""What the marks of a drawing mean."""

STAND_IN = Body("rectangle", (0.1, 0.1), (0.1, 0.1), 0.5, is_known=False, rocking=None)
"""Body of a draft, in which no dimension is known yet."""


def drawn_of(campaign: Campaign, specimen: str, setup: str) -> Drawn:
    """Describe a specimen with the transducers of a setup."""
    whole, markers = campaign.specimens[specimen], campaign.setups[setup].markers
    channels = campaign.channels_in(specimen, setup)
    if isinstance(whole, Whole):
        body = _several(whole, campaign.gravity)
        channels = {name: _in_place(campaign.setups[setup].channels[name], body) for name in channels}
    else:
        body = body_of(whole, campaign.block(specimen))
    followed = {f"{name}_{axis}" for name in markers for axis in "xyz"}
    transducers = [transducer_of(name, each) for name, each in channels.items() if name not in followed]
    # A marker is one point, which is followed along three axes.
    seen = {name: channels[f"{name}_x"] for name in markers if f"{name}_x" in channels}
    transducers += [transducer_of(name, each)._replace(quantity=MARKER, direction=None) for name, each in seen.items()]
    shown = [each for each in transducers if each.on]
    others = [each.name for each in transducers if not each.on]
    words = [*body.words, "", *SIGNS]
    if any(each.at is None for each in shown if each.on == "specimen"):
        words += ["hollow: place not given"]
    if others:
        words += [f"not drawn: {listed(others)}"]
    return Drawn(f"{specimen} in {setup}", body._replace(words=words), shown)


def picture(campaign: Campaign, specimen: str, setup: str) -> Picture:
    """Draw a specimen with the transducers of a setup."""
    figure = setup_drawings([drawn_of(campaign, specimen, setup)])
    title = f"Specimen {specimen} and the transducers of {setup}, to scale"
    return Picture(figure, f"setup-{specimen}-{setup}", title, said_of(campaign, specimen, setup))


def said_of(campaign: Campaign, specimen: str, setup: str) -> str:
    """Say what the drawing of a specimen with the transducers of a setup shows."""
    drawn = drawn_of(campaign, specimen, setup)
    body = [word for word in drawn.body.words if word and word not in SIGNS]
    return " ".join(f"{part}." for part in (*body, *(f"{each.name}: {_said(each)}" for each in drawn.transducers)))


def of_campaign(campaign: Campaign) -> Picture:
    """
    Draw every specimen with the transducers of every setup that a test combines it with.

    Raises
    ------
    CampaignError
        If there is no test.
    """
    if not campaign.combinations:
        raise CampaignError(f"{campaign.path}: the campaign has no test, so no specimen is in a set-up to be drawn.")
    drawn = [drawn_of(campaign, *pair) for pair in campaign.combinations]
    said = " ".join(f"{each.title}: {count(len(each.transducers), 'transducer')}." for each in drawn)
    return Picture(setup_drawings(drawn), "drawing", f"Specimens and transducers of {campaign.title}, to scale", said)


def body_of(specimen: Specimen, block: Block) -> Body:
    """Describe a specimen; one without dimensions is drawn from pole to pole, twice as high as its centre of mass."""
    rocking, sizes = Rocking.of(block), specimen.sizes()
    height = sizes.get("height", 2 * rocking.centre[1])
    base = sizes.get("width", sizes.get("diameter", sizes.get("base_diameter", rocking.poles[1] - rocking.poles[0])))
    top, depth = sizes.get("top_diameter", base), sizes.get("depth")
    words = [
        f"{specimen.shape}, {quantity(specimen.mass, 'kg', 4)}",
        *(
            f"α = {words_of_angle(angle)}{side}"
            for angle, side in _sides(block.negative.critical_angle, block.positive.critical_angle)
        ),
        *(
            f"R = {quantity(distance, 'mm', 4)}{side}"
            for distance, side in _sides(block.negative.pole_distance, block.positive.pole_distance)
        ),
        f"⊕ centre of mass, {quantity(rocking.centre[1], 'mm', 4)} up",
        "▲ poles: −x θ < 0, +x θ > 0",
    ]
    if not sizes:
        words += ["outline not known: drawn from pole to pole, twice as high as ⊕, as deep as wide"]
    return Body(
        "circle" if specimen.radius(0.0) is not None else "rectangle",
        (base, top),
        (depth or base, depth or top),
        height,
        is_known=bool(sizes),
        rocking=rocking,
        words=words,
    )


def _several(whole: Whole, gravity: float) -> Body:
    """Describe the bodies of an assembly where they stand."""
    assembly = whole.assembly(gravity)
    parts = {
        name: (body_of(whole.made[name], placed.block), (*placed.position, assembly.levels[name]))
        for name, placed in assembly.bodies.items()
    }
    width, depth = (
        2 * max(abs(place[axis]) + max(getattr(part, size)) / 2 for part, place in parts.values())
        for axis, size in enumerate(("width", "depth"))
    )
    words = [f"{count(len(parts), 'body', 'bodies')}, {quantity(whole.mass, 'kg', 4)}"]
    words += [f"{name}: {whole.placed[name].specimen}" for name in reversed(parts)]
    return Body(
        "rectangle",
        (width, width),
        (depth, depth),
        assembly.height,
        is_known=True,
        rocking=None,
        words=words,
        parts=parts,
    )


def _in_place(channel: Channel, body: Body) -> Channel:
    """Return a channel with its place from the base of all bodies, if it is on one of them."""
    if channel.on is None or channel.on not in body.parts:
        return channel
    there = body.parts[channel.on][1]
    at = None if channel.at is None else tuple(own + each for own, each in zip(channel.at, there, strict=True))
    return channel.model_copy(update={"on": "specimen", "at": at})


def _sides(negative: float, positive: float) -> list[tuple[float, str]]:
    return [(negative, "")] if negative == positive else [(negative, ", θ < 0"), (positive, ", θ > 0")]


def transducer_of(name: str, channel: Channel) -> Transducer:
    """Describe a channel; one that is fixed to nothing is `on` nothing."""
    return Transducer(
        name,
        channel.quantity,
        channel.on or "",
        channel.direction,
        channel.at,
        channel.relative_to or "",
        channel.normal,
        channel.anchor,
        is_laser=channel.sensing == "surface",
    )


def _said(one: Transducer) -> str:
    """Say where a transducer is and what it reads, for those who do not see it."""
    place = "" if one.at is None else f" at ({', '.join(f'{1e3 * part:.4g}' for part in one.at)}) mm"
    direction = (
        "" if one.direction is None else f", positive along ({', '.join(f'{part:.3g}' for part in one.direction)})"
    )
    relative = f", relative to the {one.relative_to}" if one.relative_to else ""
    return f"{one.quantity.replace('_', ' ')} of the {one.on}{place}{direction}{relative}"


def of_draft(text: str) -> Picture:
    """
    Draw what a drafted campaign file guesses of transducers, on a body that stands in for the specimen.

    Parameters
    ----------
    text : str
        Of the file, in which "?" stands for what is not known.
    """
    setups = tomllib.loads(text)["setups"]
    words = ["dimensions and places are asked for in campaign.toml; hollow: not yet placed", "", *SIGNS]
    drawn = [
        Drawn(
            f"{name}, as drafted",
            STAND_IN._replace(words=words),
            [_drafted(channel, keys) for channel, keys in setup["channels"].items() if keys.get("on", "?") != "?"],
        )
        for name, setup in setups.items()
    ]
    said = (
        "Directions of positive readings as guessed; the specimen stands in for one whose dimensions are not known yet."
    )
    return Picture(setup_drawings(drawn), "drawing", "Transducers of the drafted campaign file", said)


def _drafted(name: str, keys: Mapping[str, Any]) -> Transducer:
    relative, direction = str(keys.get("relative_to", "")), keys.get("direction")
    return Transducer(
        name,
        str(keys["quantity"]).replace("?", "other"),
        str(keys["on"]),
        None if direction is None else (float(direction[0]), float(direction[1]), float(direction[2])),
        _place(keys.get("at")),
        "" if relative == "?" else relative,
        anchor=_place(keys.get("anchor")),
        is_laser=keys.get("sensing") == "surface",
    )


def _place(written: object) -> Point | None:
    if not isinstance(written, list):
        return None
    try:
        x, y, z = (units.to_si(str(part), "length") for part in written)
    except (UnitError, ValueError):
        return None
    return x, y, z
