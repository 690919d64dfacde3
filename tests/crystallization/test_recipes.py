"""Recipes, choice, charts, moments and the formulas of kinetics: printed numbers, limits and agreement of
engines.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.crystallization import (
    DURATION,
    GROWTH,
    NUCLEATION,
    SEEDED,
    SOLUBILITY,
    START,
    linear_cooling,
    mixture,
    model,
    seeds,
)

from granum.core.errors import ApplicabilityError, InputError
from granum.crystallization.charts import size_distribution_chart, solubility_chart
from granum.crystallization.charts_solutions import solubilities_chart
from granum.crystallization.equipment.batch import BatchCrystallizer
from granum.crystallization.equipment.classified import ClassifiedCrystallizer
from granum.crystallization.equipment.msmpr import Msmpr, VacuumCrystallizer
from granum.crystallization.formulas.agglomeration import agglomeration_coefficient_brownian
from granum.crystallization.formulas.classified import (
    population_density_classified,
    population_density_second_stage,
)
from granum.crystallization.formulas.critical_nucleus import critical_radius
from granum.crystallization.formulas.film import film_growth
from granum.crystallization.formulas.growth import (
    PowerLawDissolution,
    growth_rate_birth_and_spread,
    growth_rate_spiral,
)
from granum.crystallization.formulas.msmpr import (
    dominant_size_changed,
    population_density,
    population_density_size_dependent,
)
from granum.crystallization.formulas.nucleation import (
    heterogeneous_factor,
    interfacial_energy_mersmann,
    nucleation_rate_classical,
)
from granum.crystallization.formulas.programs import PowerCooling
from granum.crystallization.formulas.ripening import supersaturation_ratio_gibbs_thomson
from granum.crystallization.formulas.seeding import seed_chart
from granum.crystallization.formulas.solubility_laws import LibrarySolubility
from granum.crystallization.population.lagrangian import march
from granum.crystallization.population.moment_equations import march_moments
from granum.crystallization.population.operations import Programmed
from granum.crystallization.recipes import choose, optimal_cooling
from granum.crystallization.vessels.batch import batch
from granum.streams.audit import closure
from granum.streams.stream import empty


def test_three_engines_agree():
    times = jnp.linspace(0.0, DURATION, 801)
    packets = march(model(), Programmed(linear_cooling), seeds(), START, 1.0, times)
    moments = march_moments(model(), Programmed(linear_cooling), seeds(), START, 1.0, times[::100])
    np.testing.assert_allclose(packets.moments[::100], moments, rtol=1e-4)


def test_moment_equations_are_refused_where_they_are_not_closed():
    with pytest.raises(ApplicabilityError, match="packet engine"):
        march_moments(
            model(dissolution=PowerLawDissolution(1e-5)),
            Programmed(linear_cooling),
            seeds(),
            START,
            1.0,
            jnp.array([0.0, 1.0]),
        )


@pytest.mark.long
def test_optimal_cooling_beats_linear_and_cubic_and_respects_the_limit():
    best = optimal_cooling(**SEEDED, temperature_start=305.15, temperature_end=301.15, intervals=5, steps=300)
    cubic = batch(**SEEDED, temperature_program=PowerCooling(305.15, 301.15, DURATION, 3.0), steps=300)
    assert best.nuclei_mass_fraction < 0.9 * best.nuclei_mass_fraction_linear
    assert best.nuclei_mass_fraction <= cubic.nuclei_mass_fraction * 1.001
    assert np.all(np.diff(best.temperature) <= 1e-9)
    limited = optimal_cooling(
        **SEEDED,
        temperature_start=305.15,
        temperature_end=301.15,
        intervals=5,
        steps=300,
        relative_supersaturation_maximum=0.9 * best.relative_supersaturation_maximum,
    )
    assert limited.relative_supersaturation_maximum <= 0.9 * best.relative_supersaturation_maximum * (
        1 + 1e-4
    )


def test_batch_errors_speak_plainly():
    program = PowerCooling(305.15, 301.15, DURATION)
    with pytest.raises(InputError, match="width"):
        batch(**{**SEEDED, "seed_width": "300 um"}, temperature_program=program)
    with pytest.raises(InputError, match="per kg of solvent"):
        batch(**{**SEEDED, "solute_per_solvent": 49.3}, temperature_program=program)
    with pytest.raises(InputError):
        batch(
            **{**SEEDED, "solubility": {"law": "polynomial_solubility", "coefficients": [-1.0]}},
            temperature_program=program,
        )


def test_batch_error_estimate_is_honest():
    coarse, fine = (
        batch(**SEEDED, temperature_program=PowerCooling(305.15, 301.15, DURATION), steps=n)
        for n in (100, 400)
    )
    truth = abs(float(coarse.crystals_number[-1] / fine.crystals_number[-1]) - 1)
    assert 0.5 * truth < coarse.step_error < 2.0 * truth


def test_choice_follows_the_solubility_slope():
    """Course notes, figure I.12: potassium nitrate by cooling, copper sulfate by vacuum, sodium chloride by
    evaporation.
    """
    steep = choose(SOLUBILITY, 353.15, 293.15, 1.0).crystallization_process[0]
    flat = choose(
        {"law": "polynomial_solubility", "coefficients": [0.356, 3e-4]}, 353.15, 293.15, 1.0
    ).crystallization_process[0]
    small = choose(SOLUBILITY, 353.15, 293.15, 0.01).crystallization_process[0]
    assert "cooling through a wall" in steep
    assert "continuous" in steep
    assert "evaporation" in flat
    assert "batch" in small


@pytest.mark.parametrize(
    ("solute", "way"),
    [
        ("potassium nitrate", "cooling through a wall"),
        ("copper sulfate", "vacuum (adiabatic) cooling"),
        ("sodium chloride", "evaporation"),
    ],
)
@pytest.mark.parametrize("crystal_flow", [2e4 / 86400, 2e3 / 86400])
def test_the_three_salts_of_the_course_notes(solute, way, crystal_flow):
    """Course notes, I.7.1 and figure I.13, whatever the tonnage; continuous from 10 t/d on (I.11)."""
    law = {"law": "library_solubility", "solute": solute}
    best = choose(law, "80 degC", "20 degC", crystal_flow).crystallization_process[0]
    assert best == f"{way}, {'continuous' if crystal_flow > 0.11 else 'seeded batch'}"


def test_each_circumstance_turns_the_choice_and_says_why():
    """A hazardous solvent is not boiled where a wall will do, a fouling wall gives way to vacuum, a
    centrifuge asks for coarse crystals (course notes, I.11); without them none of the reasons stands there.
    """
    law = {"law": "library_solubility", "solute": "copper sulfate"}

    def told(**more):
        found = choose(law, "80 degC", "20 degC", "20 tonne/day", **more)
        rows = zip(*(found[:2] + found[2:]), strict=True)
        return {row[0]: row[1:] for row in rows}

    plain, hazard = told(), told(solvent_hazardous=True)
    vacuum, wall = "vacuum (adiabatic) cooling, continuous", "cooling through a wall, continuous"
    oslo = "cooling through a wall, fluidized bed (Oslo), classified product"
    assert next(iter(hazard)) == wall
    assert hazard[vacuum][0] < plain[vacuum][0]
    assert "hazardous" in hazard[vacuum][2]
    assert not any("hazardous" in str(row) for row in plain.values())
    assert "boils off 9 % of the solvent" in plain[vacuum][1]
    fouled = told(fouling=True)
    assert next(iter(fouled)) == vacuum
    assert "foul" in fouled[wall][2]
    coarse, again = told(downstream="centrifuge"), told(downstream="reaction")
    assert coarse[oslo][0] > plain[oslo][0] > again[oslo][0]
    assert "centrifuge" in coarse[oslo][1]
    assert "dissolved again" in again[oslo][2]


def test_film_model_limits():
    """Order 1: the resistances add. Fast integration: diffusion alone. Second order against its quadratic."""
    flux = film_growth(110.0, 100.0, 2e-5, 3e-5, 1.0).growth_flux
    assert flux == pytest.approx(10 / (1 / 2e-5 + 1 / 3e-5))
    assert film_growth(110.0, 100.0, 1e-5, 10.0, 1.0).growth_flux == pytest.approx(1e-4, rel=1e-5)
    kd, kr, d = 1e-5, 1e-6, 10.0
    y = (-kd + np.sqrt(kd**2 + 4 * kr * kd * d)) / (2 * kr)
    assert film_growth(100 + d, 100.0, kd, kr, 2.0).interface_concentration == pytest.approx(100 + y)
    assert film_growth(90.0, 100.0, kd, kr, 2.0).growth_flux == 0.0


def test_growth_laws_have_their_limits():
    """BCF: parabola below, line above; birth and spread: nothing at saturation."""
    assert growth_rate_spiral(1e-3, 1e-6, 1.0) == pytest.approx(1e-6 * 1e-6, rel=1e-6)
    assert growth_rate_spiral(10.0, 1e-6, 1e-3) == pytest.approx(1e-6 * 10.0, rel=1e-3)
    assert growth_rate_birth_and_spread(0.0, 1e-6, 0.1) == 0.0
    gradient = jax.grad(lambda s: growth_rate_birth_and_spread(s, 1e-6, 0.1))(0.0)
    assert np.isfinite(float(gradient))


def test_classical_nucleation_of_water():
    """Critical radius: r = 2 gamma v / (kT ln S), by hand; a complete wetting leaves no barrier; rates rise
    with supersaturation.
    """
    v = 18.015e-3 / (997 * 6.02214076e23)
    expected = 2 * 0.072 * v / (1.380649e-23 * 298.15 * np.log(4.0))
    assert critical_radius(4.0, 0.072, 997.0, 18.015e-3) == pytest.approx(expected, rel=1e-9)
    assert heterogeneous_factor(np.pi) == pytest.approx(1.0)
    assert heterogeneous_factor(0.0) == pytest.approx(0.0)
    rates = np.asarray(nucleation_rate_classical(np.array([1.0, 2.0, 4.0, 8.0]), 5e-3, 2000.0, 0.1, 1e30))
    assert rates[0] == 0.0
    assert np.all(np.diff(rates) > 0)


def test_interfacial_energy_falls_with_solubility():
    """Mersmann: barium sulfate, 1e-2 mol/m3 in 19.3e3 mol/m3, about 0.13 J/m2."""
    assert interfacial_energy_mersmann(19300.0, 0.01) == pytest.approx(0.126, abs=0.01)
    assert interfacial_energy_mersmann(19300.0, 100.0) < interfacial_energy_mersmann(19300.0, 1.0)


def test_barium_sulfate_ripening_of_mullin():
    """0.13 J/m2, 4500 kg/m3, two ions: 0.5, 6 and 72 % more soluble at 1, 0.1 and 0.01 um."""
    for size, excess in ((1e-6, 0.005), (1e-7, 0.06), (1e-8, 0.72)):
        ratio = supersaturation_ratio_gibbs_thomson(size, 0.13, 4500.0, 0.233, 298.15, 2.0)
        assert ratio - 1 == pytest.approx(excess, rel=0.1)


def test_brownian_kernel_of_equal_sizes():
    assert agglomeration_coefficient_brownian(1e-6, 1e-6, 1e-3, 298.15) == pytest.approx(
        8 * 1.380649e-23 * 298.15 / 3e-3
    )


def test_continuous_populations_have_their_limits():
    L = np.linspace(0.0, 1e-3, 5)
    plain = population_density(L, 1e12, 5e-8, 3600.0)
    np.testing.assert_allclose(
        population_density_classified(L, 1e12, 5e-8, 3600.0, 1.0, 1e-4, 1.0, 5e-4), plain
    )
    np.testing.assert_allclose(
        population_density_size_dependent(L, 1e12, 5e-8, 3600.0, 1e3, 1e-9), plain, rtol=1e-6
    )
    # Equal stages: the limit of the difference quotient.
    near = population_density_second_stage(L[1:], 1.0, 1e-4, 1e-4 * (1 - 1e-5))
    np.testing.assert_allclose(population_density_second_stage(L[1:], 1.0, 1e-4, 1e-4), near, rtol=1e-3)
    assert dominant_size_changed(5e-4, 4.0, 1.0, 1.0) == pytest.approx(5e-4)


def test_seed_chart_is_the_cube_root_law():
    assert seed_chart(1 / 26.0, 1e-4, 2000.0).growth_ratio == pytest.approx(3.0)


def test_charts_draw():
    assert (
        len(
            solubility_chart(
                SOLUBILITY,
                283.15,
                323.15,
                path_temperature=[305.0, 301.0],
                path_solute_per_solvent=[0.49, 0.43],
            ).data
        )
        == 5
    )
    drawing = size_distribution_chart(**SEEDED, temperature_program=PowerCooling(305.15, 301.15, DURATION))
    area = [float(np.nansum(t.y) * (t.x[1] - t.x[0])) for t in drawing.data]
    assert area[0] == pytest.approx(0.5, rel=1e-3)  # g of seed per kg
    assert area[-1] > 50 * area[0]


@pytest.mark.parametrize("kind", ["msmpr", "evaporative", "vacuum", "classified", "batch"])
def test_equipment_closes_its_balances(kind):
    kinetics = {"solubility": SOLUBILITY, "growth": GROWTH, "nucleation": NUCLEATION}
    unit = {
        "msmpr": lambda: Msmpr(temperature=293.15, volume=5.0, **kinetics),
        "evaporative": lambda: Msmpr(temperature=293.15, volume=5.0, evaporation=0.1, **kinetics),
        "vacuum": lambda: VacuumCrystallizer(temperature=293.15, volume=5.0, **kinetics),
        "classified": lambda: ClassifiedCrystallizer(
            temperature=293.15,
            volume=5.0,
            fines_removal_ratio=3.0,
            fines_cut_size="80 um",
            product_removal_ratio=2.0,
            product_cut_size="400 um",
            **kinetics,
        ),
        "batch": lambda: BatchCrystallizer(
            temperature_program=PowerCooling(333.15, 293.15, 10800.0, 2.0),
            duration=10800.0,
            seed_mass_per_solvent=0.01,
            **kinetics,
        ),
    }[kind]()
    feed = empty(mixture(), 333.15).replace(
        liquid=jnp.array([1.0, 1.0]), solid=jnp.zeros((1, 40)).at[0, 15].set(0.02)
    )
    out = unit(feed=feed)
    streams = [s for s in (out.product, getattr(out, "vapor", None)) if s is not None]
    found = closure([feed], streams, out.heat_duty)
    assert float(found.mass) < 1e-12
    assert float(found.energy) < 1e-12
    figures = unit.operate(feed=feed).figures
    assert 0.6 < float(figures.yield_fraction) < 0.85
    assert all(check.ok for check in unit.operate(feed=feed).checks if "volume" not in check.name)
    if kind == "vacuum":
        assert float(out.heat_duty) == pytest.approx(0.0, abs=1e-3)
        assert 0.15 < float(figures.evaporation) < 0.2


def test_library_solubility_is_a_law():
    assert float(LibrarySolubility("potassium nitrate")(293.15)) == pytest.approx(0.316, rel=0.03)


def test_several_solubility_curves_on_one_chart():
    """Course notes, figure I.12, and Perry's table: 31.6 and 169 g of potassium nitrate in 100 g of water at
    20 and 80 °C, 36.0 and 38.4 g of sodium chloride; wrong names are refused with what is near.
    """
    drawing = solubilities_chart("potassium nitrate, sodium chloride,", "0 degC", "100 degC")
    curves = {trace.name: trace for trace in drawing.data if trace.showlegend is not False}
    for name, (cold, hot) in {
        "potassium nitrate in water": (0.316, 1.69),
        "sodium chloride in water": (0.360, 0.384),
    }.items():
        x, y = (np.asarray(values, dtype=float) for values in (curves[name].x, curves[name].y))
        assert np.interp([20.0, 80.0], x, y) == pytest.approx([cold, hot], rel=0.015)
    with pytest.raises(InputError, match="potassium nitrate"):
        solubilities_chart("potassium nitrat")
    with pytest.raises(InputError, match="at least one"):
        solubilities_chart(" , ")
    with pytest.raises(InputError, match="above the cold"):
        solubilities_chart("sodium chloride", "50 degC", "20 degC")
