"""The contact core: closed forms, order, conservation in steady state and in time, derivatives, batches."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import flags, notices
from granum.core.errors import ApplicabilityError
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.gas_solid.cells import Contact, Inlet, Network
from granum.drying.gas_solid.dryer import Through, ready
from granum.drying.gas_solid.kinetics import (
    DiffusionKinetics,
    Meeting,
    ReactionKinetics,
    SurfaceKinetics,
    ThinLayerKinetics,
    VanMeelKinetics,
)
from granum.drying.gas_solid.matter import Matter
from granum.drying.isotherms.adsorption import Gab
from granum.drying.thin_layers.exponential import Page
from granum.humid_gas.formulas.state import state
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

MIXTURE = mixture_of(["water"], ["quartz"], ["dry air", "water"], [1e-4, 1e-3])
MATTER = Matter(MIXTURE, jnp.ones((1, 1)), jnp.array([1.0, 0.0]), 101325.0)
FLOW, STAY, GAS = 0.5, 1800.0, 1.0
INLET = Inlet(jnp.array([0.1]), jnp.array([293.15]), 0.01, 423.15)


def contact(
    n: int, network: Network, units: float = 2.0, kinetics=SurfaceKinetics(critical_moisture=0.05), **more
) -> Contact:
    """A dryer of 0.5 kg/s of sand in 1 kg/s of air, with a number of transfer units."""
    exchange = units * GAS * 1010.0 / (FLOW * STAY)
    solid, renewal = jnp.full((n, 1), FLOW * STAY / n), jnp.full((n, 1), n / STAY)
    return Contact(MATTER, kinetics, solid, renewal, GAS, network, lambda X, Ts, Tg, Y: exchange, **more)


def water_and_heat(core: Contact, inlet: Inlet) -> tuple[float, float]:
    """What enters with solid and gas, kg/s and W."""
    water = jnp.sum(core.solid_flow * inlet.moisture) + core.gas_flow * inlet.humidity
    heat = jnp.sum(core.solid_flow * MATTER.moist_solid(inlet.temperature, inlet.moisture))
    return float(water), float(heat + core.gas_flow * MATTER.moist_gas(inlet.gas_temperature, inlet.humidity))


NETWORKS = {
    "co": Network.co_current,
    "counter": Network.counter_current,
    "cross": Network.cross_current,
    "mixed": Network.mixed,
}


@pytest.mark.parametrize("name", NETWORKS)
def test_steady_state_conserves_water_and_energy(name: str) -> None:
    def solve(units):
        core = contact(
            12, NETWORKS[name](12), units, heat_loss=500.0, wall_exchange=0.05, wall_temperature=400.0
        )
        return core.steady(INLET)

    found = ready(solve)(2.0)
    water, heat = water_and_heat(contact(12, NETWORKS[name](12)), INLET)
    assert bool(found.converged)
    assert float(jnp.sum(found.water) + found.vapor) == pytest.approx(water, rel=1e-12)
    assert float(jnp.sum(found.solid_enthalpy) + found.gas_enthalpy - found.heat_duty) == pytest.approx(
        heat, rel=1e-12
    )


@pytest.mark.long
def test_cells_tend_to_the_plug_flow_closed_form_with_order_one() -> None:
    """Wet solid at the wet bulb: gas cools along T − T_w = (T₁ − T_w) e^(−NTU); Stefan flow and rising heat
    capacity are kept small.
    """
    humidity, hot = 0.01, 333.15
    wet = state(temperature=hot, humidity_ratio=humidity).wet_bulb_temperature
    inlet = Inlet(jnp.array([0.5]), jnp.array([wet]), humidity, hot)

    errors = []
    for n in (10, 20, 40, 80):
        exit_gas = float(
            ready(lambda n=n: contact(n, Network.co_current(n)).steady(inlet).gas_temperature[-1])()
        )
        errors.append(exit_gas)
    steps = -np.diff(errors)
    assert np.all((steps[:-1] / steps[1:] > 1.7) & (steps[:-1] / steps[1:] < 2.4))  # first order in 1/n
    limit = errors[-1] + (errors[-1] - errors[-2])  # Richardson
    heat_capacity = float(MATTER.gas_heat_capacity(0.5 * (hot + wet), humidity)) * (1.0 + humidity)
    expected = wet + (hot - wet) * np.exp(-2.0 * 1010.0 / heat_capacity)
    assert limit == pytest.approx(expected, abs=0.02 * (hot - wet) * 0.5)


def test_wet_solid_goes_to_the_wet_bulb_of_humid_gas() -> None:
    """Independent of this core: the adiabatic-saturation balance of the psychrometrics. Air and water have a
    Lewis factor near one.
    """
    for T, w in ((333.15, 0.01), (394.25, 0.04), (500.0, 0.1)):
        one = jnp.ones((1, 1))
        at = Meeting(one, 300.0 * one, T * one, w * one, one, MATTER)
        assert float(at.wet_bulb[0, 0]) == pytest.approx(
            state(temperature=T, humidity_ratio=w).wet_bulb_temperature, abs=0.25
        )


@pytest.mark.long
def test_dynamic_conserves_and_reaches_the_steady_state() -> None:
    n, steps, step = 20, 150, 40.0
    rng = np.random.default_rng(1)
    moist = jnp.asarray(0.1 + 0.02 * rng.standard_normal((steps, 1)))
    inlets = Inlet(
        moist,
        jnp.full((steps, 1), 293.15),
        jnp.full(steps, 0.01),
        jnp.asarray(423.15 + 10.0 * rng.standard_normal(steps)),
    )

    @ready
    def run(units):
        core = contact(n, Network.counter_current(n), units, gas_time=5.0)
        start = core.start(INLET)
        found, totals = core.dynamic(start, inlets, step)
        calm, _ = core.dynamic(
            start, jax.tree.map(lambda v: jnp.broadcast_to(v, (steps, *jnp.shape(v))), INLET), step
        )
        gas = core.gas_flow * core.gas_time / n
        held = [
            (
                jnp.sum(core.solid * X) + gas * jnp.sum(Y),
                jnp.sum(core.solid * MATTER.moist_solid(T, X)) + gas * jnp.sum(MATTER.moist_gas(Tg, Y)),
            )
            for X, T, Y, Tg in (
                (
                    *(jnp.broadcast_to(v, (n, 1)) for v in (0.1, 293.15)),
                    jnp.full(n, 0.01),
                    jnp.full(n, 423.15),
                ),
                (found.moisture[-1], found.temperature[-1], found.humidity[-1], found.gas_temperature[-1]),
            )
        ]
        water = jnp.sum(step * (core.solid_flow * inlets.moisture[:, 0] + core.gas_flow * inlets.humidity))
        heat = jnp.sum(
            step
            * (
                core.solid_flow * MATTER.moist_solid(inlets.temperature, inlets.moisture)[:, 0]
                + core.gas_flow * MATTER.moist_gas(inlets.gas_temperature, inlets.humidity)
            )
        )
        return held, totals[-1], water, heat, calm, core.steady(INLET)

    (before, after), totals, water, heat, calm, steady = run(2.0)
    assert float(after[0] - before[0]) == pytest.approx(
        float(water - totals[0] - totals[2]), abs=1e-9 * float(water)
    )
    assert float(after[1] - before[1]) == pytest.approx(
        float(heat - 1e5 * (totals[1] + totals[3])), abs=1e-9 * abs(float(heat))
    )
    np.testing.assert_allclose(calm.moisture[-1], steady.moisture, atol=2e-6)


@pytest.mark.long
def test_second_order_in_time() -> None:
    def moisture(steps: int) -> float:
        inlets = jax.tree.map(lambda v: jnp.broadcast_to(v, (steps, *jnp.shape(v))), INLET)
        core = contact(10, Network.co_current(10), gas_time=60.0)
        return float(
            ready(lambda: core.dynamic(core.start(INLET), inlets, 600.0 / steps)[0].moisture[-1, -1, 0])()
        )

    a, b, c = (moisture(n) for n in (20, 40, 80))
    assert 3.0 < (a - b) / (b - c) < 5.5


@pytest.mark.long
def test_derivative_and_batch() -> None:
    def leaves(units):
        return contact(10, Network.counter_current(10), units).steady(INLET).moisture[-1, 0]

    at = ready(leaves)
    slope = float(ready(jax.grad(leaves))(jnp.asarray(2.0)))
    behind, middle, ahead = (float(at(jnp.asarray(2.0 + s * 1e-4))) for s in (-1, 0, 1))
    assert slope == pytest.approx((ahead - behind) / 2e-4, rel=1e-6)
    batch = ready(jax.vmap(leaves))(jnp.array([1.0, 2.0, 3.0]))
    assert float(batch[1]) == pytest.approx(middle, rel=1e-10)
    assert batch[0] > batch[1] > batch[2]


def test_kinetics_vanish_at_their_equilibrium_and_agree_when_wet() -> None:
    one = jnp.ones((1, 1))
    isotherm = Gab(0.06, 10.0, 0.9)
    laws = (
        SurfaceKinetics(0.3, isotherm=isotherm),
        VanMeelKinetics(0.3, isotherm=isotherm),
        ReactionKinetics(isotherm=isotherm),
        ThinLayerKinetics(Page(1e-3, 1.0), 1.0, isotherm),
        DiffusionKinetics(1e-9, 1e-3, isotherm=isotherm),
    )
    for law in laws:
        dry = Meeting(one, 340.0 * one, 340.0 * one, 0.02 * one, one, MATTER)
        X = law.equilibrium(dry)
        assert abs(float(law.rate(dry._replace(moisture=X))[0, 0])) < 1e-9
        assert float(law.rate(dry)[0, 0]) > 0.0
    wet_bulb = dry.wet_bulb
    wet = dry._replace(temperature=wet_bulb, moisture=10.0 * one)
    rates = [float(law.rate(wet)[0, 0]) for law in laws[:3]]
    assert rates[0] == pytest.approx(rates[1], rel=1e-6)
    assert rates[0] == pytest.approx(rates[2], rel=1e-3)
    # Page with n = 1 is Newton: the rate is k (X − X_e), where the film does not bound it
    newton = laws[3].rate(wet._replace(moisture=0.5 * one, exchange=1e3 * one))
    assert float(newton[0, 0]) == pytest.approx(
        1e-3 * (0.5 - float(laws[3].equilibrium(wet)[0, 0])), rel=1e-6
    )
    assert float(laws[3].rate(wet)[0, 0]) == pytest.approx(float(wet.film_rate()[0, 0]))
    cold = Meeting(0.5 * one, 283.0 * one, 300.0 * one, 0.02 * one, one, MATTER)  # dew point 24.7 °C
    assert float(laws[3].rate(cold)[0, 0]) < 0.0


def test_a_dryer_without_solution_names_the_likely_cause(monkeypatch) -> None:
    core = contact(3, Network.counter_current(3))
    lost = Through(core.profile(core.start(INLET), jnp.asarray(False)), 1.0)
    monkeypatch.setattr(RotaryDryer, "through", lambda _self, _feed, _gas: lost)
    gas = empty(MIXTURE, 400.0).replace(gas=jnp.array([1.0, 0.01]))
    for X, cause in ((0.0, "all but dry"), (0.2, "less solid")):
        feed = empty(MIXTURE).replace(solid=jnp.full((1, 2), 0.5), liquid=jnp.array([X]))
        with flags.collect() as records:
            RotaryDryer(5.0, 1.0, SurfaceKinetics(0.05), 0.03).inside(feed, gas)
        (told,) = notices.describe(records)
        assert told["flag"] == "not converged"
        assert cause in told["message"]


def test_milk_is_wetted_by_what_condenses_alone() -> None:
    """Chen's law counts the activity of cold solid from the hot gas, far too low: powder at 17 °C that holds
    more than its isotherm gives there was wetted by air of 128 °C.
    """
    law, one = ReactionKinetics(isotherm=Gab(0.06, 10.0, 0.9)), jnp.ones((1, 1))
    cold = Meeting(one, 290.0 * one, 401.0 * one, 0.006 * one, one, MATTER)  # dew point 6.5 °C
    rest = law.equilibrium(cold._replace(gas_temperature=cold.temperature))
    assert float(law.rate(cold._replace(moisture=rest + 2e-3))[0, 0]) >= 0.0
    assert float(law.rate(cold._replace(moisture=rest - 2e-3))[0, 0]) < 0.0
    assert float(law.rate(cold._replace(temperature=275.0 * one))[0, 0]) < 0.0
    # in gas beyond saturation drops at their equilibrium are wetted as those a little above and below
    X = law.equilibrium(cold) + jnp.linspace(-2e-3, 4e-3, 13)[:, None]
    warm = 301.5 + 0.0 * X
    damp = Meeting(X, warm, warm, 0.02465 + 0.0 * X, 1.0 + 0.0 * X, MATTER)
    rates = law.rate(damp._replace(moisture=law.equilibrium(damp) + X - law.equilibrium(cold)))[:, 0]
    assert np.all(np.diff(rates) >= 0.0)
    assert float(rates[-1]) < 0.0


def test_gas_that_meets_a_large_surface_against_the_solid_is_solved() -> None:
    """Twenty transfer units: at first the gas would dry beyond nothing, and being without memory it would do
    so in the shortest of steps.
    """
    core = contact(
        20, Network.counter_current(20), 20.0, SurfaceKinetics(0.1, isotherm=Gab(0.025, 10.0, 0.8))
    )
    inlet = Inlet(jnp.array([0.04]), jnp.array([278.15]), 0.002, 420.0)
    found = ready(lambda: core.steady(inlet))()
    assert bool(found.converged)
    water, heat = water_and_heat(core, inlet)
    assert float(found.water[0] + found.vapor) == pytest.approx(water, rel=1e-10)
    assert float(found.solid_enthalpy[0] + found.gas_enthalpy) == pytest.approx(heat, rel=1e-10)


def test_solid_drinks_no_faster_than_its_film_where_equilibrium_lies_above_the_critical_moisture() -> None:
    one = jnp.ones((1, 1))
    moist = Meeting(one, 300.0 * one, 300.0 * one, 0.0215 * one, one, MATTER)
    for kinetics in (SurfaceKinetics, VanMeelKinetics):
        law = kinetics(0.02, isotherm=Gab(0.06, 10.0, 0.8))
        rest = law.equilibrium(moist)
        assert float(rest[0, 0]) > 0.1
        drunk = -law.rate(moist._replace(moisture=rest - 1e-3)) / moist.conductance
        assert 0.0 < float(drunk[0, 0]) < 1.0  # of the film at a logarithmic driving force of one


def test_roots_within_a_law_are_known_as_well_as_the_core_asks() -> None:
    one = jnp.ones((50, 1))
    at = Meeting(
        0.5 * one, 300.0 * one, jnp.linspace(310.0, 450.0, 50)[:, None], 0.004 * one, 1e3 * one, MATTER
    )
    wet = at._replace(temperature=at.wet_bulb)  # there heat and vapor agree
    np.testing.assert_allclose(VanMeelKinetics(0.1).rate(wet), wet.film_rate(), rtol=1e-11)
    left = np.linspace(0.05, 0.95, 50)[:, None]
    page = ThinLayerKinetics(Page(1e-3, 1.2), 1.0)
    closed = left * 1e-3 * 1.2 * (-np.log(left) / 1e-3) ** (0.2 / 1.2)
    np.testing.assert_allclose(
        page.rate(at._replace(moisture=left, temperature=350.0 * one)), closed, rtol=1e-11
    )


def test_a_mixture_without_its_vapor_is_refused() -> None:
    mixture = mixture_of(["ethanol"], ["quartz"], ["dry air", "water"], [1e-4, 1e-3])
    with pytest.raises(ApplicabilityError, match="first liquid among the gases"):
        Matter.of(empty(mixture), empty(mixture))
