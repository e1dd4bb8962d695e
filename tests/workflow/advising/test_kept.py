"""Advice in the report: only if a further test is asked for, and made again only for what changed."""

from colonnade.workflow.advising import next as advising


def test_the_report_advises_while_tests_are_planned(small, monkeypatch):
    small.complete()
    assert "What next" not in small.layout.report.read_text(encoding="utf-8")

    campaign_file = small.folder / "campaign.toml"
    campaign_file.write_text(campaign_file.read_text() + '\n[table]\nstroke = "75 mm"\n')
    small.complete()
    text = small.layout.report.read_text(encoding="utf-8")
    (free,) = advising.advise(small.folder).advice
    assert "What next" in text
    assert free.row()[-1].replace("<", "&lt;") in text

    def refuse(*_):
        raise AssertionError("advice was made again")

    monkeypatch.setattr(advising, "advise_kind", refuse)
    small.layout.report.unlink()
    small.complete()
    assert "What next" in small.layout.report.read_text(encoding="utf-8")
