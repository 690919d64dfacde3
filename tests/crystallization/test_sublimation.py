"""Solids that go to vapor and back: against printed pressures and a printed balance, and in lines."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.alone import alone
from granum.core.errors import CaseError, GranumError
from granum.crystallization.equipment.sublimation import Desublimer, Sublimer
from granum.crystallization.formulas.sublimation import vapors_held
from granum.materials.library import solid
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

c = gr.crystallization
EDGES = np.geomspace(5e-6, 2e-3, 11)
PAIR = ["naphthalene", "benzoic acid"]


@pytest.mark.parametrize(
    ("name", "temperature", "pressure", "spread"),
    [
        ("naphthalene", 267.88, 0.4, 0.07),  # de Kruif, abstract opened
        ("anthracene", 351.28, 0.4, 0.35),  # the same; Malaspina's effusion gives a third more
        ("naphthalene", 273.15, 0.8, 0.05),  # Růžička, Fulem and Růžička, abstract opened
        ("benzoic acid", 360.0, 10 ** (12.175 - 4501 / 360) * 133.322, 1e-3),  # Malaspina, abstract opened
        ("iodine", 320.0, 223.0, 0.05),  # CRC Handbook, recalled
    ],
)
def test_pressures_of_the_library(name: str, temperature: float, pressure: float, spread: float) -> None:
    assert float(solid(name).sublimation_pressure(temperature)) == pytest.approx(pressure, rel=spread)


@pytest.mark.parametrize(
    ("name", "molar", "spread"),
    [("naphthalene", 74.4e3, 0.05), ("anthracene", 100.4e3, 0.02), ("iodine", 62.4e3, 0.03)],
)
def test_heats_follow_from_the_slope(name: str, molar: float, spread: float) -> None:
    """De Kruif's two are opened (abstract); iodine's is recalled."""
    made = solid(name)
    assert float(made.heat_of_sublimation(320.0)) * made.molar_mass == pytest.approx(molar, rel=spread)
    T = np.linspace(300.0, 340.0, 5)
    whole = c.sublimation_pressure_clapeyron(T, float(made.sublimation_pressure(320.0)), 320.0, molar)
    assert np.asarray(made.sublimation_pressure(T)) == pytest.approx(np.asarray(whole), rel=0.1)


def test_salicylic_acid_of_the_textbook() -> None:
    """Richardson, Harker and Backhurst, example 15.9, recalled: 2000 kg/h of air at 423 K and 101.5 kPa take
    up 138 kg/h at 1.44 kPa; 0.26 kg/h leave the last condenser with 2.3 Pa at 85.6 kPa.
    """
    out = c.entrainer_balance(1440, 2.3, 101.5e3, 85.6e3, 0.138, 0.029)
    assert out.vapor_per_carrier_inlet * 2000 == pytest.approx(138, rel=0.015)
    assert out.vapor_per_carrier_outlet * 2000 == pytest.approx(0.26, rel=0.03)
    assert out.product_recovery == pytest.approx(1 - 0.26 / 138, rel=1e-3)
    assert out.carrier_per_product == pytest.approx(2000 / 137.7, rel=0.02)
    for pressures in ((2e5, 2.3), (1440, 2000)):
        with pytest.raises(GranumError):
            c.entrainer_balance.evaluate(*pressures, 101.5e3, 85.6e3, 0.138, 0.029).raise_for_flags()


def test_vapors_in_a_gas_by_plain_iteration() -> None:
    rng, of_gas = np.random.default_rng(3), jax.jit(vapors_held)
    for _try in range(30):
        others = 10 ** rng.uniform(-3, 1) * (rng.random() > 0.2)
        available, shares = 10 ** rng.uniform(-4, 1, 3), 10 ** rng.uniform(-5, 0.3, 3)
        held, moles = np.minimum(available, shares), others + available.sum()
        for _round in range(20000):  # from above to the largest solution
            held = np.minimum(available, shares * moles)
            new = others + held.sum()
            if abs(new - moles) < 1e-14 * moles:
                break
            moles = new
        expected = held if moles > 1e-8 * (others + available.sum()) else 0.0 * held
        found = np.asarray(of_gas(others, available, shares))
        assert found == pytest.approx(expected, rel=1e-6, abs=1e-7 * available.sum())
    assert float(of_gas(0.0, np.zeros(1), np.array([0.5]))[0]) == 0.0
    # whose pressure is above that of the vessel is gas wholly, however the sum is rounded
    others, available = rng.random((2, 50))
    for other, there in zip(others, 1e-3 * available, strict=True):
        assert float(of_gas(other, np.array([there]), np.array([9.0]))[0]) == there


def _random(rng: np.random.Generator) -> Stream:
    mixture = mixture_of([], [*PAIR, "quartz"], ["nitrogen", *PAIR], EDGES)
    shares = rng.random((3, 10))
    amounts = np.array([*(10 ** rng.uniform(-3, 0, 2)), 0.1 * rng.random()])
    gas = np.array([10 ** rng.uniform(-2, 2), *(0.01 * rng.random(2))])
    feed = empty(mixture, jnp.asarray(rng.uniform(280.0, 350.0))).replace(
        solid=jnp.asarray(amounts[:, None] * shares / shares.sum(axis=1, keepdims=True)),
        gas=jnp.asarray(gas),
    )
    return feed.replace(pressure=jnp.asarray(10 ** rng.uniform(3, 5.3)))


@eqx.filter_jit
def _passed(feed: Stream, hot: Any, share: Any, cold: Any) -> tuple[Any, Any]:
    """Through a vaporizer and a condenser."""
    vaporizer, condenser = Sublimer(hot, vapor_saturation=share), Desublimer(cold)
    up = vaporizer.outlets(vaporizer.inside(feed), feed)
    return up, condenser.outlets(condenser.inside(up.vapor), up.vapor)


def test_random_vaporizers_and_condensers_close() -> None:
    rng = np.random.default_rng(11)
    for _try in range(100):
        feed, T = _random(rng), rng.uniform(300.0, 352.0)
        condensed = rng.uniform(275.0, T)
        up, down = _passed(feed, jnp.asarray(T), jnp.asarray(rng.uniform(0.2, 1.0)), jnp.asarray(condensed))
        for before, after, duty in (
            (feed, (up.vapor, up.residue), up.heat_duty),
            (up.vapor, (down.product, down.exhaust), down.heat_duty),
        ):
            for k in range(3):
                held = [
                    float(s.solid_by_species[k] + (s.gas[1 + k] if k < 2 else 0.0)) for s in (before, *after)
                ]
                assert sum(held[1:]) == pytest.approx(held[0], rel=1e-12)
            whole = sum(float(s.enthalpy_flow) for s in after) - float(before.enthalpy_flow)
            assert whole == pytest.approx(float(duty), rel=1e-9, abs=1e-6)
            for stream in after:
                assert (np.asarray(stream.solid) >= 0.0).all()
                assert (np.asarray(stream.gas) >= 0.0).all()
        for k, name in enumerate(PAIR):
            moles = np.asarray(down.exhaust.gas) / np.array([g.molar_mass for g in feed.mixture.gases])
            partial = moles[1 + k] / moles.sum() * float(feed.pressure)
            saturated = float(solid(name).sublimation_pressure(condensed))
            assert partial <= saturated * (1 + 1e-9)
            if float(down.product.solid_by_species[k]) > 1e-12:
                assert partial == pytest.approx(saturated, rel=1e-6)


def test_condensers_in_series_take_vapors_apart() -> None:
    """Benzoic acid, the less volatile, before naphthalene; a warmer condenser loses more."""
    mixture = mixture_of([], PAIR, ["nitrogen", *PAIR], EDGES)
    feed = empty(mixture, 350.0).replace(gas=jnp.array([1.0, 0.005, 0.004]))
    one = Desublimer(330.0)
    warm = one.outlets(one.inside(feed), feed)
    two = Desublimer(290.0)
    cold = two.outlets(two.inside(warm.exhaust), warm.exhaust)
    first, second = (np.asarray(s.product.solid_by_species) for s in (warm, cold))
    assert first[0] == 0.0
    assert first[1] > 0.9 * 0.004
    assert second[0] / second.sum() > 0.95
    single = two.outlets(two.inside(feed), feed)
    assert np.asarray(single.product.solid_by_species) == pytest.approx(first + second, rel=1e-3)


def test_a_vacuum_needs_no_carrier() -> None:
    """Simple sublimation: nothing below the pressure of the vapor, everything above it."""
    mixture = mixture_of([], ["naphthalene"], ["naphthalene"], EDGES)
    feed = empty(mixture, 300.0).replace(solid=jnp.full((1, 10), 0.001))
    saturated = float(solid("naphthalene").sublimation_pressure(340.0))
    for pressure, share in ((0.9 * saturated, 1.0), (1.1 * saturated, 0.0)):
        unit = Sublimer(340.0, pressure=pressure)
        out = unit.outlets(unit.inside(feed), feed)
        assert float(out.vapor.gas[0]) == pytest.approx(0.01 * share, abs=1e-10)
        # the heat of sublimation and what warms the solid, from the slope of the pressure: 72 kJ/mol
        if share:
            assert float(out.heat_duty) / 0.01 * 0.128 == pytest.approx(74e3, rel=0.05)


def test_what_does_not_sublime_is_refused() -> None:
    mixture = mixture_of([], ["quartz"], ["nitrogen"], EDGES)
    with pytest.raises(CaseError, match="sublimation_pressure"):
        Sublimer(340.0).inside(empty(mixture, 300.0))
    lost = alone("crystallization.desublimer", temperature="74 degC").solve().units["desublimer"]
    assert [k.ok for k in lost.checks] == [False, True]
    empty_gas = alone("crystallization.sublimer", temperature="20 degC").solve().units["sublimer"]
    assert not empty_gas.checks[0].ok


def test_nitrogen_goes_round_in_a_line() -> None:
    run = gr.read(EXAMPLES / "sublimation" / "line.toml").solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert not [k.name for unit in run.units.values() for k in unit.checks if not k.ok]
    # of 19 kg/h of naphthalene only what the purge carries is lost: 11 Pa at 25 °C, 6.6 at 20 °C
    lost = 19.0 - float(run.streams["snow"].solid_flow) * 3600
    assert lost == pytest.approx(10 / 28.0 * 6.6 / 101325 * 128.2, rel=0.1)
    assert np.asarray(run.streams["snow"].solid_by_species)[1] == 0.0
