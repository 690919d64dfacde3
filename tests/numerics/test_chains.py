"""Chains of cells: where neither Newton's method nor the plain path in time arrives, the path examined step
by step does.
"""

from functools import partial

import jax
import jax.numpy as jnp
import numpy as np

from granum.numerics import Cells, Rates, chains, solve_chain

MOST = Cells(jnp.array([0.11, 0.4]), jnp.inf)


def drops(fast: float, hot: float, steep: float, cooling: float, load: float):
    """Drops that follow their gas fast: water and warmth of the drops, vapor and warmth of the gas, a
    pressure that rises steeply with warmth.
    """

    def rates(u: Cells) -> Rates:
        water, warmth = u.lanes[..., 0], u.lanes[..., 1]
        vapor, gas = u.shared[:, :1], u.shared[:, 1:]
        rate = fast * (jnp.exp(steep * (warmth - 0.5)) - vapor) * jnp.clip(water / 0.3, 0.0, 1.0)
        heat = fast * (gas - warmth)
        lanes = jnp.stack([0.5 - water - rate, 0.3 - warmth + heat - cooling * rate], axis=-1)
        return Rates(
            lanes,
            load * jnp.stack([rate, -heat], axis=-1),
            jnp.concatenate([0.1 - vapor, hot - gas], axis=-1),
        )

    return rates


def test_the_examined_path_arrives_where_lanes_bend_within_a_step() -> None:
    @jax.jit
    def solve(given):
        start = Cells(jnp.array([[[0.5, 0.3]]]), jnp.stack([jnp.asarray(0.1), given[1]])[None])
        found = solve_chain(
            drops(*given),
            start,
            Cells(1.0, 1e-3),
            first_step=0.1,
            largest_change=MOST,
            max_steps=chains.LEASH,
        )
        left = drops(*given)(found.state)
        return found, left.lanes, left.shared + jnp.sum(left.parts, axis=1)

    bent = ((353.0, 1.21, 7.0, 1.13, 0.31), (267.0, 1.43, 3.66, 2.42, 0.38), (1834.0, 3.85, 2.27, 1.77, 1.3))
    for given in bent:
        found, lanes, shared = solve(jnp.array(given))
        assert bool(found.converged)
        assert int(found.steps) > chains.BOLD  # those before it did not arrive
        np.testing.assert_allclose(lanes, 0.0, atol=1e-9 * given[0])
        np.testing.assert_allclose(shared, 0.0, atol=1e-9 * given[0])
        water, warmth = np.asarray(found.state.lanes)[0, 0]
        assert 0.0 < water < 0.5
        assert 0.3 < warmth < given[1]
    assert int(solve(jnp.array([1.0, 0.6, 2.0, 1.0, 0.1]))[0].steps) < 20  # mild ones arrive by themselves


def falling(hold: float):
    """Three cells with two lanes: what a lane gives to the gas that rises hangs on its own moisture, on that
    of the cell before and on the gas, as the time in a cell hangs on the speed before it.
    """

    def rates(u: Cells) -> Rates:
        water, gas = u.lanes[..., 0], u.shared[:, 0]
        before = jnp.concatenate([jnp.array([[1.0, 0.7]]), water[:-1]])
        rate = 0.3 * (0.3 * before + 0.7 * water) ** 2 * (hold - gas[:, None])
        below = jnp.concatenate([gas[1:], jnp.array([0.2])])
        return Rates((before - water - rate)[..., None], 0.8 * rate[..., None], (below - gas)[:, None])

    return rates


def test_what_a_lane_gives_may_hang_on_the_cell_before() -> None:
    """One step solves the linear system of all derivatives; the solution moves with a parameter as far as two
    of them are apart.
    """
    u = Cells(jnp.linspace(0.9, 0.4, 6).reshape(3, 2, 1), jnp.array([[0.5], [0.4], [0.3]]))

    def flat(v):
        made = falling(2.0)(Cells(v[:6].reshape(3, 2, 1), v[6:].reshape(3, 1)))
        return jnp.concatenate([made.lanes.ravel(), (made.shared + jnp.sum(made.parts, axis=1)).ravel()])

    at = jnp.concatenate([u.lanes.ravel(), u.shared.ravel()])
    value, push = jax.linearize(falling(2.0), u)
    right = Cells(value.lanes, value.shared + jnp.sum(value.parts, axis=1))
    found = chains.solve_factored(chains.factor_chain(chains.chain_blocks(push, u)), right)
    whole = jnp.linalg.solve(jax.jacfwd(flat)(at), flat(at))
    np.testing.assert_allclose(
        jnp.concatenate([found.lanes.ravel(), found.shared.ravel()]), whole, rtol=1e-12
    )

    @jax.jit
    @partial(jax.value_and_grad, has_aux=True)
    def solved(hold):
        made = solve_chain(falling(hold), u, Cells(1.0, 1.0))
        return made.state.shared[0, 0], (made.converged, made.steps)

    (_value, (well, steps)), moved = solved(2.0)
    assert bool(well)
    assert int(steps) <= 8  # quadratic
    (more, _more), (less, _less) = (solved(2.0 + change)[0] for change in (1e-5, -1e-5))
    apart = (more - less) / 2e-5
    np.testing.assert_allclose(moved, apart, rtol=1e-8)
