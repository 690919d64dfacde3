"""Countercurrent decantation against a balance of each thickener and the examples of a book."""

import jax
import numpy as np
import pytest
from tests.contracts.unit_cases import slurries, slurry

from granum.core.errors import ApplicabilityError, InputError
from granum.settling import soluble_loss_countercurrent
from granum.settling.equipment.decantation import CountercurrentDecantation
from granum.settling.velocities import Vesilind
from granum.streams.audit import closure
from granum.streams.stream import empty


@pytest.mark.parametrize(
    ("wash", "stages", "feed", "mixing"),
    [(0.5, 2, 1.0, 1.0), (1.0, 4, 1.0, 0.9), (2.5, 3, 3.0, 1.0), (3.0, 6, 0.7, 0.8), (0.0, 3, 2.0, 0.9)],
)
def test_each_thickener_in_balance(wash, stages, feed, mixing):
    """Liquor of underflow u and overflow x of each stage, one of an underflow, nothing in the wash."""
    n = stages
    A, b = np.zeros((2 * n, 2 * n)), np.zeros(2 * n)
    past = (1.0 - mixing) * min(feed, 1.0)
    for k in range(n):
        over = wash + feed - 1.0 if k == 0 else wash
        A[k, k], A[k, n + k] = 1.0, over  # what leaves the stage
        A[n + k, k] = 1.0  # the underflow: what passes by, and the mixed liquor
        if k == 0:
            b[0], b[n] = feed, past
            A[n, n] = -(1.0 - past)
        else:
            A[k, k - 1] = -1.0
            A[n + k, k - 1], A[n + k, n + k] = -(1.0 - mixing), -mixing
        if k + 1 < n:
            A[k, n + k + 1] = -wash
    if wash == 0.0:  # the stages behind the first pass on what they get
        lost = A[:1, :1] @ np.array([past + 1.0 - past])
    else:
        lost = np.linalg.solve(A, b)[n - 1 : n]
    found = soluble_loss_countercurrent(wash, stages, feed, mixing)
    assert found == pytest.approx(lost[0] / feed, rel=1e-12)


def test_the_examples_of_coulson_and_richardson():
    # volume 2, chapter 10; opened in solutions of others, the answer of the first and third recalled.
    # Problem 10.3, caustic soda: four liquors over each underflow, 3.11 thickeners lose 1 %
    assert soluble_loss_countercurrent(wash_ratio=4, wash_stages=3.11) == pytest.approx(0.01, rel=0.02)
    # Example 10.3, titanium dioxide: 100 kg with 50 kg of liquor that holds 14.1 kg of salt, 200 kg of wash;
    # 0.1 kg is left by n + 1 = log 421 / log 4
    n = np.log(421) / np.log(4) - 1
    assert soluble_loss_countercurrent(4, n) == pytest.approx(0.1 / (50 * 54.9 / 195), rel=0.01)
    # Example 10.2: 100 kg of chalk, 80 kg of soda in 900 kg of water, 300 kg in each of three underflows;
    # 980 kg of wash leave 1 kg
    assert soluble_loss_countercurrent(980 / 300, 3, 900 / 300) == pytest.approx(1 / 80, rel=0.01)
    # Problem 10.1: salt on dry sand through two classifiers, a quarter of it stays
    assert soluble_loss_countercurrent(2, 2, 1e-9) == pytest.approx(0.25)
    with pytest.raises(ApplicabilityError, match="at least the liquor"):
        soluble_loss_countercurrent(wash_ratio=0.2, wash_stages=2, feed_liquor_ratio=0.5)


MIXTURE = slurries(6, 1e-6, 2e-4)
SINKING = Vesilind("2 m/hour", 0.005)


def pulp(solid, liquid, temperature=330.0):
    """Sand in water with a third of ethanol as the solute."""
    return empty(MIXTURE, temperature).replace(
        solid=np.vstack([np.full(6, solid / 6), np.zeros(6)]), liquid=np.array([0.67, 0.33]) * liquid
    )


def water(flow, temperature=300.0):
    return empty(MIXTURE, temperature).replace(liquid=np.array([flow, 0.0]))


