"""Crystallizers of more than one solvent, solute or phase at ordinary settings, for the contracts."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case, shares
from tests.contracts.vessel_cases import crystallizers, solution

from granum.crystallization.equipment.adductive import AdductiveCrystallizer
from granum.crystallization.equipment.antisolvent import (
    AntisolventBatchCrystallizer,
    AntisolventCrystallizer,
)
from granum.crystallization.equipment.controlled import NucleationControlledCrystallizer
from granum.crystallization.equipment.dissolver import Dissolver
from granum.crystallization.equipment.extractive import ExtractiveCrystallizer
from granum.crystallization.equipment.hydroxides import HydroxidePrecipitator
from granum.crystallization.equipment.layer_melt import LayerMeltCrystallizer
from granum.crystallization.equipment.polymorphs import PolymorphCrystallizer
from granum.crystallization.equipment.precipitator import Precipitator
from granum.crystallization.equipment.preferential import PreferentialCrystallizer
from granum.crystallization.equipment.sublimation import Desublimer, Sublimer
from granum.crystallization.equipment.suspension_melt import SuspensionMeltCrystallizer
from granum.crystallization.equipment.two_salts import TwoSaltCrystallizer
from granum.crystallization.equipment.uptake import ImpurityUptake
from granum.crystallization.formulas.growth import PowerLawDissolution, PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.formulas.solubility_laws import (
    AntisolventSolubility,
    LibrarySolubility,
    PolynomialSolubility,
)
from granum.streams.from_materials import mixture_of
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty

THREONINE = ("L-threonine", "D-threonine")
ALPHA, BETA = "L-glutamic acid alpha", "L-glutamic acid"
EXTRACTED = ("water", "sodium chloride", "ethanol", "adipic acid")
IMPURE = ("water", "potassium nitrate", "sodium chloride")


def _impure(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with nitrate and salt; crystals in every second one, some with salt in them."""
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    crystals = 0.3 * x[3] * (x[4] > 0.5) * shares(x[5], x[6], classes)
    none = jnp.zeros(classes)
    solid = water * jnp.stack([crystals, none, none, 0.01 * x[7] * crystals])
    liquid = water * jnp.stack([1.0, 0.1 + 0.4 * x[1], 0.1 * x[2]])
    return {"feed": empty(mixture, 290.0 + 30.0 * x[6]).replace(solid=solid, liquid=liquid)}


