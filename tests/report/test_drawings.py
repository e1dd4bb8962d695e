"""Each specimen and setup is drawn once, and again only if it changed."""

from __future__ import annotations

from dataclasses import replace

from colonnade.report import addresses, drawings
from colonnade.store import stamps


def test_a_drawing_is_kept_until_it_changes(empty_campaign, tmp_path):
    campaign, _ = empty_campaign
    made = list(drawings.files(campaign, tmp_path, "code"))
    assert [address for address, *_ in made] == [addresses.of_setup(*pair) for pair in campaign.combinations]
    assert {address for address, *_ in made} <= {*addresses.addresses(campaign, [])[0]}
    for address, text, made_from in made:
        path = tmp_path / address
        path.parent.mkdir(exist_ok=True)
        path.write_text(stamps.stamped(text, made_from), encoding="utf-8")
    assert {text for _, text, _ in drawings.files(campaign, tmp_path, "code")} == {None}
    heavier = replace(campaign, gravity=9.8)
    assert None not in {text for _, text, _ in drawings.files(heavier, tmp_path, "code")}
    assert None not in {text for _, text, _ in drawings.files(campaign, tmp_path, "other")}


def test_a_page_names_the_drawing_without_drawing_it(empty_campaign):
    campaign, _ = empty_campaign
    for specimen in campaign.specimens:
        for drawing in drawings.of_specimen(campaign, specimen):
            assert drawing.specimen == specimen
            assert drawing.address == addresses.of_setup(specimen, drawing.setup)
            assert "mm" in drawing.description
