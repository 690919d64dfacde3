"""Membrane plants, carbon beds, flotation and presses with ordinary waters, for the contracts."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case, shares

from granum.filtration.adsorption import FreundlichIsotherm
from granum.filtration.equipment.belt_press import BeltPress
from granum.filtration.equipment.carbon import GasCarbonBed, LiquidCarbonBed
from granum.filtration.equipment.membranes import ReverseOsmosis, Ultrafiltration
from granum.filtration.equipment.screw_press import ScrewPress
from granum.settling.equipment.flotation import DissolvedAirFlotation
from granum.streams.from_materials import mixture_of
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty


def _whey(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s with up to 6 % of sugar and 0.1 to 3 % of protein at 10 to 50 °C, and water to wash."""
    flow, sugar = 10.0 ** (-1.0 + 2.0 * x[0]), 0.06 * x[1]
    solid = flow * 10.0 ** (-3.0 + 1.5 * x[2]) * shares(x[4], x[5], len(mixture.sizes))
    feed = empty(mixture, 283.0 + 40.0 * x[3]).replace(
        solid=solid[None, :], liquid=flow * jnp.stack([1.0 - sugar, sugar])
    )
    water = empty(mixture, 293.0 + 20.0 * x[6]).replace(liquid=flow * x[7] * jnp.array([1.0, 0.0]))
    return {"feed": feed, "solvent": water}


