"""Two enantiomers: how they dissolve beside each other, whether they crystallize apart or together, and what
seeding with one and the other in turn yields.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    MassRatio,
    MolarEnergy,
    MoleFraction,
    PositiveNumber,
    Temperature,
    Within,
)
from granum.crystallization.kinds import PositiveMolarEnergy, RacemateSolubilityRatio
from granum.numerics import find_root

UNEQUAL = Annotated[MoleFraction, Within(1e-6, 1.0 - 1e-6)]
PUREST = 1.0 - 1e-9  # mole fraction up to which the eutectic is looked for
_TYPICAL = {
    "enthalpy_of_fusion": (2e4, 3e4),
    "enthalpy_of_fusion_racemate": (2e4, 3e4),
    "melting_temperature": (390.0, 420.0),
    "melting_temperature_racemate": (385.0, 415.0),
    "temperature": (380.0, 400.0),
}
_SYMBOLS = {"enthalpy_of_fusion": r"\Delta H_A", "melting_temperature": "T_A"}
NO_CROP = "The seeded enantiomer must end less supersaturated than the other may become."


class EutecticPoint(NamedTuple):
    """Where a melt of two enantiomers freezes as a whole: share of the more plentiful one, temperature."""

    mole_fraction_eutectic: MoleFraction
    temperature_eutectic: Temperature


class AlternatingCrop(NamedTuple):
    """Per kg of solvent: crystals of each crop, excess of one enantiomer before it, and what is dissolved of
    the seeded enantiomer then.
    """

    crop_per_solvent: MassRatio
    excess_per_solvent: MassRatio
    solute_per_solvent: MassRatio


def salting(racemate_solubility_ratio: Any) -> Any:
    """Setschenow's constant by which both enantiomers together have this ratio to one alone."""
    return 2.0 / racemate_solubility_ratio * jnp.log(0.5 * racemate_solubility_ratio)


@formula(
    source="meyerhoffer1904; jacques1981, ch. 3; setschenow1889",
    title="Solubility of an enantiomer beside the other",
    equation=(
        r"C^*_1 = C^*\,\exp\left(K\,\frac{C_2}{C^*}\right),\quad "
        r"K = \frac{2}{\alpha}\ln\frac{\alpha}{2}"
    ),
    output="solubility_per_solvent_enantiomer",
    typical={"solubility_per_solvent": (0.05, 0.2), "solute_per_solvent_other": (0.05, 0.2)},
    symbols={"solubility_per_solvent_enantiomer": "C^*_1", "solute_per_solvent_other": "C_2"},
)
def solubility_per_solvent_enantiomer(
    solubility_per_solvent: PositiveNumber,
    solute_per_solvent_other: MassRatio,
    racemate_solubility_ratio: RacemateSolubilityRatio = 2.0,
) -> MassRatio:
    """Solubility of one enantiomer of a conglomerate where so much of the other is dissolved, from that of
    one alone.

    Meyerhoffer's double-solubility rule: a racemate that crystallizes as a conglomerate dissolves twice as
    well as one enantiomer, since neither minds the other; salts that part into ions dissolve √2 times as
    well, by their common ion. Any other ratio is measured. Between the pure enantiomer and the racemate the
    logarithm of the solubility goes with the other enantiomer, as Setschenow has it.

    >>> round(solubility_per_solvent_enantiomer(0.1, 0.0707107, racemate_solubility_ratio=2**0.5), 4)
    0.0707
    """
    C = solubility_per_solvent
    return C * jnp.exp(salting(racemate_solubility_ratio) * solute_per_solvent_other / C)


@formula(
    source="prigogine1954; jacques1981, ch. 2",
    title="Freezing point over a racemic compound (Prigogine and Defay)",
    equation=r"\frac1T = \frac1{T_R} - \frac{R\,\ln[4x(1-x)]}{2\,\Delta H_R}",
    output="temperature",
    typical=_TYPICAL | {"mole_fraction": (0.5, 0.8)},
)
def freezing_temperature_racemate(
    mole_fraction: UNEQUAL,
    enthalpy_of_fusion_racemate: PositiveMolarEnergy,
    melting_temperature_racemate: Temperature,
) -> Temperature:
    """Temperature at which a racemic compound begins to freeze out of an ideal melt of two enantiomers.

    The heat of fusion is per mole of molecules, two of which make one of the compound. On the other side of
    the eutectic the enantiomer freezes first (``freezing_temperature_ideal``).

    >>> round(freezing_temperature_racemate(0.5, 25600, 391.95), 2)
    391.95
    """
    x = mole_fraction
    fall = GAS_CONSTANT * jnp.log(4.0 * x * (1.0 - x)) / (2.0 * enthalpy_of_fusion_racemate)
    return 1.0 / (1.0 / melting_temperature_racemate - fall)