def test_the_solute_of_the_balance_leaves_below():
    unit = CountercurrentDecantation(4.0, 900.0, 1 / 1.5, SINKING, mixing_efficiency=1.0)
    made = unit.operate(feed=pulp(2.0, 3.0), wash=water(4.0))
    under = made.outlets.underflow
    assert float(under.liquid_flow) == pytest.approx(1.0)
    assert float(under.solid_flow) == pytest.approx(2.0)
    share = float(under.liquid[1]) / (0.33 * 3.0)
    assert share == pytest.approx(soluble_loss_countercurrent(4.0, 4.0, 3.0), rel=1e-10)
    assert share == pytest.approx(float(made.figures.soluble_loss), rel=1e-10)
    assert 300.0 < float(under.temperature) < 301.0 < float(made.outlets.overflow.temperature) < 330.0
    worse = CountercurrentDecantation(4.0, 900.0, 1 / 1.5, SINKING, mixing_efficiency=0.9)
    assert float(worse.operate(feed=pulp(2.0, 3.0), wash=water(4.0)).figures.soluble_loss) > share


def test_what_the_thickeners_cannot_pass_flows_over():
    made = CountercurrentDecantation(3.0, 5.0, 0.4, SINKING).operate(feed=pulp(2.0, 6.0), wash=water(6.0))
    assert float(made.figures.loading_ratio) > 1.0
    assert float(made.outlets.overflow.solid_flow) > 0.1
    down = float(made.outlets.underflow.solid_flow)
    assert down / 5.0 == pytest.approx(float(made.inside.limiting_flux), rel=1e-9)


def test_a_train_sized_from_its_duty_does_it():
    duty = {"mass_flow": 2.0, "solid_density": 2650.0, "liquid_density": 1000.0, "settling": SINKING}
    train = CountercurrentDecantation.size(
        underflow_liquid_ratio=1.5, feed_liquid_ratio=4.0, wash_ratio=3.0, soluble_loss=0.01, **duty
    )
    less = CountercurrentDecantation(
        train.stage_count - 1.0, train.area, train.solids_mass_fraction_underflow, SINKING
    )
    feed, wash = pulp(2.0, 8.0), water(9.0)
    with pytest.raises(InputError, match="more wash"):
        CountercurrentDecantation.size(
            underflow_liquid_ratio=1.5, feed_liquid_ratio=4.0, wash_ratio=0.5, soluble_loss=0.01, **duty
        )
    figures = train.operate(feed=feed, wash=wash).figures
    assert (
        float(figures.soluble_loss) <= 0.01 < float(less.operate(feed=feed, wash=wash).figures.soluble_loss)
    )
    assert float(figures.loading_ratio) == pytest.approx(1 / 1.25, rel=0.1)


def test_anything_closes_and_has_the_right_sign():
    """A hundred settings: little and much wash, thick and thin feed, light grains, nothing at all."""
    numbers = np.random.default_rng(21).random((100, 16))
    numbers[:4, 7] = 0.0  # next to no wash

    @jax.jit
    @jax.vmap
    def run(u):
        feed = slurry(MIXTURE, u[:8], (-3.0, 0.0))
        wash = empty(MIXTURE, 280.0 + 80.0 * u[13]).replace(
            liquid=feed.liquid_flow * u[7] * np.array([3.0, 0.1])
        )
        unit = CountercurrentDecantation(
            1.0 + 9.0 * u[8],
            feed.solid_flow * 10.0 ** (1.0 + 3.0 * u[9]),
            0.1 + 0.6 * u[10],
            Vesilind(10.0 ** (-4.0 + 1.5 * u[11]), 0.001 + 0.01 * u[12]),
            mixing_efficiency=0.8 + 0.2 * u[14],
        )
        made = unit.operate(feed=feed, wash=wash)
        gap = closure([feed, wash], list(made.outlets))
        least = [np.inf]
        for stream in made.outlets:
            least = [jax.numpy.minimum(least[0], jax.numpy.min(x)) for x in (stream.solid, stream.liquid)]
        between = [made.outlets.underflow.temperature, made.outlets.overflow.temperature]
        return (
            gap,
            least[0] / feed.mass_flow,
            made.figures.soluble_loss,
            between,
            [feed.temperature, wash.temperature],
        )

    gap, least, lost, (cold, warm), (a, b) = run(numbers)
    assert all(np.all(np.abs(part) < 1e-9) for part in jax.tree.leaves(gap))
    assert np.all(least > -1e-14)
    assert np.all((lost >= 0.0) & (lost <= 1.0))
    low, high = np.minimum(a, b) - 1e-3, np.maximum(a, b) + 0.5
    out = [
        (i, float(T[i]), float(low[i]), float(high[i]))
        for T in (cold, warm)
        for i in range(100)
        if not low[i] < T[i] < high[i]
    ]
    assert out == []
