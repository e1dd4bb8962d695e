from colonnade.figures.stored import maps
from colonnade.identification.response.boundaries import MapPoint


def test_sine_tests_are_counted_by_outcome():
    points = [
        MapPoint("a", 3.0, 1.2, "rocking"),
        MapPoint("b", 3.0, 2.0, "overturned"),
        MapPoint("c", 4.0, 1.4, "rocking"),
    ]
    picture = maps.tested("map-prism", points)
    assert picture.identity == "map-prism"
    assert picture.description == "3 tests: 2 rocking, 1 overturned."
