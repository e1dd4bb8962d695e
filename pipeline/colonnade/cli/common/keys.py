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
        self._keys, self._own = keys, list[click.Parameter]()
        super().__init__(*given, **more)

    @property
    def params(self) -> list[click.Parameter]:
        """Its own arguments and options, and those of the tables ahead of where results go."""
        if (keys := self._keys) is not None:
            self._keys = None  # type: ignore[assignment]
            place = next(number for number, each in enumerate(self._own) if each.name == "out")
            self._own[place:place] = keys()
        return self._own

    @params.setter
    def params(self, own: list[click.Parameter]) -> None:
        self._own = own


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
    return [_option(key, field, with_defaults=with_defaults) for key, field in keys.items()]


def _option(key: str, field: FieldInfo, *, with_defaults: bool) -> click.Option:
    found = [*_parts(field.annotation), *field.metadata]
    texts = [each for each in found if isinstance(each, str)]
    lists = [each for each in found if get_origin(each) is tuple]
    is_many, is_pair = (any((Ellipsis in get_args(each)) is many for each in lists) for many in (True, False))
    words = next((each.words for each in found if hasattr(each, "words")), None)
    quantity = next((each for each in found if hasattr(each, "dimension")), None)
    kinds = [each for each in (float, int, Path) if each in found]
    kind: Any = click.Choice(words) if words else str if texts or quantity or str in found else kinds[0]
    flag = "--" + (key.removesuffix("s") if is_many and str in found else key).replace("_", "-")
    said = str(field.description) + (" Repeat it for several." if is_many else "")
    if with_defaults and field.default not in (None, ()):
        usual = field.default if isinstance(field.default, tuple) else (field.default,)
        said += f" Default: {' '.join(f'{each:g}' if isinstance(each, float) else str(each) for each in usual)}."
    return click.Option(
        [flag, key],
        type=click.Path(path_type=Path) if kind is Path else kind,
        nargs=2 if is_pair else 1,
        multiple=is_many,
        metavar="LOW HIGH" if is_pair else quantity.dimension.upper() if quantity else None,
        help=said,
    )


def _parts(annotation: Any) -> Iterator[Any]:
    """Give a type, all within it, and what is said of it, such as its quantity."""
    yield annotation
    if get_origin(annotation) is Literal:
        yield from get_args(annotation)
        return
    for each in (*get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield from _parts(each)
