"""What equipment draws of its inside: the curves end where the machine says, and add up to its streams."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import trapezoid

import granum
from granum.cases.alone import case_text
from granum.cases.reading import read_text
from granum.filtration.formulas.gravity import sinking_slurry
from granum.flowsheet.run import Run
from granum.streams.inside_charts import shares_by_size


def solved(key: str, **words: str) -> tuple[Run, Any]:
    run = read_text(case_text(key, words), name=key).solve()
    return run, run.units[key.partition(".")[2]].values


def drawn(run: Run, heading: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    (figure,) = (f for h, f in run.charts().items() if h.endswith(heading))
    return {t.name: (np.asarray(t.x, float), np.asarray(t.y, float)) for t in figure.data}


@pytest.mark.parametrize("key", ["filtration.belt_press", "filtration.screw_press"])
def test_a_press_ends_with_its_cake_at_its_last_pressure(key: str) -> None:
    run, figures = solved(key)
    lines = drawn(run, "through the press")
    time, dry = lines["dry solids"]
    assert np.all(np.diff(time) >= 0.0)
    assert np.all(np.diff(dry) >= -1e-9)
    feed = run.streams["feed"]
    assert dry[0] == pytest.approx(100.0 * float(feed.solid_flow / feed.mass_flow), rel=1e-6)
    assert dry[-1] == pytest.approx(100.0 * figures.solids_mass_fraction, rel=1e-6)
    pressure = lines["pressure on the sludge"][1]
    # 6 kN/m around a last roller of 0.2 m, by hand; the cone of the screw as it is set, 1 bar
    assert pressure[-1] == pytest.approx({"filtration.belt_press": 0.6, "filtration.screw_press": 1.0}[key])


def test_a_filling_sinks_until_it_meets_its_cake() -> None:
    run, figures = solved("filtration.gravity_filter")
    (time, level), (_same, cake) = drawn(run, "as it sinks").values()
    assert 60.0 * time[-1] == pytest.approx(figures.formation_time, rel=1e-9)
    assert level[-1] == pytest.approx(cake[-1], rel=1e-6) == pytest.approx(figures.cake_thickness, rel=1e-6)
    assert np.all(np.diff(level) < 0.0)
    assert np.all(np.diff(cake) >= 0.0)
    # all settled at once, by hand: half way down its logarithm a level has taken half of 10 439 s
    grains = (0.5, 1.0, 0.0232, 0.58, 1e9, 1e9, 2650.0, 1e-3, 998.0)
    times, levels, _cakes = sinking_slurry(np.array([0.5, 1.0]), *grains)
    assert times == pytest.approx([0.5 * 10439.0, 10439.0], rel=2e-3)
    assert levels == pytest.approx([0.1, 0.02], rel=1e-9)  # 0.5 m over √25 and 25


@pytest.mark.parametrize("key", ["filtration.gas_carbon_bed", "filtration.liquid_carbon_bed"])
def test_a_bed_takes_up_what_it_holds(key: str) -> None:
    run, figures = solved(key)
    second = {"filtration.gas_carbon_bed": 3600.0, "filtration.liquid_carbon_bed": 86400.0}[key]
    ((time, passes),) = drawn(run, "Breakthrough of a bed").values()
    unit = run.line.sheet.units[key.partition(".")[2]]
    assert np.all(np.diff(passes) >= 0.0)
    assert passes[-1] == pytest.approx(99.0, abs=1e-6)
    at_end = np.interp(figures.run_time / second, time, passes)
    assert at_end == pytest.approx(100.0 * unit.breakthrough_fraction, rel=0.05)
    # what is held back to the end of the curve is the capacity of the bed, but for the last hundredth
    held = trapezoid(1.0 - passes / 100.0, time) * second
    run_at_full_use = figures.run_time * figures.removal_efficiency / figures.bed_use
    assert held == pytest.approx(run_at_full_use, rel=0.01)


@pytest.mark.parametrize("key", ["filtration.reverse_osmosis", "filtration.ultrafiltration"])
def test_stages_add_up_to_the_plant(key: str) -> None:
    run, figures = solved(key)
    lines = drawn(run, "From stage to stage")
    flux = lines["flux"][1] / 3.6e6  # L/(m² h)
    assert flux.mean() == pytest.approx(figures.filtrate_flux, rel=1e-9)
    assert flux[-1] == pytest.approx(figures.filtrate_flux_last, rel=1e-9)
    assert np.all(np.diff(flux) < 0.0)
    if key.endswith("osmosis"):
        osmotic = 1e5 * lines["osmotic pressure of the retentate"][1]
        assert osmotic[-1] == pytest.approx(figures.osmotic_pressure, rel=1e-9)
    else:
        held = lines["what the membrane holds back"][1]
        # the figure is that of the liquid that the pumps have warmed
        assert held[-1] == pytest.approx(figures.concentration_retentate, rel=1e-3)


def test_between_pulses_the_flux_makes_the_filtrate() -> None:
    run, figures = solved("filtration.thickening_filter")
    lines = drawn(run, "Between two pulses")
    time, flux = lines["flux"]
    assert lines["cake"][1][-1] == pytest.approx(1e6 * figures.cake_thickness, rel=1e-6)
    assert flux[-1] == pytest.approx(3.6e6 * figures.filtrate_flux_last, rel=1e-6)
    # Ruth almost without a medium: u √t stays
    late = time > 1.0
    assert np.ptp((flux * np.sqrt(time))[late]) < 0.02 * flux[-1] * np.sqrt(time[-1])


PARTED = [
    "cyclones.gas_cyclone",
    "cyclones.hydrocyclone",
    "comminution.triple_deck_screen",
    "settling.clarifier",
]


@pytest.mark.parametrize("key", PARTED)
def test_the_shares_of_sizes_make_the_flows_of_the_outlets(key: str) -> None:
    line = granum.alone(key)
    run = line.solve()
    name, unit = next(iter(run.sheet.units.items()))
    leaving = {port: run.streams[f"{name}.{port}"] for port in type(unit).outlet_names()}
    inlets = run._inlets(name)
    shares = shares_by_size(inlets, leaving)
    assert shares is not None
    fed = np.asarray(sum(s.solid_by_size for s in inlets.values()))
    for port, share in shares.items():
        assert np.nansum(share * fed) == pytest.approx(float(leaving[port].solid_flow), rel=1e-4)
    lines = drawn(run, "Where each size goes")
    assert sum(y for _x, y in lines.values()) == pytest.approx(100.0, abs=1e-3)


def test_what_grinds_or_parts_nothing_has_no_shares() -> None:
    for key in ("comminution.ball_mill", "streams.splitter"):
        assert not [h for h in granum.alone(key).solve().charts() if h.endswith("Where each size goes")]
