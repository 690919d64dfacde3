"""Freeze drying against LyoPRONTO's published example, closed forms, and its own inputs recovered from its
output.
"""

from __future__ import annotations

import csv
from pathlib import Path

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import ApplicabilityError, InputError
from granum.drying.formulas import freeze_drying as f
from granum.drying.formulas import vials
from granum.drying.lab_tests.freeze_drying import ProductResistanceTest, VialHeatTest
from granum.drying.vial_spread import vial_spread

HERE = Path(__file__).parent
TORR, RESISTANCE = 133.322368, 3600 * 133.322368 * 0.1  # one cm² h Torr/g in m/s
VIAL = {
    "pressure_chamber": 0.15 * TORR,
    "area_vial": 3.8e-4,
    "area_product": 3.14e-4,
    "volume_fill": 2e-6,
    "concentration": 50.0,
    "vial_coefficient_contact": 2.75e-4 * 41840,
    "vial_coefficient_gas": 8.93e-4 * 41840 / TORR,
    "vial_coefficient_saturation": 0.46 / TORR,
    "vapor_resistance": 1.4 * RESISTANCE,
    "vapor_resistance_slope": 16 * RESISTANCE * 100,
}
SHELF = {"temperature_shelf": 293.15, "temperature_shelf_start": 238.15, "ramp_rate": 1 / 60}


def printed() -> dict[str, np.ndarray]:
    text = (HERE.parent / "references" / "primary_drying_shivkumar2019.csv").read_text(encoding="utf-8")
    rows = list(csv.reader(text.splitlines()))
    return {
        name.partition(" [")[0]: np.array([float(r[i]) for r in rows[1:]]) for i, name in enumerate(rows[0])
    }


def test_lyopronto_example_from_start_to_end():
    there = printed()
    vial = vials.vial_of(
        3.8e-4,
        3.14e-4,
        2e-6,
        50.0,
        1500.0,
        VIAL["vial_coefficient_contact"],
        VIAL["vial_coefficient_gas"],
        VIAL["vial_coefficient_saturation"],
        VIAL["vapor_resistance"],
        VIAL["vapor_resistance_slope"],
        0.0,
        0.15 * TORR,
    )
    total, path = vials.dry(vial, 238.15, 293.15, 1 / 60)
    assert float(total) / 3600 == pytest.approx(6.6576, rel=1e-3)  # 6.65 h and the rest at the last flux
    at = there["time"] * 3600
    for name, ours in (("temperature_front", path.front), ("temperature_product", path.bottom)):
        np.testing.assert_allclose(np.interp(at, path.time, ours) - 273.15, there[name], atol=0.06)
    np.testing.assert_allclose(np.interp(at, path.time, path.flux)[1:] * 3600, there["flux"][1:], rtol=2e-3)
    np.testing.assert_allclose(
        np.interp(at, path.time, path.depth / vial.height) * 100, there["dried"], atol=0.12
    )
    found = f.primary_drying(**VIAL, **SHELF)
    assert found.temperature_product == pytest.approx(273.15 - 14.77, abs=0.02)
    assert found.drying_time == pytest.approx(float(total), rel=1e-12)


def test_design_space_of_lyopronto():
    capacity = (-0.182 + 11.7 * 0.15) / 3600
    edge = f.freeze_drying_limit(
        temperature_limit=268.15, sublimation_capacity=capacity, vial_count=398.0, **VIAL
    )
    assert edge.drying_time / 3600 == pytest.approx(1.98, abs=0.01)  # printed to the step of 0.01 h
    assert edge.sublimation_flux * 3600 == pytest.approx(3.106941632276091, rel=5e-3)
    assert edge.sublimation_flux_end * 3600 == pytest.approx(2.2940169159986503, rel=5e-3)
    assert edge.drying_time_equipment / 3600 == pytest.approx(0.48917143462598, rel=1e-3)
    assert edge.sublimation_flux_equipment * 3600 == pytest.approx(12.58681944755625, rel=1e-6)
    # the shelf of the design space just reaches the limit
    just = f.primary_drying(**VIAL, **{**SHELF, "temperature_shelf": edge.temperature_shelf})
    assert just.temperature_product == pytest.approx(268.15, abs=0.01)
    with pytest.raises(ApplicabilityError, match="sublime"):
        f.freeze_drying_limit(
            temperature_limit=230.0, sublimation_capacity=capacity, vial_count=398.0, **VIAL
        )


