"""Choice of a mill: the machine that a book names for its own words, order, refusals."""

from __future__ import annotations

import pytest

import granum as gr
from granum.core import registry
from granum.core.datasets import dataset
from granum.core.errors import InputError

choose = gr.comminution.mill_choice


@pytest.mark.parametrize(
    ("feed", "product", "machine"),
    [
        ("1 m", "200 mm", "primary crusher"),  # McCabe, chapter 28, as in the lecture sheets that were opened
        ("200 mm", "10 mm", "secondary crusher"),
        ("50 mm", "3 mm", "smooth crushing rolls"),
        ("5 mm", "74 um", "fine grinder"),
        ("1 mm", "5 um", "ultrafine grinder"),
    ],
)
def test_it_names_the_machine_of_the_book(feed: str, product: str, machine: str) -> None:
    found = choose(feed, product, abrasive=True)
    assert found.mill[0].startswith(machine)
    assert found.suitability[0] == pytest.approx(1.0)


def test_soft_matter_may_go_to_hammers_and_hard_matter_hardly() -> None:
    soft, hard = (
        dict(zip(f.mill, f.suitability, strict=True))
        for f in (choose("20 mm", "1 mm"), choose("20 mm", "1 mm", True))
    )
    assert soft["hammer mill, pin mill"] == 1.0 > hard["hammer mill, pin mill"]


def test_where_none_goes_the_whole_way_the_first_says_what_it_takes() -> None:
    found = choose("200 mm", "5 um")
    assert found.suitability[0] < 0.1
    assert "takes" in found.speaks_against[0]
    assert "makes" in found.speaks_for[0]


def test_the_nearer_the_better() -> None:
    """A feed ever larger than a mill takes suits it ever less, a factor of ten for a decade."""
    marks = [
        dict(zip(f.mill, f.suitability, strict=True))["ultrafine grinder (fluid-energy mill, agitated mill)"]
        for f in (choose(f"{size} mm", "10 um") for size in (6, 60, 600))
    ]
    assert marks == pytest.approx([1.0, 0.1, 0.01])


def test_the_end_of_a_range_is_within_it() -> None:
    """Read in other units, 200 µm is no longer the 0.2 mm of the table to the last digit."""
    found = choose("20 mm", "200 um")
    place = [name.startswith("intermediate") for name in found.mill].index(True)
    assert found.speaks_against[place] == ""
    assert found.suitability[place] == 1.0


def test_a_mill_makes_nothing_coarser() -> None:
    with pytest.raises(InputError, match="finer than the feed"):
        choose("1 mm", "2 mm")


def test_its_units_exist() -> None:
    for row in dataset("comminution", "mills_mccabe2005"):
        for key in row["models"].split():
            assert registry.find(key).card.sort == "equipment"
