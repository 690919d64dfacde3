"""Crystals of two salts at once: what they are made of, their solubility products and heats of solution."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from granum.materials.ions import Ions

APPELO, TONER, ATTIA = "harvie1984; appelo2015", "harvie1984; toner2017", "toner2017; attia"


class DoubleSalt(NamedTuple):
    """A crystal of the library: mol of each ion and of water in a mole, the decimal logarithm of its
    solubility product as a + bT + c/T between two temperatures, and its heat of solution at 25 °C, J/mol.
    """

    ions: Mapping[str, int]
    water: float
    product: tuple[float, float, float]
    heat_of_solution: float
    source: str
    low: float = 273.15
    high: float = 333.15

    def log_product(self, T: Any) -> Any:
        """Natural logarithm of the solubility product."""
        a, b, c = self.product
        return 2.302585092994046 * (a + b * T + c / T)


# Products for 25 °C after Harvie, Møller and Weare, their change with temperature and the heats after Toner
# and Catling; that of carnallite after Appelo. Glaserite is Toner and Catling's at 25 °C; the heat of its
# formation from the solid sulfates is constant (13.5 kJ/mol) and such that the invariant points at 20 and
# 40 °C are those of Attia-Essaies and others.
DOUBLE_SALTS: Mapping[str, DoubleSalt] = MappingProxyType(
    {
        "glaserite": DoubleSalt(
            {"K": 3, "Na": 1, "SO4": 2},
            0.0,
            (18.433, -2.63520644e-2, -4275.56499),
            38900.0,
            ATTIA,
            273.15,
            373.15,
        ),
        "carnallite": DoubleSalt(
            {"K": 1, "Mg": 1, "Cl": 3}, 6.0, (23.966, -3.11e-2, -3090.0), 6200.0, APPELO, 273.15, 373.15
        ),
        "kainite": DoubleSalt(
            {"K": 1, "Mg": 1, "Cl": 1, "SO4": 1}, 3.0, (-2.4704, 0.0, 679.0), -13000.0, TONER
        ),
        "schoenite": DoubleSalt({"K": 2, "Mg": 1, "SO4": 2}, 6.0, (1.716, 0.0, -1802.0), 34500.0, TONER),
        "leonite": DoubleSalt({"K": 2, "Mg": 1, "SO4": 2}, 4.0, (-1.5088, 0.0, -736.5), 14100.0, TONER),
        "bloedite": DoubleSalt({"Na": 2, "Mg": 1, "SO4": 2}, 4.0, (1.5772, 0.0, -1170.0), 22400.0, TONER),
    }
)


def in_salts(salts: Sequence[Ions], ions: Mapping[str, int]) -> tuple[float, ...] | None:
    """Mol of each of some salts that hold the ions of a double salt; None where they do not."""
    left, found = {ion: float(n) for ion, n in ions.items()}, [0.0] * len(salts)
    for k, p in enumerate(salts):
        if p.cation in left and p.anion in left:
            found[k] = min(left[p.cation] / p.cation_count, left[p.anion] / p.anion_count)
            left[p.cation] -= found[k] * p.cation_count
            left[p.anion] -= found[k] * p.anion_count
    return None if any(left.values()) else tuple(found)
