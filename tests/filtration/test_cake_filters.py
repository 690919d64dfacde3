"""Cake filters in a line: the books' drum areas, cycles by hand, closed balances, gradients."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.commands import granum

from granum.core.constants import ZERO_CELSIUS
from granum.filtration.equipment.batch import (
    CandleFilter,
    ChamberPress,
    MembranePress,
    Nutsche,
    PlateAndFramePress,
    PressureLeafFilter,
)
from granum.filtration.equipment.continuous import (
    HorizontalBeltFilter,
    PrecoatDrum,
    RotaryDiscFilter,
    RotaryVacuumDrum,
)
from granum.filtration.formulas.deliquoring import capillary_number_cake, irreducible_saturation
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream


def mixture(solid_density=2710.0, viscosity=0.8937e-3, liquid_density=996.9):
    return Mixture(
        solids=(Species("chalk", (("chalk", 1.0),), (solid_density,), (840.0,)),),
        liquids=(
            Species("water", (("water", 1.0),), (liquid_density,), (4186.0,)),
            Species("salt", (("salt", 1.0),), (2000.0,), (900.0,)),
        ),
        gases=(Species("air", (("air", 1.0),), heat_capacity=(1005.0,), molar_mass=0.029),),
        size_edges=(0.0, 2e-5, 5e-5, 1e-4, 2e-4),
        liquid_viscosity=lambda fractions, temperature: viscosity,
    )


def stream(m, solid=0.0, water=0.0, salt=0.0, temperature=ZERO_CELSIUS + 25):
    shares = jnp.array([[0.1, 0.3, 0.4, 0.2]])
    return Stream(
        solid * shares, jnp.array([water, salt]), jnp.zeros(1), jnp.asarray(temperature), jnp.asarray(1e5), m
    )


# cake with two kilograms of wet cake per kilogram dry: ε ρ / ((1 - ε) ρ_s) = 1
def loose(m):
    return m.solids[0].density[0] / (m.solids[0].density[0] + m.liquids[0].density[0])


def test_geankoplis_example_14_2_4_drum_area():
    m = mixture()
    feed = stream(m, 0.778 * 0.191, 0.778 * 0.809)
    drum = RotaryVacuumDrum.size(
        feed,
        pressure_drop="67 kPa",
        cake_resistance=4.37e9,
        compressibility=0.3,
        reference_pressure=1.0,
        void_fraction=loose(m),
        rotation_speed=2 * np.pi / 250,
        submergence=0.33,
    )
    # printed 6.60 m2; its own intermediate figures (α = 1.225e11, W = 308.1, 4.823e-4 m3/s) give 6.66
    assert drum.area == pytest.approx(6.66, abs=0.005)
    assert drum.area == pytest.approx(6.60, rel=0.01)
    out = drum(feed)
    assert drum.operate(feed=feed).figures.capacity_use == pytest.approx(1.0, rel=1e-12)
    assert out.filtrate.liquid_volume_flow > 4.8e-4


def test_mccabe_example_29_2_drum_area():
    m = mixture(168.8 * 16.018463, 1e-3, 62.3 * 16.018463)
    solid = 0.302 * 0.45359237
    feed = stream(m, solid, solid * 62.3 / 14.7)
    drum = RotaryVacuumDrum.size(
        feed,
        pressure_drop=1414 * 47.880259,
        cake_resistance=2.90e10 * 0.3048 / 0.45359237,
        compressibility=0.26,
        reference_pressure=47.880259,
        void_fraction=loose(m),
        rotation_speed=2 * np.pi / 300,
        submergence=0.3,
    )
    assert drum.area / 0.3048**2 == pytest.approx(81.7, rel=0.003)


COMMON = {"pressure_drop": 6e4, "cake_resistance": 2e10, "void_fraction": 0.45}
BATCH = {"pressure_drop": 3e5, "cake_resistance": 2e10, "void_fraction": 0.45, "medium_resistance": 1e10}
FILTERS = {
    "drum": RotaryVacuumDrum(area=4.0, rotation_speed="0.5 rpm", **COMMON),
    "disc": RotaryDiscFilter(area=4.0, rotation_speed="0.5 rpm", wash_share=0.1, **COMMON),
    "belt": HorizontalBeltFilter(area=4.0, belt_length=8, belt_speed="4 m/min", **COMMON),
    "frames": PlateAndFramePress(area=20.0, chamber_depth="30 mm", **BATCH),
    "chambers": ChamberPress(area=20.0, chamber_depth="30 mm", solids_recovery=0.98, **BATCH),
    "membranes": MembranePress(area=20.0, chamber_depth="30 mm", void_fraction_squeezed=0.38, **BATCH),
    "nutsche": Nutsche(area=6.0, full_cake_thickness="15 cm", deliquoring_time=600, **BATCH),
    "leaves": PressureLeafFilter(area=20.0, full_cake_thickness="2 cm", **BATCH),
    "candles": CandleFilter(area=20.0, full_cake_thickness="1 cm", candle_radius="3 cm", **BATCH),
}


@pytest.mark.parametrize("name", FILTERS)
@pytest.mark.parametrize("washed", [False, True])
def test_balances_close_and_figures_make_sense(name, washed):
    m, unit = mixture(), FILTERS[name]
    feed = stream(m, 0.1, 0.6, 0.1, 320.0)
    inlets = {"feed": feed} | ({"wash": stream(m, water=0.04, temperature=290.0)} if washed else {})
    out = unit(**inlets)
    found = closure(inlets.values(), out)
    assert float(found.mass) < 1e-14
    assert float(found.energy) < 1e-10
    figures = unit.operate(**inlets).figures
    assert 0.0 < figures.cake_saturation <= 1.0
    assert out.cake.moisture_dry_basis > 0
    if washed:
        # plug displacement is the best that washing can do
        assert max(0.0, 1 - figures.wash_ratio) <= figures.solute_remaining < 1
        left = float(out.cake.liquid[1] / (feed.liquid[1] * figures.cake_saturation * unit.squeezed()))
        assert left < float(unit.slurry(feed).void_volume_flow / feed.liquid_volume_flow)
    else:
        assert float(out.washings.mass_flow) == 0.0
    assert all(check.source and check.name for check in unit.operate(**inlets).checks)


def test_wash_without_a_zone_for_it_is_refused():
    words = ["calc", "filtration.horizontal_belt_filter", "wash_share=0"]
    status, shown, told = granum(*words, "wash.liquid_flow=0.3 t/h")
    assert (status, shown) == (3, "")
    assert "'wash_share'" in told
    assert granum(*words, "wash=no")[0] == 0


def test_cycle_of_a_press_by_hand():
    m = mixture(2600.0, 1e-3, 1000.0)
    feed, wash = stream(m, 0.1, 0.9), stream(m, water=0.05)
    unit = PlateAndFramePress(
        area=30.0,
        chamber_depth=0.04,
        pressure_drop=2e5,
        cake_resistance=1e10,
        void_fraction=0.5,
        dead_time=900,
    )
    figures = unit.operate(feed=feed, wash=wash).figures
    loading = 0.02 * 0.5 * 2600
    void = 0.1 / 2600  # equal to the solid volume at ε = 0.5, m3/s
    W = 0.1 / (0.9e-3 - void)
    formation = 1e-3 * 1e10 * loading**2 / (2 * 2e5 * W)
    ratio = 0.05e-3 / void
    washing = ratio * 0.02 * 0.5 / (0.25 * 2e5 / (1e-3 * 1e10 * loading))
    assert figures.formation_time == pytest.approx(formation, rel=1e-10)
    assert figures.wash_time == pytest.approx(washing, rel=1e-10)
    assert figures.cycle_time == pytest.approx(formation + washing + 900, rel=1e-10)
    assert figures.area_required == pytest.approx(0.1 * (formation + washing + 900) / loading, rel=1e-10)
    sized = PlateAndFramePress.size(
        feed,
        wash,
        chamber_depth=0.04,
        pressure_drop=2e5,
        cake_resistance=1e10,
        void_fraction=0.5,
        dead_time=900,
        capacity_use=0.8,
    )
    assert float(sized.area) == pytest.approx(float(figures.area_required) / 0.8, rel=1e-12)


def test_wide_candle_is_a_flat_leaf():
    feed = stream(mixture(), 0.1, 0.6, 0.1)
    flat = PressureLeafFilter(area=20.0, full_cake_thickness="1 cm", **BATCH).inside(feed).plan
    wide = CandleFilter(area=20.0, full_cake_thickness="1 cm", candle_radius=300.0, **BATCH).inside(feed).plan
    thin = (
        CandleFilter(area=20.0, full_cake_thickness="1 cm", candle_radius="3 cm", **BATCH).inside(feed).plan
    )
    assert float(wide.formation_time) == pytest.approx(float(flat.formation_time), rel=1e-4)
    assert thin.dry_cake_mass_per_area > flat.dry_cake_mass_per_area


def test_gradient_through_a_drum_and_many_cases_at_once():
    m = mixture()

    def salt_in_cake(wash_flow, speed):
        unit = RotaryVacuumDrum(area=4.0, rotation_speed=speed, **COMMON)
        return unit(stream(m, 0.1, 0.6, 0.1), stream(m, water=wash_flow)).cake.liquid[1]

    slope = jax.grad(salt_in_cake)(0.04, 0.05)
    h = 1e-6
    assert float(slope) == pytest.approx(
        float((salt_in_cake(0.04 + h, 0.05) - salt_in_cake(0.04 - h, 0.05)) / (2 * h)), rel=1e-6
    )
    assert slope < 0
    batch = jax.jit(jax.vmap(salt_in_cake))(jnp.linspace(0.01, 0.1, 50), jnp.full(50, 0.05))
    assert np.all(np.diff(np.asarray(batch)) < 0)


def test_precoat_limits_the_rate_of_a_clear_feed():
    m = mixture()
    feed = stream(m, 0.002, 2.0)
    fields = {
        **COMMON,
        "rotation_speed": "0.5 rpm",
        "precoat_permeability": 1e-13,
        "knife_advance": "0.05 mm",
    }
    drum = PrecoatDrum.size(feed, precoat_thickness="80 mm", **fields)
    # hardly any cake: the flux is that of 40 mm of precoat for half of the time
    flux = 6e4 / (0.8937e-3 * 0.04 / 1e-13)
    assert float(drum.area) == pytest.approx(2.0 / 996.9 / (0.5 * flux), rel=0.1)
    out = drum(feed)
    checks = {c.name: c for c in drum.operate(feed=feed).checks}
    assert checks["life of the precoat"].value == pytest.approx(1600 * 120)
    assert float(closure([feed], out).mass) < 1e-14


def test_a_filter_says_when_its_cake_would_flow_and_when_it_is_no_cake():
    feed = stream(mixture(), 0.15, 0.6)
    drum = {"area": 6.0, "pressure_drop": 6e4, "cake_resistance": 1e11, "void_fraction": 0.5}

    def checked(**given):
        made = RotaryVacuumDrum(rotation_speed=0.03, **{**drum, **given}).operate(feed=feed)
        return {check.name: check for check in made.checks}

    plain = checked()
    assert "cake moisture, wet basis" not in plain
    permeable = plain["permeability of the cake"]
    assert permeable.ok
    # by hand from the resistance: B = 1/(α ρ_s (1 − ε))
    assert float(permeable.value) == pytest.approx(1.0 / (1e11 * 2710.0 * 0.5))
    assert not checked(cake_resistance=1e14)["permeability of the cake"].ok
    moisture = float(checked(transportable_moisture_limit=0.1)["cake moisture, wet basis"].value)
    assert 0.0 < moisture < 0.5
    assert not checked(transportable_moisture_limit=0.9 * moisture)["cake moisture, wet basis"].ok
    assert checked(transportable_moisture_limit=1.1 * moisture)["cake moisture, wet basis"].ok


def test_what_turns_a_drum_has_the_size_of_a_nameplate():
    """Drums of 5 to 80 m² carry motors of 1 to 7.5 kW (from memory); none turns for nothing."""
    feed = stream(mixture(), 0.15, 0.6)
    given = {"pressure_drop": 6e4, "cake_resistance": 1e11, "void_fraction": 0.5, "rotation_speed": 0.03}

    def drive(area, **more):
        uses = RotaryVacuumDrum(area=area, **given, **more).operate(feed=feed).uses
        return float(uses["electric_power_drive"])

    assert 1e3 / 3.0 <= drive(5.0) < drive(80.0) <= 3.0 * 7.5e3
    assert drive(20.0, drive_power_per_area="0.2 kW/m2") == pytest.approx(4e3)
    assert drive(20.0, drive_power_per_area=0.0) == 0.0


def test_a_compressible_cake_drained_unsqueezed_may_crack():
    """Strubel and others: below its entry pressure a compressible cake consolidates as it is drained. A hard
    one does not, nor one that was squeezed before; what is not drained does not crack.
    """
    m = mixture()
    feed = stream(m, solid=0.1, water=1.0)
    word = "compressibility of a cake drained but not squeezed: beyond, it shrinks and cracks"

    def check(kind, compressibility, **more):
        unit = kind(50.0, 3e5, 1e11, 0.45, compressibility=compressibility, **more)
        return {c.name: c for c in unit.operate(feed=feed).checks}[word]

    leaf = {"full_cake_thickness": 0.01, "particle_diameter": 5e-5}
    soft = check(PressureLeafFilter, 0.7, deliquoring_time=300.0, **leaf)
    assert not soft.ok
    assert soft.value == 0.7
    assert check(PressureLeafFilter, 0.3, deliquoring_time=300.0, **leaf).ok
    assert check(PressureLeafFilter, 0.7, **leaf).value == 0.0
    squeezed = {"chamber_depth": 0.03, "void_fraction_squeezed": 0.4, "particle_diameter": 5e-5}
    assert check(MembranePress, 0.7, deliquoring_time=300.0, **squeezed).value == 0.0


def test_gas_enters_no_cake_below_its_threshold_pressure():
    """Wakeman and Tarleton's 4.6 sigma (1 - e)/(e d), by hand for 2 um and a void fraction of 0.45; above it
    Brooks and Corey leave the fifth power of the ratio of pressures.
    """
    m = mixture()
    feed = stream(m, solid=0.1, water=1.0)
    threshold = 4.6 * 0.072 * 0.55 / (0.45 * 2e-6)
    assert threshold == pytest.approx(202.4e3, rel=1e-4)

    def drained(pressure):
        unit = PressureLeafFilter(
            10.0,
            pressure,
            1e8,
            0.45,
            full_cake_thickness=0.01,
            deliquoring_time=1e7,
            particle_diameter=2e-6,
        )
        made = unit.operate(feed=feed)
        check = {c.name: c for c in made.checks}[
            "pressure drop over the threshold pressure of a cake that is drained"
        ]
        assert check.value == pytest.approx(pressure / threshold, rel=1e-9)
        assert check.ok == (pressure >= threshold)
        return float(made.figures.cake_saturation), float(made.figures.moisture_dry_basis)

    full = 0.45 * 996.9 / (0.55 * 2710.0)
    for below in (0.3, 0.999):
        assert drained(below * threshold) == pytest.approx((1.0, full), rel=1e-3)
    found = [drained(x * threshold)[0] for x in (1.001, 1.1, 1.5, 2.0, 4.0)]
    assert found[0] > 0.99
    assert np.all(np.diff(found) < 0.0)
    least = irreducible_saturation(capillary_number_cake(2e-6, 0.45, 0.01, 1.5 * threshold, 996.9, 0.072))
    assert found[2] == pytest.approx(least + (1.0 - least) / 1.5**5, rel=1e-9)
