"""The paper's limestone prism, as most tests use it."""

from colonnade.dynamics.block import Block

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
SPECIMEN = 'prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}'
"""Its line in a campaign file, below `[specimens]`."""


def entry(name, kind, *lines):
    """A test of it in the set-up `frame`, as a campaign file has it, with further lines."""
    always = (f'id = "{name}"', f'kind = "{kind}"', f'file = "raw/{name}.csv"', 'specimen = "prism"', 'setup = "frame"')
    return "\n".join(("[[tests]]", *always, *lines, "", ""))
