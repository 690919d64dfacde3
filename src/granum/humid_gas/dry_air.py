"""What dry air is made of."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.datasets import dataset
from granum.core.i18n import _
from granum.core.kinds import MassFraction, MolarMass, MoleFraction, Series, Within

STANDARD = 314e-6  # mole fraction of carbon dioxide in the table
MOST = 0.01  # which oxygen turns into without air becoming another gas


class AirComposition(NamedTuple):
    """Gases of dry air, the most abundant first, and the molar mass of all of it."""

    gas: Annotated[str, Series("gases")]
    chemical_formula: Annotated[str, Series("gases")]
    mole_fraction: Annotated[MoleFraction, Series("gases")]
    mass_fraction: Annotated[MassFraction, Series("gases")]
    molar_mass: Annotated[MolarMass, Series("gases")]
    molar_mass_mean: MolarMass


@procedure(
    source="usstandard1976, table 3; picard2008",
    title="Composition of dry air",
    typical={"carbon_dioxide_fraction": (300e-6, 1000e-6)},
)
def air_composition(
    carbon_dioxide_fraction: Annotated[MoleFraction, Within(0.0, MOST)] = STANDARD,
) -> AirComposition:
    """Gases of clean dry air near sea level by mole and by mass, and its molar mass.

    Carbon dioxide beyond that of the table takes the place of oxygen, as where fuel or food was burned
    (Picard and others do so too). The standard was read in a reprint, not opened.

    Differs from the print: the standard's 28.9644 g/mol is the sum of shares that add up to 0.999 997.

    >>> round(air_composition().molar_mass_mean * 1e3, 4)
    28.9645
    """
    rows = dataset("humid_gas", "air_usstandard1976")
    extra = float(carbon_dioxide_fraction) - STANDARD
    change = {"carbon dioxide": extra, "oxygen": -extra}
    moles = np.array([row["mole_fraction"] + change.get(row["gas"], 0.0) for row in rows])
    each = np.array([row["molar_mass"] for row in rows])
    masses = moles * each
    names: Any = tuple(_(row["gas"]) for row in rows)
    formulas: Any = tuple(row["formula"] for row in rows)
    mean = masses.sum() / moles.sum()
    return AirComposition(names, formulas, moles / moles.sum(), masses / masses.sum(), each, mean)
