"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from pkgutil import resolve_name
from typing import TYPE_CHECKING, Any, TypeVar

import rich_click as click

from colonnade.errors import nearest, quoted

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.campaign.syntax.table import Table
    from colonnade.store.layout import Layout


class Commands(click.RichGroup):
    """Lists its commands in the order in which a user needs them; an unknown one is answered with the list."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in the order in which they were added."""
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command."""
        if args[0] not in self.commands and not args[0].startswith("-"):
            ctx.fail(f"There is no command {quoted(args[0])}.{nearest(args[0], self.list_commands(ctx))}")
        return super().resolve_command(ctx, args)


class Asking(click.RichCommand):
    """
    A command whose options are the keys of tables, which are made only when it is used: a table loads pydantic.

    It gets the table that `asks` names as ``module:class`` as `asked`, checked; and if it has `others`, as `given` all
    that are given, by their keys and as in a campaign file.
    """

    def __init__(self, *args: Any, asks: str = "", others: Callable[[], list[click.Option]] | None = None, **more: Any):
        super().__init__(*args, **more)
        self._asks, self._others, self._keys = asks, others, list[click.Option]()

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Give its own arguments and options, and those of the tables ahead of where results go."""
        if not self._keys:
            own = options_of(resolve_name(self._asks), alone=True) if self._asks else []
            self._keys = [*own, *(self._others() if self._others else ())]
            place = next(place for place, each in enumerate(self.params) if each.name in ("out", "workers", "results"))
            self.params[place:place] = self._keys
        return super().get_params(ctx)

    def invoke(self, ctx: click.Context) -> Any:
        """Run it."""
        from colonnade.workflow.asked import picked

        found = {str(each.name): ctx.params.pop(each.name) for each in self._keys}
        given = {key: value for key, value in found.items() if value not in (None, ())}
        if self._asks:
            ctx.params["asked"] = picked(resolve_name(self._asks), given)
        if self._others:
            ctx.params["given"] = given
        return super().invoke(ctx)


TYPES = {"string": str, "number": float, "integer": int, "boolean": bool}
"""Of options, by the types of JSON Schema."""


def options_of(table: type[Table], keys: Iterable[str] = (), *, alone: bool = False) -> list[click.Option]:
    """
    Make an option of each key of a table.

    Parameters
    ----------
    table : type
    keys : iterable of str, optional
        Default all. A list is an option that may be repeated, of texts without the "s" of its key.
    alone : bool, optional
        Whether nothing but the options says the values: the help says the defaults, and what is needed.
    """
    from colonnade.campaign.syntax.table import kind_of

    made = []
    for key in keys or table.model_fields:
        field, either = table.model_fields[key], table.alternatives()[key]
        is_pair, is_many = "prefixItems" in either[0], "items" in either[0]
        value = either[0]["prefixItems"][0] if is_pair else either[0].get("items", either[0])
        kind = TYPES[value["type"]]
        dimension = kind_of(value) if kind is str else ""
        said = str(field.description) + " Repeat it for several." * is_many
        if alone and not field.is_required() and field.default not in (None, (), False):
            default = field.default if isinstance(field.default, tuple) else (field.default,)
            said += f" Default: {' '.join(map(str, default))}."
        words = None if len(either) > 1 and either[1]["type"] == "number" else value.get("enum")
        made.append(
            click.Option(
                [f"--{(key if dimension else key.removesuffix('s' * is_many)).replace('_', '-')}", key],
                type=click.Choice(words) if words else number_or_word if "enum" in value else kind,
                is_flag=kind is bool or None,
                nargs=2 if is_pair else 1,
                multiple=is_many,
                required=alone and field.is_required(),
                metavar="LOW HIGH" if is_pair and kind is float else dimension.upper() or None,
                help=said,
            )
        )
    return made


def number_or_word(text: str) -> float | str:
    """Take a number if it is one."""
    try:
        return float(text)
    except ValueError:
        return text


Command = TypeVar("Command", bound=Callable[..., Any])


FILE = click.Path(path_type=Path)

CAMPAIGN = "CAMPAIGN is a campaign.toml or its folder, by default the current folder."


