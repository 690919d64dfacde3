"""Dryers at random ordinary settings: a solution without contradiction, or the dryer's own words that there
is none.
"""

from __future__ import annotations

from typing import Any, get_type_hints

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.dryer_settings import (
    BY_BALANCE,
    HUMID_GAS,
    MORE_AIR_DRIES,
    NUMBERS,
    PRODUCT,
    WITH_CELLS,
    Setting,
)
from tests.sharing.samples import SAMPLES

from granum.core.kinds import kind_of
from granum.drying.gas_solid.dryer import PLAIN
from granum.drying.gas_solid.kinetics import Meeting
from granum.drying.gas_solid.liquor import counted
from granum.drying.gas_solid.matter import Matter
from granum.flowsheet.findings import CLOSURE, LEAST, SATURATED, WRONG
from granum.streams.audit import closure
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream

COOL = {"compiler_options": PLAIN} if jax.default_backend() == "cpu" else {}
AIR = 1.2  # more of it for the second run of each
SLACK = 1e-6
# each setting by itself: a batch takes as long as the slowest of it, and some take a hundred times the usual
ONE_BY_ONE = ("spray counter-current",)


def told(unit: Any, inlets: dict[str, Stream]) -> tuple[Any, Any, Any]:
    """What leaves, its figures, and whether the unit says that this is no solution."""
    made = unit.operate(**inlets)
    lost = [jnp.any(r.mask) for r in made.records if r.bit & WRONG]
    return made.outlets, made.figures, jnp.any(jnp.stack(lost)) if lost else jnp.asarray(False)


def general(inlets: dict[str, Stream], out: Any, figures: Any) -> dict[str, Any]:
    """What no unit may do, whatever it is: each of these is refused with the stream or figure named."""
    outlets = [s for s in out if isinstance(s, Stream)]
    power = sum((getattr(out, p) for p in ("heat_duty", "shaft_power") if hasattr(out, p)), jnp.zeros(()))
    found = closure(inlets.values(), outlets, power)
    largest = jnp.max(jnp.stack([s.mass_flow for s in inlets.values()]))
    humid = HumidMixture(outlets[0].mixture)
    saturation = jnp.stack(
        [jnp.where(s.gas_flow > 1e-9 * largest, humid.relative_humidity(s), 0.0) for s in outlets]
    )
    least = jnp.min(
        jnp.stack([jnp.min(part, initial=0.0) for s in outlets for part in (s.solid, s.liquid, s.gas)])
    )
    hints = get_type_hints(type(figures), include_extras=True)
    there = {n: v for n, v in figures._asdict().items() if v is not None}  # what a dryer has
    kept = [_possible(kind_of(hints[n]), jnp.asarray(v)) for n, v in there.items()]
    return {
        "mass": found.mass <= CLOSURE,
        "energy": found.energy <= CLOSURE,
        "flows": least / largest >= LEAST,
        "saturation": jnp.all(saturation <= SATURATED),
        **dict(zip(there, kept, strict=True)),
    }


def _possible(kind: Any, value: Any) -> Any:
    """Finite and within the bounds of its kind, but for rounding."""
    slack = 1e-9 * jnp.maximum(jnp.abs(value), 1.0)
    return jnp.all(jnp.isfinite(value) & (value >= kind.lower - slack) & (value <= kind.upper + slack))


def convective(setting: Setting, out: Any) -> dict[str, Any]:
    """What dries in a gas stays between the temperatures and moistures that the gas can bring about."""
    feed, gas, product = setting.inlets["feed"], setting.inlets["gas"], out.product
    gases = entering(setting)
    matter = Matter.of(counted(feed), gas)
    Y, gone = gas.gas[1] / gas.gas[0], out.exhaust.gas[1] / out.exhaust.gas[0]
    X, left = feed.moisture_dry_basis, product.moisture_dry_basis
    kinetics = getattr(setting.unit, "kinetics", None)
    most = jnp.max(jnp.stack([feed.temperature, *(g.temperature for g in gases)]))
    at = Meeting(
        jnp.stack([left]),
        most + jnp.zeros(1),
        gas.temperature + jnp.zeros(1),
        Y + jnp.zeros(1),
        jnp.ones(1),
        matter,
    )
    rest = 0.0 if kinetics is None else kinetics.equilibrium(at)[0]
    moist = at._replace(
        humidity=jnp.maximum(gone, Y) + jnp.zeros(1), gas_temperature=feed.temperature + jnp.zeros(1)
    )
    wettest = 0.0 if kinetics is None else kinetics.equilibrium(moist)[0]
    condenses = matter.relative_humidity(feed.temperature, jnp.maximum(gone, Y)) > 0.9
    wet_bulbs = [by_itself(matter, left, g).wet_bulb[0] for g in gases]
    lowest = jnp.min(jnp.stack([feed.temperature, *wet_bulbs])) - 3.0
    return {
        "drier than equilibrium": left >= jnp.minimum(rest, X) * (1.0 - SLACK) - SLACK,
        "wetter than the feed": condenses | (left <= jnp.maximum(X, wettest) + SLACK),
        "too hot": (left > X + SLACK)
        | ((product.temperature <= most + 0.01) & (out.exhaust.temperature <= most + 0.01)),
        "too cold": (product.temperature >= lowest) & (out.exhaust.temperature >= lowest),
    }


