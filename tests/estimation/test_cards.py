"""Any formula or law against columns, and planned experiments against published designs."""

from __future__ import annotations

import io
import json

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.commands import granum

from granum.core.errors import GranumError
from granum.estimation import CardData, fit, fit_together, next_experiment, optimal_design

# Richardson and Zaki: u = u_t (1 − c)^n; straight line in logarithms
SLUDGE = """solids_volume_fraction [percent],hindered_velocity [mm/s]
1,9.55
5,7.93
10,6.17
20,3.55
30,1.92
40,0.85
"""


def velocities(text: str = "") -> io.StringIO:
    rows = [(60.0, 1.2), (85.0, 2.4), (120.0, 4.9), (150.0, 7.4)]
    head = "particle_diameter [um],terminal_velocity [mm/s]\n"
    return io.StringIO(text or head + "\n".join(f"{d},{v}" for d, v in rows))


def test_a_formula_by_regression_through_the_origin() -> None:
    """Stokes: v = k d², k = g Δρ / 18 η, so that η follows from ordinary regression on d²."""
    data = CardData.read(
        "particles.terminal_velocity_stokes",
        velocities(),
        estimate=["dynamic_viscosity"],
        fixed={"particle_density": "2650 kg/m3", "fluid_density": 1000.0},
    )
    d, v = np.array([60.0, 85.0, 120.0, 150.0]) * 1e-6, np.array([1.2, 2.4, 4.9, 7.4]) * 1e-3
    slope = (v @ d**2) / (d**2 @ d**2)
    found = data.fit()["dynamic_viscosity"]
    assert found.value == pytest.approx(9.80665 * 1650.0 / (18.0 * slope), rel=1e-8)
    spread = np.sqrt(np.sum((v - slope * d**2) ** 2) / 3 / np.sum(d**4))
    assert found.standard_error == pytest.approx(found.value * spread / slope, rel=1e-6)
    assert found.unit == "Pa*s"
    assert len(data.chart().data) == 4


def test_a_law_finds_what_is_not_given() -> None:
    from granum.core import registry

    law = next(
        k
        for k, t in registry.everything(("settling", "particles")).items()
        if t.card.sort == "law" and t.card.name == "richardson_zaki"
    )
    thing = registry.find(law)
    (word,) = [p.name for p in thing.card.outputs]
    table = SLUDGE.replace("hindered_velocity [mm/s]", f"{word} [dimensionless]")
    rows = [line.split(",") for line in table.splitlines()[1:]]
    text = (
        table.splitlines()[0] + "\n" + "\n".join(f"{c},{(1 - float(c) / 100) ** 4.65:.10f}" for c, _v in rows)
    )
    data = CardData.read(law, io.StringIO(text), estimate=["exponent"], fixed={"reynolds": 0.01})
    assert data.fit()["exponent"].value == pytest.approx(4.65, rel=1e-6)


@pytest.mark.parametrize(
    ("key", "how", "message"),
    [
        (
            "particles.terminal_velocity_stokes",
            {"estimate": ["dynamic_viscosity"]},
            "neither columns of the file",
        ),
        (
            "particles.terminal_velocity_stokes",
            {"estimate": ["dynamic_viscosty"]},
            "Did you mean 'dynamic_viscosity'?",
        ),
        (
            "particles.terminal_velocity_stokes",
            {"fixed": {"particle_density": 2650.0, "fluid_density": 1e3, "dynamic_viscosity": 1e-3}},
            "nothing to estimate",
        ),
        ("streams.mixer", {}, "formulas, laws and lab tests can be fitted"),
        (
            "particles.terminal_velocity_stokes",
            {"estimate": ["dynamic_viscosity"], "output": "speed"},
            "Result 'speed'",
        ),
    ],
)
def test_messages(key: str, how: dict, message: str) -> None:
    with pytest.raises(GranumError) as caught:
        CardData.read(key, velocities(), **how)
    assert message in caught.value.message