def campaign_argument(command: Command) -> Command:
    """Add the argument of most commands; their help says what it is, in place of {CAMPAIGN}."""
    command.__doc__ = (command.__doc__ or "").replace("{CAMPAIGN}", CAMPAIGN)
    return click.argument("campaign", type=FILE, default=Path(), metavar="[CAMPAIGN]")(command)


campaign_and_id_argument = click.argument("arguments", nargs=-1, metavar="[CAMPAIGN] [ID]")
"""The arguments of commands that show one test or specimen; `campaign_and_id` reads them."""


def campaign_and_id(arguments: tuple[str, ...]) -> tuple[Path, str | None]:
    """Take a single argument as CAMPAIGN if such a file or folder exists, else as ID."""
    if len(arguments) > 2:
        raise click.UsageError(f"{len(arguments)} arguments were found. Give at most a CAMPAIGN and an ID.")
    if len(arguments) == 2:
        return Path(arguments[0]), arguments[1]
    if arguments and not Path(arguments[0]).exists():
        return Path(), arguments[0]
    return Path(*arguments), None


def opened(path: Path, results: Path | None) -> tuple[Campaign, Layout]:
    """Load a campaign, and find the places of its results."""
    from colonnade.campaign import load
    from colonnade.store.layout import Layout

    campaign = load(path)
    return campaign, Layout.of(campaign.path, results)


def opened_if_there(path: Path, results: Path | None) -> tuple[Campaign, Layout] | tuple[None, None]:
    """As `opened`; nothing if no campaign is named and none is in the current folder."""
    return opened(path, results) if path != Path() or Path("campaign.toml").is_file() else (None, None)


specimen_option = click.option(
    "--specimen", multiple=True, metavar="ID", help="Only this specimen. Repeat the option for several."
)


def column_keys(*more: str) -> list[click.Option]:
    """Make the options that say which column: its sizes, and keys of [prototype.<specimen>]: e, α, p and `more`."""
    from colonnade.campaign.assessment import Prototype
    from colonnade.campaign.specimen import SIZED
    from colonnade.workflow.asked import Which

    return [
        *options_of(Which),
        *options_of(SIZED["prism"], ("width",)),
        *options_of(SIZED["cylinder"], ("diameter",)),
        *options_of(SIZED["cone"], ("base_diameter", "top_diameter", "height")),
        *options_of(Prototype, ("critical_angle", "p", "restitution", *more)),
    ]


def file_option(flag: str, help: str) -> Callable[[Command], Command]:
    """Make an option that names a file to write."""
    return click.option(flag, type=FILE, metavar="FILE", help=help)


def drawing_options(help: str) -> Callable[[Command], Command]:
    """Add the options of a picture and its table, see `expect_places` and `saved`."""
    data = file_option("--data", "Write what is drawn as a .csv table.")
    return lambda command: file_option("--out", help)(data(command))


json_option = click.option("--json", "as_json", is_flag=True, help="Write the result as JSON.")

workers_option = click.option(
    "--workers", type=click.IntRange(min=1), metavar="N", help="Number of processes; one per core by default."
)

scheduler_option = click.option(
    "--scheduler", metavar="ADDRESS", help="Compute on the Dask cluster of this scheduler, such as tcp://10.0.0.1:8786."
)

results_option = click.option(
    "--results", type=FILE, metavar="DIR", help="Folder for processed/ and report/; by default that of campaign.toml."
)


def result_options(command: Command) -> Command:
    """Add the options of commands that show results."""
    return results_option(json_option(command))


strict_option = click.option("--strict", is_flag=True, help="Exit with 1 also for a serious finding or a warning.")


def work_options(command: Command) -> Command:
    """Add the options of all commands that run stages."""
    for option in (
        json_option,
        click.option("--verbose", is_flag=True, help="Also list each redone stage, why it was redone, and its time."),
        strict_option,
        click.option(
            "--verify", is_flag=True, help="Read files even if size and time are unchanged; redo what was altered."
        ),
        click.option("--await", "awaiting", is_flag=True, help="A test without its raw file is planned, not failed."),
        results_option,
        scheduler_option,
        workers_option,
        click.option("--only", multiple=True, metavar="ID", help="Only this test. Repeat the option for several."),
    ):
        command = option(command)
    return command
