"""
The canvas on which figures are drawn as SVG.

It is matplotlib's own, but for one thing: the size of a text is kept for the next figure that shows it. Shaping every
number of every scale again takes a tenth of the time of a page.
"""

from __future__ import annotations

import codecs
from functools import lru_cache
from typing import Any, Literal

from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

BACKEND = f"module://{__name__}"
"""Name by which matplotlib finds this canvas."""

TEXTS = 20_000
"""Texts whose size is kept, a few megabytes."""


class _Renderer(RendererSVG):
    def get_text_width_height_descent(
        self, s: str, prop: FontProperties, ismath: bool | Literal["TeX"]
    ) -> tuple[float, float, float]:
        return _size(s, prop, ismath)


@lru_cache(TEXTS)
def _size(text: str, font: FontProperties, is_math: bool | Literal["TeX"]) -> tuple[float, float, float]:
    """Return width, height and descent of a text, points."""
    return text_to_path.get_text_width_height_descent(text, font, is_math)


class FigureCanvas(FigureCanvasSVG):
    """The canvas, by the name under which matplotlib looks for it."""

    def print_svg(self, filename: Any, *, metadata: Any = None, bbox_inches_restore: Any = None, **_: Any) -> None:
        """Write the figure to a binary stream."""
        writer, figure = codecs.getwriter("utf-8")(filename), self.figure
        fine, figure.dpi = figure.dpi, self.fixed_dpi
        wide, high = (float(size) for size in figure.get_size_inches())
        vector = _Renderer(72 * wide, 72 * high, writer, image_dpi=fine, metadata=metadata)  # type: ignore[no-untyped-call]
        renderer: Any = MixedModeRenderer(  # type: ignore[no-untyped-call]
            figure, wide, high, fine, vector, bbox_inches_restore=bbox_inches_restore
        )
        figure.draw(renderer)
        renderer.finalize()
