"""A spray dryer with an integrated bed, as a stranger writes it: what the spray leaves wet dries in the bed,
both gases pass one cyclone, and its fines go back to the atomizer.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

import granum as gr

MIXTURE_AND_SPRAY = """
title = "Milk powder in {stages}"

[mixture]
liquids = ["water"]
solids = ["lactose monohydrate"]
gases = ["dry air", "water"]
sizes = {{ smallest = "5 um", largest = "400 um", classes = 8 }}

[feeds.concentrate]
to = "tower.feed"
temperature = "60 degC"
solid_flow = "900 kg/h"
liquid_flow = "1100 kg/h"
sizes = {{ law = "rosin_rammler", size_modulus = "120 um", distribution_exponent = 2.5 }}

[feeds.tower_air]
to = "tower.gas"
temperature = "180 degC"
gas_flow = "{air} t/h"
gas = {{ "dry air" = 0.993, water = 0.007 }}

[units.tower]
model = "drying.spray_dryer"
length = "9 m"
diameter = "5 m"
atomizer = {{ law = "atomizer_pressure_nozzle", pressure_difference = "10 MPa" }}
kinetics = {{ law = "kinetics_rea", isotherm = "skim_milk" }}
drop_exponent = 2.2
entrainment = true

[units.cyclone]
model = "cyclones.gas_cyclone"
diameter = "1.5 m"
parallel_number = 2
cyclone_geometry = {{ law = "standard_cyclone", standard = "lapple" }}
"""
BED = """
[feeds.bed_air]
to = "bed.gas"
temperature = "105 degC"
gas_flow = "6 t/h"
gas = { "dry air" = 0.993, water = 0.007 }

[units.bed]
model = "drying.fluidized_bed_dryer"
area = "5 m2"
mass = "600 kg"
kinetics = { law = "kinetics_rea", isotherm = "skim_milk" }
entrainment = true
cells = 6

[units.gases]
model = "streams.mixer"

[streams]
moist_powder = ["tower.product", "bed.feed"]
powder = ["bed.product"]
tower_exhaust = ["tower.exhaust", "gases.tower"]
bed_exhaust = ["bed.exhaust", "gases.bed"]
dusty_gas = ["gases.product", "cyclone.feed"]
stack = ["cyclone.gas"]
fines = ["cyclone.dust", "tower.fines"]
"""
ALONE = """
[streams]
powder = ["tower.product"]
dusty_gas = ["tower.exhaust", "cyclone.feed"]
stack = ["cyclone.gas"]
fines = ["cyclone.dust", "tower.fines"]
"""


def solved(text: str) -> Any:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "line.toml"
        path.write_text(text, encoding="utf-8")
        return gr.read(path).solve()


@cache
def two_stages() -> Any:
    return solved(MIXTURE_AND_SPRAY.format(stages="two stages", air=22) + BED)


@cache
def one_stage(air: float) -> Any:
    return solved(MIXTURE_AND_SPRAY.format(stages="one stage", air=air) + ALONE)


def test_the_line_closes() -> None:
    run = two_stages()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9


def test_the_bed_dries_the_rest() -> None:
    """Water of the powder, of the bed's exhaust and of its dust, from the streams, against its own figure."""
    run = two_stages()
    moist, powder, exhaust, air = (
        run.streams[n] for n in ("moist_powder", "powder", "bed_exhaust", "bed_air")
    )
    taken = float(moist.liquid_flow - powder.liquid_flow - exhaust.liquid_flow)
    assert float(exhaust.gas_flow - air.gas_flow) == pytest.approx(taken, rel=1e-9)
    assert run.figure("bed.evaporation_rate") == pytest.approx(taken, rel=1e-6)
    assert float(powder.moisture_dry_basis) < 0.3 * float(moist.moisture_dry_basis)


def test_all_solid_leaves_as_powder_but_what_the_cyclone_lets_through() -> None:
    run = two_stages()
    powder, stack, fed = (float(run.streams[n].solid_flow) for n in ("powder", "stack", "concentrate"))
    assert powder + stack == pytest.approx(fed, rel=1e-9)
    assert 0.0 < stack < 1e-3 * fed
    # fines of the bed and of the tower both come back
    back = float(run.streams["fines"].solid_flow)
    dust = sum(float(run.streams[n].solid_flow) for n in ("tower_exhaust", "bed_exhaust"))
    assert back + stack == pytest.approx(dust, rel=1e-9)


def test_two_stages_save_heat() -> None:
    """That the last water is dear in the tower is why beds are built behind it: a tower alone, with half as
    much air again, gives moister powder for more heat per water than the two together.
    """
    together, alone = two_stages(), one_stage(33.0)
    assert float(alone.streams["powder"].moisture_dry_basis) > float(
        together.streams["powder"].moisture_dry_basis
    )
    assert alone.utilities.energy_per_water > together.utilities.energy_per_water
