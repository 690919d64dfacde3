"""Balances of dryers against the course notes, hand balances and another property library."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.drying.balances import savings as s
from granum.drying.balances.convective import dryer_balance
from granum.drying.balances.indices import dry_gas_flow_evaporation

FOLDER = EXAMPLES / "dryers"
MAIZE = {
    "mass_flow_inlet": 100.0,
    "moisture_dry_basis_inlet": 0.54,
    "moisture_dry_basis_outlet": 0.18,
    "temperature_fresh": 298.15,
    "relative_humidity_fresh": 0.5,
}


def test_maize_of_the_notes():
    found = dryer_balance(**MAIZE, temperature_inlet=323.15, relative_humidity_outlet=1.0)
    # they round 35.065 and 64.935 before subtracting
    assert found.evaporation_rate == pytest.approx(23.3, rel=0.005)
    assert found.heat_duty_minimum == pytest.approx(56.735e6, rel=0.005)
    assert found.humidity_ratio_fresh == pytest.approx(9.9e-3, rel=0.005)
    assert found.enthalpy_fresh == pytest.approx(50e3, rel=0.01)
    assert found.enthalpy_inlet == pytest.approx(76e3, rel=0.01)
    assert found.wet_bulb_temperature == pytest.approx(273.15 + 25.1, abs=0.1)
    assert found.humidity_ratio_outlet == pytest.approx(20.1e-3, rel=0.01)
    assert found.dry_gas_flow == pytest.approx(2284.0, rel=0.02)
    # the notes give it as the outlet's: it is the inlet's
    assert found.volume_flow / found.dry_gas_flow == pytest.approx(0.93, rel=0.002)
    assert found.mass_efficiency == pytest.approx(1.0, abs=1e-9)


def test_dry_gas_of_the_water_balance():
    """Bhatt and Vora, example 6.21: 0.085 kg/s from 0.036 to 0.056 take 4.25 kg/s of dry air; air that gains
    nothing takes none.
    """
    assert dry_gas_flow_evaporation(0.085, 0.036, 0.056) == pytest.approx(4.25)
    with pytest.raises(ApplicabilityError):
        dry_gas_flow_evaporation(0.085, 0.056, 0.036)


@pytest.mark.long
def test_any_consistent_set_gives_the_same_dryer():
    whole = dryer_balance(
        **MAIZE,
        temperature_inlet=353.15,
        relative_humidity_outlet=0.6,
        recirculated_fraction=0.7,
        leak_fraction=0.05,
        shaft_power=5e4,
        heat_loss=1e5,
        temperature_product_inlet=293.15,
        temperature_product_outlet=313.15,
    )
    product = {"temperature_product_inlet": 293.15, "temperature_product_outlet": 313.15}
    rest = {"leak_fraction": 0.05, "shaft_power": 5e4, "heat_loss": 1e5, "recirculated_fraction": 0.7}
    air = {"temperature_fresh": 298.15, "relative_humidity_fresh": 0.5}
    solids = {
        n: MAIZE[n] for n in ("mass_flow_inlet", "moisture_dry_basis_inlet", "moisture_dry_basis_outlet")
    }
    sets = [
        ({**solids, **air, **rest}, ("dry_gas_flow", "temperature_inlet"), {}),
        ({**solids, **air, **rest}, ("dry_gas_flow", "temperature_outlet"), {}),
        ({**solids, **air, **rest}, ("temperature_inlet", "temperature_outlet"), {}),
        ({**solids, **air, **rest}, ("heat_duty", "temperature_outlet"), {}),
        ({**solids, **air, **rest}, ("enthalpy_inlet", "humidity_ratio_outlet"), {}),
        (
            {**solids, **rest},
            ("humidity_ratio_fresh", "enthalpy_fresh", "dry_gas_flow_fresh", "temperature_inlet"),
            {},
        ),
        (
            {**air, **rest},
            (
                "mass_flow_outlet",
                "evaporation_rate",
                "dry_solid_flow",
                "temperature_inlet",
                "temperature_outlet",
            ),
            {},
        ),
        (
            {**air, **rest, "moisture_dry_basis_inlet": 0.54, "moisture_dry_basis_outlet": 0.18},
            ("dry_gas_flow", "temperature_inlet", "relative_humidity_outlet"),
            {},
        ),
        (
            {**air, **rest, "mass_flow_inlet": 100.0, "moisture_dry_basis_inlet": 0.54},
            ("dry_gas_flow", "temperature_inlet", "temperature_outlet"),
            {},
        ),
        (
            {**solids, **air, **{n: v for n, v in rest.items() if n != "heat_loss"}},
            ("dry_gas_flow", "temperature_inlet", "temperature_outlet"),
            {"quantity_sought": "heat_loss"},
        ),
        (
            {**solids, **air, **{n: v for n, v in rest.items() if n != "recirculated_fraction"}},
            ("dry_gas_flow", "temperature_inlet", "temperature_outlet"),
            {"quantity_sought": "recirculated_fraction"},
        ),
    ]
    for fixed, more, extra in sets:
        again = dryer_balance(**fixed, **{n: getattr(whole, n) for n in more}, **product, **extra)
        for name in whole._fields:
            assert getattr(again, name) == pytest.approx(getattr(whole, name), rel=1e-7, abs=1e-7), (
                more,
                name,
            )


def test_balances_close():
    v = dryer_balance(
        **MAIZE,
        temperature_inlet=353.15,
        temperature_outlet=320.0,
        recirculated_fraction=0.5,
        leak_fraction=0.1,
        shaft_power=3e4,
        heat_duty_inside=2e5,
        heat_loss=1e5,
    )
    fresh = v.dry_gas_flow_fresh
    assert fresh * (v.humidity_ratio_outlet - v.humidity_ratio_fresh) == pytest.approx(
        v.evaporation_rate, rel=1e-10
    )
    entered = v.heat_duty + v.shaft_power + v.heat_duty_inside - v.heat_loss
    assert fresh * (v.enthalpy_outlet - v.enthalpy_fresh) == pytest.approx(entered, rel=1e-9)


def test_continuous_dryers_of_the_textbooks():
    """Geankoplis, example 9.10-1: 1166 kg/h of dry air leave at 0.0248. Coulson and Richardson, vol. 2,
    example 16.5: 2.08 to 2.09 kg/s of moist air.
    """
    counter = dryer_balance(
        dry_solid_flow="453.6 kg/hour",
        moisture_dry_basis_inlet=0.04,
        moisture_dry_basis_outlet=0.002,
        temperature_inlet="93.3 degC",
        humidity_ratio_inlet=0.010,
        temperature_outlet="37.8 degC",
        temperature_product_inlet="26.7 degC",
        temperature_product_outlet="62.8 degC",
        specific_heat_capacity_solid=1465.0,
    )
    assert counter.dry_gas_flow * 3600 == pytest.approx(1166, rel=3e-3)
    assert counter.humidity_ratio_outlet == pytest.approx(0.0248, abs=1e-4)
    assert np.isnan(counter.energy_per_water)  # where the hot air comes from is not said
    rotary = dryer_balance(
        dry_solid_flow=0.35,
        moisture_dry_basis_inlet=0.15,
        moisture_dry_basis_outlet=0.005,
        temperature_inlet=400.0,
        humidity_ratio_inlet=0.01,
        temperature_outlet=331.5,
        temperature_product_inlet=300.0,
        temperature_product_outlet=325.0,
        specific_heat_capacity_solid=2180.0,
    )
    assert rotary.wet_bulb_temperature == pytest.approx(312.0, abs=0.7)  # from a chart
    assert rotary.dry_gas_flow * 1.01 == pytest.approx(147.0 / (1.03 * (400 - 331.5)), rel=0.01)


def test_recirculation_of_treybal():
    """Treybal, example 12.2: trays with 3 m/s at 95 °C and 0.05, 7.5 g/s evaporated, fresh air of 0.01:
    90.65 % returned; 233 and 215.9 kJ/kg.
    """
    through = 3.0 * 11 * (0.1 - 0.038) / ((0.00283 + 0.00456 * 0.05) * 368.0)
    found = dryer_balance(
        evaporation_rate=7.5e-3,
        dry_solid_flow=1.0,
        moisture_dry_basis_outlet=0.1,
        dry_gas_flow=through,
        temperature_fresh=298.15,
        humidity_ratio_fresh=0.01,
        temperature_inlet=368.15,
        humidity_ratio_inlet=0.05,
        quantity_sought="recirculated_fraction",
    )
    assert found.recirculated_fraction == pytest.approx(0.9065, abs=5e-4)
    assert found.humidity_ratio_outlet == pytest.approx(0.0541, abs=5e-5)
    # the print reads 233 kJ/kg from a chart where 1.006·95 + 0.05·(2501 + 1.86·95) is 229.5: its heater is
    # 2 % too large
    assert found.heat_duty == pytest.approx(through * (233.0 - 215.89) * 1e3, rel=0.03)
    assert found.heat_duty == pytest.approx(through * (1 - 0.9065) * (229.5 - 50.6) * 1e3, rel=2e-3)


def test_recirculation_and_heat_save_energy():
    plain, part, most = (
        dryer_balance(
            **MAIZE, temperature_inlet=353.15, relative_humidity_outlet=0.4, recirculated_fraction=r
        ).energy_per_water
        for r in (0.0, 0.5, 0.9)
    )
    assert plain > part > most > 2.3e6
    assert (
        dryer_balance(**MAIZE, temperature_inlet=400.0, relative_humidity_outlet=0.4).energy_per_water < plain
    )


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({**MAIZE, "temperature_inlet": 353.15}, "Not fixed: give one more of .*dry_gas_flow"),
        (
            {**MAIZE, "temperature_inlet": 353.15, "temperature_outlet": 320.0, "dry_gas_flow": 1000.0},
            "Too many: one of dry_gas_flow",
        ),
        (
            {**MAIZE, "evaporation_rate": 20.0, "temperature_inlet": 353.15, "temperature_outlet": 320.0},
            (
                "one of evaporation_rate, mass_flow_inlet, moisture_dry_basis_inlet, "
                "moisture_dry_basis_outlet follows"
            ),
        ),
        (
            {
                "mass_flow_inlet": 1.0,
                "mass_flow_outlet": 0.8,
                "evaporation_rate": 0.2,
                "temperature_fresh": 298.0,
                "relative_humidity_fresh": 0.5,
                "temperature_inlet": 353.0,
                "temperature_outlet": 310.0,
            },
            "say the same thing",
        ),
        (
            {
                **MAIZE,
                "temperature_inlet": 353.15,
                "temperature_outlet": 320.0,
                "temperature_product_inlet": 300.0,
            },
            "both ends",
        ),
        ({**MAIZE, "heat_loss": 1.0, "quantity_sought": "heat_loss"}, "cannot be sought"),
    ],
)
def test_wrong_sets_are_named(given, words):
    with pytest.raises(InputError, match=words):
        dryer_balance(**given)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        # would leave beyond saturation
        ({"temperature_inlet": 323.15, "temperature_outlet": 295.0}, "relative humidity of the outlet air"),
        # too little air, too cold for the water
        ({"temperature_inlet": 323.15, "dry_gas_flow": 1080.0}, "relative humidity of the outlet air"),
        # the outlet cannot be hotter than the inlet
        ({"temperature_inlet": 303.15, "temperature_outlet": 303.2}, "dry-gas flow"),
        # such a solid would be wetted
        (
            {"temperature_inlet": 323.15, "relative_humidity_outlet": 1.0, "moisture_dry_basis_outlet": 0.6},
            "evaporation rate",
        ),
    ],
)
def test_impossible_dryers_say_why(more, words):
    with pytest.raises(ApplicabilityError, match=words):
        dryer_balance.evaluate(**{**MAIZE, **more})


def test_without_fresh_air_nothing_is_said_of_heater_and_indices():
    """Geankoplis, example 9.10-1: the balance of the dryer stands, the heater is not known. With 'heat_duty'
    said to be zero the air comes hot.
    """
    given = {
        "dry_solid_flow": "453.6 kg/hour",
        "moisture_dry_basis_inlet": 0.04,
        "moisture_dry_basis_outlet": 0.002,
        "temperature_product_inlet": "26.7 degC",
        "temperature_product_outlet": "62.8 degC",
        "temperature_inlet": "93.3 degC",
        "temperature_outlet": "37.8 degC",
        "humidity_ratio_inlet": 0.01,
        "heat_loss": 0.0,
        "specific_heat_capacity_solid": 1465.0,
    }
    found = dryer_balance.evaluate(**given)
    unknown = (
        "heat_duty",
        "energy_per_water",
        "energy_consumption_ratio",
        "drying_efficiency",
        "moisture_extraction_rate",
        "temperature_fresh",
        "relative_humidity_fresh",
        "enthalpy_fresh",
    )
    assert [name for name, value in found.outputs.items() if np.isnan(value)] == [
        n for n in found.outputs if n in unknown
    ]
    (notice,) = found.notices
    assert notice["flag"] == "limit active"
    assert "state of the fresh air is missing" in notice["message"]
    assert found.check().dry_gas_flow == pytest.approx(1166 / 3600.0, rel=3e-3)
    hot = dryer_balance.evaluate(**given, heat_duty=0.0)
    assert not hot.notices
    assert float(hot.value.temperature_fresh) == pytest.approx(273.15 + 93.3)


def test_hot_air_known_by_relative_humidity_and_enthalpy():
    """Air of 120 °C, hotter than boiling water, is found again from its relative humidity and enthalpy."""
    known = {**MAIZE, "relative_humidity_outlet": 0.5}
    whole = dryer_balance(**known, temperature_inlet=393.15)
    again = dryer_balance(
        **known,
        relative_humidity_inlet=whole.relative_humidity_inlet,
        enthalpy_inlet=whole.enthalpy_inlet,
        quantity_sought="recirculated_fraction",
    )
    assert again.temperature_inlet == pytest.approx(393.15, rel=1e-9)
    assert again.recirculated_fraction == pytest.approx(0.0, abs=1e-6)


def test_ten_thousand_at_once_and_their_gradient():
    rng = np.random.default_rng(1)
    T, phi = rng.uniform(320.0, 400.0, 10_000), rng.uniform(0.5, 0.95, 10_000)

    def energy(T, phi):
        return dryer_balance(
            **MAIZE, temperature_inlet=T, relative_humidity_outlet=phi, recirculated_fraction=0.3
        ).energy_per_water

    found = np.asarray(jax.jit(jax.vmap(energy))(T, phi))
    assert np.all(np.isfinite(found))
    assert np.all(found > 2.3e6)
    assert found[7] == pytest.approx(float(energy(T[7], phi[7])), rel=1e-10)
    slope = float(jax.grad(energy)(350.0, 0.6))
    assert slope == pytest.approx(float(energy(351.0, 0.6) - energy(349.0, 0.6)) / 2.0, rel=1e-3)
    assert slope < 0


def test_staged_heating_saves_air_and_energy():
    stages = [s.staged_heating(288.15, 0.006, 353.15, 0.8, stage_count=n) for n in (1, 2, 3)]
    assert np.all(np.diff([x.energy_per_water for x in stages]) < 0)
    assert np.all(np.diff([x.dry_gas_per_water for x in stages]) < 0)
    one = dryer_balance(
        **MAIZE | {"temperature_fresh": 288.15}, temperature_inlet=353.15, relative_humidity_outlet=0.8
    )
    same = s.staged_heating(288.15, one.humidity_ratio_fresh, 353.15, 0.8, stage_count=1)
    assert same.energy_per_water == pytest.approx(one.energy_per_water, rel=1e-9)


def test_exhaust_recovery_condenses_and_conserves():
    wet = s.exhaust_heat_recovery(333.15, 0.1, 283.15, 0.006, 0.9, fresh_per_exhaust=2.0)
    dry = s.exhaust_heat_recovery(333.15, 0.02, 283.15, 0.006, 0.5)
    assert wet.condensate_ratio > 0.01
    assert wet.temperature_exhaust < 325.0
    assert dry.condensate_ratio == pytest.approx(0.0, abs=1e-12)
    # sensible exchange of nearly equal airs: the fresh air gains half of the 50 K
    assert dry.temperature_fresh_heated == pytest.approx(308.15, abs=0.2)
    assert s.exhaust_heat_recovery(
        333.15, 0.02, 283.15, 0.006, 0.0
    ).specific_energy_recovered == pytest.approx(0.0, abs=1e-6)


def test_vapor_recompression_against_coolprop():
    CP = pytest.importorskip("CoolProp.CoolProp")
    for p1, p2, efficiency in ((101325.0, 2e5, 0.75), (1e5, 5e5, 0.8), (4e4, 1e5, 0.7)):
        entropy, h1 = (CP.PropsSI(x, "P", p1, "Q", 1, "Water") for x in "SH")
        work = (CP.PropsSI("H", "P", p2, "S", entropy, "Water") - h1) / efficiency
        found = s.vapor_recompression(p1, p2, efficiency)
        assert found.energy_per_water == pytest.approx(work, rel=2e-3)
        assert found.temperature_discharge == pytest.approx(
            CP.PropsSI("T", "P", p2, "H", h1 + work, "Water"), abs=0.5
        )
        assert found.coefficient_of_performance == pytest.approx(
            (h1 + work - CP.PropsSI("H", "P", p2, "Q", 0, "Water")) / work, rel=3e-3
        )
    assert 160e3 < s.vapor_recompression(101325.0, 2e5).energy_per_water < 200e3  # the notes' table III.2


def test_superheated_steam_lies_with_the_boiling_dryers_of_the_notes():
    found = s.superheated_steam_drying("180 degC", "120 degC")
    assert 2400e3 < found.energy_per_water < 3300e3
    assert 0.6 < found.energy_per_water / 3.6e6 < 0.75  # kWh/kg: the notes' sheets print 0.6 to 0.7
    with pytest.raises(ApplicabilityError, match="temperature"):
        s.superheated_steam_drying("180 degC", "90 degC")


def test_heat_pump_and_direct_firing():
    pump = s.heat_pump_dryer("45 degC", "70 %", "10 degC")
    hot = dryer_balance(
        evaporation_rate=1.0,
        dry_solid_flow=10.0,
        moisture_dry_basis_outlet=0.1,
        temperature_fresh=298.15,
        relative_humidity_fresh=0.5,
        temperature_inlet="45 degC",
        relative_humidity_outlet=0.7,
    )
    assert 1.0 < pump.moisture_extraction_rate * 3.6e6 < 4.0
    assert pump.energy_per_water < 0.7 * hot.energy_per_water
    assert pump.specific_energy_rejected > 0
    # Carnot by hand: half of 323.15/(323.15 − 278.15)
    assert pump.coefficient_of_performance == pytest.approx(0.5 * 323.15 / 45.0)
    gas = s.direct_firing("400 degC", "100 degC", temperature_fresh="20 degC")
    back = gr.humid_gas.combustion_gas(
        0.749, 0.251, 50e6, gas.excess_air_ratio, temperature="20 degC", humidity_ratio=0.008
    )
    assert back.temperature == pytest.approx(673.15, abs=0.01)
    assert back.humidity_ratio == pytest.approx(gas.humidity_ratio_inlet, rel=1e-6)
    # Coulson and Richardson's example 16.6 takes gas at 811 K with 0.036 kg/kg: methane in air with 0.01
    assert s.direct_firing(811.0, 380.0, humidity_ratio_fresh=0.01).humidity_ratio_inlet == pytest.approx(
        0.036, rel=0.01
    )
    with pytest.raises(ApplicabilityError, match="without excess air"):
        s.direct_firing("2500 degC", "100 degC")


def test_convective_dryer_in_a_line():
    run = gr.read(FOLDER / "balance.toml").solve()
    assert run.figure("dryer.evaporation_rate") * 3600 == pytest.approx(23.3, rel=0.005)
    assert run.figure("dryer.humidity_ratio_outlet") == pytest.approx(20.1e-3, rel=0.005)
    assert run.figure("dryer.heat_duty_heater") == pytest.approx(2284 / 3600 * 26e3, rel=0.02)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-9
    assert all(c.ok for c in run.units["dryer"].checks)


def test_convective_dryer_says_what_fails():
    line = gr.read(FOLDER / "balance.toml")
    with pytest.raises(ConvergenceError, match=r"dryer.*would hold .* times the vapor that saturates it"):
        line.with_values(**{"dryer.temperature_inlet": 313.15}).solve()
    warm = line.with_values(**{"dryer.temperature_limit": 280.0}).solve()
    assert "product temperature over its limit" in [c.name for c in warm.units["dryer"].checks if not c.ok]
    with pytest.raises(ConvergenceError, match="saturates"):
        line.with_values(**{"dryer.moisture_outlet": 0.02}).solve()
    unit = type(line.sheet.units["dryer"])
    with pytest.raises(InputError, match="exactly one"):
        unit(temperature_inlet=320.0)
    with pytest.raises(InputError, match="Too much"):
        unit(temperature_inlet=320.0, heat_duty=1e3, moisture_outlet=0.1)


def test_closed_form_of_dry_air():
    """Without water in the fresh air and at one temperature level the isenthalpic line is (2501 + 1.86
    T₂)(w₂) = c (T₁ − T₂).

    The heat capacity of air between the temperatures is that of Incropera's table A.4: 1.007 at 300 K,
    1.009 at 350 K.
    """
    found = dryer_balance(
        evaporation_rate=1.0,
        dry_solid_flow=1.0,
        moisture_dry_basis_outlet=0.1,
        temperature_fresh=273.15,
        humidity_ratio_fresh=0.0,
        temperature_inlet=373.15,
        temperature_outlet=323.15,
    )
    assert found.humidity_ratio_outlet == pytest.approx(1.009 * 50 / (2501 + 1.86 * 50), rel=2e-3)
    assert float(jnp.asarray(found.energy_per_water)) == pytest.approx(
        1.008e3 * 100 / found.humidity_ratio_outlet, rel=2e-3
    )


def test_study_of_recirculation_stops_at_the_driest_air_it_may_leave():
    from granum.cases.studying import read_studies

    best = read_studies(FOLDER / "recirculation.toml")["best"].run()
    share = float(best.values["recirculated_fraction"])
    again = dryer_balance(
        evaporation_rate=1000 / 3600,
        dry_solid_flow=3000 / 3600,
        moisture_dry_basis_outlet=0.14,
        dry_gas_flow=120e3 / 3600,
        temperature_fresh=288.15,
        relative_humidity_fresh=0.7,
        temperature_inlet=343.15,
        relative_humidity_outlet=0.6,
        quantity_sought="recirculated_fraction",
    )
    # the outlet humidity is tied to the flow through the dryer: two statements about it leave the fresh air's
    # share to be found
    assert share == pytest.approx(again.recirculated_fraction, abs=1e-3)
    assert gr.drying.water_activity(0.14, isotherm="maize", temperature=325.0) == pytest.approx(
        0.70, abs=0.005
    )
