"""A figure outside the bounds of its own kind is not a value; contradictory inputs are named; bare
temperatures are asked about.
"""

from __future__ import annotations

import math

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import flags, record_steps, registry
from granum.core.conversion import convert
from granum.core.errors import ApplicabilityError, InputError
from granum.cyclones.formulas.efficiency import vortex_exponent_alexander
from granum.filtration.formulas.mass_balance import dry_cake_per_filtrate

SLURRY = {"liquid_density": 1000.0, "wet_to_dry_mass_ratio": 2.5}


def test_a_scalar_outside_its_kind_raises_and_names_output_value_bounds_and_inputs() -> None:
    # at 25 m of body Alexander's exponent is 1 - (1 - 0.67 * 25**0.14) * 1.0106 = 1.05
    with pytest.raises(
        ApplicabilityError,
        match=r"vortex.* = 10\d\.\d+ % is outside.*\[0 … 100 %\].*Given: .*diameter = 25 m",
    ):
        vortex_exponent_alexander(diameter=25.0)


def test_elements_outside_their_kind_are_lost_and_flagged_alone() -> None:
    result = dry_cake_per_filtrate.evaluate(solids_mass_fraction=np.array([0.1, 0.5]), **SLURRY)
    np.testing.assert_allclose(result.value, [1000 * 0.1 / 0.75, np.nan])
    assert result.flags.tolist() == [0, flags.OUTSIDE_DOMAIN]
    np.testing.assert_allclose(
        dry_cake_per_filtrate(solids_mass_fraction=np.array([0.1, 0.5]), **SLURRY), result.value
    )


def test_the_note_records_no_impossible_step() -> None:
    with record_steps() as steps:
        assert np.isnan(dry_cake_per_filtrate(solids_mass_fraction=0.5, **SLURRY))
    assert steps[0].result().flags & flags.OUTSIDE_DOMAIN


def test_inside_another_computation_the_number_stays_and_is_flagged_and_its_gradient_is_finite() -> None:
    def inner(s):
        with flags.collect() as records:
            value = dry_cake_per_filtrate(solids_mass_fraction=s, **SLURRY)
        return value, [found.mask for found in records if found.bit == flags.OUTSIDE_DOMAIN]

    value, masks = jax.jit(inner)(jnp.array(0.5))
    assert float(value) == pytest.approx(-2000.0)
    assert any(map(bool, masks))
    slope = jax.grad(
        lambda s: jnp.where(s < 0.4, dry_cake_per_filtrate(solids_mass_fraction=s, **SLURRY), 0.0)
    )
    assert float(slope(0.1)) == pytest.approx(1000.0 / 0.75**2)
    assert float(slope(0.5)) == 0.0


def test_rounding_beyond_a_bound_is_no_error() -> None:
    # 1 - (1 - 0.67 D^0.14): the body diameter at which the exponent is 1, up to rounding
    diameter = (1 / 0.67) ** (1 / 0.14)
    found = [
        vortex_exponent_alexander(diameter=diameter * (1 + k * 1e-15), temperature=283.0)
        for k in range(-3, 4)
    ]
    np.testing.assert_allclose(found, 1.0, rtol=1e-13)


def test_an_infinite_figure_is_no_value() -> None:
    with pytest.raises(ApplicabilityError, match="not a finite number"):
        registry.find("particles.reynolds_number")(
            particle_diameter=1e308, velocity=1e308, fluid_density=1e3, dynamic_viscosity=1e-3
        )


