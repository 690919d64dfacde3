"""Caustic liquor, whose parts hold another heat apart than together, through units that part it, thin it or
dry it: each closes its energy at shares of lye drawn at random.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import granum as gr
from granum.core.errors import GranumError
from granum.materials.schema import read_materials

LYE, CRYSTAL = "sodium hydroxide", "sodium hydroxide monohydrate"
# what is fed with lye, what solid there is beside its crystal where it dries, the strongest lye
UNITS = {
    "filtration.plate_and_frame_press": ("feed", "calcite", 0.4),
    "filtration.rotary_vacuum_drum": ("feed", "calcite", 0.4),
    "filtration.reverse_osmosis": ("feed", None, 0.04),
    "streams.adiabatic_humidifier": ("water", None, 0.3),
    "streams.heater": ("feed", None, 0.5),
    "drying.tunnel_dryer": ("feed", "cellulose", 0.1),
    "drying.rotary_dryer": ("feed", "quartz", 0.1),
    "drying.well_mixed_dryer": ("feed", "quartz", 0.1),
}


@pytest.mark.parametrize("key", UNITS)
@pytest.mark.parametrize("seed", range(2))
def test_it_closes_with_lye(key: str, seed: int) -> None:
    port, solid, most = UNITS[key]
    share = most * float(np.random.default_rng(seed).uniform(0.2, 1.0))
    mixture: dict[str, Any] = {"liquids": f"water,{LYE}"}
    fed: dict[str, Any] = {"liquid": {"water": 1.0 - share, LYE: share}}
    if solid is not None:
        mixture["solids"] = f"{solid},{CRYSTAL}"
        fed["solid"] = {solid: 1.0, CRYSTAL: 0.0}
    elif port == "water":
        mixture["solids"] = CRYSTAL
    run = gr.alone(key, mixture=mixture, **{port: fed}).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert float(run.streams[port].liquid[1]) > 0.0


FLASHED = {
    # solute: its crystal, the shares between which it is drawn, °C of the feed and of the vessel
    "magnesium chloride": ("magnesium chloride hexahydrate", 0.34, 0.41, 105, 50),
    "calcium chloride": ("calcium chloride tetrahydrate", 0.50, 0.56, 70, 35),
    "sodium sulfate": ("sodium sulfate decahydrate", 0.2, 0.31, 60, 20),
    "potassium chloride": ("potassium chloride", 0.32, 0.345, 90, 40),
}


@pytest.mark.parametrize("solute", FLASHED)
def test_a_flash_takes_the_heat_of_mixing_from_the_liquor(solute: str) -> None:
    """Without heat from outside the product and the vapor hold what the feed held."""
    crystal, least, most, hot, cold = FLASHED[solute]
    share = float(np.random.default_rng(4).uniform(least, most))
    run = gr.alone(
        "crystallization.vacuum_crystallizer",
        mixture={"liquids": f"water,{solute}", "solids": crystal},
        feed={"liquid": {"water": 1.0 - share, solute: share}, "temperature": f"{hot} degC"},
        solubility={"law": "library_solubility", "solute": solute},
        temperature=f"{cold} degC",
    ).solve()
    assert run.audit["mass_closure"] < 1e-9
    figures = run.sheets["vacuum_crystallizer"].figures
    assert float(figures.crystal_flow) > 0.0
    assert abs(float(figures.heat_duty)) < 1e-9 * float(figures.condenser_duty)


def test_the_law_of_lye_is_of_lye_alone() -> None:
    branch = {
        "crystal": "salt",
        "stable": [273.15, 373.15],
        "range": [273.15, 373.15],
        "basis": "kg anhydrous per kg solvent",
        "form": "table",
        "table": [[0, 10], [50, 20], [100, 30]],
        "source": "own",
    }
    entry = {"molar_mass": 0.05, "formula": "KCl", "mixing": "olsson", "branches": [branch]}
    with pytest.raises(GranumError, match="NaOH in water"):
        read_materials({"solute": {"mine": entry}}, "own")
