"""The paper's slips: where it contradicts itself or its own dimensions, each with the arithmetic."""

from __future__ import annotations

from typing import NamedTuple


class Slip(NamedTuple):
    """
    A slip.

    Attributes
    ----------
    where : str
    printed : str
        What is printed, in our words.
    meant : str
        What it should be, or what it is.
    statement : str
        Id of the statement whose answer is the arithmetic; empty if the text alone shows it.
    """

    where: str
    printed: str
    meant: str
    statement: str = ""


SLIPS = (
    Slip(
        "Table 1, text of 2.2",
        "critical angles of 0.1886, 0.2132, 0.2203 rad",
        "they are tangents, base over height of the centre of mass twice; the angles are smaller by 1.2 to 1.6 %",
        "critical-angles-are-angles",
    ),
    Slip(
        "Table 1",
        "distances of 227 and 220 mm from pole to centre of mass, of cylinder and cone",
        "they are the heights of the centre of mass; the prism's 232 mm is a distance",
        "distances-are-distances",
    ),
    Slip(
        "Table 1",
        "p = 5.631 rad/s in the rows of cylinder and cone",
        "the printed weight, distance and inertia give another p",
        "p-follows-from-its-columns",
    ),
    Slip(
        "Table 1",
        "p = 5.631 rad/s three times",
        "the dimensions give it to prism and, almost, cylinder; not to the cone",
        "one-p-for-all",
    ),
    Slip(
        "Table 2, text of 4",
        "20322 degrees of freedom in the table, 20332 in the text",
        "nodes in space have three each: 20332 cannot be divided by three",
        "degrees-of-freedom",
    ),
    Slip(
        "2.2",
        "amplitudes A that rise from 1.05 to 3.35",
        "3.35 is the frequency ratio Ω of the three histories; their largest A is 1.80",
        "levels-to-335",
    ),
    Slip(
        "Table 2",
        "a step of 100 µs for elastic steel",
        "impossible for an explicit scheme unless modulus, mass, rigid parts or scheme are other than described",
        "step-of-100us-is-possible",
    ),
    Slip(
        "Table 2",
        "a step of 10 µs for elastic steel, which all later runs have",
        "the same",
        "step-of-10us-is-possible",
    ),
    Slip(
        "2.1, fig. 3",
        "free vibrations announced of the truncated cone",
        "the figure and its caption show the prism",
    ),
    Slip("fig. 4a", "captioned 4b, as the next one is", "the captions read 4b, 4b, 4c; A = 1.05 is the first"),
    Slip("fig. 1b", "captioned 1a, as the temple before it is", "the text calls the specimens' figure 1b"),
)
