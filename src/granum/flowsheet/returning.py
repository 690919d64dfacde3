"""The pressure at which a torn stream comes round: found with the rest of its loop, unless the loop loses or
gains some at every turn.

A loop is first brought near to rest with each torn stream at the pressure of the first feed. Where it comes
back at another one, it is carried round as well: some rounds as it is, everything else being held, since
steps that look ahead run away with a loss that never ends. A pressure that rises is raised by more and more:
what it meets at the next mixer holds it. If what is missing then stays missing, as where nothing makes good
for the loss of a filter, there is no such pressure: that of the feed is kept, and it is told.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.numerics.fixed_points import largest
from granum.numerics.settled import Turns

GIVEN, CARRIED = 0.0, 1.0
SAME = 1e-9  # of the pressure: what a stream may miss of it
SETTLED = 1e-4  # flows have, before anybody looks at pressures
STAYS = 0.25  # of what was missing two rounds before: so much will not go away
RISES = 24  # rounds in which a pressure is raised by what it rose, twice that, four times, …
HIGHEST = 30.0  # of the pressure before: what rises farther meets nothing that holds it
TOLD = 1e-6  # of the pressure: less than this is nothing to speak of
REASON = (
    "Every round of this loop loses or gains pressure, which nothing in the line makes good: the stream that "
    "goes round is taken up again at the pressure of the first feed. Draw in a fan or a pump with the rise "
    "that the loop needs; what it warms the stream by is then counted, too."
)


class Loop(NamedTuple):
    """Where the numbers of torn streams stand among the unknowns: ``count`` rows, each ending with its
    pressure, then how each pressure is come by.
    """

    count: int
    row: int

    def pressures(self, vector: Any) -> Any:
        """Of each torn stream, scaled."""
        return vector[: self.count * self.row].reshape(self.count, self.row)[:, -1]

    def modes(self, vector: Any) -> Any:
        """``GIVEN``, that of the first feed, or ``CARRIED``."""
        return vector[self.count * self.row :][: self.count]

    def changed(self, vector: Any, pressures: Any, modes: Any) -> Any:
        """The unknowns with other pressures and modes."""
        rows = vector[: self.count * self.row].reshape(self.count, self.row)
        rest = vector[self.count * (self.row + 1) :]
        return jnp.concatenate([jnp.ravel(rows.at[:, -1].set(pressures)), modes, rest])


class _Round(NamedTuple):
    """How many rounds pressures have been carried, or a negative number, and raised; the state before; what
    was missing two rounds before it is looked at what comes of it; and which will not come to rest.
    """

    rounds: Any
    raised: Any
    before: Any
    missing: Any
    drifting: Any


def turns(loop: Loop, returned: Callable[[Any], Any]) -> Turns:
    """For ``settle``: pressures that are missed are carried on, and given up again.

    ``returned``: which array of what a pass makes has the pressures at which torn streams come back, scaled.
    """
    carried_on = loop.count + 2  # rounds in which a change has passed every torn stream

    def begin(start: Any) -> _Round:
        # what an earlier case carried is carried on: toward a higher feed it rises as if it drifted
        no = jnp.zeros((loop.count,), bool)
        return _Round(jnp.full((), -1), jnp.zeros((), int), start, jnp.zeros((loop.count,)), no)

    def after(known: _Round, x: Any, r: Any, back: Any) -> tuple[_Round, Any, Any]:
        here, modes = loop.pressures(x), loop.modes(x)
        missing = abs(back - here)
        missed = ~(missing <= SAME * here)
        free = (modes == GIVEN) & missed & ~known.drifting
        opens = (largest(r[: loop.count * loop.row]) <= SETTLED) & jnp.any(free)
        modes = jnp.where(opens & free, CARRIED, modes)

        rising = (modes == CARRIED) & missed & (back > here) & ~opens
        low = here < HIGHEST * loop.pressures(known.before)
        raises = (known.rounds >= 0) & jnp.any(rising & low) & (known.raised < RISES)
        higher = jnp.where(rising, here + 2.0**known.raised * (back - here), here)
        onward = jnp.where(raises, higher, jnp.where(modes == CARRIED, back, here))

        rounds = jnp.where(known.rounds < 0, -1, known.rounds + ~raises)
        looks = ~opens & ~raises & (rounds == carried_on + 2)
        drifts = (modes == CARRIED) & missed & ~(missing <= STAYS * known.missing)
        at = jnp.where(drifts, loop.pressures(known.before), here)
        given_up = loop.changed(known.before, at, jnp.where(drifts, GIVEN, modes))
        following = _Round(
            jnp.where(opens, 0, jnp.where(looks, -1, rounds)),
            jnp.where(opens, 0, known.raised + raises),
            jnp.where(opens, x, known.before),
            jnp.where(rounds == carried_on, missing, known.missing),
            known.drifting | (looks & drifts),
        )
        goes_round = opens | ((rounds >= 0) & ~looks)
        turned = goes_round | (looks & jnp.any(drifts))
        return following, turned, jnp.where(goes_round, loop.changed(x, onward, modes), given_up)

    return Turns(begin, returned, after)


def told(back: Any, pressure: Any, card: str) -> flags.Record:
    """That a stream comes back at another pressure than that at which it is taken up."""
    missed = abs(back - pressure) > TOLD * pressure
    return flags.Record(missed, back, flags.EXTRAPOLATED, "pressure", card, -np.inf, np.inf, "", REASON)
