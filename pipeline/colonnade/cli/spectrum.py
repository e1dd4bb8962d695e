"""`colonnade spectrum`: the rocking spectrum of a motion, or the overturning spectrum of a pulse, for a column."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click
from click import get_current_context
from click.core import ParameterSource

from colonnade.cli.common.console import say, show_fields, show_json, show_table
from colonnade.cli.common.options import (
    CAMPAIGN,
    MODEL,
    LateChoice,
    campaign_argument,
    column_options,
    json_option,
    plane_models,
    results_option,
)

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.store.layout import Layout
    from colonnade.workflow.spectrum import Overturning, Rocking

OF_MOTION = ("unit", "interval", "column", "peak", "baseline", "drift", "slenderness", "periods")
OF_PULSE = ("omega", "cycles", "phase", "largest", "least_width")
"""Options that say nothing with the other of --motion and --pulse, and are refused there."""

SHAPE = ("cycles", "phase")
"""Those of one pulse alone."""


def _pulses() -> Iterable[str]:
    from colonnade.dynamics.pulses import PULSES

    return PULSES


@click.command(
    epilog='Example: colonnade spectrum --motion record.AT2 --shape prism --width "1 m" --height "5 m"',
    help=f"""
    Show what a base motion or a pulse does to a column.

    --motion gives the rocking spectrum of a motion: the largest angle over the size of blocks as slender as the column,
    with the intensity measures of the motion. --pulse gives the overturning spectrum of a pulse: the amplitudes from
    which it overturns the column, and up to which it may not, over frequency.

    The column is a specimen of CAMPAIGN, or is given by --shape and its sizes, or by --critical-angle and --p; then no
    campaign is needed. A specimen has the e that its predictions use. Of the real column, or with another α or p, say
    it: by --restitution or [prototype.ID].
    {CAMPAIGN}
    """,
)
@campaign_argument
@click.option("--motion", metavar="FILE|NAME", help="A file, a test that recorded it, or one of [motions].")
@click.option("--pulse", type=LateChoice(_pulses), help="Kind of pulse.")
@column_options
@click.option("--model", type=LateChoice(plane_models), default=MODEL, show_default=True, help="Model of rocking.")
@click.option("--unit", help='Unit of the accelerations in the file, such as "g".')
@click.option("--interval", metavar="TIME", help='Sampling interval of the file, such as "0.01 s".')
@click.option("--column", metavar="NAME|NUMBER", help="Column of the accelerations in the file.")
@click.option("--peak", metavar="ACCELERATION", help='Bring the motion to this peak, such as "0.3 g".')
@click.option(
    "--baseline",
    default="none",
    show_default=True,
    metavar="METHOD",
    help="Correct the motion's baseline: linear, quadratic or highpass(0.1 Hz).",
)
@click.option(
    "--drift",
    type=float,
    help="Largest drift over PGV of a motion with PGV; by default 0.1, or 0.25 of a table at rest at both ends.",
)
@click.option(
    "--slenderness", multiple=True, metavar="ANGLE", help="A further α of the rocking spectrum. Repeat it for several."
)
@click.option("--periods", type=float, nargs=2, metavar="LOW HIGH", help="Sizes 2π/p of the rocking spectrum, s.")
@click.option("--omega", type=float, nargs=2, metavar="LOW HIGH", help="Frequency ratios Ω of the pulse.")
@click.option("--points", type=int, default=24, show_default=True, help="Number of sizes or of frequencies.")
@click.option("--cycles", type=float, default=2.0, show_default=True, help="γ of mavroeidis-papageorgiou.")
@click.option("--phase", type=float, default=0.0, show_default=True, help="ν of mavroeidis-papageorgiou, in degrees.")
@click.option("--largest", type=float, default=10.0, show_default=True, help="Largest A that is tried.")
@click.option(
    "--least-width",
    type=float,
    default=0.01,
    show_default=True,
    help="In A: narrower intervals are islands, not limits.",
)
@click.option("--out", type=click.Path(path_type=Path), metavar="FILE", help="Draw it: .svg, .pdf or .png.")
@click.option("--data", type=click.Path(path_type=Path), metavar="FILE", help="Write what is drawn as a .csv table.")
@results_option
@json_option
def spectrum(campaign: Path, motion: str | None, pulse: str | None, results: Path | None, **options: Any) -> int:
    """Compute a spectrum, show and draw it, and return the exit code."""
    if (motion is None) == (pulse is None):
        raise click.UsageError("Give either --motion or --pulse.")
    _refuse(OF_MOTION if pulse else OF_PULSE, "--motion" if pulse else "--pulse")
    if pulse != "mavroeidis-papageorgiou":
        _refuse(SHAPE, "--pulse mavroeidis-papageorgiou")
    from colonnade.workflow.real_column import AskedColumn
    from colonnade.workflow.spectrum import Asked, overturning_of, rocking_of

    out, data, as_json = (options.pop(name) for name in ("out", "data", "as_json"))
    if out is not None or data is not None:
        from colonnade.figures.files.saving import expect_places

        expect_places(out, data)
    known, layout = _campaign(campaign, results)
    column, asked = AskedColumn.of(options), Asked.of(options)
    if motion is not None:
        return _show(rocking_of(known, layout, column, motion, asked), out, data, as_json)
    return _show(overturning_of(known, layout, column, str(pulse), asked), out, data, as_json)


def _refuse(names: Iterable[str], only: str) -> None:
    """Refuse options that are given but say nothing."""
    context = get_current_context()
    for name in names:
        if context.get_parameter_source(name) is ParameterSource.COMMANDLINE:
            raise click.UsageError(f"--{name.replace('_', '-')} is only for {only}.")


def _campaign(path: Path, results: Path | None) -> tuple[Campaign | None, Layout | None]:
    """Load the campaign if one is named, or if the current folder is one."""
    if path == Path() and not Path("campaign.toml").is_file():
        return None, None
    from colonnade.campaign import load
    from colonnade.store.layout import Layout

    campaign = load(path)
    return campaign, Layout.of(campaign.path, results)


def _show(found: Rocking | Overturning, out: Path | None, data: Path | None, as_json: bool) -> int:
    from colonnade.workflow import spectrum_shown as shown
    from colonnade.workflow.spectrum import Rocking, picture_of

    written: list[Path] = []
    if out is not None or data is not None:
        from colonnade.figures.files.saving import save

        picture = picture_of(found)
        written = [save(picture, place) for place in (out, data) if place is not None]
    if as_json:
        show_json(shown.record_of(found) | {"figure": out, "data": data})
        return 0
    more = shown.motion_fields(found) if isinstance(found, Rocking) else shown.pulse_fields(found)
    say(shown.verdict(found))
    show_fields([*shown.column_fields(found.column), *more])
    say()
    if isinstance(found, Rocking):
        show_table(shown.MEASURE_HEADS, shown.measure_rows(found))
        say()
        show_table(shown.ROCKING_HEADS, shown.rocking_rows(found))
    else:
        show_table(shown.OVERTURNING_HEADS, shown.overturning_rows(found))
    for place in written:
        say(f"{'data' if place.suffix.lower() == '.csv' else 'figure'}: {place}")
    return 0
