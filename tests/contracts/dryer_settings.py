"""Random ordinary settings of dryers and of units for humid gas: what an engineer would type, as functions of
numbers between 0 and 1.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.drying.equipment.atomizers import GivenDrops
from granum.drying.equipment.belt import BeltDryer
from granum.drying.equipment.burner import Burner
from granum.drying.equipment.closed import ClosedDryer, HeatPumpCircuit, SteamCircuit
from granum.drying.equipment.convective import ConvectiveDryer
from granum.drying.equipment.drum import DrumDryer
from granum.drying.equipment.flash import FlashDryer
from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.equipment.freeze import FreezeDryer
from granum.drying.equipment.freeze_trays import TrayFreezeDryer
from granum.drying.equipment.paddle import PaddleDryer
from granum.drying.equipment.paper import PaperMachine
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.silo import SiloDryer
from granum.drying.equipment.spouted_bed import SpoutedBedDryer
from granum.drying.equipment.spray import SprayDryer
from granum.drying.equipment.tray import TrayDryer
from granum.drying.equipment.tunnel import TunnelDryer
from granum.drying.equipment.vacuum_shelves import VacuumShelfDryer
from granum.drying.equipment.vibrated_bed import VibratedBedDryer
from granum.drying.equipment.web_ovens import ImpingementDryer, RadiantDryer
from granum.drying.equipment.well_mixed import WellMixedDryer
from granum.drying.equipment.wood_kiln import WoodKiln
from granum.drying.gas_solid.kinetics import (
    DiffusionKinetics,
    ReactionKinetics,
    SurfaceKinetics,
    ThinLayerKinetics,
    VanMeelKinetics,
)
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.products import PRODUCTS
from granum.drying.radiant_heat import DielectricField, InfraredEmitter
from granum.drying.thin_layers.exponential import Page
from granum.streams.equilibrium import HumidMixture
from granum.streams.equipment.humid_gas import (
    AdiabaticHumidifier,
    CondenserCooler,
    DehumidifyingCoil,
    HumidMixer,
)
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

NUMBERS = 20
WATER_HEAT, AIR_HEAT = 2.6e6, 1.02e3  # J/kg and J/(kg K), for a sensible flow of air
SOLIDS = ["calcite", "starch"]


def mixture(*sizes: float) -> Any:
    return mixture_of(["water"], SOLIDS, ["dry air", "water"], list(sizes))


FINE = mixture(*np.geomspace(5e-5, 2e-3, 5))
MIDDLE = mixture(*np.geomspace(2e-4, 4e-3, 5))
POWDER = mixture(*np.geomspace(1e-5, 2e-4, 5))
TOWER = mixture(*np.geomspace(5e-5, 1.5e-3, 7))
GRAIN = mixture(3e-3, 6e-3)
FIRED = mixture_of(["water"], SOLIDS, ["dry air", "water", "methane"], [3e-3, 6e-3])


def between(u: Any, low: float, high: float) -> Any:
    """From low to high in proportion, that is even on a logarithmic scale."""
    return low * (high / low) ** u


class Duty(NamedTuple):
    """Wet feed and gas that suits it within a factor of four; ``fresh`` is the same flow of the same air
    before it was heated.
    """

    feed: Stream
    gas: Stream
    fresh: Stream
    moisture: Any


def moisture(u: Any, wet: Any, wettest: float = 1.0) -> Any:
    """One feed in twenty is dry, one nearly so."""
    return jnp.where(u < 0.05, 0.0, jnp.where(u < 0.1, 1e-5, between(wet, 0.01, wettest)))


def duty(m: Any, x: Any, more: Any = 1.0, hottest: float = 523.0, X: Any = None) -> Duty:
    """From ten numbers: 36 kg/h to 36 t/h of any width of sizes, gas of 40 °C and more, ambient air of dew
    points from −5 to 25 °C.
    """
    X = moisture(x[0], x[1]) if X is None else X
    flow, hot, ambient = between(x[2], 0.01, 10.0), 313.15 + (hottest - 313.15) * x[3], 278.0 + 35.0 * x[4]
    classes = len(m.sizes)
    sizes = jnp.exp(-0.5 * ((jnp.arange(classes) + 0.5 - classes * x[5]) / (0.15 + 2.0 * x[6])) ** 2)
    grades = flow * sizes / jnp.sum(sizes)
    feed = empty(m, 278.0 + 35.0 * x[7]).replace(
        solid=jnp.stack([grades * x[8], grades * (1.0 - x[8])]), liquid=jnp.stack([flow * X])
    )
    dry = more * flow * (X + 0.02) * WATER_HEAT / (AIR_HEAT * (hot - 305.0)) * 4.0 ** (2.0 * x[9] - 1.0)
    vapor = dry * jnp.minimum(
        0.0025 + 0.0175 * x[10] ** 2, 0.7 * 0.622 * 611.0 / 101325.0 * jnp.exp(0.065 * (ambient - 273.15))
    )
    gas = empty(m, hot).replace(gas=jnp.stack([dry, vapor]))
    return Duty(feed, gas, gas.replace(temperature=ambient), X)


PRODUCT: dict[str, Callable[[Any, Any, Any], Any]] = {
    "surface": lambda a, b, X: SurfaceKinetics(
        between(a, 0.01, 0.3), isotherm=Gab(between(b, 1e-4, 0.1), 10.0, 0.8)
    ),
    "not hygroscopic": lambda a, b, X: SurfaceKinetics(between(a, 0.01, 0.3)),
    "van Meel": lambda a, b, X: VanMeelKinetics(between(a, 0.05, 0.5), isotherm=PRODUCTS["wheat"]()),
    "milk": lambda a, b, X: ReactionKinetics(isotherm=PRODUCTS["skim_milk"]()),
    "thin layer": lambda a, b, X: ThinLayerKinetics(
        Page(between(a, 1e-5, 1e-2), 0.7 + 0.6 * b), jnp.maximum(X, 0.2), isotherm=PRODUCTS["wheat"]()
    ),
    "diffusion": lambda a, b, X: DiffusionKinetics(
        between(a, 1e-12, 1e-9), 5e-4, isotherm=Gab(between(b, 1e-3, 0.1), 10.0, 0.8)
    ),
}


class Setting(NamedTuple):
    """A dryer and what enters it, by port."""

    unit: Any
    inlets: dict[str, Stream]
    isotherm: Any = None


def _bed(cells: int, bypass: Any = None) -> Callable[..., Setting]:
    def build(x: Any, product: Any, more: Any) -> Setting:
        d = duty(MIDDLE, x)
        area = d.gas.gas_volume_flow / (0.5 + 1.5 * x[11])
        kinetics = product(x[18], x[19], d.moisture)
        unit = FluidBedDryer(
            area, area * between(x[12], 0.05, 1.0) * 1200.0, kinetics, cells=cells, bypass_fraction=bypass
        )
        return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)

    return build


def _spouted(x: Any, product: Any, more: Any) -> Setting:
    d = duty(GRAIN, x, hottest=473.0)
    kinetics = product(x[18], x[19], d.moisture)
    diameter = between(x[11], 0.1, 0.6)
    vessel = 0.25 * np.pi * diameter**2
    number = jnp.maximum(d.gas.gas_volume_flow / vessel / (0.5 + 1.5 * x[12]), 1.0)
    unit = SpoutedBedDryer(
        diameter,
        diameter / (5.0 + 5.0 * x[13]),
        number * vessel * diameter * between(x[14], 0.5, 3.0) * 800.0,
        kinetics,
        parallel_number=number,
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _vibrated(x: Any, product: Any, more: Any) -> Setting:
    d = duty(MIDDLE, x)
    kinetics = product(x[18], x[19], d.moisture)
    slender = 2.0 + 8.0 * x[14]
    width = jnp.sqrt(d.gas.gas_volume_flow / between(x[11], 0.2, 2.0) / slender)
    unit = VibratedBedDryer(
        slender * width,
        width,
        kinetics,
        amplitude=between(x[12], 1e-3, 6e-3),
        vibration_frequency=5.0 + 20.0 * x[13],
        throw_angle=0.5 + 0.9 * x[15],
        weir_height=0.25 * x[16],
        cells=4,
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _flash(x: Any, product: Any, more: Any) -> Setting:
    d = duty(FINE, x)
    kinetics = product(x[18], x[19], d.moisture)
    diameter = jnp.sqrt(d.gas.gas_volume_flow / (12.0 + 18.0 * x[11]) * 4.0 / np.pi)
    unit = FlashDryer(
        between(x[12], 3.0, 30.0), diameter, kinetics, feed_velocity=0.5 + 4.0 * x[13], cells=40
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _spray(x: Any, product: Any, more: Any, entrainment: bool = False) -> Setting:
    X = between(x[1], 0.5, 4.0)
    d = duty(POWDER, x, hottest=573.0, X=X)
    kinetics = product(x[18], x[19], X)
    volume = d.gas.gas_volume_flow * (10.0 + 20.0 * x[11])
    slender = 1.0 + 3.0 * x[12]
    diameter = (volume / slender * 4.0 / np.pi) ** (1.0 / 3.0)
    unit = SprayDryer(
        slender * diameter,
        diameter,
        GivenDrops(between(x[13], 3e-5, 1.5e-4), 5.0 + 50.0 * x[14]),
        kinetics,
        dry_density=1200.0,
        cells=40,
        entrainment=entrainment,
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _tower(x: Any, product: Any, more: Any) -> Setting:
    """A tower in which 0.2 to 1.5 m/s of gas rise against the spray."""
    X = between(x[1], 0.3, 4.0)
    d = duty(TOWER, x, hottest=673.0, X=X)
    kinetics = product(x[18], x[19], X)
    diameter = jnp.sqrt(d.gas.gas_volume_flow / between(x[11], 0.2, 1.5) * 4.0 / np.pi)
    unit = SprayDryer(
        between(x[12], 5.0, 30.0),
        diameter,
        GivenDrops(between(x[13], 1e-4, 8e-4), 5.0 + 50.0 * x[14]),
        kinetics,
        dry_density=between(x[15], 400.0, 1400.0),
        gas_direction="counter-current",
        cells=30,
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _belt(x: Any, product: Any, more: Any) -> Setting:
    d = duty(GRAIN, x, hottest=453.0)
    kinetics = product(x[18], x[19], d.moisture)
    unit = BeltDryer(
        d.gas.gas_volume_flow / (0.3 + 1.2 * x[11]),
        0.02 + 0.18 * x[12],
        300.0 + 500.0 * x[13],
        kinetics,
        zone_count=2,
        alternating=True,
        layers=12,
        steps=40,
    )
    return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)


def _silo(x: Any, product: Any, more: Any) -> Setting:
    d = duty(GRAIN, x, hottest=393.0)
    kinetics = product(x[18], x[19], d.moisture)
    volume = d.feed.solid_flow / 650.0 * between(x[11], 1800.0, 6 * 3600.0)
    unit = SiloDryer(
        volume, 0.15 + 0.35 * x[12], 650.0, kinetics, cooling_share=0.1 + 0.3 * x[13], layers=12, steps=40
    )
    return Setting(
        unit,
        {"feed": d.feed, "gas": d.gas.part(gas=more), "cooling": d.fresh.part(gas=0.3 + x[14])},
        kinetics.isotherm,
    )


def _rotary(way: str) -> Callable[..., Setting]:
    def build(x: Any, product: Any, more: Any) -> Setting:
        d = duty(MIDDLE, x)
        kinetics = product(x[18], x[19], d.moisture)
        diameter = jnp.sqrt(d.gas.gas_flow / between(x[11], 0.5, 4.0) * 4.0 / np.pi)
        unit = RotaryDryer(
            diameter * (4.0 + 6.0 * x[12]),
            diameter,
            kinetics,
            0.02 + 0.05 * x[13],
            gas_direction=way,
            cells=20,
        )
        return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)

    return build


def _tunnel(way: str) -> Callable[..., Setting]:
    def build(x: Any, product: Any, more: Any) -> Setting:
        d = duty(GRAIN, x, hottest=473.0)
        kinetics = product(x[18], x[19], d.moisture)
        unit = TunnelDryer(
            between(x[11], 1800.0, 72000.0),
            between(x[12], 0.02, 0.3),
            d.gas.gas_volume_flow / (1.0 + 4.0 * x[13]),
            10.0,
            kinetics,
            gas_direction=way,
            cells=20,
        )
        return Setting(unit, {"feed": d.feed, "gas": d.gas.part(gas=more)}, kinetics.isotherm)

    return build


WITH_CELLS: dict[str, Callable[..., Setting]] = {
    "bed": _bed(1),
    "bed without bypass": _bed(1, 0.0),
    "long bed": _bed(4),
    "spouted bed": _spouted,
    "vibrated bed": _vibrated,
    "flash": _flash,
    "spray": _spray,
    "spray with dust": partial(_spray, entrainment=True),
    "spray counter-current": _tower,
    "belt": _belt,
    "silo": _silo,
    "rotary counter-current": _rotary("counter-current"),
    "rotary co-current": _rotary("co-current"),
    "tunnel counter-current": _tunnel("counter-current"),
    "tunnel co-current": _tunnel("co-current"),
}
MORE_AIR_DRIES = (
    "bed without bypass",
    "spouted bed",
    "belt",
    "silo",
    "tunnel counter-current",
    "tunnel co-current",
    "well mixed",
)
"""Where more of the same gas cannot leave the product wetter: it shortens no residence time."""


def _by_balance(
    build: Callable[..., Any], m: Any = MIDDLE, fresh: bool = False, hottest: float = 523.0
) -> Callable[..., Setting]:
    """A dryer from its duty and six numbers; it takes the feed alone, or hot or fresh gas too."""

    def setting(x: Any, product: Any, more: Any) -> Setting:
        d = duty(m, x, hottest=hottest)
        unit = build(d, *x[11:17])
        gas = (d.fresh if fresh else d.gas).part(gas=more)
        return Setting(
            unit, {"feed": d.feed, "gas": gas} if "gas" in type(unit).inlet_names() else {"feed": d.feed}
        )

    return setting


def _freeze(d: Duty, a: Any, b: Any, c: Any, e: Any, f: Any, g: Any) -> Any:
    return FreezeDryer(
        pressure_chamber=5.0 + 25.0 * a, temperature_shelf=253.0 + 40.0 * b, area_vial=3.8e-4, area_product=3.1e-4, volume_fill=1e-6 + 4e-6 * c,  # noqa: E501
        vial_coefficient_contact=5.0 + 15.0 * e, vial_coefficient_gas=0.3 + 0.8 * f, vapor_resistance=2e4 + 2e5 * g, vapor_resistance_slope=1e7,  # noqa: E501
        vapor_resistance_saturation=200.0,
    )  # fmt: skip


def _trays(d: Duty, a: Any, b: Any, c: Any, e: Any, f: Any, g: Any) -> Any:
    return TrayFreezeDryer(
        temperature_shelf=268.0 + 80.0 * a,
        pressure_chamber=10.0 + 90.0 * b,
        load_per_area=3.0 + 17.0 * c,
        thickness=2e-3 + 3e-2 * e,
        moisture_outlet=0.005 + 0.3 * f,
        thermal_conductivity_dry=0.02 + 0.15 * g,
        vapor_permeability=between(a * c, 5e-9, 1e-7),
        emissivity=0.5 + 0.5 * e,
        conduction_coefficient=20.0 * b * g,
    )


def _paper(d: Duty, a: Any, b: Any, c: Any, e: Any, f: Any, g: Any) -> Any:
    grammage = between(a, 0.01, 0.4)
    return PaperMachine(
        width=d.feed.solid_flow / grammage / between(b, 0.5, 30.0),
        dry_mass_per_area=grammage,
        pressure_steam=1.2e5 + 8e5 * c,
        cylinder_count=6,
        temperature_air=323.0 + 60.0 * e,
        felt_factor=f,
        heat_transfer_coefficient_air=10.0 + 90.0 * g,
    )


def _stenter(d: Duty, a: Any, b: Any, c: Any, e: Any, f: Any, g: Any) -> Any:
    grammage, seconds = between(a, 0.02, 0.5), between(b, 0.5, 120.0)
    return ImpingementDryer(
        width=2.0,
        length=d.feed.solid_flow / grammage / 2.0 * seconds,
        dry_mass_per_area=grammage,
        temperature_air=353.0 + 150.0 * c,
        gas_velocity=5.0 + 50.0 * e,
        diameter=0.002 + 0.01 * f,
        nozzle_area_fraction=0.01 + 0.08 * g,
        radiant_heat=DielectricField(2.7e7, 1e5 * f, 1e-3),
    )


def _infrared(d: Duty, a: Any, b: Any, c: Any, e: Any, f: Any, g: Any) -> Any:
    """For a part of the time in which the emitters alone would dry the web, up to a little more than all: one
    that stays for long burns, and is refused.
    """
    grammage, emitter = between(a, 0.02, 1.0), InfraredEmitter(500.0 + 700.0 * c, view_factor=0.3 + 0.7 * e)
    seconds = between(b, 0.1, 1.2) * grammage * (0.1 + d.moisture) * 2.5e6 / emitter.absorbed(0.5, 350.0)
    return RadiantDryer(
        width=1.0,
        length=d.feed.solid_flow / grammage * seconds,
        dry_mass_per_area=grammage,
        radiant_heat=emitter,
        temperature_air=d.fresh.temperature + 60.0 * f,
        heat_transfer_coefficient=5.0 + 50.0 * g,
    )


BY_BALANCE: dict[str, Callable[..., Setting]] = {
    "wood kiln": _by_balance(
        lambda d, a, b, c, e, f, g: WoodKiln(
            0.019 + 0.04 * a,
            0.06 + 0.14 * b,
            350.0 + 350.0 * c,
            gas_velocity=1.0 + 3.0 * e,
            diffusivity_preexponential=19.2e-4 * between(f, 1.0, 6.0),
            heat_loss_share=0.4 * g,
        ),
        GRAIN,
        fresh=True,
    ),
    "moisture": _by_balance(
        lambda d, a, b, c, e, f, g: ConvectiveDryer(
            temperature_inlet=d.gas.temperature,
            moisture_outlet=a * d.moisture,
            recirculated_fraction=0.8 * c,
            effectiveness=0.9 * b,
        ),
        fresh=True,
    ),
    "humidity": _by_balance(
        lambda d, a, b, c, e, f, g: ConvectiveDryer(
            temperature_inlet=d.gas.temperature,
            relative_humidity_outlet=0.1 + 0.85 * a,
            effectiveness=0.9 * b,
        ),
        fresh=True,
    ),
    "exhaust": _by_balance(
        lambda d, a, b, c, e, f, g: ConvectiveDryer(
            heat_duty=d.gas.gas_flow * AIR_HEAT * (d.gas.temperature - d.fresh.temperature),
            temperature_outlet=310.0 + 40.0 * a,
            effectiveness=0.9 * b,
        ),
        fresh=True,
    ),
    "heat pump": _by_balance(
        lambda d, a, b, c, e, f, g: ClosedDryer(
            HeatPumpCircuit(0.4 + 0.5 * a, 276.0 + 14.0 * b, 0.3 * c), 313.0 + 40.0 * e, f * d.moisture
        )
    ),
    "steam": _by_balance(
        lambda d, a, b, c, e, f, g: ClosedDryer(
            SteamCircuit(378.0 + 20.0 * a, 1.5e5 + 4e5 * b), 410.0 + 60.0 * c, 0.2 * e * d.moisture
        )
    ),
    "drum": _by_balance(
        lambda d, a, b, c, e, f, g: DrumDryer(
            between(a, 0.5, 2.0),
            between(b, 0.5, 5.0),
            between(c, 0.05, 1.0),
            1.5e5 + 8e5 * e,
            critical_moisture=0.05 + 0.4 * f,
            pressure=between(g, 3e3, 1.01e5),
        ),
        POWDER,
    ),
    "vacuum shelves": _by_balance(
        lambda d, a, b, c, e, f, g: VacuumShelfDryer(
            330.0 + 60.0 * a,
            between(b, 2e3, 1.5e4),
            between(c, 0.01, 0.06),
            300.0 + 700.0 * e,
            f * d.moisture,
            between(g, 0.1, 0.6),
        )
    ),
    "paddle": _by_balance(
        lambda d, a, b, c, e, f, g: PaddleDryer(
            380.0 + 90.0 * a, f * d.moisture, between(b, 3e3, 1e5), 1e-3, between(c, 0.2, 4.0), 0.3 + e
        )
    ),
    "paddle, paste": _by_balance(
        lambda d, a, b, c, e, f, g: PaddleDryer(
            380.0 + 90.0 * a,
            f * d.moisture,
            between(b, 3e3, 1e5),
            1e-3,
            between(c, 0.2, 4.0),
            0.3 + e,
            pasty_moisture=g * d.moisture,
        )
    ),
    "tray": _by_balance(
        lambda d, a, b, c, e, f, g: TrayDryer(
            d.gas.temperature,
            0.5 + 4.5 * a,
            between(b, 3.0, 50.0),
            c * d.moisture,
            between(e, 0.02, 0.5),
            isotherm=Gab(between(f, 1e-3, 0.1), 10.0, 0.8),
            tray_gap=0.03 + 0.1 * g,
        ),
        GRAIN,
        True,
    ),
    "well mixed": _by_balance(
        lambda d, a, b, c, e, f, g: WellMixedDryer(between(a, 60.0, 3600.0), 0.4 + 1.6 * b)
    ),
    "freeze": _by_balance(_freeze, POWDER),
    "freeze on trays": _by_balance(_trays, GRAIN),
    "paper": _by_balance(_paper, POWDER, fresh=True),
    "stenter": _by_balance(_stenter, POWDER, fresh=True),
    "infrared": _by_balance(_infrared, POWDER, fresh=True),
}


def _humid(x: Any, at: int, hottest: float = 523.0) -> Stream:
    """Air of 36 kg/h to 36 t/h, of −20 °C and more, from dry to saturated below 60 °C."""
    T = 253.15 + (hottest - 253.15) * x[at] ** 2
    most = HumidMixture(MIDDLE).saturated_vapor(
        empty(MIDDLE, T).replace(gas=jnp.array([1.0, 0.0])), jnp.minimum(T, 333.0)
    )
    dry = between(x[at + 1], 0.01, 10.0)
    return empty(MIDDLE, T).replace(
        gas=dry * jnp.stack([1.0, most * jnp.where(x[at + 2] < 0.1, 0.0, x[at + 2])])
    )


def _water(x: Any, at: int, gas: Stream) -> Stream:
    """Water of 1 to 90 °C, from a thousandth of the gas to as much."""
    return empty(MIDDLE, 274.0 + 89.0 * x[at]).replace(
        liquid=jnp.stack([gas.gas_flow * between(x[at + 1], 1e-3, 1.0)])
    )


def _steam(x: Any, at: int, gas: Stream) -> Stream:
    """Steam of 100 to 200 °C."""
    return empty(MIDDLE, 373.15 + 100.0 * x[at]).replace(
        gas=jnp.stack([0.0, gas.gas_flow * between(x[at + 1], 1e-3, 0.1)])
    )


def _air(build: Callable[..., Any], **ports: Callable[..., Stream]) -> Callable[..., Setting]:
    def setting(x: Any, _product: Any, _more: Any) -> Setting:
        gas = _humid(x, 0)
        return Setting(
            build(x),
            {"gas": gas, **{port: made(x, 6 + 3 * i, gas) for i, (port, made) in enumerate(ports.items())}},
        )

    return setting


def _burner(x: Any, _product: Any, _more: Any) -> Setting:
    gas = _humid(x, 0, 473.0)
    fired = empty(FIRED, gas.temperature).replace(gas=jnp.concatenate([gas.gas, jnp.zeros(1)]))
    fuel = empty(FIRED, 288.0).replace(
        gas=jnp.stack([0.0, 0.0, gas.gas[0] * jnp.where(x[6] < 0.1, 0.0, between(x[6], 1e-4, 0.02))])
    )
    return Setting(Burner(0.1 * x[7]), {"gas": fired, "fuel": fuel})


HUMID_GAS: dict[str, Callable[..., Setting]] = {
    "humidifier": _air(lambda x: AdiabaticHumidifier(x[12]), water=_water),
    "cooler": _air(lambda x: CondenserCooler(263.0 + 100.0 * x[12])),
    "coil": _air(lambda x: DehumidifyingCoil(268.0 + 25.0 * x[12], 0.5 * x[13])),
    "two airs": _air(lambda x: HumidMixer(), other=lambda x, at, gas: _humid(x, at)),
    "spray and air": _air(lambda x: HumidMixer(), other=_water),
    "steam and air": _air(lambda x: HumidMixer(), other=_steam),
    "burner": _burner,
}
