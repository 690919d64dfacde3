"""The paper machine against TAPPI's definition and ranges, known figures of mills, and its own limits."""

from __future__ import annotations

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import granum as gr
from granum.core.errors import InputError
from granum.drying.equipment.paper import PaperMachine
from granum.drying.isotherms.paper import Heikkila
from granum.drying.web_path import Air, Phase, web_of
from granum.materials.formulas.water import water_vapor_pressure
from granum.streams.equilibrium import HumidMixture
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

MIXTURE = mixture_of(["water"], ["cellulose"], ["dry air", "water"], [1e-5, 5e-5])
FEED = empty(MIXTURE, 318.15).replace(solid=jnp.full((1, 1), 12 / 3.6), liquid=jnp.array([16 / 3.6]))
AIR = empty(MIXTURE, 298.15).replace(gas=jnp.array([30.2, 0.3]))
STEAM = {"pressure_steam": 3e5, "pressure_steam_first": 1.2e5}


@eqx.filter_jit
def _operated(unit: PaperMachine):
    run = unit.operate(feed=FEED, gas=AIR)
    return run.figures, run.outlets.heat_duty


def made(**change):
    """Figures and heat; numbers are arrays, so that one program serves all of them."""
    given = (
        {"width": 5.0, "dry_mass_per_area": 0.06, "felt_factor": 0.5, "cylinder_count": 40} | STEAM | change
    )
    return _operated(
        PaperMachine(**{k: v if isinstance(v, int) else jnp.asarray(v) for k, v in given.items()})
    )


def test_a_fine_paper_machine_lies_in_the_ranges_of_mills() -> None:
    """TAPPI's curves for printing paper: 10 to 25 kg/(m² h) at 105 to 135 °C of mean steam temperature
    (recalled); 1.2 to 1.5 kg of steam per kg of water and 0.12 to 0.18 kg/kg of moisture in closed hoods
    (Karlsson, recalled); Reardon et al. find 65 % of the evaporation of two-tier machines in the free draws.
    """
    figures, _heat = made()
    assert 10 < float(figures.evaporation_per_area) * 3600 < 25
    assert 1.2 < float(figures.steam_use) < 1.5
    assert 0.12 < float(figures.humidity_ratio) < 0.18
    assert 0.45 < float(figures.draw_share) < 0.75
    assert 0.05 < float(figures.moisture_dry_basis) < 0.10


def test_tappi_counts_the_whole_circumference() -> None:
    figures, _heat = made()
    area = np.pi * 1.5 * 40 * 5.0
    assert float(figures.evaporation_per_area) == pytest.approx(float(figures.evaporation_rate) / area)


def test_drives_pull_what_tappi_says() -> None:
    """P = n NRL l v of a drive maker's page: 0.0047 hp per inch and 100 ft/min, 40 cylinders, 200 in and
    3000 ft/min make 1128 hp. The default is a paper's 276 hp for six cylinders and 17 felt rolls of 4.8 hp,
    each of which takes 0.16 lbf/in of tension.
    """
    hp, inch, foot = 745.7, 0.0254, 0.3048
    load = 0.0047 * hp / (inch * 100.0 * foot / 60.0)
    power = gr.drying.shaft_power_cylinders(40, load, 200.0 * inch, 3000.0 * foot / 60.0)
    assert power / hp == pytest.approx(0.0047 * 40 * 200.0 * 30.0, rel=1e-9)
    width_by_speed = 4.8 * hp / (0.16 * 4.44822 / inch)
    machine, _heat = made()
    assert PaperMachine.running_load == pytest.approx(276.0 / 6.0 * hp / width_by_speed, rel=0.01)
    turned = 40 * PaperMachine.running_load * 5.0 * float(machine.web_speed)
    assert float(machine.shaft_power) == pytest.approx(turned, rel=1e-9)
    faster, _heat = made(width=2.5)  # half as wide, twice as fast: the same paper by the same work
    assert float(faster.shaft_power) == pytest.approx(turned, rel=1e-9)


