from colonnade.report.overview_page import groups


def test_sines_of_known_amplitude_are_in_the_ladder_and_all_others_by_kind(rows, filled_campaign):
    prism, statue = groups.by_specimen(filled_campaign[0], rows)
    assert [(group.frequency, [row.id for row in group.tests]) for group in prism.sines] == [
        ("3 Hz", ["sine-3hz-too-strong-for-the-block-1"])
    ]
    assert prism.steps == 1
    assert {group.title: [row.id for row in group.tests] for group in prism.kinds} == {
        "Free vibrations": ["free-01", "free-refused"],
        "Sine tests of unknown amplitude": ["sine-dead", "later"],
        "Earthquake tests": ["span-2.0", "span-2.5", "span-3.0"],
    }
    assert statue.steps == 0
