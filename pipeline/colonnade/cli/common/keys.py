"""Options from the keys of tables: type, sentence and default of each are said by the table's model alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args, get_origin

import rich_click as click

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo


class WithKeys(click.RichCommand):
    """A command with options that `keys` gives, made only when it is used: a table loads pydantic."""

    def __init__(self, *given: Any, keys: Callable[[], list[click.Option]], **more: Any) -> None:
        self._keys: Callable[[], list[click.Option]] | None = keys
        super().__init__(*given, **more)

    @property
    def params(self) -> list[click.Parameter]:
        """Its own arguments and options, and those of the tables ahead of where results go."""
        if self._keys is not None:
            place = next(number for number, each in enumerate(self._params) if each.name in ("out", "workers"))
            self._params[place:place], self._keys = self._keys(), None
        return self._params

    @params.setter
    def params(self, own: list[click.Parameter]) -> None:
        self._params = own


def options_of(keys: Mapping[str, FieldInfo], *, with_defaults: bool = False) -> list[click.Option]:
    """
    Make an option of each key; one that is not given is None or (), so that the table takes its own default.

    Parameters
    ----------
    keys : mapping
        Fields of a table. A list of texts is an option that may be repeated, without the "s" of its key.
    with_defaults : bool, optional
        Whether the help says the defaults.
    """
    from colonnade.campaign.syntax.fields import OneOf, Quantity

    made = []
    for key, field in keys.items():
        found = [*_parts(field.annotation), *field.metadata]
        tuples = [get_args(each) for each in found if get_origin(each) is tuple]
        is_many, is_pair = any(... in each for each in tuples), any(... not in each for each in tuples)
        words = [click.Choice(each.words) for each in found if isinstance(each, OneOf)]
        dimension = [each.dimension for each in found if isinstance(each, Quantity)]
        plain = str if dimension else next(each for each in (str, Path, float, bool, int) if each in found)
        said = str(field.description) + " Repeat it for several." * is_many
        if with_defaults and field.default not in (None, (), False):
            default = field.default if isinstance(field.default, tuple) else (field.default,)
            said += f" Default: {' '.join(map(str, default))}."
        flag = key.removesuffix("s") if is_many and not dimension else key
        made.append(
            click.Option(
                ["--" + flag.replace("_", "-"), key],
                type=words[0] if words else click.Path(path_type=Path) if plain is Path else plain,
                is_flag=plain is bool or None,
                nargs=2 if is_pair else 1,
                multiple=is_many,
                metavar="LOW HIGH" if is_pair and plain is float else dimension[0].upper() if dimension else None,
                help=said,
            )
        )
    return made


def _parts(annotation: Any) -> Iterator[Any]:
    """Give a type, the types within it, and the annotations of both, such as a quantity."""
    yield annotation
    is_words = get_origin(annotation) is Literal
    for each in (*get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield from [type(each)] if is_words else _parts(each)
