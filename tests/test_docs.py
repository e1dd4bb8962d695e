"""The example of docs/explanation/assessment.md runs as it is printed."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "explanation" / "assessment.md"


def test_the_example_of_an_assessment_runs(capsys):
    [block] = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    names = {}
    exec(compile(block, str(PAGE), "exec"), names)
    assert names["measured"].values["pga"] < 2.5
    assert 0.1 < names["found"].isotonic.reaches(0.5).value < 10.0
    assert names["spectrum"].overturned.shape == (1, 2)
    assert names["limits"].lower[0] < names["limits"].upper[0]
    assert capsys.readouterr().out.count("\n") == 4
