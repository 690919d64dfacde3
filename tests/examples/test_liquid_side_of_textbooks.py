"""Worked examples of the liquid side put through its machines, entered as a stranger enters them.

Opened: Coulson and Richardson, volume 2, in github.com/FOSSEE/Scilab-TBC-Uploads (542); the others as each
test says.
"""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.examples.test_plants_of_textbooks import described
from tests.examples.test_units_of_books import solved


# -- presses
# ------------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("frame", "cloth", "dead", "rising", "filtering"),
    [(1.0, 1.0, 900.0, 600.0, 4200.0), (7 / 8, 1 / 4, 1080.0, 825.0, 825.0 + 2178.0)],
)
def test_press_at_a_constant_rate_and_then_a_constant_pressure(
    frame: float, cloth: float, dead: float, rising: float, filtering: float
) -> None:
    """Coulson and Richardson 7.7: a quarter of the filtrate at a constant rate in 600 s, the rest at a
    constant pressure in an hour, 900 s of cleaning. Frames an eighth thinner and a cloth of a quarter of the
    resistance, three minutes longer to clean: 825 and 2178 s, a cycle of 4083 s and 9.2 % more filtrate (of
    its rounded rates).
    """
    area, void, density, pressure, viscosity = 10.0, 0.5, 2500.0, 4e5, 1.002e-3
    slope, intercept = 3 / 19200, cloth / 8  # dV/dt = a/(V + b) of 1 m³ from whole frames
    full = 0.5 * 0.05 * (1 - void) * density * area  # kg of cake with that 1 m³
    alpha = area**2 * pressure / (viscosity * full * slope)
    run = solved(
        "filtration.chamber_press",
        area=f"{area} m2",
        pressure_drop=f"{pressure} Pa",
        cake_resistance=f"{alpha} m/kg",
        medium_resistance=f"{intercept * alpha * full / area} 1/m",
        void_fraction=void,
        chamber_depth=f"{50 * frame} mm",
        filtrate_flux_largest=f"{0.25 / 600 / area} m/s",
        dead_time=f"{dead} s",
        deliquoring_time="0 s",
        wash="no",
        mixture={"liquids": "water", "solids": "sludge"},
        feed={
            "solid_flow": f"{full / 5100} kg/s",
            "liquid_flow": f"{(1 + 0.5 * 0.05 * area * void) * 998.2 / 5100} kg/s",
            "liquid": {"water": 1.0},
            "solid": {"sludge": 1.0},
            "temperature": "20 degC",
        },
        **described("sludge", density),
    )
    assert run.figure("chamber_press.pressure_rise_time") == pytest.approx(rising, rel=2e-3)
    assert run.figure("chamber_press.formation_time") == pytest.approx(filtering, rel=2e-3)
    assert run.figure("chamber_press.cycle_time") == pytest.approx(filtering + dead, rel=2e-3)
    # of the slurry of the first cycle: 1/1.092 = 0.916 of what the second could take
    most = (filtering + dead) / frame / 5100
    assert run.figure("chamber_press.capacity_use") == pytest.approx(most, rel=2e-3)


# -- membranes
# ------------------------------------------------------------------------------------------------------------
def test_two_modules_before_one() -> None:
    """Coulson and Richardson 8.3 as it is printed: two modules of 30 m² and then one, 2.5 m³/h from 0.5 to 20
    kg/m³ with a gel at 30 and 0.02 m/h; by hand c from 1.25/c + 0.02 A ln(30/c) = what comes.
    """
    run = solved(
        "filtration.ultrafiltration",
        area="90 m2",
        stage_count="2",
        area_shares="60; 30",
        mass_transfer_coefficient="0.02 m/h",
        concentration_gel="30 kg/m3",
        medium_resistance="1e11 1/m",
        fouling_resistance=0,
        pressure_drop="3 bar",
        pore_diameter="1 nm",
        solvent="no",
        mixture={"liquids": "water", "solids": "whey protein"},
        feed={
            "liquid_flow": "2.5 m3/h",
            "solid_flow": "1.25 kg/h",
            "temperature": "20 degC",
            "liquid": {"water": 1.0},
        },
    )
    flow, c = 2.5, 0.0
    for area in (60.0, 30.0):
        low, high = 1e-6, flow
        for _ in range(80):
            left = 0.5 * (low + high)
            c = 1.25 / left
            passes = 0.02 * area * math.log(30 / c)
            low, high = (left, high) if flow - left > passes else (low, left)
        flow = left
    assert c > 20
    assert run.figure("ultrafiltration.concentration_retentate") == pytest.approx(c, rel=2e-3)


@pytest.mark.parametrize(("bar", "flux"), [(0.5, 5.0), (2.0, 15.0), (3.0, 20.0), (6.0, 20.0)])
def test_flux_as_measured_over_the_pressure(bar: float, flux: float) -> None:
    law: dict[str, Any] = {
        "law": "measured_flux_pressure",
        "pressure_points": ["3 bar", "1 bar"],
        "flux_points": ["20 L/m2/h", "10 L/m2/h"],
    }
    run = solved("filtration.ultrafiltration", pressure_drop=f"{bar} bar", flux_law=law, solvent="no")
    assert run.figure("ultrafiltration.filtrate_flux") * 3.6e6 == pytest.approx(flux, rel=1e-6)
