"""Units at random ordinary settings, empty feeds among them: a solution that conserves and keeps its bounds,
or one word of the unit itself.

GRANUM_RANDOM_SAMPLES tries every unit so often, with few and with many size classes; otherwise some of each
kind, a hundred times; what has random settings of its own (enantiomers, several salts) is left out.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.contracts import crystallizer_cases, evaporator_cases, membrane_cases, unit_cases, vessel_cases
from tests.contracts.unit_search import EMPTY, Case, Tried, disordered, rows, tried, wrong
from tests.sharing.samples import SAMPLES

GROUPS = {
    "mills": unit_cases.mills,
    "filters": unit_cases.filters,
    "centrifuges": unit_cases.centrifuges,
    "basics": unit_cases.basics,
    "crystallizers": vessel_cases.crystallizers,
    "evaporators": evaporator_cases.evaporators,
    "mixed": crystallizer_cases.mixed,
    "membranes": membrane_cases.membranes,
}
QUICK = (
    "mill plug",
    "screen ideal",
    "sized screen 3 wet",
    "cartridge",
    "drum",
    "thickening",
    "tower",
    "tube",
    "gravity",
    "decanter",
    "peeler",
    "heater",
    "msmpr",
    "evaporator",
    "recompression",
    "drowned",
    "drowned in batches",
    "ultrafiltration",
    "osmosis",
    "layers",
    "wash column",
    "dissolver",
    "sublimer",
    "desublimer",
    "flotation",
    "belt press",
    "screw press",
    "gas carbon",
    "liquid carbon",
    "hydroxide",
    "uptake",
    "baffled tube",
    "needles",
)
CLASSES = (2, 8, 40) if SAMPLES else (8,)
COUNT = max(SAMPLES, 100)
SLOW = {"enantiomers": 30}  # of which each takes a fifth of a second
CASES = [(group, name) for group, made in GROUPS.items() for name in made(2) if SAMPLES or name in QUICK]


def cumulative(solid: np.ndarray) -> np.ndarray:
    """Solid of each species finer than each class boundary, kg/s."""
    return np.cumsum(solid, axis=2)


def coarser(found: Tried) -> np.ndarray:
    """By how much the product of a mill has less below some size than its feed, as a share of the feed."""
    feed, product = found.feeds["feed"].solid, found.products["product"].solid
    return (cumulative(feed) - cumulative(product)).max(axis=(1, 2)) / np.maximum(
        feed.sum(axis=(1, 2)), 1e-300
    )


def wetter(found: Tried, name: str) -> np.ndarray:
    """By how much a cake holds more liquid per solid than its feed, as a share of the feed's."""
    feed, cake = found.feeds["feed"], found.products[name]
    held, had = (s.liquid.sum(axis=1) / np.maximum(s.solid.sum(axis=(1, 2)), 1e-300) for s in (cake, feed))
    return np.where(feed.solid.sum(axis=(1, 2)) > 0, held / np.maximum(had, 1e-300) - 1.0, 0.0)


def judge(case: Case, name: str, found: Tried) -> None:
    """What physics demands of each kind of unit besides the balances."""
    ok = ~found.refused
    out = found.products
    nothing = (
        sum(s.solid.sum(axis=(1, 2)) + s.liquid.sum(axis=1) + s.gas.sum(axis=1) for s in found.feeds.values())
        == 0.0
    )
    for s in out.values():
        assert not any(part[nothing & ok].any() for part in (s.solid, s.liquid, s.gas))
    if name.startswith(("mill", "bond", "cone")):
        assert coarser(found)[ok].max() <= 1e-9
    if "cake" in out and "wash" in found.feeds:
        unwashed = found.feeds["wash"].liquid.sum(axis=1) == 0.0
        assert wetter(found, "cake")[ok & unwashed].max() <= 1e-9
    if "sediment" in out:
        assert wetter(found, "sediment")[ok].max() <= 1e-9
    if name.startswith(("screen", "sized", "two", "three")):
        parts = [s.solid for s in out.values()]
        fed = found.feeds["feed"].solid
        assert all(((part >= 0.0) & (part <= fed * (1.0 + 1e-12))).all() for part in parts)


@pytest.mark.parametrize("classes", CLASSES)
@pytest.mark.parametrize(("group", "name"), CASES)
def test_random_settings(group: str, name: str, classes: int) -> None:
    case, x = GROUPS[group](classes)[name], rows(max(SAMPLES, SLOW.get(name, COUNT)))
    found = tried(case, x)
    print(f"{name}, {classes} classes: {len(x)} tried, {int(found.refused.sum())} refused")
    assert not wrong(found)
    assert found.refused.mean() <= 0.3
    judge(case, name, found)


@pytest.mark.parametrize(("group", "name"), [c for c in CASES if SAMPLES or c[1] == "drum"])
def test_the_order_of_the_species_does_not_matter(group: str, name: str) -> None:
    case, x = GROUPS[group](8)[name], rows(COUNT)
    found, other = tried(case, x), tried(case, x, reverse=True)
    np.testing.assert_array_equal(found.refused, other.refused)
    assert not disordered(found, other, ~found.refused & (np.arange(COUNT) >= EMPTY))
