"""Ions of a salt from its formula: what stays the same when two salts exchange them."""

from __future__ import annotations

import re
from functools import cache
from typing import NamedTuple

# charge number; g/mol, sums of the atomic weights of haynes2014, sec. 1
CATIONS = {
    "Na": (1, 22.98977),
    "K": (1, 39.0983),
    "Li": (1, 6.941),
    "NH4": (1, 18.03846),
    "Ag": (1, 107.8682),
    "Mg": (2, 24.305),
    "Ca": (2, 40.078),
    "Sr": (2, 87.62),
    "Ba": (2, 137.327),
    "Cu": (2, 63.546),
    "Fe": (2, 55.845),
    "Zn": (2, 65.38),
    "Cd": (2, 112.414),
    "Ni": (2, 58.6934),
    "Co": (2, 58.933194),
    "Mn": (2, 54.938044),
    "Pb": (2, 207.2),
}
ANIONS = {
    "OH": (-1, 17.00734),
    "F": (-1, 18.998403),
    "Cl": (-1, 35.4527),
    "Br": (-1, 79.904),
    "I": (-1, 126.90447),
    "NO3": (-1, 62.00494),
    "NO2": (-1, 46.00554),
    "SO4": (-2, 96.0626),
    "CO3": (-2, 60.0089),
    "CrO4": (-2, 115.9937),
    "C2O4": (-2, 88.0190),
}
WATER = 18.01528  # g/mol


def _one_of(names: dict[str, tuple[int, float]]) -> str:
    return "|".join(sorted(names, key=len, reverse=True))


_SALT = re.compile(
    rf"(?:\(({_one_of(CATIONS)})\)(\d+)|({_one_of(CATIONS)})(\d*))"
    rf"(?:\(({_one_of(ANIONS)})\)(\d+)|(Cl|Br|F|I)(\d+)|({_one_of(ANIONS)}))"
    r"(?:[.·](\d*)H2O)?"
)


class Ions(NamedTuple):
    """One formula unit: its ions by name with how many, charge number and g/mol of each; and its water."""

    cation: str
    cation_count: int
    cation_charge: int
    cation_mass: float
    anion: str
    anion_count: int
    anion_charge: int
    anion_mass: float
    water_count: int

    @property
    def anhydrous_mass(self) -> float:
        """Of a formula unit without its water, kg/mol."""
        return 1e-3 * (self.cation_count * self.cation_mass + self.anion_count * self.anion_mass)

    @property
    def water_mass(self) -> float:
        """Of the water in a formula unit, kg/mol."""
        return 1e-3 * self.water_count * WATER

    @property
    def charges(self) -> float:
        """Amount times charge squared, summed over the ions of a mole."""
        return self.cation_count * self.cation_charge**2 + self.anion_count * self.anion_charge**2

    @property
    def shares(self) -> tuple[tuple[str, float], tuple[str, float]]:
        """The mass shares of cation and anion in the anhydrous salt, as the components that are conserved."""
        whole = 1e3 * self.anhydrous_mass
        share = self.cation_count * self.cation_mass / whole
        return (f"{self.cation} ion", share), (f"{self.anion} ion", 1.0 - share)


@cache
def ions_of(formula: str) -> Ions | None:
    """The ions of a salt of one cation and one anion; None where a formula is not one of these.

    Acids and the salts of weak acids with hydrogen of their own are left out: what they dissolve into
    depends on the pH.

    >>> ions_of("Na2SO4").cation_count, ions_of("CaSO4.2H2O").water_count, ions_of("C6H8O7")
    (2, 2, None)
    """
    found = _SALT.fullmatch(formula.strip())
    if found is None:
        return None
    cation, cation_count = found[1] or found[3], int(found[2] or found[4] or 1)
    anion, anion_count = found[5] or found[7] or found[9], int(found[6] or found[8] or 1)
    (z, M), (charge, mass) = CATIONS[cation], ANIONS[anion]
    if cation_count * z + anion_count * charge != 0:
        return None
    water = 0 if found[10] is None else int(found[10] or 1)
    return Ions(cation, cation_count, z, M, anion, anion_count, charge, mass, water)
