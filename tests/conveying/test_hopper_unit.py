"""The hopper as a unit, and the formulas of its outlet: prints, independent balances, limits, a stranger's
settings.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.cases.alone import alone
from granum.conveying.equipment.hopper import Hopper
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

DEGREE = np.pi / 180.0
SAND = mixture_of(["water"], ["quartz"], ["dry air"], list(np.geomspace(1e-5, 2e-3, 9)))
FREE = {
    "effective_friction_angle": 30 * DEGREE,
    "wall_friction_angle": 19 * DEGREE,
    "hopper_half_angle": 27.5 * DEGREE,
}


def sand(flow=2.0, at=6, water=0.0):
    """Quartz of one size class, kg/s."""
    return empty(SAND, 293.15).replace(
        solid=jnp.zeros((1, 8)).at[0, at].set(flow), liquid=jnp.array([water * flow])
    )


def measured(hopper: Hopper, feed) -> dict:
    made = hopper.operate(feed=feed)
    return {k: float(v) for k, v in hopper.measured(made.inside, made.outlets, made.figures, feed).items()}


def test_the_least_outlet_is_that_of_rhodes() -> None:
    """Rhodes's worked hopper, opened earlier: 0.16 m by the flow function (1300, 780) … (2400, 970)."""
    a, b = 560.0, 0.17
    hopper = Hopper(2.0, 3.0, 0.20, bulk_density=1300.0, strength_intercept=a, strength_slope=b, **FREE)
    made = hopper.operate(feed=sand())
    assert float(made.figures.outlet_width_least) == pytest.approx(0.16, abs=0.01)
    assert float(made.figures.residence_time) == pytest.approx(float(hopper.volume()) * 1300.0 / 2.0)
    # at its least outlet an arch stands: nothing leaves; a little wider it runs
    narrow, wide = (
        float(
            Hopper(2.0, 3.0, width, bulk_density=1300.0, strength_intercept=a, strength_slope=b, **FREE)
            .operate(feed=sand())
            .figures.discharge_largest
        )
        for width in (0.999 * float(made.figures.outlet_width_least), 0.25)
    )
    assert narrow == 0.0
    assert wide > 2.0


def test_a_narrowing_stream_of_grains_in_free_fall() -> None:
    """v = Q/(4π r² · const) along a radius: v dv/dr = −2 v²/r must be g at r = B/(2 sin θ), for a tenth of a
    degree where sine and tangent agree; Carleton's coarse grains and Johanson's cone are both that.
    """
    width, theta = 0.3, 2.0 * DEGREE
    r = width / (2.0 * np.sin(theta))
    by_hand = np.sqrt(9.80665 * r / 2.0)
    carleton = gr.conveying.outlet_velocity_carleton(width, theta, 0.05, 2500.0, 1.2, 1.8e-5)
    johanson = gr.conveying.mass_flow_johanson(1000.0, width, theta, 0.0, 10.0)
    assert carleton == pytest.approx(by_hand, rel=2e-3)
    assert johanson / (1000.0 * 0.25 * np.pi * width**2) == pytest.approx(by_hand, rel=1e-3)


def test_finer_grains_leave_more_slowly() -> None:
    d = jnp.geomspace(2e-5, 2e-3, 12)
    v = np.array([gr.conveying.outlet_velocity_carleton(0.2, 0.3, float(x), 2500.0, 1.2, 1.8e-5) for x in d])
    assert np.all(np.diff(v) > 0)
    assert v[0] < 0.1 * v[-1]


@pytest.mark.parametrize("phi", [30.0, 40.0, 50.0, 60.0])
def test_ratholes_by_the_polynomial_of_other_handbooks(phi: float) -> None:
    g = -5.066 + 0.490 * phi - 0.0112 * phi**2 + 0.000108 * phi**3
    found = gr.conveying.rathole_diameter_jenike(1500.0, 700.0, phi * DEGREE)
    assert found == pytest.approx(g * 1500.0 / (700.0 * 9.80665), rel=0.05)


def test_any_hopper_has_numbers_and_its_checks_follow_physics() -> None:
    rng = np.random.default_rng(5)
    n = 200
    span = {
        "diameter": (0.8, 6.0),
        "height": (0.5, 12.0),
        "share": (0.05, 0.6),
        "angle": (8 * DEGREE, 60 * DEGREE),
        "rho": (400.0, 900.0),
        "effective": (32 * DEGREE, 60 * DEGREE),
        "wall": (8 * DEGREE, 32 * DEGREE),
        "a": (0.0, 1500.0),
        "b": (0.0, 0.3),
    }
    drawn = {k: jnp.asarray(rng.uniform(*ends, n)) for k, ends in span.items()}
    feed = sand(at=3, water=0.05)

    def made(v, wider=1.0):
        hopper = Hopper(
            v["diameter"],
            v["height"],
            v["share"] * v["diameter"] * wider,
            v["angle"],
            v["rho"],
            v["effective"],
            v["wall"],
            v["a"],
            v["b"],
        )
        done = hopper.operate(feed=feed)
        return done.figures, hopper.measured(done.inside, done.outlets, done.figures, feed)

    figures, checks = jax.jit(jax.vmap(made))(drawn)
    wider, _more = jax.jit(jax.vmap(lambda v: made(v, 1.2)))(drawn)
    for values in (*figures, *checks.values()):
        assert np.all(np.isfinite(values))
        assert np.all(np.asarray(values) >= 0.0)
    assert np.all(wider.discharge_largest >= figures.discharge_largest)
    stands = np.asarray(checks["flows"]) > 1.0
    assert 0 < stands.sum() < n
    assert np.all(np.asarray(figures.discharge_largest)[stands] == 0.0)
    free, checks = jax.jit(jax.vmap(made))(drawn | {"a": jnp.zeros(n), "b": jnp.zeros(n)})
    assert np.all(free.outlet_width_least == 0.0)
    assert np.all(checks["funnel"] == 0.0)
    assert np.all(free.discharge_largest > 0.0)


def test_what_cannot_be_is_refused_in_words() -> None:
    with pytest.raises(InputError, match="narrower than the hopper"):
        alone("conveying.hopper", outlet_width="3 m")
    with pytest.raises((ConvergenceError, ApplicabilityError), match="no outlet is wide enough"):
        alone("conveying.hopper", strength_slope=0.9).solve()


def test_checks_speak_of_a_narrow_outlet() -> None:
    checks = alone("conveying.hopper", outlet_width="10 cm").solve().as_json()["units"]["hopper"]["checks"]
    told = {c["name"]: c for c in checks}
    failed = [name for name, c in told.items() if not c["ok"]]
    assert any("arch" in name for name in failed)
    assert any("largest discharge" in name for name in failed)
