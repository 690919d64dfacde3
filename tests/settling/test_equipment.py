"""Settling equipment in streams: conservation, grade efficiency, limits, simulations and charts."""

from __future__ import annotations

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.cases.alone import alone
from granum.core.errors import InputError
from granum.particles.formulas.terminal import terminal_velocity
from granum.settling import charts
from granum.settling.equipment.api_separator import ApiSeparator
from granum.settling.equipment.clarifier_thickener import ClarifierThickener
from granum.settling.equipment.clarifiers import (
    CircularClarifier,
    Clarifier,
    GritChamber,
    Lamella,
    RectangularClarifier,
)
from granum.settling.equipment.thickener import Thickener
from granum.settling.simulations import batch_simulation, continuous_simulation
from granum.settling.velocities import Vesilind
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

EDGES = tuple(np.geomspace(2e-6, 5e-4, 13))
MIXTURE = Mixture(
    solids=(
        Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),
        Species("oil", (("oil", 1.0),), (880.0,), (2000.0,)),
    ),
    liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
    gases=(),
    size_edges=EDGES,
    liquid_viscosity=lambda w, T: 1e-3,
)


def feed(water=100.0, sand=0.02, oil=0.001):
    return empty(MIXTURE).replace(
        solid=jnp.stack([jnp.full(12, sand), jnp.full(12, oil)]), liquid=jnp.array([water])
    )


UNITS = [
    Clarifier(100.0, 100.0),
    CircularClarifier(12.0, 3.0, 100.0),
    RectangularClarifier(20.0, 4.0, 3.0, 100.0),
    Lamella(60.0, 2.5, 1.25, 0.05, 50.0),
    Lamella(60.0, 2.5, 1.25, 0.05, 50.0, flow_direction="crosscurrent"),
    GritChamber(15.0, 0.5, 0.7),
    Thickener(100.0, 30.0, Vesilind("5 m/hour", 0.2)),
    ApiSeparator(18.0, 3.6, 1.1),
    ClarifierThickener(500.0, 4.0, 0.03, Vesilind("5 m/hour", 0.4), settling_time=86400.0, cells=20),
]


@pytest.mark.parametrize("unit", UNITS, ids=lambda u: type(u).__name__)
def test_every_unit_conserves_mass_and_energy(unit):
    stream = feed()
    outlets = eqx.filter_jit(unit)(stream)
    found = closure([stream], list(outlets))
    assert float(found.mass) < 1e-12
    assert float(found.energy) < 1e-12
    for outlet in outlets:
        assert float(jnp.min(outlet.solid)) >= 0.0
        assert float(jnp.min(outlet.liquid)) >= 0.0
    figures = unit.operate(feed=stream).figures
    assert all(np.isfinite(float(x)) for x in figures)
    assert all(check.name and check.source for check in unit.operate(feed=stream).checks)


def test_clarifier_removes_each_class_in_the_ratio_of_its_velocity():
    stream = feed(sand=1e-6, oil=0.0)  # too dilute to be hindered
    unit = Clarifier(100.0, 100.0)
    out = unit(stream)
    removed = np.asarray(out.underflow.solid[0] / stream.solid[0])
    v = np.asarray(terminal_velocity(MIXTURE.sizes, 2650.0, 1000.0, 1e-3))
    np.testing.assert_allclose(removed, np.minimum(v / (0.1 / 100.0), 1.0), rtol=1e-4)


def test_what_floats_is_skimmed_by_the_same_statement_and_never_sinks():
    stream = feed(sand=0.0, oil=1e-6)
    out = Clarifier(100.0, 100.0, skimmings_concentration=300.0)(stream)
    skimmed = np.asarray(out.skimmings.solid[1] / stream.solid[1])
    v = -np.asarray(terminal_velocity(MIXTURE.sizes, 880.0, 1000.0, 1e-3))
    np.testing.assert_allclose(skimmed, np.minimum(v / (0.1 / 100.0), 1.0), rtol=1e-4)
    assert float(out.underflow.mass_flow) == 0.0
    assert float(out.skimmings.solid_flow / out.skimmings.slurry_volume_flow) == pytest.approx(300.0)
    # side by side with sand, in either order of the species
    both = CircularClarifier(12.0, 3.0, 100.0)(feed())
    assert float(both.underflow.solid[1].sum()) == float(both.skimmings.solid[0].sum()) == 0.0
    turned = Mixture(MIXTURE.solids[::-1], MIXTURE.liquids, (), EDGES, liquid_viscosity=lambda w, T: 1e-3)
    other = empty(turned).replace(solid=feed().solid[::-1], liquid=feed().liquid)
    again = CircularClarifier(12.0, 3.0, 100.0)(other)
    np.testing.assert_allclose(again.skimmings.solid[::-1], both.skimmings.solid, rtol=1e-12)


