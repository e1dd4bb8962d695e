"""Contract 1 as a whole: what is read, and that everything wrong is told at once, with its place."""

import math
import pickle
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.campaign import load
from colonnade.campaign.setup import Align
from colonnade.errors import CampaignError
from every import every

CONTRACT = Path(__file__).with_name("contract.toml").read_text(encoding="utf-8")


def test_every_key_of_the_contract_becomes_si(contract, load_text, tmp_path):
    campaign = load_text(contract)
    assert (campaign.version, campaign.campaign, campaign.gravity) == (1, "prism-2013", 9.80)
    assert campaign.facility == "Earthquake Simulator, Aristotle University"
    assert campaign.folder == tmp_path.resolve()
    assert campaign.path == tmp_path.resolve() / "campaign.toml"

    assert list(campaign.specimens) == ["prism", "cylinder", "cone", "statue"]
    prism, statue = campaign.specimens["prism"], campaign.specimens["statue"]
    assert (prism.shape, prism.width, prism.mass, prism.scale) == ("prism", 0.086, 26.10, 20.0)
    assert statue.pole_distance == (0.610, 0.612)
    assert statue.critical_angle == (0.21, pytest.approx(math.radians(12)))
    assert statue.restitution == 0.9
    assert campaign.block("prism").gravity == 9.80

    setup = campaign.setups["frame"]
    assert setup.file.format == "delimited"
    assert setup.file.options == {"delimiter": ";", "decimal": ",", "encoding": "latin-1", "time": "Time [s]"}
    assert (setup.sampling_rate, setup.catch) == (200.0, 0.3)
    assert setup.table_tilt == pytest.approx(math.radians(0.1))
    assert list(setup.recorders) == ["main", "daq2"]
    assert setup.recorders["main"].sampling_rate == 200.0
    assert setup.recorders["main"].file is setup.file
    assert setup.recorders["daq2"].clock == Align(align=("table_acceleration", "table_acceleration_2"))

    top, bottom = setup.channels["top"], setup.channels["bottom"]
    assert (top.column, top.recorder, top.time, top.sensing, top.delay) == ("LVDT 1", "main", None, "point", 0.0)
    assert top.factor == pytest.approx(0.01002)
    assert top.offset == pytest.approx(-0.00013)
    assert top.at == (0.043, 0.0, 0.440)
    assert (bottom.column, bottom.direction, bottom.delay, bottom.relative_to) == (3, (1.0, 0.0, 0.0), 0.002, "ground")
    assert setup.channels["table_displacement"].time == "Time 2"
    assert [name for name, each in setup.channels.items() if each.recorder == "daq2"] == ["table_acceleration_2"]

    free, span = campaign.tests["free-01"], campaign.tests["span-2.0"]
    folder = tmp_path.resolve()
    assert free.files == {"main": folder / "raw" / "free-01.csv", "daq2": folder / "raw" / "free-01b.csv"}
    assert (free.window, free.zero, free.kind) == ((2.0, 14.0), (0.0, 0.5), "free-vibration")
    assert span.files == {"main": folder / "raw" / "span20.csv"}
    assert (span.zero, span.span, span.motion) == ("auto", 2.0, "El Centro 1940 NS")
    assert (span.time_scale, span.observed_outcome) == (0.2236, "overturned")
    assert "table_acceleration_2" not in campaign.channels(span)

    assert campaign.processing.lowpass == 25.0
    assert campaign.processing.base_lowpass == "auto"
    assert campaign.processing.restitution.level == 0.9
    assert campaign.processing.restitution.lowest_amplitude == 0.02


def test_a_campaign_goes_to_another_process_unchanged(contract, load_text):
    campaign = load_text(contract)
    assert pickle.loads(pickle.dumps(campaign)) == campaign


def test_windows_line_ends_and_a_byte_order_mark_change_nothing(contract, load_text, tmp_path):
    campaign = load_text(contract)
    (tmp_path / "campaign.toml").write_bytes(b"\xef\xbb\xbf" + contract.replace("\n", "\r\n").encode())
    assert load(tmp_path) == campaign


