"""A changed review redoes just what it touches, and each decision does what it says."""

import numpy as np
import pytest

from colonnade.errors import CampaignError
from colonnade.store import files

pytestmark = pytest.mark.whole

SIGNED = 'who = "V. D."\nwhen = 2013-04-26\nwhy = "as seen on the video"\n'


def review(small, *entries):
    text = "schema = 1\n" + "".join(f"[[{kind}]]\n{said}\n{SIGNED}" for kind, said in entries)
    (small.folder / "review.toml").write_text(text, encoding="utf-8")


def recorded(small, test):
    return files.read(small.layout.stage(test, "ingest"))


def touched(redone):
    return {subject for subject, _ in redone}


DECISIONS = (
    ("trim", 'test = "pulse-01"\nwindow = ["0.5 s", "6 s"]'),
    ("flag", 'test = "pulse-01"\nchannel = "table"\nwindow = ["2 s", "3 s"]\nas = "suspect"'),
    ("correct", 'test = "pulse-01"\nchannel = "table"\nfactor = -2'),
    ("exclude", 'test = "pulse-01"\nchannel = "top"'),
)


@pytest.mark.smoke
def test_decisions_do_what_they_say_redo_their_test_alone_and_are_kept_with_the_recording(small):
    before = recorded(small, "pulse-01")
    others = {name: content for name, content in small.contents().items() if "pulse-01" not in name}
    review(small, *DECISIONS)
    redone = small.redone()
    assert touched(redone) == {"pulse-01"}
    assert redone["pulse-01", "ingest"] == "settings changed"
    assert others == {name: content for name, content in small.contents().items() if "pulse-01" not in name}
    after = recorded(small, "pulse-01")
    before = before.sel(elapsed=after["elapsed"])
    assert len(after.attrs["review"]) == len(DECISIONS)
    assert all(each.startswith("2013-04-26, V. D.: ") for each in after.attrs["review"])
    assert (after["elapsed"][0], after["elapsed"][-1]) == (0.5, 6.0)
    inside = (after["elapsed"] >= 2) & (after["elapsed"] <= 3)
    np.testing.assert_array_equal(after["table_quality"] >= 3, inside | (before["table_quality"] >= 3))
    np.testing.assert_array_equal(after["table_recorded"], before["table_recorded"])
    np.testing.assert_allclose(after["table"], -2 * before["table"], rtol=1e-12)
    assert (after["top_quality"] == 4).all()
    assert np.isfinite(after["top_recorded"]).all()
    assert "rocking_angle" not in files.read(small.layout.stage("pulse-01", "rocking"))


def test_a_review_that_stays_redoes_nothing_other_words_the_ingest_and_one_that_goes_its_test(small):
    before, path = small.contents(), small.folder / "review.toml"
    review(small, ("correct", 'test = "pulse-01"\nchannel = "table"\nfactor = -1'))
    written = path.read_bytes()
    small.run()
    assert small.redone() == {}
    assert path.read_bytes() == written
    path.write_bytes(written.replace(b"video", b"photograph"))
    assert set(small.redone()) == {("pulse-01", "ingest")}
    assert "photograph" in recorded(small, "pulse-01").attrs["review"][0]
    path.unlink()
    assert touched(small.redone()) == {"pulse-01"}
    assert small.contents() == before


def test_an_excluded_test_is_pending_with_its_reason_enters_no_pooled_value_and_is_refused_if_asked_for(small):
    review(small, ("exclude", 'test = "free-01"'))
    redone = small.redone()
    assert touched(redone) >= {"prism"}
    assert "free-01" not in touched(redone)
    record = small.summary()["tests"]["free-01"]
    assert (record["status"], record["outcome"]) == ("pending", None)
    assert record["reason"] == "excluded by V. D. on 2013-04-26: as seen on the video"
    assert small.summary()["specimens"]["prism"]["restitution"]["tests"] == ["free-02"]
    assert not small.layout.stage("free-01", "ingest").exists()
    assert small.redone() == {}
    with pytest.raises(CampaignError, match=r"free-01 is excluded by V\. D\. .*review\.toml"):
        small.run(only="free-01")