def entering(setting: Setting) -> list[Stream]:
    """The gases that the solid meets."""
    return [setting.inlets[port] for port in ("gas", "cooling") if port in setting.inlets]


def by_itself(matter: Matter, X: Any, gas: Stream) -> Meeting:
    """Solid of a moisture, as warm as the gas that it meets."""
    T, Y = gas.temperature + jnp.zeros(1), gas.gas[1] / gas.gas[0] + jnp.zeros(1)
    return Meeting(jnp.stack([X]), T, T, Y, jnp.ones(1), matter)


def judged(build: Any, product: Any, x: Any, more: Any) -> tuple[Any, dict[str, Any], Any, Any]:
    """Whether it refuses, what is in order, its moisture, and whether the feed dries without drinking from a
    gas that it meets.
    """
    setting = build(x, product, more)
    out, figures, lost = told(setting.unit, setting.inlets)
    found = general(setting.inlets, out, figures)
    if (
        set(setting.inlets) >= {"feed", "gas"}
        and hasattr(out, "exhaust")
        and hasattr(setting.unit, "kinetics")
    ):
        found |= convective(setting, out)
    left, feed = out.product.moisture_dry_basis, setting.inlets.get("feed", out.product)
    dries = left < feed.moisture_dry_basis
    gases, kinetics = entering(setting), getattr(setting.unit, "kinetics", None)
    if gases and kinetics is not None:
        matter = Matter.of(counted(feed), gases[0])
        rests = jnp.stack([kinetics.equilibrium(by_itself(matter, left, g))[0] for g in gases])
        dries &= jnp.all(left >= rests * (1.0 - SLACK) - SLACK)
    return lost, found, left, dries


def outcome(
    name: str, build: Any, product: str, count: int, seed: int = 11
) -> tuple[np.ndarray, dict[str, np.ndarray], np.ndarray]:
    """Of so many settings, each run again with more air: which the unit refuses, which of the others are
    wrong and in what, and the settings.
    """
    rows = np.random.default_rng(seed).random((count, NUMBERS))

    def both(x: Any) -> Any:
        return jax.vmap(lambda more: judged(build, PRODUCT[product], x, more))(jnp.array([1.0, AIR]))

    # batches of one size: a smaller one at the end would be traced and compiled besides
    batch = 1 if name in ONE_BY_ONE else next(n for n in range(min(count, 50), 0, -1) if count % n == 0)
    lost, found, left, dry = jax.jit(lambda xs: jax.lax.map(both, xs, batch_size=batch), **COOL)(rows)
    lost = np.asarray(lost)
    bad = {what: ~np.asarray(ok) & ~lost for what, ok in found.items()}
    if name in MORE_AIR_DRIES:
        left, dries = np.asarray(left), np.asarray(dry).all(axis=1) & ~lost.any(axis=1)
        bad["wetter with more air"] = np.stack(
            [dries & (left[:, 1] > left[:, 0] + SLACK * (1.0 + left[:, 0]))] * 2, axis=1
        )
    return lost, bad, rows


ALL = WITH_CELLS | BY_BALANCE | HUMID_GAS
# those that compile within a second or three
QUICK = (
    "drum",
    "freeze on trays",
    "vacuum shelves",
    "tray",
    "heat pump",
    "humidifier",
    "coil",
    "two airs",
    "burner",
)
CASES = [
    (name, product)
    for name in (ALL if SAMPLES else QUICK)
    for product in (PRODUCT if SAMPLES and name in WITH_CELLS else ("surface",))
]


@pytest.mark.parametrize(("name", "product"), CASES)
def test_settings(name: str, product: str) -> None:
    lost, bad, rows = outcome(name, ALL[name], product, SAMPLES or 60)
    print(
        f"{name}, {product}: {lost.size} tried, {lost.sum()} refused by the unit, "
        f"{bad['saturation'].sum()} for their streams"
    )
    # gas beyond saturation is refused by the line, which names the stream and the cure: an outlet asked for
    # may need more air than there is
    wrong = {what: rows[no.any(axis=1)] for what, no in bad.items() if no.any() and what != "saturation"}
    assert not wrong, {what: (len(found), found[0]) for what, found in wrong.items()}
    assert lost.mean() < 0.3