def _brine(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of 0.05 to 4 % of salt between 10 and 40 °C."""
    flow, share = 10.0 ** (-1.0 + 2.0 * x[0]), 10.0 ** (-3.3 + 1.9 * x[1])
    return {
        "feed": empty(mixture, 283.0 + 30.0 * x[2]).replace(liquid=flow * jnp.stack([1.0 - share, share]))
    }


def _flocs(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """1 to 100 kg/s of water with 10 mg/L to 5 g/L of flocs heavier than it and of oil, at 5 to 35 °C."""
    water, classes = 10.0 ** (2.0 * x[0]), len(mixture.sizes)
    solid = water * 10.0 ** (-5.0 + 2.7 * x[1])
    both = jnp.stack([(1.0 - x[2]) * shares(x[4], x[5], classes), x[2] * shares(x[5], x[4], classes)])
    return {"feed": empty(mixture, 278.0 + 30.0 * x[3]).replace(solid=solid * both, liquid=water[None])}


def _sludge(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of sludge of 0.5 to 8 %, and spray water."""
    flow, share = 10.0 ** (-1.0 + 2.0 * x[0]), 10.0 ** (-2.3 + 1.2 * x[1])
    sizes = shares(x[4], x[5], len(mixture.sizes))
    both = jnp.stack([(1.0 - x[2]) * sizes, x[2] * sizes])
    feed = empty(mixture, 278.0 + 30.0 * x[3]).replace(
        solid=flow * share * both, liquid=flow * (1.0 - share) * jnp.ones(1)
    )
    return {"feed": feed, "wash": empty(mixture, 285.0).replace(liquid=flow * x[6] * jnp.ones(1))}


def _spent(phase: str) -> Any:
    """0.1 to 30 kg/s of air or of water with 1 mg/kg to 1 % of acetone and a trace of dust."""

    def made(mixture: Mixture, x: Any) -> dict[str, Stream]:
        flow, share = 10.0 ** (-1.0 + 2.5 * x[0]), 10.0 ** (-6.0 + 4.0 * x[1])
        sizes = 1e-6 * flow * shares(x[4], x[5], len(mixture.sizes))
        parts = {phase: flow * jnp.stack([1.0 - share, share])}
        return {"feed": empty(mixture, 280.0 + 40.0 * x[2]).replace(solid=sizes[None, :], **parts)}

    return made


def membranes(classes: int) -> dict[str, Case]:
    """One case of each, its area in proportion to its feed."""
    whey = mixture_of(["water", "sucrose"], ["whey protein"], [], np.geomspace(2e-9, 2e-8, classes + 1))
    brine = mixture_of(
        ["water", "sodium chloride"], ["sodium chloride"], [], np.geomspace(1e-5, 1e-3, classes + 1)
    )
    flocs = mixture_of(["water"], ["kaolinite", "crude oil"], [], np.geomspace(1e-6, 1e-4, classes + 1))
    solvent = mixture_of(
        ["water", "acetone"], ["quartz"], ["nitrogen", "acetone"], np.geomspace(1e-6, 1e-4, classes + 1)
    )
    return {
        "gas carbon": Case(
            solvent,
            _spent("gas"),
            lambda f, u: GasCarbonBed(
                f["feed"].gas_volume_flow / (0.05 + 0.5 * u[0]),
                0.2 + 2.0 * u[1],
                1e-3 + 4e-3 * u[2],
                FreundlichIsotherm(0.02 + 0.4 * u[3], 0.05 + 0.8 * u[4]),
                10.0 ** (2.0 * u[5]),
                adsorbate="acetone",
            ),
        ),
        "liquid carbon": Case(
            solvent,
            _spent("liquid"),
            lambda f, u: LiquidCarbonBed(
                f["feed"].liquid_volume_flow / (5e-4 + 6e-3 * u[0]),
                0.5 + 4.0 * u[1],
                3e-4 + 2e-3 * u[2],
                FreundlichIsotherm(0.001 + 0.1 * u[3], 0.1 + 0.8 * u[4]),
                10.0 ** (-2.0 + 2.0 * u[5]),
                adsorbate="acetone",
            ),
        ),
        "flotation": Case(
            flocs,
            _flocs,
            lambda f, u: DissolvedAirFlotation(
                f["feed"].slurry_volume_flow * (300.0 + 1200.0 * u[0]),
                30.0 + 200.0 * u[1],
                recycle_ratio=0.03 + u[2],
                pressure_saturator=2.5e5 + 5e5 * u[3],
                attachment_efficiency=u[4],
                floc_water_ratio=30.0 * u[5],
            ),
        ),
        "belt press": Case(
            flocs,
            _sludge,
            lambda f, u: BeltPress(
                0.5 + 2.5 * u[0],
                0.02 + 0.15 * u[1],
                2e3 + 1e4 * u[2],
                10.0 ** (8.0 + 3.0 * u[3]),
                0.03 + 0.1 * u[4],
                0.15 + 0.25 * u[5],
                10.0 ** (-10.0 + 3.0 * u[0]),
                compaction_exponent=0.3 * u[1],
                solids_recovery=0.8 + 0.2 * u[2],
            ),
        ),
        "screw press": Case(
            flocs,
            lambda m, x: {"feed": _sludge(m, x)["feed"]},
            lambda f, u: ScrewPress(
                0.2 + 0.8 * u[0],
                1.0 + 3.0 * u[1],
                0.1 + 0.5 * u[2],
                0.02 + 0.5 * u[3],
                0.1 + 0.05 * u[4],
                0.12 + 0.07 * u[5],
                10.0 ** (4.5 + 2.0 * u[0]),
                10.0 ** (8.0 + 3.0 * u[1]),
                0.03 + 0.1 * u[2],
                0.15 + 0.25 * u[3],
                10.0 ** (-10.0 + 4.0 * u[4]),
                compaction_exponent=0.3 * u[5],
                solids_recovery=0.5 + 0.5 * u[0],
            ),
        ),
        "ultrafiltration": Case(
            whey,
            _whey,
            lambda f, u: Ultrafiltration(
                f["feed"].liquid_flow * (5.0 + 60.0 * u[0]),
                5e4 + 4e5 * u[1],
                3e-9 + 2e-8 * u[2],
                10.0 ** (-6.0 + 1.5 * u[3]),
                10.0 ** (12.0 + 1.5 * u[4]),
                concentration_gel=200.0 + 100.0 * u[5],
                stage_count="3",
                circulation_flow=1e-2 * u[1],
            ),
        ),
        "osmosis": Case(
            brine,
            _brine,
            lambda f, u: ReverseOsmosis(
                f["feed"].liquid_flow * (5.0 + 60.0 * u[0]),
                1e6 + 5.5e6 * u[1],
                10.0 ** (-12.0 + u[2]),
                10.0 ** (-8.0 + 1.5 * u[3]),
                10.0 ** (-5.0 + u[4]),
                energy_recovery_efficiency=u[5],
            ),
        ),
    }