def test_heat_of_cylinders_and_hood_is_what_leaves() -> None:
    """The march knows nothing of the enthalpies of the streams: what is left for the hood's heater must be
    the heat of its air, from 25 to 85 °C, and of the vapor, from the web's temperature to 85 °C, within
    the heat that the web gave or took.
    """
    figures, heat = made()
    air = float(AIR.enthalpy_at(358.15) - AIR.enthalpy_flow)
    vapor = float(figures.evaporation_rate) * 1900.0 * 10.0
    assert float(figures.heat_duty_heater) == pytest.approx(air + vapor, rel=0.1)
    total = figures.heat_duty_cylinders + figures.heat_duty_heater
    assert float(total) == pytest.approx(float(heat), rel=1e-12)


def test_hotter_steam_more_cylinders_and_drier_air_dry_further() -> None:
    base = float(made()[0].moisture_dry_basis)
    assert float(made(pressure_steam=4e5)[0].moisture_dry_basis) < base
    assert float(made(felt_factor=0.8)[0].moisture_dry_basis) < base
    assert float(made(width=5.5)[0].moisture_dry_basis) < base


def test_paper_never_dries_below_equilibrium_and_stays_below_the_steam() -> None:
    figures, _heat = made(width=30.0)
    w = float(figures.humidity_ratio)
    vapor = w / (0.622 + w) * 101325.0

    def rest(T: float) -> float:
        """In equilibrium with the vapor of the hood, at the web's own temperature."""
        return float(Heikkila()(vapor / float(water_vapor_pressure(T)), T))

    X = float(figures.moisture_dry_basis)
    assert 0.98 * rest(float(figures.temperature_highest)) < X < rest(float(figures.temperature_product))
    assert float(figures.temperature_highest) < 406.7  # 3 bar


@pytest.mark.long
def test_sized_width_reaches_its_moisture() -> None:
    unit = PaperMachine.size(0.06, FEED, AIR, 0.06, **STEAM)
    assert float(made(width=unit.width)[0].moisture_dry_basis) == pytest.approx(0.06, abs=1e-5)
    with pytest.raises(InputError, match="These cylinders dry"):
        PaperMachine.size(2.0, FEED, AIR, 0.06, **STEAM)


def test_the_march_agrees_with_a_stiff_solver() -> None:
    """Six steps on a cylinder against Radau with tight tolerances: a thin and a thick web, wet and dry."""
    humid = HumidMixture(MIXTURE)
    hood = AIR.replace(gas=jnp.array([30.2, 4.4]), temperature=jnp.asarray(358.15))
    air = Air.of(hood, humid)
    phase = Phase(400.0, lambda X: 500.0 + 0.0 * X, 15.0, 15.0)
    for grammage, X in ((0.03, 1.2), (0.06, 0.3), (0.06, 0.08), (0.3, 1.0)):
        web = web_of(FEED, grammage, Heikkila(), humid)

        slopes = jax.jit(lambda y, web=web: jnp.stack(web.slopes((y[0], y[1]), phase, air)))
        there = solve_ivp(
            lambda _t, y, f=slopes: np.asarray(f(y)),
            (0, 0.28),
            [X, 340.0, 0.0],
            method="Radau",
            rtol=1e-7,
            atol=1e-8,
        ).y[:, -1]
        X2, T2, heat, _top = web.along((jnp.asarray(X), jnp.asarray(340.0)), 0.28, phase, air, 6)
        assert float(X2) == pytest.approx(there[0], abs=2e-4)
        assert float(T2) == pytest.approx(there[1], abs=0.15)
        assert float(heat) == pytest.approx(there[2], rel=5e-3)


def test_paper_holds_what_paper_holds() -> None:
    """ISO 187 conditions, 23 °C and 50 %: 6 to 9 % of printing and kraft papers; less when hot."""
    paper = Heikkila()
    assert 0.06 < float(paper(0.5, 296.15)) < 0.09
    assert float(paper(0.5, 353.15)) < float(paper(0.5, 296.15))
    for a in (0.05, 0.4, 0.9, 0.99):
        assert float(paper.activity(paper(a, 330.0), 330.0)) == pytest.approx(a, rel=1e-9)
    assert float(paper.net_isosteric_heat(0.05, 350.0)) > 0.0