def test_on_the_command_line(tmp_path) -> None:
    (tmp_path / "v.csv").write_text(velocities().getvalue())
    words = [
        "fit",
        "particles.terminal_velocity_stokes",
        str(tmp_path / "v.csv"),
        "particle_density=2650kg/m3",
        "fluid_density=1000kg/m3",
    ]
    code, out, _err = granum(
        *words, "--estimate", "dynamic_viscosity=2mPa*s", "--json", "--chart", tmp_path / "c.html"
    )
    assert code == 0
    assert json.loads(out)["parameters"]["dynamic_viscosity"]["value"] == pytest.approx(2.7e-3, rel=0.05)
    assert "plotly" in (tmp_path / "c.html").read_text()
    _code, out, _err = granum(*words, "--estimate", "dynamic_viscosity", "--robust", "--next", "--json")
    told = json.loads(out)["next"]  # v = k d²: the largest grain tells most
    assert told["at"]["particle_diameter"]["value"] == pytest.approx(150e-6)
    assert 0.5 < told["shrinkage"] < 1.0
    assert (
        "Next measurement: particle diameter"
        in granum(*words, "--estimate", "dynamic_viscosity", "--next")[1]
    )
    code, _out, err = granum(*words)
    assert code == 2
    assert "--estimate dynamic_viscosity" in err


def test_sets_fitted_together_weigh_as_they_scatter() -> None:
    """Two fluids, one unknown density of the grains: the estimate is the mean of the two, weighted by their
    inverse variances.
    """
    rng = np.random.default_rng(5)
    d = np.linspace(40e-6, 120e-6, 9)
    sets = []
    for viscosity, noise in ((1e-3, 2e-5), (4e-3, 5e-6)):
        v = 9.80665 * 1650.0 * d**2 / (18 * viscosity) + noise * rng.standard_normal(9)
        text = "particle_diameter [m],terminal_velocity [m/s]\n" + "\n".join(
            f"{a},{b}" for a, b in zip(d, v, strict=True)
        )
        sets.append(
            CardData.read(
                "particles.terminal_velocity_stokes",
                io.StringIO(text),
                estimate=["particle_density"],
                fixed={"fluid_density": 1000.0, "dynamic_viscosity": viscosity},
            )
        )
    one, two = (s.fit()["particle_density"] for s in sets)
    weights = np.array([one.standard_error, two.standard_error]) ** -2.0
    expected = (weights @ [one.value, two.value]) / weights.sum()
    found = fit_together(sets)["particle_density"]
    assert found.value == pytest.approx(expected, rel=1e-6)
    # the scatter is estimated again from all points
    assert found.standard_error == pytest.approx(weights.sum() ** -0.5, rel=0.05)
    with pytest.raises(GranumError, match="same parameters"):
        fit_together([])


def test_box_and_lucas_design() -> None:
    """A → B → C with k1 = 0.7, k2 = 0.2: measure B at t = 1.229 and 6.858 (Box and Lucas 1959)."""
    t = np.linspace(0.0, 12.0, 12001)

    def model(p, t):
        return p["k1"] / (p["k1"] - p["k2"]) * (jnp.exp(-p["k2"] * t) - jnp.exp(-p["k1"] * t))

    chosen = t[optimal_design(model, {"k1": 0.7, "k2": 0.2}, t, 2)]
    assert chosen == pytest.approx([1.229, 6.858], abs=2e-3)


def test_michaelis_menten_design() -> None:
    """Saturation kinetics: half of the points at the highest concentration, half at K x/(2K + x) (Duggleby
    1979).
    """
    x = np.linspace(0.0, 5.0, 5001)
    chosen = x[optimal_design(lambda p, x: p["v"] * x / (p["k"] + x), {"v": 1.0, "k": 1.0}, x, 6)]
    assert chosen == pytest.approx([5 / 7] * 3 + [5.0] * 3, abs=2e-3)


def test_next_measurement_of_a_straight_line_is_at_an_end() -> None:
    """With points near one end, the other end tells most; the standard error expected is that of a regression
    with it.
    """
    x = np.array([0.0, 0.1, 0.2, 0.3, 0.4])
    y = np.array([1.02, 1.19, 1.43, 1.58, 1.81])
    found = fit(lambda p, x: p["slope"] * x + p["start"], {"slope": 1.0, "start": 1.0}, x, y)
    grid = np.linspace(0.0, 1.0, 11)
    told = next_experiment(found, grid)
    assert grid[told.best] == 1.0
    with_it = np.append(x, 1.0)
    expected = found.statistics["residual_standard_deviation"] / np.sqrt(
        np.sum((with_it - with_it.mean()) ** 2)
    )
    assert told.standard_errors["slope"] == pytest.approx(expected, rel=1e-9)
    leverage = 1 / 5 + (grid - x.mean()) ** 2 / np.sum((x - x.mean()) ** 2)
    assert told.shrinkage == pytest.approx(1 / np.sqrt(1 + leverage), rel=1e-9)
