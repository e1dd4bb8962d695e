"""The arrays that functions take and return: one name for each element type."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Codes = NDArray[np.int8]
Vector = tuple[float, float, float]
