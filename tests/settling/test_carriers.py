"""Basins whose liquid does not follow Newton: creeping spheres by hand, limits, what a yield stress holds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import granum as gr
from granum.core.errors import CaseError, ConvergenceError
from granum.flowsheet.run import Run

GRAVITY, SOLID, LIQUID = 9.80665, 2650.0, 998.2
# drag of a creeping sphere over Stokes' at the shear rate v/d, of tables from memory (Chhabra)
TABLE = {1.0: 1.0, 0.9: 1.14, 0.8: 1.24, 0.7: 1.32, 0.6: 1.38, 0.5: 1.42, 0.4: 1.44}


def basin(sizes: tuple[float, ...], key: str = "settling.clarifier", **settings: Any) -> Run:
    """Little quartz of narrow sizes, µm, in water or in what is said."""
    edges = [f"{share * d} um" for d in sizes for share in (0.995, 1.005)]
    fractions = [1 / len(sizes) if i % 2 == 0 else 0.0 for i in range(len(edges) - 1)]
    return gr.alone(
        key,
        mixture={"solids": "quartz", "liquids": "water", "sizes": {"boundaries": edges}},
        feed={
            "solid_flow": "1 g/h",
            "liquid_flow": "100 t/h",
            "liquid": {"water": 1.0},
            "sizes": {"fractions": fractions},
            "temperature": "20 degC",
        },
        **settings,
    ).solve()


@pytest.mark.parametrize("n", TABLE)
def test_creeping_grains_in_a_power_law(n: float) -> None:
    """A basin ten times too small keeps a tenth of what falls at v = (g d^(n+1) Δρ/(18 X K))^(1/n)."""
    d, consistency = 1e-3, 2.0
    speed = (GRAVITY * d ** (n + 1) * (SOLID - LIQUID) / (18 * TABLE[n] * consistency)) ** (1 / n)
    area = 0.1 * 100 / 3.6 / LIQUID / speed
    run = basin((1000,), area=f"{area} m2", consistency=f"{consistency} Pa*s", flow_index=n)
    # X within 2 %, quartz of the library within 1 % of the difference, and the power 1/n of it
    assert run.figure("clarifier.removal_efficiency") == pytest.approx(0.1, rel=0.03 / n)


def test_newtons_liquid_by_any_name() -> None:
    """Water as a power law of index one, and as a Bingham liquid without stress, is water."""
    plain = basin((40,), area="10 m2").figure("clarifier.removal_efficiency")
    assert 0.1 < plain < 0.9
    water = {"consistency": "1.0016 mPa*s"}
    thin = basin((40,), area="10 m2", flow_index=1.0, **water)
    slack = basin((40,), area="10 m2", yield_stress="1e-12 Pa", **water)
    assert thin.figure("clarifier.removal_efficiency") == pytest.approx(plain, rel=0.02)
    assert slack.figure("clarifier.removal_efficiency") == pytest.approx(plain, rel=2e-3)


def test_a_yield_stress_holds_the_fine_and_lets_the_coarse_fall() -> None:
    """Ansley and Smith: held from 4/(21π) g d Δρ on, whatever the area; told."""
    limit = 4 / (21 * np.pi) * GRAVITY * (SOLID - LIQUID)  # of a sphere of 1 m
    stress = limit * 1.5e-3
    run = basin((1000, 2000), area="1e5 m2", consistency="50 mPa*s", yield_stress=f"{stress} Pa")
    assert run.figure("clarifier.removal_efficiency") == pytest.approx(0.5, abs=1e-6)
    assert any("yield stress holds" in str(flag) for flag in run.flags)
    free = basin((1000, 2000), area="1e5 m2", consistency="50 mPa*s", yield_stress=f"{0.6 * stress} Pa")
    assert free.figure("clarifier.removal_efficiency") == pytest.approx(1.0, abs=1e-6)
    assert not any("yield stress holds" in str(flag) for flag in free.flags)


@pytest.mark.parametrize("seed", range(12))
def test_thicker_liquids_keep_less_and_balances_close(seed: int) -> None:
    rng = np.random.default_rng(seed)
    key = ("settling.clarifier", "settling.grit_chamber", "settling.rectangular_clarifier")[seed % 3]
    name = key.split(".")[1]
    sizes = tuple(sorted(rng.uniform(20, 2000, 2) * np.array([1.0, 1.5])))
    law = {"flow_index": float(rng.uniform(0.5, 1.0))} if seed % 2 else {"yield_stress": "0.01 Pa"}
    kept = 1.0 + 1e-9
    for consistency in np.sort(10 ** rng.uniform(-2, 1, 3)):
        run = basin(sizes, key, consistency=float(consistency), **law)
        now = run.figure(f"{name}.removal_efficiency")
        assert 0.0 <= now <= kept + 1e-9
        assert float(run.audit["mass_closure"]) < 1e-9
        kept = now


def test_half_a_liquid_is_refused() -> None:
    with pytest.raises(CaseError, match="consistency"):
        basin((100,), flow_index=0.5)
    with pytest.raises(CaseError, match="alone does not tell"):
        basin((100,), consistency=0.5)


def lamella(**settings: Any) -> Run:
    """Plates between which all of the coarser and part of the finer grain settles."""
    fixed = {"plate_number": 12, "plate_length": "1.2 m", "plate_width": "1 m", "plate_spacing": "5 cm"}
    return basin((40, 60), "settling.lamella", **fixed, **settings)


@pytest.mark.parametrize("n", [0.9, 0.7, 0.5])
def test_plates_in_a_power_law(n: float) -> None:
    """Yao between wide plates, whatever the profile: v_c = v₀/(sin α + L/b cos α); creeping grains."""
    d, consistency, plates = 1e-3, 2.0, 50
    speed = (GRAVITY * d ** (n + 1) * (SOLID - LIQUID) / (18 * TABLE[n] * consistency)) ** (1 / n)
    flow = 100 / 3.6 / LIQUID
    # a tenth of what falls is kept where the critical velocity is ten times as high
    angle = np.radians(60)
    width = flow / (plates * 0.05) / (10 * speed * (np.sin(angle) + 1.2 / 0.05 * np.cos(angle)))
    run = basin(
        (1000,),
        "settling.lamella",
        plate_number=plates,
        plate_length="1.2 m",
        plate_width=f"{width} m",
        plate_spacing="5 cm",
        consistency=f"{consistency} Pa*s",
        flow_index=n,
    )
    assert run.figure("lamella.removal_efficiency") == pytest.approx(0.1, rel=0.03 / n)
    # Metzner and Reed between wide plates: 24 over the friction factor of a flow of that profile, by hand
    v = flow / (plates * width * 0.05)
    friction = 2 * consistency * ((2 + 1 / n) * 2 * v / 0.05) ** n / (LIQUID * v**2)
    checks = {c.name: float(c.value) for c in run.units["lamella"].checks}
    assert checks["Reynolds number between the plates"] == pytest.approx(24 / friction, rel=2e-3)


def test_plates_in_newtons_liquid_by_any_name() -> None:
    plain, water = lamella(), {"consistency": "1.0016 mPa*s"}
    kept = plain.figure("lamella.removal_efficiency")
    assert 0.3 < kept < 0.95
    reynolds = "Reynolds number between the plates"
    told = {c.name: float(c.value) for c in plain.units["lamella"].checks}[reynolds]
    for law, near in (({"flow_index": 1.0}, 0.02), ({"yield_stress": "1e-12 Pa"}, 2e-3)):
        run = lamella(**law, **water)
        assert run.figure("lamella.removal_efficiency") == pytest.approx(kept, rel=near)
        found = {c.name: float(c.value) for c in run.units["lamella"].checks}[reynolds]
        assert found == pytest.approx(told, rel=1e-3)


def test_oil_in_a_thinning_water() -> None:
    """Creeping globules by hand: rise, ratio and turbulence factor of API from its points."""
    n, consistency, d = 0.9, 2e-3, 150e-6
    run = gr.alone("settling.api_separator", consistency=consistency, flow_index=n).solve()
    feed = run.streams["feed"]
    water, oil = float(feed.liquid_density), float(np.min(feed.mixture.densities("solids", feed.temperature)))
    rise = (GRAVITY * d ** (n + 1) * (water - oil) / (18 * TABLE[n] * consistency)) ** (1 / n)
    assert run.figure("api_separator.rise_velocity") == pytest.approx(rise, rel=0.05)
    ratio = run.figure("api_separator.horizontal_velocity") / run.figure("api_separator.rise_velocity")
    factor = np.interp(ratio, (3.0, 6.0, 10.0, 15.0, 20.0), (1.28, 1.37, 1.52, 1.64, 1.74))
    assert 3.0 < ratio < 20.0
    assert run.figure("api_separator.turbulence_factor") == pytest.approx(factor, rel=1e-9)
    plain = gr.alone("settling.api_separator").solve()
    assert run.figure("api_separator.removal_efficiency") < plain.figure("api_separator.removal_efficiency")


def test_a_held_globule_is_no_design() -> None:
    with pytest.raises(ConvergenceError, match="yield stress holds the globule"):
        gr.alone("settling.api_separator", consistency="50 mPa*s", yield_stress="5 Pa").solve()


@pytest.mark.parametrize("seed", range(20))
def test_plates_and_oil_basins_in_thicker_liquids_keep_less_and_balances_close(seed: int) -> None:
    rng = np.random.default_rng(seed)
    law = {"flow_index": float(rng.uniform(0.5, 1.0))} if seed % 2 else {"yield_stress": "0.001 Pa"}
    name = ("lamella", "api_separator")[seed // 2 % 2]
    kept = 1.0
    for consistency in np.sort(10 ** rng.uniform(-3, 0, 3)):
        run = gr.alone(f"settling.{name}", consistency=float(consistency), **law).solve()
        now = run.figure(f"{name}.removal_efficiency")
        assert 0.0 <= now <= kept + 1e-9
        assert float(run.audit["mass_closure"]) < 1e-9
        assert float(run.audit["energy_closure"]) < 1e-9
        kept = now