@pytest.mark.parametrize("name", [*VIAL, "temperature_limit"])
def test_edges_of_the_design_space_for_many_values_are_those_of_each(name: str) -> None:
    given = {"temperature_limit": 268.15, "sublimation_capacity": 4.37e-4, "vial_count": 398.0, **VIAL}
    values = given[name] * np.array([0.98, 0.99, 1.0])
    many = f.freeze_drying_limit(**{**given, name: values})
    for place, value in enumerate(values):
        one = f.freeze_drying_limit(**{**given, name: float(value)})
        for found, alone in zip(many, one, strict=True):
            assert np.broadcast_to(found, 3)[place] == pytest.approx(float(alone), rel=1e-9)


def test_against_scipy_with_the_same_equations():
    """Another integrator, another root finder, slow ramp and leveling resistance; ends inside and after the
    ramp.
    """
    for ramp, slope in ((0.5 / 60, 16.0), (0.05 / 60, 4.0)):
        given = {
            **VIAL,
            "vapor_resistance_slope": slope * RESISTANCE * 100,
            "vapor_resistance_saturation": 50.0,
        }
        ours = f.primary_drying(**given, **{**SHELF, "ramp_rate": ramp, "temperature_shelf_start": 248.15})
        K = 2.75e-4 * 41840 + 8.93e-4 * 41840 * 0.15 / (1 + 0.46 * 0.15)
        L0, ice = float(ours.frozen_height), 2e-3 * (1 - 50 / 1500)
        from granum.materials import ice_vapor_pressure

        def flux(t, L, ramp=ramp, slope=slope, K=K, L0=L0):
            Tsh = min(248.15 + ramp * t, 293.15)
            R = (1.4 + slope * 100 * L / (1 + 50 * L)) * RESISTANCE
            Z = 3.14e-4 / (K * 3.8e-4) + (L0 - L) / vials.ICE_CONDUCTIVITY
            T = brentq(
                lambda T: ice_vapor_pressure(T) - 0.15 * TORR - R * (Tsh - T) / (vials.SUBLIMATION_HEAT * Z),
                180.0,
                273.0,
            )
            return max(ice_vapor_pressure(T) - 0.15 * TORR, 0.0) / R

        def end(t, y, L0=L0):
            return y[0] - L0

        end.terminal = True
        path = solve_ivp(
            lambda t, y, L0=L0, ice=ice, flux=flux: [flux(t, min(y[0], L0)) * L0 * 3.14e-4 / ice],
            (0, 3e5),
            [0.0],
            events=end,
            rtol=1e-6,
            max_step=1800.0,
        )
        assert ours.drying_time == pytest.approx(path.t_events[0][0], rel=2e-3)


@pytest.mark.long
def test_limits_and_signs():
    base = f.primary_drying(**VIAL, **SHELF).drying_time
    assert (
        f.primary_drying(**{**VIAL, "vapor_resistance": 2 * VIAL["vapor_resistance"]}, **SHELF).drying_time
        > base
    )
    assert f.primary_drying(**{**VIAL, "vial_coefficient_contact": 20.0}, **SHELF).drying_time < base
    with pytest.raises(ApplicabilityError, match="sublime"):  # colder than ice at 150 mTorr
        f.primary_drying(**VIAL, temperature_shelf=233.15, temperature_shelf_start=233.15)
    slope = jax.grad(lambda R: f.primary_drying(**{**VIAL, "vapor_resistance": R}, **SHELF).drying_time)(
        VIAL["vapor_resistance"]
    )
    ahead, behind = (
        f.primary_drying(**{**VIAL, "vapor_resistance": VIAL["vapor_resistance"] * s}, **SHELF).drying_time
        for s in (1.001, 0.999)
    )
    assert float(slope) == pytest.approx((ahead - behind) / (0.002 * VIAL["vapor_resistance"]), rel=1e-3)