def test_a_machine_without_a_skimmer_says_that_oil_has_no_outlet():
    stream, sludge = feed(sand=0.02, oil=0.01), Vesilind("5 m/hour", 0.2)
    for unit in (Thickener(100.0, 30.0, sludge), UNITS[-1]):
        made = unit.operate(feed=stream)
        said = {check.name: check for check in made.checks}["floating matter, which has no outlet here"]
        assert not said.ok
        assert float(said.value) == pytest.approx(1 / 3)
    assert float(Thickener(100.0, 30.0, sludge)(stream).underflow.solid[1].sum()) == 0.0


def test_thickener_passes_the_limit_and_spills_the_rest():
    sludge = Vesilind("5 m/hour", 0.5)
    stream = empty(MIXTURE).replace(solid=jnp.zeros((2, 12)).at[0].set(0.05), liquid=jnp.array([240.0]))
    unit = Thickener.size(0.6, 2.5, 10.0, sludge, safety_factor=1.0)
    exact = unit(stream)
    assert float(exact.underflow.solid_flow) == pytest.approx(0.6, rel=1e-2)
    small = Thickener(0.5 * unit.area, 10.0, sludge)
    out = small(stream)
    assert float(out.underflow.solid_flow) == pytest.approx(0.3, rel=1e-2)
    figures = small.operate(feed=stream).figures
    assert float(figures.loading_ratio) == pytest.approx(2.0, rel=1e-2)
    assert float(out.underflow.solid_flow / out.underflow.slurry_volume_flow) == pytest.approx(10.0, rel=1e-9)
    assert not unit.operate(feed=stream).checks[0].ok or figures.limiting_flux > 0
    # More area never gives less underflow, by the exact derivative.
    slope = jax.grad(lambda a: Thickener(a, 10.0, sludge)(stream).underflow.solid_flow)(0.5 * unit.area)
    assert float(slope) == pytest.approx(0.3 / (0.5 * float(unit.area)), rel=1e-6)


def test_api_separator_skims_all_oil_of_the_design_globule():
    unit = ApiSeparator.size(0.06, 1000.0, 880.0, 1e-3)
    edges = (1.499e-4, 1.501e-4)
    mixture = Mixture(MIXTURE.solids[1:], MIXTURE.liquids, (), edges, liquid_viscosity=lambda w, T: 1e-3)
    stream = empty(mixture).replace(solid=jnp.full((1, 1), 1e-4), liquid=jnp.array([59.9]))
    out = unit(stream)
    # Stokes in the design, full drag here
    assert float(out.skimmings.solid_flow / stream.solid_flow) == pytest.approx(1.0, abs=0.1)
    assert all(check.ok for check in unit.operate(feed=stream).checks)


def test_continuous_simulation_answers_bad_input():
    sludge = Vesilind("5 m/hour", 0.5)
    with pytest.raises(InputError, match="one value or one for each"):
        continuous_simulation([0, 3600, 7200], [0.1, 0.1, 0.1], 2.5, 0.03, 1000, 4, sludge)
    with pytest.raises(InputError, match="run dry"):
        continuous_simulation([0, 3600], 0.1, 2.5, 0.2, 1000, 4, sludge)
    with pytest.raises(InputError, match="must increase"):
        batch_simulation(3.0, 0.4, [0, 300, 200], sludge)


def test_charts_draw():
    sludge = Vesilind("5 m/hour", 0.4)
    times = np.linspace(0, 7200, 30)
    course = batch_simulation(3.0, 0.4, times, sludge, cells=60)
    assert course.mass_error < 1e-12
    curve = charts.settling_curve_chart(times, course.interface_height, 3.0)
    assert any("A–B" in (a.text or "") for a in curve.layout.annotations)
    diagram = charts.flux_diagram(0.22, 2.5, 0.083, 1000.0, sludge)
    assert len(diagram.data) == 5
    moving = charts.settling_course_chart(3.0, 0.4, times[:6], sludge, cells=40)
    assert len(moving.frames) == 6


