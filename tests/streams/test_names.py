"""Names of units and streams in the language of the reader."""

from __future__ import annotations

from granum.app.shipped import examples
from granum.cases.outline import outline
from granum.core.i18n import language
from granum.streams.names import french, pretty


def _names() -> set[str]:
    found = (outline(place.read_text(encoding="utf-8")) for place in examples().values())
    return {
        name
        for line in found
        for name in (*line.order, *line.feeds, *(k.name for k in line.links if "." not in k.name))
    }


def test_every_name_of_the_examples_has_its_french_and_no_other_stands_there() -> None:
    words = {name.rstrip("0123456789").rstrip("_") for name in _names()}
    assert words | {"feed"} == set(french())  # the inlet of a machine alone


def test_english_keeps_the_names_of_the_case_file() -> None:
    with language("en"):
        assert all(pretty(name) == name.replace("_", " ") for name in _names())


def test_two_names_of_one_example_stay_two_in_french() -> None:
    with language("fr"):
        for key, place in examples().items():
            line = outline(place.read_text(encoding="utf-8"))
            for names in ((*line.order,), (*(k.name for k in line.links),)):
                assert len({pretty(n) for n in names}) == len(set(names)), key