def test_secondary_drying_in_closed_form():
    warm = f.secondary_drying_time(0.2, 0.02, 303.15, 1e-4, 4e4, temperature_shelf_start=303.15)
    assert warm == pytest.approx(
        np.log(10) / (1e-4 * np.exp(4e4 / 8.314462618 * (1 / 293.15 - 1 / 303.15))), rel=1e-9
    )
    slow = f.secondary_drying_time(
        0.2, 0.02, 303.15, 1e-4, 4e4, temperature_shelf_start=263.15, ramp_rate=0.1 / 60
    )
    path = solve_ivp(lambda t, y: [-1e-4 * np.exp(4e4 / 8.314462618 * (1 / 293.15 - 1 / min(263.15 + t / 600, 303.15))) * y[0]], (0, 1e5), [0.2],  # noqa: E501
                     events=lambda t, y: y[0] - 0.02, rtol=1e-9, atol=1e-12)  # fmt: skip
    assert slow == pytest.approx(path.t_events[0][0], rel=1e-5)
    with pytest.raises(ApplicabilityError, match="3 … 20 %"):
        f.secondary_drying_time(0.2, 0.02, 303.15, 1e-4, moisture_dry_basis_equilibrium=0.03)


def test_cake_resistance_recovered_from_lyopronto_output():
    """The temperatures that LyoPRONTO printed, read as a lab test, give back the resistance it was run
    with.
    """
    there = printed()
    K = 2.75e-4 * 41840 + 8.93e-4 * 41840 * 0.15 / (1 + 0.46 * 0.15)
    whole = {
        "pressure_chamber": 0.15 * TORR,
        "heat_transfer_coefficient": K,
        "area_vial": 3.8e-4,
        "area_product": 3.14e-4,
        "volume_fill": 2e-6,
        "concentration": 50.0,
    }
    test = ProductResistanceTest(
        time=there["time"] * 3600,
        temperature_product=there["temperature_product"] + 273.15,
        temperature_shelf=there["temperature_shelf"] + 273.15,
        linear=True,
        **whole,
    )
    found = test.fit()
    assert found["vapor_resistance"].value / RESISTANCE == pytest.approx(1.4, rel=0.1)
    assert found["vapor_resistance_slope"].value / (100 * RESISTANCE) == pytest.approx(16.0, rel=0.05)
    with pytest.raises(InputError, match="more ice would have sublimed"):
        ProductResistanceTest(
            time=[3600.0 * k for k in range(1, 12)],
            temperature_product=[240.0] * 11,
            temperature_shelf=[293.15] * 11,
            **whole,
        ).fit()


def test_vial_heat_recovered():
    P = np.array([5.0, 10.0, 20.0, 30.0, 50.0, 80.0])
    K = 11.5 + 0.28 * P / (1 + 0.0035 * P)
    m = K * 3.8e-4 * 14400.0 * 20.0 / vials.SUBLIMATION_HEAT
    test = VialHeatTest(
        pressure_chamber=P,
        mass_sublimed=m,
        time=[14400.0] * 6,
        temperature_shelf=[263.15] * 6,
        temperature_product=[243.15] * 6,
        area_vial=3.8e-4,
    )
    found = test.fit()
    for name, value in (
        ("vial_coefficient_contact", 11.5),
        ("vial_coefficient_gas", 0.28),
        ("vial_coefficient_saturation", 0.0035),
    ):
        assert found[name].value == pytest.approx(value, rel=1e-4)
    with pytest.raises(InputError, match="warmer"):
        VialHeatTest(
            pressure_chamber=P,
            mass_sublimed=m,
            time=[14400.0] * 6,
            temperature_shelf=[243.15] * 6,
            temperature_product=[243.15] * 6,
            area_vial=3.8e-4,
        ).fit()


def test_choked_flow_against_another_derivation():
    """Area over critical area at Mach 1 by the isentropic relations written out one by one."""
    g, T, P = 1.33, 283.15, 20.0
    throat_T, throat_P = T * 2 / (g + 1), P * (2 / (g + 1)) ** (g / (g - 1))
    rho = throat_P * 0.018015268 / (8.314462618 * throat_T)
    sound = (g * 8.314462618 / 0.018015268 * throat_T) ** 0.5
    assert f.choked_flow_rate(P, 0.4, T, 1.0) == pytest.approx(rho * sound * np.pi * 0.04, rel=1e-12)