def test_clarifier_thickener_agrees_with_flux_theory_and_with_its_own_simulation():
    """Underflow of all solids at the given flow; overloaded, what the thickening zone passes (Lambert W, by
    hand in test_thickening).
    """
    law = Vesilind("5 m/hour", 0.5)
    slurry = empty(MIXTURE).replace(
        solid=jnp.zeros((2, 12)).at[0].set(2.5 * 800 / 3600 / 12),
        liquid=jnp.array([(1 - 2.5 / 2650) * 800 / 3.6]),
    )
    unit = ClarifierThickener(1000.0, 4.0, "300 m^3/hour", law, settling_time="4 day")
    out, figures, checks, course, *_rest = unit.operate(feed=slurry)
    assert float(figures.underflow_concentration) == pytest.approx(2.5 * 800 / 300, rel=1e-9)
    assert float(out.underflow.slurry_volume_flow) * 3600 == pytest.approx(300.0, rel=1e-9)
    assert float(course.underflow_concentration[-1]) == pytest.approx(
        float(figures.underflow_concentration), rel=1e-3
    )
    assert float(figures.retention_time) == pytest.approx(
        float(figures.solids_held) / float(slurry.solid_flow)
    )
    assert all(check.ok for check in checks)
    small = ClarifierThickener(300.0, 4.0, "300 m^3/hour", law, settling_time="4 day")
    spilled, figures, checks, *_rest = small.operate(feed=slurry)
    assert float(figures.loading_ratio) > 1.0
    assert float(spilled.overflow.solid_flow) == pytest.approx(
        float(slurry.solid_flow) * (1 - 1 / float(figures.loading_ratio)), rel=1e-9
    )
    assert not all(check.ok for check in checks)


@pytest.mark.parametrize(
    ("unit", "word"),
    [
        ("flocculator", "volume"),
        ("clarifier", "area"),
        ("clarifier", "underflow_concentration"),
        ("lamella", "skimmings_concentration"),
        ("grit_chamber", "underflow_concentration"),
        ("api_separator", "underflow_concentration"),
        ("clarifier_thickener", "settling_time"),
    ],
)
def test_a_settler_without_size_or_thickness_is_refused_in_words(unit: str, word: str) -> None:
    with pytest.raises(InputError, match="is not possible") as refused:
        alone(f"settling.{unit}", **{word: "0"})
    assert refused.value.exit_code == 2


def test_overflow_rate_and_weir_of_a_round_clarifier_by_hand():
    # 300 t/h of water and 100 kg/h of stone on 18 m: π/4 · 18² = 254.47 m², a wall of 56.55 m
    checks = {
        c.name: c for c in alone("settling.circular_clarifier").solve().units["circular_clarifier"].checks
    }
    surface, weir = checks["overflow rate"], checks["flow over the weir per length"]
    assert float(surface.value) * 86400 == pytest.approx(7200 / 254.47, rel=2e-3)
    assert float(weir.value) == pytest.approx(7200 / 56.55, rel=1e-2)
    assert surface.ok
    assert weir.ok
    crowded = alone("settling.circular_clarifier", diameter="8 m", weir_length="12 m").solve()
    failed = {c.name for c in crowded.units["circular_clarifier"].checks if not c.ok}
    assert {"overflow rate", "flow over the weir per length"} <= failed


def test_a_weir_of_unknown_length_is_not_judged():
    names = [c.name for c in RectangularClarifier(20.0, 4.0, 3.0, 100.0).operate(feed=feed()).checks]
    assert "overflow rate" in names
    assert "flow over the weir per length" not in names


def test_floating_matter_is_spoken_of_where_something_floats():
    said = "floating matter, which has no outlet here"
    plain = alone("settling.thickener").solve().units["thickener"]
    assert said not in [check.name for check in plain.checks]
    oily = alone(
        "settling.thickener",
        **{
            "mixture": {"solids": ["calcite", "crude oil"]},
            "feed": {"solid": {"calcite": "90 %", "crude oil": "10 %"}},
        },
    )
    assert said in [check.name for check in oily.solve().units["thickener"].checks]
