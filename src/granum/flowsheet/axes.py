"""Further particle axes, such as moisture or porosity, as the few distributions that feeds and holdups have
over them.

Units leave an axis alone that they do not know, so that along it every stream is a sum of the distributions
it was fed with. A line that carries the shares of these instead of all classes gives the same answer, sooner.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import prod
from typing import Any, NamedTuple

import equinox as eqx
import jax
import numpy as np

from granum.flowsheet.sheet import Flowsheet
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

SAME = 1e-9  # shares that differ by less are of one distribution


class Gathered(NamedTuple):
    """A line in the shares of distributions over its further axes.

    Parameters
    ----------
    line, holdups: as given, with one axis ``part`` in place of the further axes, which a unit
        that knows one of them keeps in place.
    parts: the distributions, each adding up to 1, shape (parts, classes of all further axes).
    mixture: that of the line as given.
    """

    line: Flowsheet
    holdups: dict[str, Any]
    parts: Any
    mixture: Mixture

    def spread(self, stream: Stream) -> Stream:
        """A stream (or many, with leading axes) in the classes of all axes again."""
        if stream.mixture == self.mixture:
            return stream
        solid = stream.solid @ self.parts
        shape = (*solid.shape[:-1], *self.mixture.solid_shape[2:])
        fields = {name: getattr(stream, name) for name in ("liquid", "gas", "temperature", "pressure")}
        return Stream(solid.reshape(shape), **fields, mixture=self.mixture)


def gather_axes(line: Flowsheet, holdups: Mapping[str, Any] | None = None) -> Gathered:
    """The line with the further axes of its solids gathered, or as it is where a unit knows one of them.

    Parameters
    ----------
    line: a flowsheet with numbers in its feeds, not traced.
    holdups: what units hold at the start (see ``march``).
    """
    mixture = next(iter(line.feeds.values())).mixture
    shape = mixture.solid_shape
    classes = prod(shape[2:])
    held = dict(holdups or {})

    names = {name for name, _edges in mixture.axes}
    if classes == 1 or any(names & set(unit.known_axes) for unit in line.units.values()):
        return Gathered(line, held, np.eye(1), mixture)

    def is_solid(leaf: Any) -> bool:
        return eqx.is_array(leaf) and leaf.shape[-len(shape) :] == shape

    def rows(solid: Any) -> tuple[np.ndarray, np.ndarray]:
        flat = np.asarray(solid, dtype=float).reshape(-1, classes)
        total = flat.sum(axis=1)
        return total, flat / np.where(total > 0, total, 1.0)[:, None]

    given = [feed.solid for feed in line.feeds.values()] + [
        leaf for leaf in jax.tree.leaves(held) if is_solid(leaf)
    ]
    left = np.concatenate([shares[total > 0] for total, shares in map(rows, given)])
    parts = [np.eye(classes)[0]]  # where units put what they hold at a start-up
    while len(parts) < classes and len(left := left[np.abs(left - parts[-1]).max(axis=1) > SAME]):
        parts.append(left[0])
    basis = np.stack(parts) if len(parts) < classes else np.eye(classes)
    few = replace(mixture, axes=(("part", tuple(float(i) for i in range(len(basis) + 1))),))

    def gathered(solid: Any) -> Any:
        lead = solid.shape[: solid.ndim - len(shape) + 2]
        if len(basis) == classes:
            return solid.reshape(*lead, classes)
        total, shares = rows(solid)
        nearest = np.abs(shares[:, None] - basis).max(axis=2).argmin(axis=1)
        return (total[:, None] * np.eye(len(basis))[nearest]).reshape(*lead, len(basis))

    feeds = {
        n: Stream(gathered(f.solid), f.liquid, f.gas, f.temperature, f.pressure, few)
        for n, f in line.feeds.items()
    }
    links = {k.name: (k.origin, k.target) for k in line.links}
    held = {
        n: jax.tree.map(lambda leaf: gathered(leaf) if is_solid(leaf) else leaf, state)
        for n, state in held.items()
    }
    return Gathered(Flowsheet({n: line.units[n] for n in line.order}, feeds, links), held, basis, mixture)
