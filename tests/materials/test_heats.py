"""Heats of solution against the differences of the NBS enthalpies of formation (Wagman and others 1982),
kJ/mol at 25 °C.

An independent route: ions at infinite dilution less the crystal, water of crystallization as liquid.
"""

from __future__ import annotations

import math
import tomllib
from importlib.resources import files

import pytest

from granum.materials.library import session

IONS = {
    "K": -252.38,
    "Rb": -251.17,
    "Cs": -258.28,
    "Na": -240.12,
    "NH4": -132.51,
    "Ag": 105.58,
    "Cl": -167.16,
    "Br": -121.55,
    "I": -55.19,
    "NO3": -207.36,
    "Li": -278.49,
    "Cr2O7": -1490.3,
    "ClO3": -103.97,
    "ClO4": -129.33,
    "IO3": -221.3,
    "SO4": -909.27,
    "CO3": -677.14,
    "H2PO4": -1296.29,
    "Fe(CN)6": 561.9,
    "water": -285.83,
}
CRYSTALS = [
    ("potassium nitrate", -494.63, "K NO3"),
    ("potassium chloride", -436.75, "K Cl"),
    ("potassium bromide", -393.80, "K Br"),
    ("potassium iodide", -327.90, "K I"),
    ("potassium chlorate", -397.73, "K ClO3"),
    ("potassium perchlorate", -432.75, "K ClO4"),
    ("potassium iodate", -501.37, "K IO3"),
    ("sodium chloride", -411.15, "Na Cl"),
    ("sodium nitrate", -467.85, "Na NO3"),
    ("ammonium chloride", -314.43, "NH4 Cl"),
    ("ammonium nitrate", -365.56, "NH4 NO3"),
    ("potassium sulfate", -1437.79, "K K SO4"),
    ("potassium dichromate", -2061.5, "K K Cr2O7"),
    ("lithium carbonate", -1215.9, "Li Li CO3"),
    ("silver nitrate", -124.39, "Ag NO3"),
    ("ammonium dihydrogen phosphate", -1445.07, "NH4 H2PO4"),
    ("potassium ferricyanide", -249.8, "K K K Fe(CN)6"),
    ("rubidium bromide", -394.59, "Rb Br"),
    ("rubidium nitrate", -495.05, "Rb NO3"),
    ("cesium chloride", -443.04, "Cs Cl"),
    ("cesium nitrate", -505.97, "Cs NO3"),
    ("sodium sulfate decahydrate", -4327.26, "Na Na SO4 " + 10 * "water "),
    ("sodium carbonate decahydrate", -4081.32, "Na Na CO3 " + 10 * "water "),
]


def heats() -> dict[str, float]:
    data = tomllib.loads(
        (files("granum") / "materials" / "data" / "solutes.toml").read_text(encoding="utf-8")
    )["solute"]
    return {
        b["crystal"]: b["heat_of_solution"]
        for s in data.values()
        for b in s["branches"]
        if "heat_of_solution" in b
    }


@pytest.mark.parametrize(("crystal", "formation", "parts"), CRYSTALS, ids=[row[0] for row in CRYSTALS])
def test_heat_of_solution_is_the_difference_of_formation_enthalpies(crystal, formation, parts):
    difference = sum(IONS[part] for part in parts.split()) - formation
    assert heats()[crystal] / 1e3 == pytest.approx(
        difference, rel=0.01, abs=2.4 if "deca" in crystal else 0.4
    )


@pytest.mark.parametrize(
    "name", ["ammonium dihydrogen phosphate", "potassium ferricyanide", "sodium oxalate"]
)
def test_the_slope_of_the_solubility_bears_out_heats_that_stand_alone(name):
    """Last heat in the saturated solution, ν R T² d ln a/dT: lower than the first one where activities fall
    behind the ideal, and never above the ideal slope (three salts, from CRC solubilities).
    """
    system, T = session().solute(name), 298.15
    ions = {"ammonium dihydrogen phosphate": 2, "potassium ferricyanide": 4, "sodium oxalate": 3}[name]
    cold, warm = (math.log(float(system.value(T + d))) for d in (-2.0, 2.0))
    ideal = ions * 8.314e-3 * (warm - cold) / (1.0 / (T - 2.0) - 1.0 / (T + 2.0))
    assert 0.4 * ideal < heats()[name] / 1e3 < 1.4 * ideal


WATEQ4F = {
    "sodium chloride": 3.84,
    "sodium hydrogen carbonate": 15.56,
    "sodium sulfate decahydrate": 79.44,
    "sodium sulfate anhydrous": -2.39,
    "magnesium sulfate heptahydrate": 11.80,
    "sodium carbonate decahydrate": 65.88,
    "sodium carbonate monohydrate": -11.72,
    "iron(II) sulfate heptahydrate": 20.54,
    "nickel sulfate heptahydrate": 12.30,
    "zinc sulfate heptahydrate": 13.81,
    "zinc sulfate hexahydrate": -0.67,
    "zinc sulfate monohydrate": -44.52,
    "gypsum": -0.46,
}
FORMATION = {
    "potassium permanganate": (-837.2, "K MnO4"),
    "potassium chromate": (-1403.7, "K K CrO4"),
    "ammonium sulfate": (-1180.9, "NH4 NH4 SO4"),
    "sodium nitrite": (-358.7, "Na NO2"),
}


def test_heats_of_perry_are_near_infinite_dilution_at_25_degrees() -> None:
    """Perry's table is for 18 °C and a few hundred moles of water: within 5.5 kJ/mol of the WATEQ4F database
    and of CRC enthalpies of formation.
    """
    found = heats()
    for crystal, expected in WATEQ4F.items():
        assert found[crystal] / 1e3 == pytest.approx(expected, abs=5.5), crystal
    ions = IONS | {"MnO4": -541.4, "CrO4": -881.2, "NO2": -104.6}
    for crystal, (formation, parts) in FORMATION.items():
        assert found[crystal] / 1e3 == pytest.approx(
            sum(ions[part] for part in parts.split()) - formation, abs=5.5
        ), crystal
