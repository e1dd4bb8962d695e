"""What a campaign file, or the draft of one, says of specimens and transducers, as it is drawn."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any, Literal

from colonnade import units
from colonnade.campaign import Campaign
from colonnade.campaign.assembly import Whole
from colonnade.campaign.channel import Channel
from colonnade.campaign.specimen import ROUND, Specimen
from colonnade.dynamics.block import Block
from colonnade.errors import CampaignError, UnitError, count
from colonnade.figures.drawing.body import words_of_angle
from colonnade.figures.drawing.setup import MARKER, Drawn, setup_drawings
from colonnade.figures.drawing.view import Body, Point, Rocking
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
    transducers = {name: each for name, each in channels.items() if name not in followed}
    for name in markers:  # one point, which is followed along three axes
        if f"{name}_x" in channels:
            transducers[name] = channels[f"{name}_x"].model_copy(update={"quantity": MARKER, "direction": None})
    shown = {name: each for name, each in transducers.items() if each.on}
    words = [*body.words, "", *SIGNS]
    if any(each.at is None for each in shown.values() if each.on == "specimen"):
        words += ["hollow: place not given"]
    if len(shown) < len(transducers):
        words += [f"not drawn: {listed([name for name in transducers if name not in shown])}"]
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
    return " ".join(
        f"{part}." for part in (*body, *(f"{name}: {_said(each)}" for name, each in drawn.transducers.items()))
    )


def of_campaign(campaign: Campaign) -> Picture:
    """Draw every specimen with the transducers of every setup that a test combines it with."""
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
    sides = block.negative, block.positive
    angles = _sides(*(words_of_angle(side.critical_angle) for side in sides))
    distances = _sides(*(quantity(side.pole_distance, "mm", 4) for side in sides))
    words = [
        f"{specimen.shape}, {quantity(specimen.mass, 'kg', 4)}",
        *(f"α = {angle}" for angle in angles),
        *(f"R = {distance}" for distance in distances),
        f"⊕ centre of mass, {quantity(rocking.centre[1], 'mm', 4)} up",
        "▲ poles: −x θ < 0, +x θ > 0",
    ]
    if not sizes:
        words += ["outline not known: drawn from pole to pole, twice as high as ⊕, as deep as wide"]
    shape: Literal["rectangle", "circle"] = "circle" if specimen.shape in ROUND else "rectangle"
    return Body(shape, (base, top), (depth or base, depth or top), height, bool(sizes), rocking, words)


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
    return Body("rectangle", (width, width), (depth, depth), assembly.height, True, None, words, parts)


def _in_place(channel: Channel, body: Body) -> Channel:
    """Return a channel with its place from the base of all bodies, if it is on one of them."""
    if channel.on is None or channel.on not in body.parts:
        return channel
    there = body.parts[channel.on][1]
    at = None if channel.at is None else tuple(own + each for own, each in zip(channel.at, there, strict=True))
    return channel.model_copy(update={"on": "specimen", "at": at})


def _sides(negative: str, positive: str) -> list[str]:
    return [negative] if negative == positive else [f"{negative}, θ < 0", f"{positive}, θ > 0"]


def _said(one: Channel) -> str:
    """Say where a transducer is and what it reads, for those who do not see it."""
    place = "" if one.at is None else f" at ({', '.join(f'{1e3 * part:.4g}' for part in one.at)}) mm"
    direction = ", ".join(f"{part:.3g}" for part in one.direction or ())
    along = f", positive along ({direction})" if direction else ""
    relative = f", relative to the {one.relative_to}" if one.relative_to else ""
    return f"{one.quantity.replace('_', ' ')} of the {one.on}{place}{along}{relative}"


def of_draft(text: str) -> Picture:
    """Draw what a drafted file, in which "?" is not known, guesses of transducers, on a body that stands in."""
    setups = {name: setup.get("channels", {}) for name, setup in tomllib.loads(text)["setups"].items()}
    words = ["dimensions and places are asked for in campaign.toml; hollow: not yet placed", "", *SIGNS]
    drawn = [
        Drawn(
            f"{name}, as drafted",
            STAND_IN._replace(words=words),
            {channel: _drafted(keys) for channel, keys in channels.items() if keys.get("on", "?") != "?"},
        )
        for name, channels in setups.items()
    ]
    said = (
        "Directions of positive readings as guessed; the specimen stands in for one whose dimensions are not known yet."
    )
    return Picture(setup_drawings(drawn), "drawing", "Transducers of the drafted campaign file", said)


def _drafted(keys: Mapping[str, Any]) -> Channel:
    """Return what is known of a channel, unchecked."""
    relative = keys.get("relative_to")
    return Channel.model_construct(
        quantity=keys["quantity"].replace("?", "other"),
        on=keys["on"],
        direction=keys.get("direction"),
        at=_place(keys.get("at")),
        relative_to=None if relative == "?" else relative,
        anchor=_place(keys.get("anchor")),
        sensing=keys.get("sensing", "point"),
    )


def _place(written: object) -> Point | None:
    if not isinstance(written, list):
        return None
    try:
        x, y, z = (units.to_si(str(part), "length") for part in written)
    except (UnitError, ValueError):
        return None
    return x, y, z
