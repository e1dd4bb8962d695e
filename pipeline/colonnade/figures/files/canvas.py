"""
The canvas on which figures are drawn as SVG.

It is matplotlib's own, but for one thing: the sizes of texts and fonts are kept for the next figure that shows them.
Shaping every number of every scale again takes a tenth of the time of a page, and reading the tables of fonts as much.
"""

from __future__ import annotations

from functools import lru_cache
from io import StringIO
from typing import Any, Literal

from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.textpath import text_to_path

BACKEND = f"module://{__name__}"
"""Name by which matplotlib finds this canvas."""

TEXTS = 20_000
"""Texts whose size is kept, a few megabytes."""


Heights = tuple[float, float, float] | tuple[None, None, None]

_TABLES = (("OS/2", "sTypoAscender", "sTypoDescender", "sTypoLineGap"), ("hhea", "ascent", "descent", "lineGap"))
"""Tables of a font that hold the heights of its lines, in matplotlib's order, with the names of the three."""


class _Renderer(RendererSVG):
    def get_text_width_height_descent(
        self, s: str, prop: FontProperties, ismath: bool | Literal["TeX"]
    ) -> tuple[float, float, float]:
        return _size(s, prop, ismath)

    def _get_font_height_metrics(self, prop: FontProperties) -> Heights:
        """Answer matplotlib's question for each text; unless a renderer does, it reads the font's tables each time."""
        return _heights(prop)


_OFTEN = ("open_group", "close_group", "new_gc", "draw_path", "draw_text", "points_to_pixels", "flipy")
"""Methods of a renderer that nearly every artist calls."""


class _Mixed(MixedModeRenderer):
    """Has these methods at hand, of the vector renderer or of the raster's; matplotlib looks for each at each call."""

    def __init__(self, *given: Any, **options: Any) -> None:
        super().__init__(*given, **options)  # type: ignore[no-untyped-call]
        self._share()

    def _share(self) -> None:
        vars(self).update({name: getattr(self._renderer, name) for name in _OFTEN})

    def start_rasterizing(self) -> None:
        super().start_rasterizing()  # type: ignore[no-untyped-call]
        self._share()

    def stop_rasterizing(self) -> None:
        super().stop_rasterizing()  # type: ignore[no-untyped-call]
        self._share()


@lru_cache(TEXTS)
def _size(text: str, font: FontProperties, is_math: bool | Literal["TeX"]) -> tuple[float, float, float]:
    """Return width, height and descent of a text, points."""
    return text_to_path.get_text_width_height_descent(text, font, is_math)


@lru_cache(TEXTS)
def _heights(font: FontProperties) -> Heights:
    """Return ascent, descent and gap of the lines of a font, points; None if its tables do not say."""
    face: Any = get_font(findfont(font))
    for name, *keys in _TABLES:
        if (table := face.get_sfnt_table(name)) is not None:
            size = font.get_size_in_points() / face.get_sfnt_table("head")["unitsPerEm"]
            ascent, descent, gap = (size * table[key] for key in keys)
            return ascent, -descent, gap
    return None, None, None


class FigureCanvas(FigureCanvasSVG):
    """The canvas, by the name under which matplotlib looks for it."""

    def print_svg(self, filename: Any, *, metadata: Any = None, bbox_inches_restore: Any = None, **_: Any) -> None:
        """Write the figure to a binary stream."""
        text, figure = StringIO(), self.figure
        fine, figure.dpi = figure.dpi, self.fixed_dpi
        wide, high = (float(size) for size in figure.get_size_inches())
        vector = _Renderer(72 * wide, 72 * high, text, image_dpi=fine, metadata=metadata)  # type: ignore[no-untyped-call]
        renderer: Any = _Mixed(figure, wide, high, fine, vector, bbox_inches_restore=bbox_inches_restore)
        figure.draw(renderer)
        renderer.finalize()
        filename.write(text.getvalue().encode())
