"""The paper's limestone prism, as most tests use it."""

from colonnade.dynamics.block import Block

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
SPECIMEN = 'prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}'
"""Its line in a campaign file, below `[specimens]`."""


def entry(name, kind, *lines):
    """A test of it in the set-up `frame`, as a campaign file has it, with further lines."""
    always = (f'id = "{name}"', f'kind = "{kind}"', f'file = "raw/{name}.csv"', 'specimen = "prism"', 'setup = "frame"')
    return "\n".join(("[[tests]]", *always, *lines, "", ""))


TOP = (
    'top = {column = "top", quantity = "displacement", unit = "mm", on = "specimen", '
    'at = ["43 mm", "0 mm", "440 mm"], direction = [1, 0, 0], relative_to = "table"}'
)
"""The line of a transducer at its top."""


def campaign_of(*channels, before="", tests=""):
    """A campaign file of it in the set-up `frame` with these channels, and with further tables before the set-up."""
    head = ("schema = 1", 'campaign = "small"', 'title = "A small campaign"', "", "[specimens]", SPECIMEN, "", before)
    return "\n".join((*head, "[setups.frame.channels]", *channels, "", tests))