def test_a_batch_spreads_and_edges_dry_first():
    batch = vial_spread(temperature_shelf=263.15, temperature_limit=243.15, vial_count=2000, **VIAL)
    alone = vial_spread(
        temperature_shelf=263.15,
        temperature_limit=243.15,
        vial_count=2000,
        edge_share=0.0,
        spread_heat_transfer=0.0,
        spread_resistance=0.0,
        spread_fill=0.0,
        **VIAL,
    )
    assert alone.drying_time_early == pytest.approx(alone.drying_time_last, rel=1e-12)
    assert batch.drying_time_early < alone.drying_time_median < batch.drying_time_last
    assert batch.temperature_product_hottest > alone.temperature_product_hottest
    with pytest.raises(ApplicabilityError, match="never dry"):
        vial_spread(temperature_shelf=230.0, vial_count=20, **{**VIAL})


def test_freeze_dryer_in_a_line():
    run = gr.read(EXAMPLES / "dryers" / "freeze.toml").solve()
    assert run.figure("dryer.drying_time_primary") / 3600 == pytest.approx(6.66, abs=0.01)
    assert run.figure("dryer.temperature_product") - 273.15 == pytest.approx(-14.77, abs=0.02)
    assert run.audit["mass_closure"] < 1e-12
    assert run.audit["energy_closure"] < 1e-9
    assert all(c.ok for c in run.units["dryer"].checks)
    hot = run.line.with_values(**{"dryer.temperature_limit": 250.0, "dryer.duct_diameter": 0.1}).solve()
    assert [c.ok for c in hot.units["dryer"].checks] == [False, True, False]
    # a cabinet of shelves 10 cm apart, pumped down in half an hour: V/t ln(p0/p) at 14 W per m³/h
    uses, values = run.units["dryer"].as_json()["utilities"], run.units["dryer"].values
    drying = (values.drying_time_primary + values.drying_time_secondary) / values.cycle_time
    pumped = uses["area_installed"]["value"] * 0.1 / 0.5 * np.log(760.0 / 0.15)  # m³/h
    assert uses["electric_power_vacuum"]["value"] == pytest.approx(13.9 * pumped * drying, rel=0.005)


def test_layer_of_food():
    """King's coffee: −29.4 °C and 301 µm Hg. Notes (D IV.2.2): layers of 1.5 to 3 cm dry in 10 to 72 h."""
    coffee = f.freeze_drying_slab("30 degC", "0.097 mmHg", 0.035, 3.5e-9 / 0.133322, "5 mm", 250.0, 2.0)
    assert coffee.temperature_front - 273.15 == pytest.approx(-29.4, abs=0.15)
    # read from a chart: ice at −29.4 °C has 304
    assert coffee.vapor_pressure / 0.133322 == pytest.approx(301, rel=0.02)
    by_hand = 2.8367e6 * 250.0 * 2.0 * 0.005**2 / (2 * 0.035 * 59.3)
    assert coffee.drying_time == pytest.approx(by_hand, rel=0.01)
    thin, thick = (
        f.freeze_drying_slab("60 degC", "60 Pa", 0.05, 2.5e-8, L, 90.0, 9.0, 0.11).drying_time
        for L in ("15 mm", "30 mm")
    )
    assert 10 <= thin / 3600 < thick / 3600 <= 72
    assert thick == pytest.approx(4 * thin)
    with pytest.raises(ApplicabilityError, match="sublime"):
        f.freeze_drying_slab("-40 degC", "100 Pa", 0.05, 2.5e-8, "10 mm", 90.0, 9.0)


def test_a_freeze_dryer_whose_duct_is_not_given(tmp_path: Path) -> None:
    """It has no choked flow to show, which is no reason to refuse it."""
    example = EXAMPLES / "dryers" / "freeze.toml"
    (tmp_path / "freeze.toml").write_text(
        "\n".join(row for row in example.read_text().splitlines() if not row.startswith("duct_diameter"))
    )
    (tmp_path / "solids_made.toml").write_text((example.parent / "solids_made.toml").read_text())
    run = gr.read(tmp_path / "freeze.toml").solve()
    figures = run.as_json()["units"]["dryer"]["results"]
    assert figures["choked_flow_rate"]["value"] is None
    assert figures["drying_time_primary"]["value"] > 0
