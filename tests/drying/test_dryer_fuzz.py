"""Water and heat close in every dryer by balance, over hundreds of random ones at once."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.drying.equipment.burner import Burner
from granum.drying.equipment.closed import ClosedDryer, HeatPumpCircuit, SteamCircuit
from granum.drying.equipment.convective import ConvectiveDryer
from granum.drying.equipment.drum import DrumDryer
from granum.drying.equipment.freeze import FreezeDryer
from granum.drying.equipment.paddle import PaddleDryer
from granum.drying.equipment.tray import TrayDryer
from granum.drying.equipment.well_mixed import WellMixedDryer
from granum.drying.gas_solid.dryer import PLAIN
from granum.humid_gas.pairs import AIR_WATER
from granum.humid_gas.relations import saturated_fraction
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

COUNT = 400
MIXTURE = mixture_of(["water"], ["starch"], ["dry air", "water", "methane"], [1e-3, 2e-3])
# of the feed: kg/s, kg/kg, K; of the gas: kg/s, kg/kg, K; then three numbers from 0 to 1 that each dryer uses
# in its own way
LOW = np.array([0.01, 0.3, 280.0, 1.0, 0.002, 280.0, 0.0, 0.0, 0.0])
HIGH = np.array([0.5, 3.0, 320.0, 30.0, 0.012, 305.0, 1.0, 1.0, 1.0])


def streams(x) -> tuple[Stream, Stream]:
    nothing = jnp.zeros(())
    return (
        empty(MIXTURE, x[2]).replace(solid=x[0] * jnp.ones((1, 1)), liquid=jnp.stack([x[0] * x[1]])),
        empty(MIXTURE, x[5]).replace(gas=jnp.stack([x[3], x[3] * x[4], nothing])),
    )


# each from three random numbers and the moisture of the feed
DRYERS = {
    "moisture": lambda a, b, c, X: ConvectiveDryer(
        temperature_inlet=330.0 + 70.0 * a,
        moisture_outlet=b * X,
        recirculated_fraction=0.9 * c,
        effectiveness=0.8 * a,
        heat_loss=2e3 * b,
        fan_power=1e3 * c,
    ),
    "humidity": lambda a, b, c, X: ConvectiveDryer(
        temperature_inlet=330.0 + 70.0 * a, relative_humidity_outlet=0.3 + 0.6 * b, temperature_product=300.0
    ),
    "exhaust": lambda a, b, c, X: ConvectiveDryer(
        heat_duty=1e4 + 1e6 * a, temperature_outlet=310.0 + 20.0 * b, recirculated_fraction=0.5 * c
    ),
    "heat pump": lambda a, b, c, X: ClosedDryer(
        HeatPumpCircuit(0.6 + 0.3 * a, 280.0 + 8.0 * b, 0.3 * c), 315.0 + 15.0 * a, 0.1 * X, heat_loss=1e3 * c
    ),
    "steam": lambda a, b, c, X: ClosedDryer(
        SteamCircuit(378.0 + 20.0 * a, 1.5e5 + 2e5 * b), 410.0 + 60.0 * c, 0.1 * X
    ),
    "drum": lambda a, b, c, X: DrumDryer(1.0, 0.5 + 3.0 * a, 0.2 + 0.3 * b, 3e5 + 3e5 * c),
    "paddle": lambda a, b, c, X: PaddleDryer(
        385.0 + 40.0 * a, 0.05 * X, 2e4 + 8e4 * b, 1e-3, 1.0 + 2.0 * c, 0.6, pasty_moisture=0.5 * X
    ),
    "tray": lambda a, b, c, X: TrayDryer(
        330.0 + 60.0 * a, 1.0 + 3.0 * b, 20.0, 0.05 * X, 0.4 * X, tray_gap=0.05 + 0.1 * c
    ),
    "well mixed": lambda a, b, c, X: WellMixedDryer(300.0 + 3000.0 * a, 0.5 + b, heat_loss=1e3 * c),
    "freeze": lambda a, b, c, X: FreezeDryer(
        pressure_chamber=8.0 + 15.0 * a,
        temperature_shelf=260.0 + 30.0 * b,
        area_vial=3.8e-4,
        area_product=3.1e-4,
        volume_fill=1e-6 + 3e-6 * c,
        vial_coefficient_contact=11.5,
        vial_coefficient_gas=0.28,
        vapor_resistance=5e4,
        vapor_resistance_slope=1e7,
    ),
}


def closed(name: str, x) -> tuple:
    feed, gas = streams(x)
    if name == "burner":
        fuel = gas.replace(gas=jnp.stack([0.0 * x[3], 0.0 * x[3], 0.02 * x[6] * x[3]]))
        unit, inlets = Burner(heat_loss_share=0.1 * x[7]), (gas, fuel)
    else:
        unit = DRYERS[name](x[6], x[7], x[8], x[1])
        names = type(unit).inlet_names()
        if name == "well mixed":
            gas = gas.replace(temperature=330.0 + 60.0 * x[8])
        inlets = (feed,) if names == ("feed",) else (feed, gas)
    out = unit(*inlets)
    power = sum((getattr(out, p) for p in ("heat_duty", "shaft_power") if hasattr(out, p)), jnp.zeros(()))
    found = closure(inlets, [s for s in out if isinstance(s, Stream)], power)
    return found.mass, found.energy, missed(unit, out, x[1])


def missed(unit, out, X):
    """How far the outlet of a convective dryer is from what was stated about it; zero for others, and for
    those that can only dry all or nothing.
    """
    if not isinstance(unit, ConvectiveDryer):
        return jnp.zeros(())
    left = out.product.moisture_dry_basis
    if unit.moisture_outlet is not None:
        return left - unit.moisture_outlet
    if unit.temperature_outlet is not None:
        gone = (out.exhaust.temperature - unit.temperature_outlet) / unit.temperature_outlet
    else:
        moles = out.exhaust.gas / jnp.array([species.molar_mass for species in MIXTURE.gases])
        saturated = saturated_fraction(AIR_WATER, out.exhaust.temperature, out.exhaust.pressure)
        gone = moles[1] / jnp.sum(moles) / saturated - unit.relative_humidity_outlet
    return jnp.where((left > 1e-9) & (left < X * (1.0 - 1e-9)), gone, 0.0)


@pytest.mark.parametrize("name", [*DRYERS, "burner"])
def test_random_dryers_close(name: str) -> None:
    sets = LOW + (HIGH - LOW) * np.random.default_rng(7).random((COUNT, len(LOW)))
    job = jax.jit(
        jax.vmap(lambda x: closed(name, x)),
        compiler_options=PLAIN if jax.default_backend() == "cpu" else None,
    )
    mass, energy, miss = (np.asarray(v) for v in job(sets))
    solved = np.isfinite(mass) & np.isfinite(energy)
    assert solved.mean() > 0.95
    assert mass[solved].max() < 1e-9
    assert energy[solved].max() < 1e-9
    assert abs(miss[solved]).max() < 1e-8