WRONG = [
    ("schema = 1", "schema = 2", "line 1: schema: 2 was found. It should be 1: version of the campaign file's form"),
    ('campaign = "prism-2013"', 'campaing = "x"', 'line 2: campaing: Unknown key. Did you mean "campaign"?'),
    ('campaign = "prism-2013"', "", "campaign: It is missing. Expected: id of the campaign"),
    ('"9.80 m/s^2"', "9.80", "line 5: gravity: 9.8 has no unit. A quantity in quotes was expected, such as"),
    ('width = "86 mm"', 'width = "86"', 'line 8: specimens.prism.width: "86" has no unit. A length was expected'),
    ('width = "86 mm"', 'widht = "86 mm"', 'specimens.prism.widht: Unknown key. Did you mean "width"?'),
    ('quantity = "acceleration"', 'quantity = "acceleraton"', '"acceleraton" was found. Did you mean "acceleration"?'),
    ('shape = "cone"', 'shape = "kone"', 'specimens.cone: "kone" was found. Did you mean "cone"?'),
    ('shape = "cone", ', "", 'specimens.cone: "shape" is missing.'),
    (', relative_to = "table"', "", "channels.top.relative_to: It is missing. Expected: what a displacement"),
    ('lowpass = "25 Hz"', 'lowpas = "25 Hz"', 'processing.lowpas: Unknown key. Did you mean "lowpass"?'),
    ("level = 0.9", "level = 90", "processing.restitution.level: 90 was found. It should be less than 0.999999"),
    ('id = "span-2.0"', "", "tests[2].id: It is missing."),
    ('kind = "earthquake"', 'kind = "earthquakes"', 'tests[span-2.0].kind: "earthquakes" was found. Did you mean'),
    ('main = "raw/free-01.csv", ', "", "tests[free-01].file: A file of `main` was expected"),
    ("[processing]", "[processing", "this is not valid TOML: "),
]


@every(("right", "wrong", "told"), WRONG)
def test_one_wrong_thing_is_told_with_its_place_and_what_to_do(right, wrong, told, load_text):
    assert right in CONTRACT
    with pytest.raises(CampaignError, match=rf"(?s)^campaign\.toml.*{re.escape(told)}"):
        load_text(CONTRACT.replace(right, wrong, 1))


def test_all_problems_are_told_at_once_in_the_order_of_the_file(load_text):
    text = CONTRACT
    for right, wrong, _ in [each for each in WRONG if "Did you mean" in each[2]]:
        text = text.replace(right, wrong, 1)
    with pytest.raises(CampaignError) as caught:
        load_text(text)
    lines = [int(number) for number in re.findall(r"(?m)^campaign\.toml, line (\d+):", str(caught.value))]
    assert len(lines) >= 6
    assert lines == sorted(lines)


def test_a_missing_campaign_file_is_told_with_its_folder(tmp_path):
    with pytest.raises(CampaignError, match=r"campaign\.toml: not found in .*\. Name a campaign\.toml or its folder"):
        load(tmp_path)


@pytest.mark.parametrize(
    "text", ["x = " + "[" * 20000, "x = " + "9" * 5000, "schema = 1", "", "\0", "tests = 3", "specimens = [1]"]
)
def test_odd_files_are_refused_without_a_traceback(text, load_text):
    with pytest.raises(CampaignError):
        load_text(text)


VALUES = st.sampled_from(
    [
        *('""', "3", "-1", "true", "nan", "inf", "1e400", "[]", "{}", '"1e308 Mm"', '"86 mm"', '["1 s"]'),
        *("1979-05-27", "[[1]]", '"\\u0000"', "9" * 400),
    ]
)


@st.composite
def mutated(draw):
    lines = CONTRACT.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        index = draw(st.integers(0, len(lines) - 1))
        line = lines[index]
        kind = draw(st.sampled_from(["value", "delete", "repeat", "cut", "character", "key", "swap"]))
        values = list(re.finditer(r'(?<== )("[^"]*"|\[[^\]]*\]|[0-9.]+)', line))
        if kind == "value" and values:
            chosen = draw(st.sampled_from(values))
            lines[index] = line[: chosen.start()] + draw(VALUES) + line[chosen.end() :]
        elif kind == "delete":
            lines[index] = ""
        elif kind == "repeat":
            lines.insert(index, line)
        elif kind == "cut" and line:
            lines[index] = line[: draw(st.integers(0, len(line) - 1))]
        elif kind == "character" and line:
            at = draw(st.integers(0, len(line) - 1))
            lines[index] = line[:at] + draw(st.characters(codec="utf-8")) + line[at + 1 :]
        elif kind == "key":
            name = draw(st.sampled_from(["x", "unit", "on", "at", "shape", "id"]))
            lines[index] = re.sub(r"[a-z_]+ =", f"{name} =", line, count=1)
        elif kind == "swap":
            other = draw(st.integers(0, len(lines) - 1))
            lines[index], lines[other] = lines[other], lines[index]
    return "\n".join(lines)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(mutated())
def test_a_mutated_campaign_is_read_or_refused_with_a_place_never_a_traceback(tmp_path, text):
    (tmp_path / "campaign.toml").write_text(text, encoding="utf-8", newline="")
    told = ""
    try:
        load(tmp_path)
    except CampaignError as error:
        told = str(error)
    assert all(line.startswith("campaign.toml") for line in told.splitlines())