def _met(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with nitrate, some crystals, sand, ethanol and air; as much ethanol at most,
    with up to a fifth of water and some nitrate.
    """
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    feed = empty(mixture, 290.0 + 30.0 * x[2]).replace(
        solid=water
        * jnp.stack(
            [
                0.1 * x[3] * (x[3] > 0.5) * shares(x[4], x[5], classes),
                0.01 * x[7] * shares(x[5], x[4], classes),
            ]
        ),
        liquid=water * jnp.stack([1.0, 0.1 + 0.4 * x[1], 0.05 * x[6]]),
        gas=1e-4 * water * jnp.stack([0.0, x[7]]),
    )
    spirit = empty(mixture, 285.0 + 20.0 * x[6]).replace(
        liquid=water * x[4] * jnp.stack([0.2 * x[5], 0.02 * x[7], 1.0 - 0.2 * x[5]])
    )
    return {"feed": feed, "antisolvent": spirit}


def _extracted(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with salt and up to 10 % of an acid, crystals of both in every second one; up
    to twice as much ethanol, with up to a fifth of water and some acid.
    """
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    seeds = 0.05 * jnp.stack([x[3] * (x[3] > 0.5), x[7] * (x[7] > 0.5)])
    feed = empty(mixture, 290.0 + 20.0 * x[2]).replace(
        solid=water * seeds[:, None] * shares(x[4], x[5], classes)[None],
        liquid=water * jnp.stack([1.0, 0.1 + 0.3 * x[1], 0.0, 0.1 * x[6]]),
    )
    spirit = empty(mixture, 285.0 + 20.0 * x[6]).replace(
        liquid=2.0 * water * x[4] * jnp.stack([0.2 * x[5], 0.0, 1.0 - 0.2 * x[5], 0.02 * x[7]])
    )
    return {"feed": feed, "antisolvent": spirit}


def _exchanging(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with barium chloride and some byproduct, barite in every second one; up to
    twice as much water with sodium sulfate.
    """
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    seed = 0.01 * x[3] * (x[3] > 0.5) * shares(x[4], x[5], classes)
    barium = empty(mixture, 285.0 + 30.0 * x[2]).replace(
        solid=water * seed[None],
        liquid=water * jnp.stack([1.0, 1e-4 + 0.03 * x[1], 0.0, 0.01 * x[6]]),
    )
    sulfate = empty(mixture, 285.0 + 30.0 * x[5]).replace(
        liquid=2.0 * x[7] * water * jnp.stack([1.0, 0.0, 1e-4 + 0.02 * x[2], 0.0])
    )
    return {"feed": barium, "reagent": sulfate}


def _melt(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with up to 6 % of nitrate and ethanol, sand and air."""
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    return {
        "feed": empty(mixture, 275.0 + 30.0 * x[2]).replace(
            solid=water
            * 0.02
            * x[7]
            * jnp.stack([0.0 * shares(x[5], x[4], classes), shares(x[5], x[4], classes)]),
            liquid=water * jnp.stack([1.0, 0.03 * x[1], 0.03 * x[6]]),
            gas=1e-4 * water * jnp.stack([0.0, x[7]]),
        )
    }


def _oils(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of three oils with sand and nitrogen."""
    flow, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    return {
        "feed": empty(mixture, 270.0 + 50.0 * x[2]).replace(
            solid=flow * 0.02 * x[7] * shares(x[5], x[4], classes)[None],
            liquid=flow * jnp.stack([x[1], x[3], x[6]]),
            gas=1e-3 * flow * jnp.stack([x[7]]),
        )
    }


def _chlorides(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with up to 7 mol/kg of each chloride, crystals and vapor."""
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    crystals = jnp.stack([0.2 * x[3] * shares(x[4], x[5], classes), 0.2 * x[7] * shares(x[5], x[4], classes)])
    return {
        "feed": empty(mixture, 290.0 + 70.0 * x[2]).replace(
            solid=water * crystals,
            liquid=water * jnp.stack([1.0, 0.4 * x[1], 0.5 * x[6]]),
            gas=1e-4 * water * jnp.stack([x[7]]),
        )
    }


def _mirrored(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with up to 0.25 kg/kg of each enantiomer, crystals in every second one."""
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    seed = 0.01 * x[3] * (x[3] > 0.5) * shares(x[4], x[5], classes)
    other = 0.01 * x[7] * (x[7] > 0.5) * shares(x[5], x[4], classes)
    return {
        "feed": empty(mixture, 290.0 + 40.0 * x[2]).replace(
            solid=water * jnp.stack([seed, other]),
            liquid=water * jnp.stack([1.0, 0.25 * x[1], 0.25 * x[6]]),
        )
    }


def _alpha(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.1 to 10 kg/s of water with up to 5 % of glutamic acid, crystals of alpha, and of beta in every second
    one.
    """
    water, classes = 10.0 ** (-1.0 + 2.0 * x[0]), len(mixture.sizes)
    alpha = 0.05 * x[3] * shares(x[4], x[5], classes)
    beta = 0.01 * x[7] * (x[7] > 0.5) * shares(x[5], x[4], classes)
    return {
        "feed": empty(mixture, 290.0 + 40.0 * x[2]).replace(
            solid=water * jnp.stack([alpha, beta]), liquid=water * jnp.stack([1.0, 0.05 * x[1]])
        )
    }


def _subliming(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """0.01 to 1 kg/s of nitrogen, or none, with vapor, crystals and sand."""
    nitrogen, classes = 10.0 ** (-2.0 + 2.0 * x[0]), len(mixture.sizes)
    crystals = jnp.stack([0.2 * x[1] * shares(x[4], x[5], classes), 0.1 * x[6] * shares(x[5], x[4], classes)])
    return {
        "feed": empty(mixture, 285.0 + 60.0 * x[2]).replace(
            solid=nitrogen * crystals,
            gas=nitrogen * jnp.stack([1.0 * (x[3] > 0.1), 0.05 * x[7]]),
        )
    }


def mixed(classes: int) -> dict[str, Case]:
    plain = crystallizers(classes)
    nitrate = plain["msmpr"].mixture

    masses = zip(nitrate.liquids, (0.018015, 0.1011, 0.046068), strict=True)
    molten = replace(nitrate, liquids=tuple(replace(s, molar_mass=m) for s, m in masses))

    edges = np.geomspace(5e-6, 4e-3, classes + 1)
    mirrored = mixture_of(["water", *THREONINE], THREONINE, ["water"], edges)
    forms = mixture_of(["water", BETA], [ALPHA, BETA], ["water"], edges)
    subliming = mixture_of([], ["naphthalene", "quartz"], ["nitrogen", "naphthalene"], edges)

    def dissolving(name: str) -> Case:
        """A batch or tube whose crystals dissolve in an undersaturated solution."""

        def unit(f: Any, u: Any) -> Any:
            made = plain[name].unit(f, u)
            law = PowerLawDissolution(10.0 ** (-6.0 + 3.0 * u[4]))
            return eqx.tree_at(lambda x: x.dissolution, made, law, is_leaf=lambda x: x is None)

        return Case(nitrate, solution, unit)

    def spread(f: Any, u: Any) -> Any:
        made = plain["tube"].unit(f, u)
        return eqx.tree_at(
            lambda x: x.tank_number_tube, made, 3.0 + 100.0 * u[5] ** 2, is_leaf=lambda x: x is None
        )

    return {
        "tube with spread stays": Case(nitrate, solution, spread),
        "batch that dissolves": dissolving("batch"),
        "jacketed that dissolves": dissolving("jacketed"),
        "vacuum batch that dissolves": dissolving("vacuum batch"),
        "tube that dissolves": dissolving("tube"),
        "counted": Case(
            nitrate,
            solution,
            lambda f, u: NucleationControlledCrystallizer(
                10.0 ** (6.0 + 3.0 * u[5]),
                10.0 ** (6.0 + 3.0 * u[5]) * (1.5 + 10.0 * u[3]),
                temperature_end=f["feed"].temperature - 1.0 - 30.0 * u[0],
                cooling_rate=(1.0 + 20.0 * u[1]) / 3600.0,
                heating_rate=(1.0 + 20.0 * u[2]) / 3600.0,
                count_deviation=0.1 * u[4],
                dissolution=PowerLawDissolution(10.0 ** (-5.0 + 2.0 * u[5])),
                duration=3600.0 * (1.0 + 9.0 * u[1]),
                seed_mass_per_solvent=0.01 * u[3] * (u[4] > 0.5),
                solubility=PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
                growth=PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
                nucleation=PowerLawNucleation(
                    10.0 ** (8.0 + 6.0 * u[4]), 2.0 + 4.0 * u[5], 1.0 * (u[0] > 0.5)
                ),
                solid="nitrate",
                solvent="water",
            ),
        ),
        "drowned": Case(
            nitrate,
            _met,
            lambda f, u: AntisolventCrystallizer(
                285.0 + 25.0 * u[0],
                (f["feed"].slurry_volume_flow + f["antisolvent"].slurry_volume_flow)
                * 10.0 ** (2.5 + 1.5 * u[1]),
                AntisolventSolubility(PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]), 1.0 + 5.0 * u[5]),
                PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
                PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
                solid="nitrate",
                solvent="water",
                second_solvent="ethanol",
            ),
        ),
        "extracted": Case(
            mixture_of(EXTRACTED, ["sodium chloride", "adipic acid"], [], edges),
            _extracted,
            lambda f, u: ExtractiveCrystallizer(
                285.0 + 25.0 * u[0],
                (f["feed"].slurry_volume_flow + f["antisolvent"].slurry_volume_flow)
                * 10.0 ** (2.5 + 1.5 * u[1]),
                AntisolventSolubility(PolynomialSolubility([0.356]), 1.0 + 5.0 * u[5]),
                PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
                PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
                other_solubility=AntisolventSolubility(PolynomialSolubility([0.02]), -3.0 * u[0]),
                second_solvent="ethanol",
            ),
        ),
        "drowned in batches": Case(
            nitrate,
            _met,
            lambda f, u: AntisolventBatchCrystallizer(
                285.0 + 25.0 * u[0],
                duration=10.0 ** (3.0 + 2.0 * u[1]),
                addition_exponent=0.5 + 3.0 * u[3],
                seed_mass_per_solvent=0.02 * u[4],
                solubility=AntisolventSolubility(
                    PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]), 1.0 + 5.0 * u[5]
                ),
                growth=PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
                nucleation=PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
                solid="nitrate",
                solvent="water",
                second_solvent="ethanol",
            ),
        ),
        "drowned batches that dissolve": Case(
            nitrate,
            _met,
            lambda f, u: AntisolventBatchCrystallizer(
                285.0 + 25.0 * u[0],
                duration=10.0 ** (3.0 + 2.0 * u[1]),
                addition_exponent=0.5 + 3.0 * u[3],
                seed_mass_per_solvent=0.02 * u[4],
                solubility=AntisolventSolubility(
                    PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]), 1.0 + 5.0 * u[5]
                ),
                growth=PowerLawGrowth(10.0 ** (-6.0 + 2.0 * u[2]), 1.0 + u[3]),
                nucleation=PowerLawNucleation(10.0 ** (5.0 + 4.0 * u[4]), 1.5 + u[5]),
                dissolution=PowerLawDissolution(10.0 ** (-6.0 + 3.0 * u[4])),
                solid="nitrate",
                solvent="water",
                second_solvent="ethanol",
            ),
        ),
        "enantiomers": Case(
            mirrored,
            _mirrored,
            lambda f, u: PreferentialCrystallizer(
                PowerCooling(330.0, 285.0 + 40.0 * u[0], 1800.0),
                solubility=LibrarySolubility("L-threonine"),
                growth=PowerLawGrowth(10.0 ** (-8.0 + 2.0 * u[1]), 1.0 + u[2]),
                nucleation=PowerLawNucleation(10.0 ** (4.0 + 4.0 * u[3]), 1.0 + u[4]),
                duration=7200.0,
                seed_mass_per_solvent=0.01 * u[5],
                counter_nucleation=u[2],
                racemate_solubility_ratio=1.4 + u[4],
            ),
        ),
        "polymorphs": Case(
            forms,
            _alpha,
            lambda f, u: PolymorphCrystallizer(
                PowerCooling(325.0, 285.0 + 40.0 * u[0], 1800.0),
                solubility=LibrarySolubility(ALPHA),
                solubility_law_stable=LibrarySolubility(BETA),
                growth=PowerLawGrowth(10.0 ** (-8.0 + 2.0 * u[1]), 1.0 + u[2]),
                growth_stable=PowerLawGrowth(10.0 ** (-9.0 + 2.0 * u[3]), 1.0),
                dissolution=PowerLawDissolution(10.0 ** (-6.0 + 2.0 * u[4])),
                nucleation_stable=PowerLawNucleation(10.0 ** (4.0 + 4.0 * u[3]), 1.0 + u[4]),
                duration=14400.0,
                cross_nucleation=0.1 * u[2],
                seed_mass_stable=0.001 * u[5],
                volume_shape_factor_stable=0.1,
            ),
        ),
        "dissolver": Case(
            mirrored,
            _mirrored,
            lambda f, u: Dissolver(
                285.0 + 45.0 * u[0],
                f["feed"].slurry_volume_flow * 10.0 ** (2.5 + 1.5 * u[1]),
                solubility=LibrarySolubility("L-threonine"),
            ),
        ),
        "sublimer": Case(
            subliming,
            _subliming,
            lambda f, u: Sublimer(300.0 + 50.0 * u[0], 10.0 ** (3.0 + 2.3 * u[1]), 0.2 + 0.8 * u[2]),
        ),
        "desublimer": Case(
            subliming,
            _subliming,
            lambda f, u: Desublimer(275.0 + 40.0 * u[0], 10.0 ** (3.0 + 2.3 * u[1]), crystal_size=1e-4),
        ),
        "adducts": Case(
            mixture_of(["heptane", "toluene", "cyclohexane"], ["silica sand"], ["nitrogen"], edges),
            _oils,
            lambda f, u: AdductiveCrystallizer(
                260.0 + 50.0 * u[0],
                300.0 + 80.0 * u[1],
                10.0 ** (4.0 + u[2]),
                1.0 + 14.0 * u[3],
                0.5 + 0.5 * u[4],
                liquor_per_crystals=0.02 * u[5],
            ),
        ),
        "layers": Case(
            nitrate,
            _melt,
            lambda f, u: LayerMeltCrystallizer(
                260.0 + 15.0 * u[0],
                334e3,
                0.01 + 0.1 * u[1],
                10.0 ** (-7.0 + u[2]),
                3e-6,
                0.3 + 0.5 * u[3],
                sweated_fraction=0.2 * u[4],
                impurity_fraction_eutectic=0.3 + 0.6 * u[5],
                pure_liquid="water",
            ),
        ),
        "wash column": Case(
            nitrate,
            _melt,
            lambda f, u: SuspensionMeltCrystallizer(
                260.0 + 15.0 * u[0],
                334e3,
                0.1 + 0.8 * u[3],
                1.8e-3,
                temperature_crystallizer=258.0 + 15.0 * u[0] - 20.0 * u[1],
                crystal_size=5e-5 + 1e-3 * u[2],
                wash_ratio=1.5 * u[4],
                wash_efficiency=0.8 + 0.2 * u[5],
                washed_height=0.02 + u[4],
                bed_velocity=10.0 ** (-4.0 + 2.0 * u[3]),
                inclusion_fraction=0.01 * u[1],
                impurity_fraction_eutectic=0.3 + 0.6 * u[5],
                pure_liquid="water",
            ),
        ),
        "wash column at its freezing point": Case(
            molten,
            _melt,
            lambda f, u: SuspensionMeltCrystallizer(
                260.0 + 15.0 * u[0],
                334e3,
                0.1 + 0.8 * u[3],
                1.8e-3,
                wash_ratio=1.5 * u[4],
                wash_efficiency=0.8 + 0.2 * u[5],
                washed_height=0.02 + u[4],
                bed_velocity=10.0 ** (-4.0 + 2.0 * u[3]),
                inclusion_fraction=0.01 * u[1],
                pure_liquid="water",
            ),
        ),
        "uptake": Case(
            mixture_of(
                ["water", "potassium nitrate", "sodium chloride"],
                ["potassium nitrate", *(f"{x} in crystals" for x in IMPURE)],
                [],
                np.geomspace(1e-5, 4e-3, classes + 1),
            ),
            _impure,
            lambda f, u: ImpurityUptake(u[0], inclusion_fraction=0.02 * u[1]),
        ),
        "exchange": Case(
            mixture_of(
                ["water", "barium chloride", "sodium sulfate", "sodium chloride"],
                ["barium sulfate"],
                [],
                np.geomspace(1e-7, 4e-4, classes + 1),
            ),
            _exchanging,
            lambda f, u: Precipitator(
                285.0 + 30.0 * u[0],
                (f["feed"].slurry_volume_flow + f["reagent"].slurry_volume_flow) * 10.0 ** (1.5 + 1.5 * u[1]),
                PowerLawGrowth(10.0 ** (-15.0 + 2.0 * u[2]), 1.5 + u[3]),
                PowerLawNucleation(10.0 ** (5.0 + 3.0 * u[4]), 1.5 + u[5]),
                rotation_speed=10.0 + 20.0 * u[2],
            ),
        ),
        "hydroxide": Case(
            mixture_of(
                ["water", "magnesium chloride", "sodium hydroxide", "sodium chloride"],
                ["magnesium hydroxide"],
                [],
                np.geomspace(1e-7, 4e-4, classes + 1),
            ),
            _exchanging,
            lambda f, u: HydroxidePrecipitator(
                285.0 + 30.0 * u[0],
                (f["feed"].slurry_volume_flow + f["reagent"].slurry_volume_flow) * 10.0 ** (1.5 + 1.5 * u[1]),
                PowerLawGrowth(10.0 ** (-12.0 + 2.0 * u[2]), 1.5 + u[3]),
                PowerLawNucleation(10.0 ** (6.0 + 3.0 * u[4]), 1.5 + u[5]),
                rotation_speed=10.0 + 20.0 * u[2],
            ),
        ),
        "salt pair": Case(
            mixture_of(
                ["water", "sodium chloride", "potassium chloride"],
                ["sodium chloride", "potassium chloride"],
                ["water"],
                np.geomspace(1e-5, 4e-3, classes + 1),
            ),
            _chlorides,
            lambda f, u: TwoSaltCrystallizer(
                280.0 + 90.0 * u[0],
                f["feed"].slurry_volume_flow * 10.0 ** (2.5 + 1.5 * u[1]),
                evaporation=0.6 * u[2] * f["feed"].liquid[0],
                crystal_size=1e-4 + 5e-4 * u[3],
                first_salt="sodium chloride",
                second_salt="potassium chloride",
            ),
        ),
    }
