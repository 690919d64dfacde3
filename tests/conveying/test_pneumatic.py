"""Pneumatic conveying: printed and peers' numbers, limits and signs of the laws, the line in a flowsheet."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.conveying.equipment.pneumatic import PneumaticConveyor
from granum.core.errors import ConvergenceError, GranumError
from granum.flowsheet import Flowsheet
from granum.flowsheet.findings import CLOSURE
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

EDGES = list(np.geomspace(2e-5, 2e-3, 13))
AIR = mixture_of(["water"], ["quartz", "starch"], ["dry air", "water"], EDGES)
OTHER = mixture_of(["water"], ["starch", "quartz"], ["water", "nitrogen"], EDGES)
LAWS: tuple[Any, ...] = ("rizk", "matsumoto", "schade", "weber")
PIPE = np.pi / 4.0


def alone(unit, **feeds):
    return Flowsheet({"u": unit}, feeds, {n: ("", f"u.{n}") for n in feeds}).solve()


def sand(mixture, flow: float = 0.25, middle: int = 6, spread: float = 1.0):
    """Quartz around a class."""
    share = np.exp(-0.5 * ((np.arange(12) - middle) / spread) ** 2)
    solid = [flow * share / share.sum() * (s.name == "quartz") for s in mixture.solids]
    return empty(mixture, 295.0).replace(solid=jnp.asarray(np.stack(solid)))


def air(mixture, flow: float = 0.2, pressure: float = 1.5e5):
    gas = [flow * (0.005 if g.name == "water" else 1.0) for g in mixture.gases]
    return empty(mixture, 310.0, pressure).replace(gas=jnp.asarray(gas))


# -- numbers of others
# ------------------------------------------------------------------------------------------------------------
def test_saltation_laws_of_a_peer() -> None:
    """ChEDL fluids 1.3.1, its own examples: 1 kg/s of 1 mm and 1000 kg/m³ in 0.1 m; Rizk as Rhodes prints."""
    flux = 1.0 / (PIPE * 0.1**2)
    c = gr.conveying
    rhodes = c.saltation_velocity_rizk(0.25 / (PIPE * 0.078**2), 1e-4, 1.2, 0.078)
    assert rhodes == pytest.approx(9.8833092829357, rel=1e-6)
    found = c.saltation_velocity_matsumoto(flux, 1e-3, 1000.0, 1.2, 5.24, 0.1)
    assert found == pytest.approx(16.64284834446686, rel=1e-6)
    assert c.saltation_velocity_schade(flux, 1e-3, 1000.0, 1.2, 0.1) == pytest.approx(
        13.697415809497912, rel=1e-6
    )
    assert c.saltation_velocity_weber(flux, 1e-3, 1.2, 4.0, 0.1) == pytest.approx(
        15.227445436331474, rel=1e-6
    )


def test_friction_factor_of_a_peer() -> None:
    """ChEDL fluids 1.3.1: Churchill_1977(Re=1E5, eD=1E-4), and its example of laminar flow."""
    c = gr.conveying
    assert c.friction_factor_churchill(1e5, 1e-4) == pytest.approx(0.018462624566280075, rel=1e-9)
    assert c.friction_factor_churchill(1e-3) == pytest.approx(64.0e3, rel=1e-6)


def test_a_sheet_after_rhodes_method() -> None:
    """Read in full: 500 kg/h of 150 µm and 1450 kg/m³ in 50 mm at 13.8165 m/s of 1.2 kg/m³, 100 m level."""
    c, flux = gr.conveying, 500.0 / 3600.0 / (PIPE * 0.05**2)
    assert flux == pytest.approx(70.73553, rel=1e-6)
    assert c.saltation_velocity_rizk(flux, 1.5e-4, 1.2, 0.05) == pytest.approx(9.211, abs=2e-3)
    v = c.particle_velocity_hinkle(13.8165, 1.5e-4, 1450.0)
    assert v == pytest.approx(11.42467, rel=1e-6)
    gas = 13.8165 / 0.99573
    reynolds = 1.2 * (gas - v) * 1.5e-4 / 1.8e-5
    assert reynolds == pytest.approx(24.5, abs=0.05)
    factor = c.particle_friction_factor_hinkle(gas, v, 1.5e-4, 1450.0, 1.2, 0.05, 2.713673)
    assert factor == pytest.approx(0.012921, abs=2e-6)
    assert 100.0 * c.pressure_gradient_solid_hinkle(flux, v, 0.05, factor) == pytest.approx(41768.5, rel=2e-4)
    # theirs is an explicit factor of a rough pipe
    assert 100.0 * c.pressure_gradient_pipe(13.8165, 0.05, 1.2, 1.8e-5, 0.05e-3) == pytest.approx(
        4940.0, rel=0.15
    )


# -- laws
# ------------------------------------------------------------------------------------------------------------
def test_choking_solves_both_of_its_equations() -> None:
    for law, args in (("punwani", (1.2,)), ("yang", ())):
        found = getattr(gr.conveying, f"choking_{law}")(60.0, 2000.0, *args, 1.5, 0.08)
        slip = found.choking_velocity / found.void_fraction - 1.5
        assert slip == pytest.approx(60.0 / (2000.0 * (1.0 - found.void_fraction)), rel=1e-8)
        spread = found.void_fraction**-4.7 - 1.0
        if law == "punwani":
            assert 2250.0 * 0.08 * spread / slip**2 == pytest.approx(1.2**0.77, rel=1e-8)
        else:
            assert 2.0 * 9.80665 * 0.08 * spread / slip**2 == pytest.approx(0.01, rel=1e-8)


def test_more_solid_chokes_earlier_and_none_at_its_fall() -> None:
    flux = np.array([0.0, 1.0, 10.0, 100.0, 1000.0])
    u = np.asarray(gr.conveying.choking_punwani(flux, 2000.0, 1.2, 1.0, 0.1).choking_velocity)
    assert u[0] == pytest.approx(1.0, rel=1e-9)
    assert np.all(np.diff(u) > 0.0)
    # near the atmosphere both laws are one
    y = np.asarray(gr.conveying.choking_yang(flux, 2000.0, 1.0, 0.1).choking_velocity)
    assert y == pytest.approx(u, rel=0.02)


def test_pickup_zones_meet_and_fine_powder_clings() -> None:
    """Archimedes numbers of 0.45 and 16.5; within the fine zone smaller particles are harder to lift."""
    rho, eta = 1.2, 1.8e-5
    for ar in (0.45, 16.5):
        d = (ar * eta**2 / (rho * (2600.0 - rho) * 9.80665)) ** (1.0 / 3.0)
        below, above = (
            gr.conveying.pickup_velocity_kalman(x * d, 2600.0, rho, eta, 0.05) for x in (0.9999, 1.0001)
        )
        assert below == pytest.approx(above, rel=0.01)
    d = np.array([1e-3, 3e-4, 3e-5, 2.2e-5])
    u = np.asarray(gr.conveying.pickup_velocity_kalman(d, 2600.0, rho, eta, 0.05))
    assert u[0] > u[1]
    assert u[3] > u[2]


def test_pipe_for_a_duty_keeps_its_margin() -> None:
    for size, margin, loading in ((1e-4, 1.5, 3.0), (1e-3, 1.3, 8.0), (3e-3, 2.0, 0.5)):
        d = gr.conveying.diameter_pneumatic(0.5, loading, size, 1.8, margin)
        flux = 0.5 / (PIPE * d**2)
        velocity = flux / loading / 1.8
        salted = gr.conveying.saltation_velocity_rizk(flux, size, 1.8, d)
        assert velocity / salted == pytest.approx(margin, rel=1e-9)


# -- the unit
# ------------------------------------------------------------------------------------------------------------
USUAL: dict[str, Any] = {"diameter": 0.09, "length_horizontal": 30.0, "length_vertical": 10.0, "bends": 6}


def line(**more: Any) -> PneumaticConveyor:
    return PneumaticConveyor(**(USUAL | more))


def test_the_line_conserves_and_other_orders_say_the_same() -> None:
    first = alone(line(), feed=sand(AIR), gas=air(AIR))
    assert first.audit["mass_closure"] < CLOSURE
    assert first.audit["energy_closure"] < CLOSURE
    other = alone(line(), feed=sand(OTHER), gas=air(OTHER))
    # nitrogen is 3 % lighter than air
    assert other.figure("u.pressure_drop") == pytest.approx(first.figure("u.pressure_drop"), rel=0.05)
    assert all(c.ok for c in first.units["u"].checks)


def test_without_solid_the_line_is_a_pipe() -> None:
    """Isothermal gas in a long pipe, closed form: p₁² − p₂² = (G/A)² R T/M f L/D, acceleration apart."""
    gas = air(AIR, 0.3, 2e5)
    run = alone(PneumaticConveyor(0.1, 200.0), feed=empty(AIR, 310.0), gas=gas)
    flux = float(gas.gas_flow) / (PIPE * 0.01)
    rho = float(gas.gas_density)
    f = gr.conveying.friction_factor_churchill(flux * 0.1 / float(gas.gas_viscosity), 5e-4)
    start = 2e5 - 0.5 * flux**2 / rho  # Bernoulli: from rest
    end = np.sqrt(start**2 - flux**2 * (2e5 / rho) * f * 2000.0)
    assert run.figure("u.pressure_drop") == pytest.approx(2e5 - end, rel=1e-6)
    assert run.figure("u.saltation_velocity") == 0.0 == run.figure("u.choking_velocity")


def test_longer_steeper_and_fuller_lines_lose_more() -> None:
    base = {"feed": sand(AIR), "gas": air(AIR)}
    lost = alone(line(), **base).figure("u.pressure_drop")
    changes: tuple[dict[str, Any], ...] = (
        {"length_horizontal": 40.0},
        {"length_vertical": 15.0},
        {"bends": 8},
        {"bend_coefficient": 1.5},
        {"pipe_roughness": 2e-4},
        {"diameter": 0.08},
        {"level_friction": "hinkle"},
    )
    for more in changes:
        assert alone(line(**more), **base).figure("u.pressure_drop") > lost
    fuller = alone(line(), feed=sand(AIR, 0.5), gas=air(AIR))
    assert fuller.figure("u.pressure_drop") > lost


def test_a_sucked_line_with_a_fan_behind_counts_one_fan() -> None:
    from granum.streams.equipment.movers import Fan

    feeds = {"feed": sand(AIR, 0.1), "gas": air(AIR, 0.12, 101325.0)}
    ways = {"feed": ("", "u.feed"), "gas": ("", "u.gas")}
    alone_ = Flowsheet({"u": line()}, feeds, ways).solve()
    drop = alone_.figure("u.pressure_drop")
    fan = {"u": line(), "fan": Fan(drop)}
    run = Flowsheet(fan, feeds, ways | {"dusty": ("u.product", "fan.feed")}).solve()
    assert float(run.streams["dusty"].pressure) == pytest.approx(101325.0 - drop)
    own = float(alone_.utilities.electric_power)
    together = float(run.utilities.electric_power)
    assert together == pytest.approx(own, rel=0.1)


def test_what_cannot_be_conveyed_is_refused_in_words() -> None:
    with pytest.raises(ConvergenceError, match="wider pipe"):
        alone(line(length_horizontal=3000.0), feed=sand(AIR), gas=air(AIR))
    with pytest.raises(GranumError):
        alone(line(), feed=sand(AIR), gas=empty(AIR, 300.0, 1.5e5))
    slow = alone(line(diameter=0.16), feed=sand(AIR), gas=air(AIR))
    failed = [c.name for c in slow.units["u"].checks if not c.ok]
    assert "gas velocity over that of saltation" in failed


def test_random_ordinary_lines_close_or_say_why() -> None:
    seeds = np.random.default_rng(4)
    refused = solved = 0
    for _ in range(30):
        pipe = 10 ** seeds.uniform(-1.3, -0.6)
        gas = air(AIR, float(PIPE * pipe**2 * seeds.uniform(8.0, 40.0) * 1.7), seeds.uniform(1.1e5, 2.5e5))
        flow = float(gas.gas_flow) * seeds.uniform(0.1, 8.0)
        unit = PneumaticConveyor(
            pipe,
            seeds.uniform(0, 80),
            seeds.uniform(0, 20),
            seeds.integers(0, 9),
            saltation=LAWS[seeds.integers(0, 4)],
        )
        feed = sand(AIR, flow, int(seeds.integers(0, 12)), seeds.uniform(0.3, 4.0))
        try:
            run = alone(unit, feed=feed, gas=gas)
        except ConvergenceError as problem:
            refused += "wider pipe" in str(problem)
            continue
        solved += 1
        assert run.audit["mass_closure"] < CLOSURE
        assert run.audit["energy_closure"] < CLOSURE
        assert run.figure("u.pressure_drop") > 0.0
        assert run.figure("u.gas_velocity_outlet") > run.figure("u.gas_velocity_inlet")
    assert refused + solved == 30
    assert solved > 15


def test_the_drop_has_a_derivative() -> None:
    def drop(length):
        made = line(length_horizontal=length).operate(feed=sand(AIR), gas=air(AIR))
        return made.figures.pressure_drop

    slope = float(jax.grad(drop)(30.0))
    assert slope == pytest.approx(float(drop(30.01) - drop(29.99)) / 0.02, rel=1e-5)