CONTRADICTIONS = [
    (
        "centrifuges.pelleting_time",
        {
            "radius_inner": "60 mm",
            "radius_outer": "50 mm",
            "rotation_speed": "10000 rpm",
            "sedimentation_coefficient": 1e-13,
        },
        r"inner radius|top of the liquid",
    ),
    (
        "centrifuges.sigma_factor_tubular",
        {"bowl_length": 1.0, "radius_inner": 0.2, "radius_outer": 0.1, "rotation_speed": 600.0},
        "free surface",
    ),
    (
        "centrifuges.loading_time_basket",
        {
            "radius_outer": 0.4,
            "cake_radius": 0.5,
            "radius_inner": 0.3,
            "rotation_speed": 100.0,
            "liquid_density": 1000.0,
            "dynamic_viscosity": 1e-3,
            "cake_permeability": 1e-12,
            "cake_volume_per_filtrate": 0.1,
        },
        "inside the basket",
    ),
    (
        "centrifuges.loading_time_basket",
        {
            "radius_outer": 0.5,
            "cake_radius": 0.4,
            "radius_inner": 0.45,
            "rotation_speed": 100.0,
            "liquid_density": 1000.0,
            "dynamic_viscosity": 1e-3,
            "cake_permeability": 1e-12,
            "cake_volume_per_filtrate": 0.1,
        },
        "not in the cake",
    ),
    (
        "comminution.feed_size_rolls",
        {"roll_diameter": 1.0, "gap_width": 0.01, "nip_angle": "190 degree"},
        "less than 180",
    ),
    ("filtration.dry_cake_per_filtrate", {"solids_mass_fraction": 0.5, **SLURRY}, "no filtrate is left"),
    (
        "particles.sphericity_diameters",
        {"diameter_volume": "1 mm", "diameter_surface": "0.5 mm"},
        "the sphere has the smallest surface",
    ),
    (
        "fluidization.bed_void_fraction_from_pressure_drop",
        {"pressure_drop": 13669.0, "height": 0.4756, "particle_density": 861.0, "fluid_density": 0.49},
        "without voids",
    ),
    (
        "crystallization.duration_for_growth",
        {"seed_size": "400 um", "product_size": "80 um", "growth_rate": 1e-8},
        "product size",
    ),
    (
        "crystallization.seed_mass_for_product",
        {"seed_size": "400 um", "product_size": "80 um", "product_mass": "120 kg"},
        "product size",
    ),
    (
        "crystallization.product_size_from_seed",
        {"seed_size": "400 um", "seed_mass": 10.0, "product_mass": 1.0},
        "mass of product",
    ),
    (
        "crystallization.coefficient_of_variation",
        {"percentile_16": 5e-4, "percentile_50": 3e-4, "percentile_84": 1e-4},
        "rise in this order",
    ),
    (
        "crystallization.undersize_mass_fraction",
        {"crystal_size": 1e-4, "growth_rate": 0.0, "residence_time": 3600.0},
        "Without growth",
    ),
    (
        "crystallization.vacuum_crystallizer_balance",
        {
            "mass_flow": 1.0,
            "solute_mass_fraction": 0.4,
            "solubility_per_solvent": 0.539,
            "temperature_inlet": 300.0,
            "temperature": 353.0,
            "specific_heat_capacity": 3500.0,
            "heat_released_per_crystal": 144e3,
            "heat_of_vaporization": 2.46e6,
        },
        "Nothing flashes off",
    ),
    (
        "crystallization.heat_duty_crystallizer",
        {
            "mass_flow": 1.0,
            "specific_heat_capacity": 3500.0,
            "temperature_inlet": 350.0,
            "temperature": 300.0,
            "crystal_flow": 2.0,
            "heat_released_per_crystal": 1e5,
        },
        "more than the feed",
    ),
    (
        "humid_gas.combustion_gas",
        {
            "fuel_fraction_carbon": 0.9,
            "fuel_fraction_hydrogen": 0.25,
            "lower_heating_value": 4e7,
            "excess_air_ratio": 5.0,
        },
        "add up to more than 1",
    ),
]


@pytest.mark.parametrize(("key", "inputs", "cause"), CONTRADICTIONS)
def test_a_contradiction_is_named(key: str, inputs: dict, cause: str) -> None:
    with pytest.raises(ApplicabilityError, match=cause), jax.disable_jit():
        registry.find(key).evaluate(**inputs)


def test_an_undersaturated_feed_yields_nothing_and_says_why() -> None:
    result = registry.find("crystallization.yield_fraction_anhydrous").evaluate(
        solute_per_solvent=0.2, solubility_per_solvent=0.4
    )
    assert result.value == 0.0
    assert "not saturated" in result.notices[0]["message"]


def test_size_dependent_growth_has_its_limit_at_exponent_one() -> None:
    # n = n0 (1 + gL)^-1 exp(-ln(1 + gL)/(g G tau)) = n0 (1 + gL)^(-1 - 1/(g G tau))
    given = {
        "crystal_size": 2e-4,
        "nuclei_population_density": 1e12,
        "growth_rate": 5e-8,
        "residence_time": 3600.0,
        "size_parameter": 5e3,
    }
    value = registry.find("crystallization.population_density_size_dependent")(**given, size_exponent=1.0)
    assert value == pytest.approx(1e12 * 2.0 ** (-1.0 - 1.0 / (5e3 * 5e-8 * 3600.0)), rel=1e-12)


def test_the_factor_of_saffman_and_turner_is_in_full() -> None:
    sizes = {"crystal_size": 1e-6, "crystal_size_other": 1e-6, "shear_rate": 1.0}
    assert registry.find("crystallization.agglomeration_coefficient_turbulent")(
        **sizes
    ) * 1e18 == pytest.approx(math.sqrt(8 * math.pi / 15), rel=1e-14)


@pytest.mark.parametrize("given", [25, 25.0, "25", [25.0, 30.0], -5.0])
def test_a_bare_celsius_number_is_asked_about_everywhere(given: object) -> None:
    water = registry.find("materials.water_density")
    for ask in (water, water.evaluate):
        with pytest.raises(InputError, match=r"read in kelvin. Did you mean −?\d+ °C"):
            ask(temperature=given)


def test_a_cold_temperature_with_its_unit_is_taken_and_told() -> None:
    told = registry.find("materials.water_density").evaluate(temperature="25 K").notices
    assert any("read in kelvin" in n["message"] for n in told)
    assert not vortex_exponent_alexander.evaluate(diameter=0.3, temperature="25 degC").notices


def test_a_whole_number_is_a_choice_that_is_written_as_text() -> None:
    evaporator = registry.find("evaporation.multiple_effect_evaporator")
    given = {p.name: p for p in evaporator.card.parameters}["effect_count"]
    assert convert(3, given) == "3"
    for odd in (9, 10**5000, True, -3):
        with pytest.raises(InputError, match="effect_count"):
            convert(odd, given)
