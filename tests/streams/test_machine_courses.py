"""What machines draw of a batch, of their effects, of more or less load: curves that meet the figures told
beside them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import granum
from granum.core.i18n import language


def drawn(key: str, heading: str, **words: str) -> tuple[Any, Any, dict[str, tuple[np.ndarray, np.ndarray]]]:
    run = granum.alone(key, **words).solve()
    (figure,) = (f for h, f in run.charts().items() if h.endswith(heading))
    lines = {t.name: (np.asarray(t.x, float), np.asarray(t.y, float)) for t in figure.data}
    return run, run.units[key.partition(".")[2]].values, lines


def product(run: Any) -> Any:
    (name,) = (n for n in run.streams if n.endswith(".product"))
    return run.streams[name]


def test_a_bag_between_pulses() -> None:
    _run, figures, lines = drawn("dust.bag_filter", "from pulse to pulse")
    drop = lines["one bag as it loads"][1]
    assert drop[-1] == pytest.approx(figures.pressure_drop_highest / 100.0, rel=1e-9)
    assert np.interp(5.0, *lines["one bag as it loads"]) == pytest.approx(figures.pressure_drop / 100.0)
    assert drop[0] == pytest.approx(lines["clean cloth"][1][0], rel=1e-9)
    assert lines["dust on the cloth"][1][-1] == pytest.approx(1e3 * figures.dry_mass_per_area, rel=1e-9)


def test_a_pad_catches_the_larger_drops_and_marks_its_own() -> None:
    _run, _figures, lines = drawn("dust.mesh_pad", "the pad catches", droplet_diameter="3 um")
    size, caught = lines["caught of each size"]
    assert np.all(np.diff(caught) >= 0.0)
    (at,), (share,) = lines["the mist here"]
    assert at == pytest.approx(3.0)
    assert share == pytest.approx(np.interp(at, size, caught), abs=0.5)


def test_a_disc_stack_cuts_at_the_root_of_its_flow() -> None:
    _run, figures, lines = drawn("centrifuges.disc_stack", "more or less feed")
    flow, cut = lines["cut size"]
    # Stokes: twice the flow over the same area catches sizes larger by the root of two
    assert cut[-1] / cut[0] == pytest.approx(np.sqrt(flow[-1] / flow[0]), rel=1e-6)
    assert np.all(np.diff(lines["solids caught"][1]) <= 1e-9)
    assert lines["as it runs"][1][0] == pytest.approx(100.0 * figures.solids_recovery)


def test_effects_fall_in_temperature_and_add_up() -> None:
    _run, figures, lines = drawn("evaporation.multiple_effect_evaporator", "From effect to effect")
    assert lines["vapor"][1].sum() == pytest.approx(3600.0 * figures.evaporation_rate, rel=1e-9)
    hot, boils, pure = (
        lines[n][1] for n in ("heating side", "boiling solution", "solvent alone at that pressure")
    )
    assert np.all(hot > boils)
    assert np.all(boils >= pure)
    assert hot[1:] == pytest.approx(pure[:-1])  # the vapor of one condenses in the next
    assert hot[0] + 273.15 == pytest.approx(figures.temperature_steam)


def test_a_solution_boils_hotter_as_it_thickens() -> None:
    _run, figures, lines = drawn("evaporation.evaporator", "as it thickens")
    share, boils = lines["boiling solution"]
    assert np.all(np.diff(boils) > 0.0)
    assert boils[0] == pytest.approx(lines["solvent alone at that pressure"][1][0], abs=1e-6)
    (at,), (here,) = lines["in the evaporator"]
    assert at == pytest.approx(100.0 * figures.solute_mass_fraction, rel=1e-6)
    assert here == pytest.approx(np.interp(at, share, boils), abs=0.05)
    assert here + 273.15 == pytest.approx(figures.boiling_temperature)


def test_gas_speeds_up_along_its_line() -> None:
    run, figures, lines = drawn("conveying.pneumatic_conveyor", "conveying line")
    velocity, pressure = lines["gas"][1], lines["pressure"][1]
    assert velocity[0] == pytest.approx(figures.gas_velocity_inlet)
    assert velocity[-1] == pytest.approx(figures.gas_velocity_outlet)
    assert velocity * pressure == pytest.approx(velocity[0] * pressure[0])  # Boyle, at one temperature
    assert pressure[-1] == pytest.approx(float(product(run).pressure) / 1e5)


@pytest.mark.parametrize("key", ["conveying.slurry_pipeline", "conveying.thick_slurry_pipeline"])
def test_friction_of_a_slurry_passes_through_what_it_runs_at(key: str) -> None:
    _run, figures, lines = drawn(key, "over the velocity")
    (at,), (here,) = lines["as it runs"]
    unit = {"conveying.slurry_pipeline": 1e3, "conveying.thick_slurry_pipeline": 100.0}[key]
    assert at == pytest.approx(figures.velocity)
    assert here == pytest.approx(figures.pressure_gradient / unit, rel=2e-3)


def test_one_stage_gains_less_and_less_by_pressure() -> None:
    _run, figures, lines = drawn("filtration.ultrafiltration", "over the pressure", stage_count="1")
    _pressure, flux = lines["flux"]
    assert np.all(np.diff(flux) > -1e-9)
    assert lines["as it runs"][1][0] == pytest.approx(3.6e6 * figures.filtrate_flux)  # L/(m² h)
    steps = np.diff(flux)
    assert steps[-1] < steps[0]


BATCHES = {
    "crystallization.batch_crystallizer": "The batch over time",
    "crystallization.plug_flow_crystallizer": "A parcel on its way through the tube",
}


@pytest.mark.parametrize("key", list(BATCHES))
def test_a_cooling_batch_stays_above_its_solubility(key: str) -> None:
    run, figures, lines = drawn(key, BATCHES[key])
    dissolved, saturated = lines["dissolved"][1], lines["solubility"][1]
    assert np.all(dissolved >= saturated * (1.0 - 1e-6))
    assert lines["temperature"][1][-1] + 273.15 == pytest.approx(float(product(run).temperature))
    driving = dissolved / saturated - 1.0
    assert driving.max() == pytest.approx(figures.relative_supersaturation_maximum, rel=1e-6)


def test_ice_leaves_a_vial_and_a_tray_in_the_time_told() -> None:
    for key, heading in (
        ("drying.freeze_dryer", "Primary drying of a vial"),
        ("drying.tray_freeze_dryer", "Sublimation of a tray"),
    ):
        _run, figures, lines = drawn(key, heading)
        time, front = lines["ice front"]
        assert np.all(np.diff(time) >= 0.0)
        assert 3600.0 * time[-1] == pytest.approx(figures.drying_time_primary, rel=2e-3)
        assert np.all(front < lines["shelf"][1])
        assert np.all(lines["sublimation"][1] >= 0.0)


def test_a_charge_dries_by_its_schedule() -> None:
    _run, figures, lines = drawn("drying.wood_kiln", "kiln over time")
    core, mean, surface = (lines[name][1] for name in ("core", "mean of the board", "surface"))
    assert np.all(core >= mean - 1e-6)
    assert np.all(mean >= surface - 1e-6)
    assert 3600.0 * lines["core"][0][-1] == pytest.approx(figures.drying_time, rel=0.01)
    assert np.all(lines["air, dry bulb"][1] > lines["air, wet bulb"][1])


def test_trays_dry_first_where_the_air_enters() -> None:
    run, figures, lines = drawn("drying.tray_dryer", "trays over time")
    time, mean = lines["mean of the tray"]
    assert np.all(lines["where the air enters"][1] <= lines["where the air leaves"][1] + 1e-6)
    # the load reaches the moisture wanted about when the figures say
    wanted = 100.0 * float(product(run).moisture_dry_basis)
    assert 60.0 * np.interp(-wanted, -mean, time) == pytest.approx(figures.drying_time, rel=0.1)


def test_the_headings_are_french_in_french() -> None:
    with language("fr"):
        (heading,) = granum.alone("dust.mesh_pad").solve().charts()
    assert heading.endswith("Gouttes que le matelas retient")
