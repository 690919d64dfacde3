"""Crystallizers of one solute at ordinary settings, for the contracts."""

# ruff: noqa: E731

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case, shares

from granum.crystallization.equipment.batch import (
    BatchCrystallizer,
    JacketedBatchCrystallizer,
    VacuumBatchCrystallizer,
)
from granum.crystallization.equipment.classified import ClassifiedCrystallizer
from granum.crystallization.equipment.controlled import ControlledBatchCrystallizer
from granum.crystallization.equipment.msmpr import Msmpr, VacuumCrystallizer
from granum.crystallization.equipment.needles import NeedleBatchCrystallizer, NeedleCrystallizer
from granum.crystallization.equipment.oslo import OsloCrystallizer
from granum.crystallization.equipment.tubes import (
    BaffledTubeCrystallizer,
    PlugFlowCrystallizer,
    SlugFlowCrystallizer,
)
from granum.crystallization.formulas.growth import PowerLawDissolution, PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import NaturalCooling, PowerCooling
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty


def solution(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of warm water with half to twice the nitrate that it dissolves at 25 °C, crystals, a
    little ethanol and air.
    """
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    return {
        "feed": empty(mixture, 300.0 + 40.0 * x[2]).replace(
            solid=water
            * jnp.stack(
                [
                    0.2 * x[3] * (x[3] > 0.5) * shares(x[4], x[5], classes),
                    0.01 * x[7] * shares(x[5], x[4], classes),
                ]
            ),
            liquid=water * jnp.stack([1.0, 0.2 + 0.7 * x[1], 0.05 * x[6]]),
            gas=1e-4 * water * jnp.stack([0.0, x[7]]),
        )
    }


def crystallizers(classes: int) -> dict[str, Case]:
    water = (("water", 1.0),)
    nitrate = Mixture(
        solids=(
            Species("nitrate", (("nitrate", 1.0),), (2110.0,), (940.0,), -3.4e5),
            Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),
        ),
        liquids=(
            Species("water", water, (1000.0,), (4180.0,)),
            Species("nitrate", (("nitrate", 1.0),), (2300.0,), (1500.0,)),
            Species("ethanol", (("ethanol", 1.0),), (789.0,), (2440.0,)),
        ),
        gases=(
            Species("water", water, (), (1860.0,), 2.5e6, 0.018015),
            Species("air", (("air", 1.0),), (1.2,), (1005.0,), molar_mass=0.02896),
        ),
        size_edges=tuple(np.geomspace(2e-6, 3e-3, classes + 1)),
        liquid_viscosity=lambda w, T: 1e-3,
    )
    laws = lambda u: {
        "solubility": PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
        "growth": PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
        "nucleation": PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
        "solid": "nitrate",
        "solvent": "water",
    }
    vessel = lambda f, u: (285.0 + 30.0 * u[0], f["feed"].slurry_volume_flow * 10.0 ** (2.5 + 1.5 * u[1]))
    cooling = lambda f, u: PowerCooling(
        f["feed"].temperature,
        f["feed"].temperature - 40.0 * u[0],
        3600.0 * (1.0 + 9.0 * u[1]),
        1.0 + 2.0 * u[3],
    )
    batch = lambda u: {
        "duration": 3600.0 * (1.0 + 9.0 * u[1]),
        "seed_mass_per_solvent": 0.02 * u[3],
        "seed_size": 5e-5 + 1.5e-4 * u[4],
        "seed_width": 4e-5 * u[5],
        **laws(u),
    }
    Cased = lambda unit: Case(nitrate, solution, unit)
    habit = lambda u: {
        "growth_width": PowerLawGrowth(10.0 ** (-6.5 + 2.0 * u[3]), 1.0 + u[2]),
        "seed_aspect_ratio": 0.5 + 8.0 * u[5],
        "volume_shape_factor": 0.5 + 0.5 * u[0],
    }
    return {
        "msmpr": Cased(
            lambda f, u: Msmpr(*vessel(f, u), evaporation=0.3 * u[5] * f["feed"].liquid[0], **laws(u))
        ),
        "classified": Cased(
            lambda f, u: ClassifiedCrystallizer(
                *vessel(f, u),
                fines_removal_ratio=1.0 + 4.0 * u[5],
                fines_cut_size=5e-5 + 1.5e-4 * u[3],
                product_removal_ratio=1.0 + 4.0 * u[4],
                product_cut_size=3e-4 + 7e-4 * u[2],
                evaporation=0.2 * u[1] * f["feed"].liquid[0],
                **laws(u),
            )
        ),
        "oslo": Cased(
            lambda f, u: OsloCrystallizer(
                vessel(f, u)[0],
                1.0 + 4.0 * u[1],
                0.2 + u[4],
                0.005 + 0.04 * u[5],
                evaporation=0.2 * u[1] * f["feed"].liquid[0],
                **laws(u),
            )
        ),
        "vacuum": Cased(
            lambda f, u: VacuumCrystallizer(
                temperature=vessel(f, u)[0],
                volume=vessel(f, u)[1],
                heat_duty=1e5 * u[5] * f["feed"].liquid[0],
                **laws(u),
            )
        ),
        "batch": Cased(lambda f, u: BatchCrystallizer(temperature_program=cooling(f, u), **batch(u))),
        "needle batch": Cased(
            lambda f, u: NeedleBatchCrystallizer(temperature_program=cooling(f, u), **batch(u), **habit(u))
        ),
        "needles": Cased(
            lambda f, u: NeedleCrystallizer(
                *vessel(f, u), evaporation=0.3 * u[5] * f["feed"].liquid[0], **laws(u), **habit(u)
            )
        ),
        "controlled": Cased(
            lambda f, u: ControlledBatchCrystallizer(
                10.0 ** (-2.5 + 1.5 * u[2]),
                temperature_end=f["feed"].temperature - 1.0 - 30.0 * u[0],
                cooling_rate_maximum=(5.0 + 55.0 * u[4]) / 3600.0,
                concentration_deviation=0.01 * u[5],
                dissolution=PowerLawDissolution(1e-4),
                **batch(u),
            )
        ),
        "jacketed": Cased(
            lambda f, u: JacketedBatchCrystallizer(
                jacket_program=NaturalCooling(f["feed"].temperature, 280.0 + 20.0 * u[0], 3600.0),
                volume=10.0 ** (-1.0 + 2.0 * u[2]),
                area=5.0 + 20.0 * u[3],
                heat_transfer_coefficient=100.0 + 400.0 * u[4],
                **batch(u),
            )
        ),
        "vacuum batch": Cased(
            lambda f, u: VacuumBatchCrystallizer(temperature_program=cooling(f, u), **batch(u))
        ),
        "slugs": Cased(
            lambda f, u: SlugFlowCrystallizer(
                temperature_program=cooling(f, u),
                diameter=0.001 + 0.004 * u[1],
                length=10.0 + 90.0 * u[0],
                gas_volume_flow=f["feed"].slurry_volume_flow * 3.0 * u[2],
                slug_length=0.002 + 0.03 * u[4],
                seed_mass_per_solvent=0.02 * u[3],
                **laws(u),
            )
        ),
        "baffled tube": Cased(
            lambda f, u: BaffledTubeCrystallizer(
                temperature_program=cooling(f, u),
                diameter=0.01 + 0.1 * u[1],
                length=10.0 + 90.0 * u[0],
                oscillation_frequency=0.3 + 3.0 * u[2],
                oscillation_amplitude=0.002 + 0.03 * u[3],
                baffle_spacing=0.02 + 0.1 * u[4],
                baffle_open_area=0.15 + 0.4 * u[5],
                seed_mass_per_solvent=0.02 * u[3],
                **laws(u),
            )
        ),
        "tube": Cased(
            lambda f, u: PlugFlowCrystallizer(
                temperature_program=cooling(f, u),
                volume=f["feed"].slurry_volume_flow * 3600.0 * (1.0 + 9.0 * u[1]),
                **{k: v for k, v in batch(u).items() if k != "duration"},
            )
        ),
    }
