"""A result over one of its inputs, and equations with their numbers."""

from __future__ import annotations

import re

import numpy as np
import pytest

from granum.app.forms import docstring_values
from granum.core import registry
from granum.core.errors import GranumError
from granum.core.i18n import language
from granum.reports.numbers import numbered
from granum.reports.quantities import beside_rows, in_units
from granum.reports.sensitivity import chart, covered, curve

SPHERE = {
    "particle_diameter": "85 um",
    "particle_density": 2650.0,
    "fluid_density": 1000.0,
    "dynamic_viscosity": 1e-3,
}


def test_the_curve_is_the_law_and_the_point_is_the_result() -> None:
    """Stokes: v ~ d², so a straight line of slope 2 on logarithmic axes."""
    thing = registry.find("particles.terminal_velocity_stokes")
    result = thing.evaluate(**SPHERE)
    found = curve(thing, result)
    assert found is not None
    assert found.against.name == "particle_diameter"
    assert found.logarithmic
    assert found.steep
    assert np.allclose(found.y, result.value * (found.x / 85e-6) ** 2, rtol=1e-12)
    assert found.point == pytest.approx(result.value, rel=1e-14)
    # Re = v d ρ/η ~ d³ is 0.2 at the end of what Stokes' law covers
    ((low, high),) = covered(found)
    reynolds = found.y * found.x * 1e6
    assert low == 0
    assert reynolds[high] <= 0.2 < reynolds[high + 1]
    assert chart(found).layout.xaxis.type == "log"


def test_axes_have_the_symbols_of_the_fields() -> None:
    thing = registry.find("crystallization.extractive_crystallization")
    found = curve(thing, thing.evaluate(**docstring_values(thing.card)), "solute_per_solvent", "purity")
    assert found is not None
    drawn = chart(found).layout
    assert "<i>C<sub>B</sub></i>" in drawn.xaxis.title.text
    assert "<i>w<sub>P</sub></i>" in drawn.yaxis.title.text


def test_beyond_the_hard_bounds_is_a_gap_and_no_zero() -> None:
    thing = registry.find("particles.sphericity_krumbein")
    found = curve(thing, thing.evaluate(**docstring_values(thing.card)))
    assert found is not None
    assert np.isnan(found.y).any()
    drawn = chart(found).data[0].y
    assert (
        sum(v is None or not np.isfinite(v) for v in np.asarray(drawn, dtype=float))
        == np.isnan(found.y).sum()
    )


@pytest.mark.parametrize(
    "key", ["humid_gas.cooling", "centrifuges.filtrate_flow_basket", "settling.rise_velocity_api"]
)
def test_every_number_of_a_card_can_be_drawn_over_every_input(key: str) -> None:
    thing = registry.find(key)
    result = thing.evaluate(**docstring_values(thing.card))
    for p in thing.card.parameters:
        found = curve(thing, result, p.name)
        if found is not None and found.against is p:
            at = np.searchsorted(found.x, found.at)
            assert found.y[at] == pytest.approx(result.outputs[found.output.name], rel=1e-9)


def test_numbers_on_the_way_are_told_with_their_range() -> None:
    with language("en"):
        (row,) = beside_rows(registry.find("particles.terminal_velocity_stokes").evaluate(**SPHERE))
        assert row.label == "Reynolds number"
        assert row.place == "above 0 … 0.2"
        assert not row.inside
        (row,) = beside_rows(registry.find("particles.terminal_velocity").evaluate(**SPHERE))
        assert row.inside
    with language("fr"):
        (row,) = beside_rows(registry.find("particles.terminal_velocity").evaluate(**SPHERE))
        assert row.place.startswith("dans 0 … 2 × 10⁵")


def test_a_number_has_all_its_digits_in_every_unit() -> None:
    p = registry.find("particles.terminal_velocity").card.outputs[0]
    rows = {row["unit"]: row for row in in_units(1.0 / 3.0, p)}
    assert rows["mm/s"]["full"] == "333.333333333"
    assert rows["m/s"]["text"] == "0.3333"
    with language("fr"):
        assert in_units(1.0 / 3.0, p)[0]["full"] == "333,333333333"


def test_an_equation_is_shown_with_numbers_only_where_they_give_the_result() -> None:
    with language("en"):
        stokes = registry.find("particles.terminal_velocity_stokes")
        text = numbered(stokes.evaluate(**SPHERE))
        assert text.startswith("v_t =")
        assert r"\left(\text{8.5 × 10⁻⁵ m}\right)^2" in text
        assert text.endswith(r"= \text{6.495 mm/s}")
    # Bond's law in its printed form wants the sizes in µm: no numbers in SI stand in it
    bond = registry.find("comminution.work_index_operating")
    assert numbered(bond.evaluate(**docstring_values(bond.card))) == ""


@pytest.mark.parametrize("code", ["en", "fr"])
def test_no_equation_with_numbers_holds_a_symbol(code: str) -> None:
    shown = 0
    with language(code):
        for key in sorted(registry.everything())[::7]:
            thing = registry.find(key)
            if thing.card.sort != "formula" or not thing.card.equation:
                continue
            try:
                text = numbered(thing.evaluate(**docstring_values(thing.card)))
            except GranumError:
                continue
            for line in filter(None, text.split(r",\quad")):
                numbers = line.partition("=")[2].partition(r"\;\Rightarrow")[0]
                right = re.sub(
                    r"\\text\{[^}]*\}|\\(mathrm|operatorname) *(\{[^}]*\}|[A-Z])|\\[A-Za-z]+", "", numbers
                )
                assert not re.search(r"[A-Za-df-z]", right), f"{key}: {text}"
            shown += bool(text)
    assert shown > 60
