"""The literature that the methods follow."""

from __future__ import annotations

REFERENCES = {
    "housner": (
        "Housner, G. W. (1963). The behavior of inverted pendulum structures during earthquakes. "
        "Bulletin of the Seismological Society of America 53(2), 403–417."
    ),
    "spanos": (
        "Spanos, P. D. and Koh, A.-S. (1984). Rocking of rigid blocks due to harmonic shaking. "
        "Journal of Engineering Mechanics 110(11), 1627–1642."
    ),
    "manos": (
        "Manos, G. C., Petalas, A. and Demosthenous, M. Experimental and numerical study of the rocking of "
        "free-standing steel models, 1:20, of ancient columns on the Earthquake Simulator Facility of Aristotle "
        "University of Thessaloniki."
    ),
    "patterson": (
        "Patterson, H. D. and Thompson, R. (1971). Recovery of inter-block information when block sizes are unequal. "
        "Biometrika 58(3), 545–554."
    ),
    "paule": (
        "Paule, R. C. and Mandel, J. (1982). Consensus values and weighting factors. "
        "Journal of Research of the National Bureau of Standards 87(5), 377–385."
    ),
    "hartung": (
        "Hartung, J. and Knapp, G. (2001). On tests of the overall treatment effect in meta-analysis with normally "
        "distributed responses. Statistics in Medicine 20(12), 1771–1782."
    ),
    "butterworth": ("Butterworth, S. (1930). On the theory of filter amplifiers. Experimental Wireless 7, 536–541."),
    "cf": "NetCDF Climate and Forecast (CF) Metadata Conventions, version 1.11.",
}
"""By the key that the text cites them with."""