@formula(
    source="jacques1981, ch. 2; prigogine1954; schroder1893",
    title="Eutectic of an enantiomer and its racemic compound",
    equation=(
        r"\frac{1}{T_E} = \frac{1}{T_A} - \frac{R\,\ln x_E}{\Delta H_A} = "
        r"\frac{1}{T_R} - \frac{R\,\ln[4x_E(1-x_E)]}{2\,\Delta H_R}"
    ),
    output="eutectic",
    typical=_TYPICAL,
    symbols=_SYMBOLS,
)
def eutectic_racemate(
    enthalpy_of_fusion: PositiveMolarEnergy,
    melting_temperature: Temperature,
    enthalpy_of_fusion_racemate: PositiveMolarEnergy,
    melting_temperature_racemate: Temperature,
) -> EutecticPoint:
    """Composition and temperature at which an ideal melt of two enantiomers freezes to enantiomer and racemic
    compound, from melting points and heats of fusion.

    Only a mixture richer than this gives the pure enantiomer, and solubilities often have their eutectic at
    nearly the same share. Where the compound would melt below the conglomerate there is none: the eutectic is
    the racemate itself.

    >>> round(eutectic_racemate(24500, 404.75, 25600, 391.95).mole_fraction_eutectic, 2)
    0.71
    """
    H, T_A, R = enthalpy_of_fusion, melting_temperature, GAS_CONSTANT
    H_R, T_R = enthalpy_of_fusion_racemate, melting_temperature_racemate

    def enantiomer(x: Any) -> Any:
        return 1.0 / T_A - R * jnp.log(x) / H

    def compound(x: Any) -> Any:
        return 1.0 / T_R - R * jnp.log(4.0 * x * (1.0 - x)) / (2.0 * H_R)

    stable = enantiomer(0.5) > compound(0.5)
    half = 0.5 + 0.0 * (H + T_A + H_R + T_R)
    found = find_root(lambda x: jnp.where(stable, enantiomer(x) - compound(x), x - 0.5), half, PUREST).value
    x = jnp.where(stable, found, 0.5)
    return EutecticPoint(x, 1.0 / enantiomer(x))


@formula(
    source="leclercq1976; jacques1981, ch. 2",
    title="Stability of a racemic compound against the conglomerate",
    equation=(
        r"\Delta G = \Delta H_A\left(1 - \frac{T}{T_A}\right) - "
        r"\Delta H_R\left(1 - \frac{T}{T_R}\right) - R T \ln 2"
    ),
    output="gibbs_energy_racemate",
    typical=_TYPICAL,
    symbols=_SYMBOLS,
)
def gibbs_energy_racemate(
    enthalpy_of_fusion: PositiveMolarEnergy,
    melting_temperature: Temperature,
    enthalpy_of_fusion_racemate: PositiveMolarEnergy,
    melting_temperature_racemate: Temperature,
    temperature: Temperature,
) -> MolarEnergy:
    """Gibbs energy of making a racemic compound from the crystals of both enantiomers, per mole of molecules;
    negative where the compound is the stable one.

    Positive: the racemate is a conglomerate, which seeding with one enantiomer can part. Heats of fusion are
    taken as constant, so that the farther from the melting points, the less certain.

    >>> round(gibbs_energy_racemate(24500, 404.75, 25600, 391.95, temperature=391.95) / 1000, 2)
    -1.48
    """
    T = temperature
    apart = enthalpy_of_fusion * (1.0 - T / melting_temperature)
    together = enthalpy_of_fusion_racemate * (1.0 - T / melting_temperature_racemate)
    return apart - together - GAS_CONSTANT * T * jnp.log(2.0)


@formula(
    source="jacques1981, ch. 4; collet1980",
    title="Crop of resolution with alternating seeds",
    equation=(r"m = 2\,(\beta_2 - \beta_1)\,C^*,\quad e = \frac{m}{2},\quad C_1 = \beta_2 C^* + e"),
    output="alternating_crop",
    typical={
        "solubility_per_solvent": (0.05, 0.2),
        "supersaturation_ratio_other": (1.08, 1.3),
        "supersaturation_ratio_end": (1.0, 1.05),
    },
    symbols={"supersaturation_ratio_other": r"\beta_2", "supersaturation_ratio_end": r"\beta_1"},
)
def crop_alternating_seeds(
    solubility_per_solvent: PositiveNumber,
    supersaturation_ratio_other: PositiveNumber,
    supersaturation_ratio_end: PositiveNumber = 1.0,
) -> AlternatingCrop:
    """Crystals of one enantiomer and the other in turn, once each crop leaves as much in excess as the one
    before it had found.

    Between crops as much racemate is dissolved as has crystallized. The other enantiomer stays at the
    supersaturation that it bears without nucleating, the seeded one ends at its own: the crop is twice the
    excess. Both supersaturations are over the solubility at the end of cooling, which is that of an
    enantiomer in this liquor; seeds taken from the product are not part of the crop.

    >>> round(crop_alternating_seeds(0.1, 1.12, 1.02).crop_per_solvent, 4)
    0.02
    """
    C, other, end = solubility_per_solvent, supersaturation_ratio_other, supersaturation_ratio_end
    excess = (other - end) * C
    impossible(excess < 0.0, end, "supersaturation_ratio_end", 0.0, other, NO_CROP)
    excess = jnp.where(excess < 0.0, jnp.nan, excess)
    return AlternatingCrop(2.0 * excess, excess, other * C + excess)
