"""The stirrer of a crystallizer: how fast it must turn, what it takes, what it lets through the wall."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import granum as gr
from granum.app.shipped import examples_folder

JACKETED = Path(examples_folder()) / "seeded-crystallizer" / "jacketed.toml"
G = 9.80665


def jacketed(tmp_path: Path, *swaps: tuple[str, str]):
    text = JACKETED.read_text(encoding="utf-8")
    for old, new in swaps:
        assert old in text
        text = text.replace(old, new)
    (tmp_path / "line.toml").write_text(text, encoding="utf-8")
    return gr.read(tmp_path / "line.toml").solve()


def told(run):
    return run.units["crystallizer"]


def check(run, name: str) -> float:
    found = [c.value for c in told(run).checks if name in c.name]
    return float(found[0]) if found else np.nan


def test_zwietering_by_hand(tmp_path: Path) -> None:
    """The just suspended speed and the power written out from the product stream."""
    run = jacketed(tmp_path, ('rotation_speed = "110 rpm"\n', ""))
    figures, product = told(run).values, run.streams["suspension"]
    width = (4 * 5.0 / np.pi) ** (1 / 3)
    D, X = width / 3, 100 * float(product.solid_flow / product.liquid_flow)
    size = float((product.size_fractions * product.mixture.sizes).sum())
    rho, solid, nu = (
        float(product.liquid_density),
        float(product.solid_density),
        float(product.liquid_viscosity / product.liquid_density),
    )
    N = 5.8 * nu**0.1 * size**0.2 * (G * (solid - rho) / rho) ** 0.45 * X**0.13 / D**0.85
    assert float(figures.rotation_speed_suspension) == pytest.approx(2 * np.pi * N, rel=1e-6)
    assert float(figures.tip_speed) == pytest.approx(np.pi * N * D, rel=1e-6)
    mixed = float((product.solid_flow + product.liquid_flow) / product.slurry_volume_flow)
    power = 1.37 * mixed * N**3 * D**5
    assert float(figures.specific_power_input) == pytest.approx(power / (mixed * 5.0), rel=1e-6)
    uses = told(run).uses["electric_power_agitator"]
    assert float(uses) == pytest.approx(float(figures.vessel_count) * power / 0.9, rel=1e-6)
    assert np.isnan(check(run, "suspends"))  # it turns just fast enough by itself
    assert float(figures.heat_transfer_coefficient_inside) == 900.0


def test_a_slow_stirrer_lets_crystals_lie(tmp_path: Path) -> None:
    slow = jacketed(tmp_path, ('"110 rpm"', '"50 rpm"'))
    fast = jacketed(tmp_path, ('"110 rpm"', '"200 rpm"'))
    assert check(slow, "suspends") < 1.0 < check(fast, "suspends")
    powers = [float(told(run).uses["electric_power_agitator"]) for run in (slow, fast)]
    assert powers[1] / powers[0] == pytest.approx(4.0**3, rel=1e-6)


@pytest.mark.long
def test_the_stirrer_gives_the_coefficient_of_the_wall(tmp_path: Path) -> None:
    """Twice the speed lets 2^(2/3) as much heat through the film; other blades, other factors."""
    inside = "heat_transfer_coefficient_inside = 900\n"
    runs = [jacketed(tmp_path, (inside, ""), ('"110 rpm"', speed)) for speed in ('"100 rpm"', '"200 rpm"')]
    h = [float(told(run).values.heat_transfer_coefficient_inside) for run in runs]
    assert h[1] / h[0] == pytest.approx(2 ** (2 / 3), rel=1e-6)
    assert 1000.0 < h[0] < 5000.0  # W/(m² K), water-like liquor
    paddle = jacketed(tmp_path, (inside, 'impeller = "paddle"\n'), ('"110 rpm"', '"100 rpm"'))
    other = float(told(paddle).values.heat_transfer_coefficient_inside)
    assert other / h[0] == pytest.approx(0.36 / 0.53, rel=1e-6)
    # a better film keeps the wall warmer
    assert float(told(runs[1]).values.undercooling_wall_maximum) < float(
        told(runs[0]).values.undercooling_wall_maximum
    )
