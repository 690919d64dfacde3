"""How dusts explode: values of tested samples."""

from __future__ import annotations

import math
from typing import NamedTuple

from granum.core.datasets import dataset
from granum.core.errors import unknown_name
from granum.core.i18n import _

COARSEST = 5e-4  # m, above which particles do not count as dust that burns


class DustData(NamedTuple):
    """A tested dust, SI; what was not tested is not a number."""

    name: str
    median_size: float
    explosible_concentration: float
    explosion_pressure: float
    deflagration_index: float
    limiting_oxygen: float
    ignition_energy: float


def dusts() -> dict[str, DustData]:
    """Every dust of the table by name."""
    ignites = {row["name"]: row for row in dataset("streams", "dusts_ignition")}

    def known(name: str, what: str) -> float:
        return ignites[name][what] if name in ignites else math.nan

    return {
        row["name"]: DustData(
            row["name"],
            row["median size"],
            row["explosible concentration"],
            row["explosion pressure"],
            row["deflagration index"],
            known(row["name"], "limiting oxygen"),
            known(row["name"], "ignition energy"),
        )
        for row in dataset("streams", "dusts_nfpa68")
    }


def dust(name: str) -> DustData:
    """A dust by its name."""
    known = dusts()
    found = known.get(name.strip().lower())
    if found is None:
        raise unknown_name(_("Dust"), name, known)
    return found
