"""``Unit``: what every piece of equipment is. It solves itself once and hands on one record; whatever else is
told of it reads that record.
"""

from __future__ import annotations

import abc
import inspect
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, final, get_type_hints

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.conversion import is_tracer
from granum.core.limits import Limit
from granum.core.packing import as_arrays, compiled, of_jax
from granum.core.steps import Step, record_steps, recorded
from granum.core.utilities import Utility
from granum.streams.stream import Stream

Limits = dict[str, Limit]
Utilities = dict[str, Utility]


STATIC = {"static": True}


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Check:
    """A practical limit with what was measured: passes when ``low ≤ value ≤ high``. Travels through jit."""

    name: str = field(metadata=STATIC)
    value: Any
    low: Any
    high: Any
    unit: str = field(metadata=STATIC)
    source: str = field(metadata=STATIC)
    quiet: bool = field(default=False, metadata=STATIC)

    @property
    def told(self) -> bool:
        """Whether a reader of the solved line needs to know."""
        return not self.quiet or float(self.value) != 0.0

    @property
    def ok(self) -> bool:
        """Whether the limit is kept."""
        return bool(float(self.low) <= float(self.value) <= float(self.high))


class Operated(NamedTuple):
    """What a unit hands on: all that is ever told of it.

    Parameters
    ----------
    outlets: streams and powers. figures: the data sheet (None, as ``checks`` are none, where only outlets
        were asked for).
    checks: the limits of the class with what was measured. inside: what was worked out on the way, for charts
        and holdups.
    records: what formulas flagged meanwhile.
    uses: the utilities of the class with how much of each is taken, SI, as far as it can be known.
    """

    outlets: Any
    figures: Any
    checks: tuple[Check, ...]
    inside: Any
    records: list[flags.Record]
    uses: dict[str, Any]


class Sheet(NamedTuple):
    """What the data sheet of a unit says: figures, checks, and how much it takes of each utility, SI."""

    figures: Any
    checks: tuple[Check, ...]
    uses: dict[str, Any]


class Unit(eqx.Module):
    """Abstract equipment. A final subclass is a frozen module declared with ``@equipment``.

    * ``inside(self, feed, …)``: the only place that solves anything; its result is handed to the other three.
    * ``outlets(self, inside, feed, …) -> Outlets``: named inlets in; a ``NamedTuple`` out whose fields are
        streams, or powers in W that the unit takes up from outside (``heat_duty``, ``shaft_power``; negative
        when it gives them off). The audit closes enthalpy in + powers = enthalpy out.
    * ``figures(self, inside, outlets, feed, …) -> NamedTuple`` annotated with kinds: the data sheet.
    * ``limits``: practical limits by name; ``measured(self, inside, outlets, figures, feed, …)`` gives a
        number for each that applies.
    * ``utilities``: power, heat, cold, materials and area taken from outside, by name (see
        ``granum.core.utilities``); ``drawn(self, inside, outlets, figures, feed, …)`` gives how much of each.
    * ``known_axes``: further axes of the solids over which the unit itself spreads what it makes.
    * ``Type.size(...)`` (class method) where sizing has a closed statement: the same equations, another
        unknown.
    """

    instead: ClassVar[Mapping[str, str]] = {}  # a setting said, and the one of an example that it displaces
    limits: ClassVar[Limits] = {}
    utilities: ClassVar[Utilities] = {}
    known_axes: ClassVar[tuple[str, ...]] = ()
    takes_dust: ClassVar[bool] = False  # whether it is there to take solid out of the gas of its feed

    def inside(self, *args: Any, **inlets: Any) -> Any:
        """What outlets, figures and limits have in common, worked out once; nothing by default."""
        return None

    @abc.abstractmethod
    def outlets(self, inside: Any, *args: Any, **inlets: Any) -> Any:
        """Outlet streams and powers."""

    @abc.abstractmethod
    def figures(self, inside: Any, outlets: Any, *args: Any, **inlets: Any) -> Any:
        """Figures of the data sheet."""

    def measured(self, inside: Any, outlets: Any, figures: Any, *args: Any, **inlets: Any) -> dict[str, Any]:
        """One number for each limit that applies."""
        return {}

    def drawn(self, inside: Any, outlets: Any, figures: Any, *args: Any, **inlets: Any) -> dict[str, Any]:
        """How much of each utility is taken, SI; ``None`` where that cannot be known of these streams."""
        return {}

    @final
    def operate(self, whole: bool = True, /, **inlets: Stream) -> Operated:
        """The one pass: everything about this unit for these inlets; without figures and checks where not
        ``whole``.
        """
        if flags.is_inner() or any(map(is_tracer, jax.tree.leaves((self, inlets)))):
            made = _passed(whole, self, inlets)
        else:
            steps = recorded()
            made, noted = of_jax(_run(whole, steps is not None, *as_arrays((self, inlets))))
            if self._is_refused(made):
                made = _passed(whole, self, inlets)  # operation by operation: a formula refuses in words
            elif steps is not None:
                steps += noted
        flags.hand_on(made.records)
        return made

    def _is_refused(self, made: Operated) -> bool:
        """Whether a formula inside has no value for these inlets."""
        own = getattr(type(self), "card", None)
        impossible = any(
            r.bit == flags.OUTSIDE_DOMAIN and (own is None or r.card != own.key) and np.any(r.mask)
            for r in made.records
        )
        return impossible or not all(np.isfinite(x).all() for x in jax.tree.leaves(made.outlets))

    @final
    def __call__(self, *args: Stream, **inlets: Stream) -> Any:
        """Outlet streams and powers, of ``operate``."""
        named = dict(zip(self.inlet_names() or (), args, strict=False))
        return self.operate(False, **named, **inlets).outlets

    def _checked(self, limit: Limit, value: Any) -> Check:
        low, high = (getattr(self, end) if isinstance(end, str) else end for end in (limit.low, limit.high))
        return Check(limit.name, value, low, high, limit.unit, limit.source, limit.quiet)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        """Pictures of what happens inside, by their heading, for the report; none by default."""
        return {}

    @classmethod
    def _ports(cls) -> list[inspect.Parameter]:
        return [
            p
            for name, p in inspect.signature(cls.outlets).parameters.items()
            if name not in ("self", "inside")
        ]

    @classmethod
    def inlet_names(cls) -> tuple[str, ...] | None:
        """Names of the inlet ports; None when any number of any name is taken (a mixer)."""
        found = cls._ports()
        if any(p.kind is inspect.Parameter.VAR_KEYWORD for p in found):
            return None
        return tuple(p.name for p in found)

    @classmethod
    def optional_inlets(cls) -> tuple[str, ...]:
        """Inlet ports that may stay open."""
        return tuple(p.name for p in cls._ports() if p.default is None)

    @classmethod
    def outlet_type(cls) -> type:
        """The named tuple of outlets."""
        return get_type_hints(cls.outlets)["return"]

    @classmethod
    def outlet_names(cls) -> tuple[str, ...]:
        """Names of the outlet ports that carry streams (powers excluded)."""
        hints = get_type_hints(cls.outlet_type())
        return tuple(name for name, hint in hints.items() if hint is Stream)

    @classmethod
    def power_names(cls) -> tuple[str, ...]:
        """Names of the powers among the outlets."""
        return tuple(n for n in cls.outlet_type()._fields if n not in cls.outlet_names())


class Dynamic(abc.ABC):
    """What a unit with a holdup adds for a line in time. Steady state and dynamics are the same equations.

    The state is a pytree of arrays; ``advance`` returns it and the outlets (without powers) at the end of a
    step in which the inlets change linearly.
    """

    @abc.abstractmethod
    def initial_holdup(self, mixture: Any) -> Any:
        """The state at a start-up."""

    @abc.abstractmethod
    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Any:
        """The state that steady inlets lead to."""

    @abc.abstractmethod
    def held_mass(self, state: Any) -> Any:
        """Mass in the state, kg."""

    def prepare(self, mixture: Any, step: Any) -> Any:
        """What depends on the step alone, worked out once."""
        return None

    @abc.abstractmethod
    def advance(
        self, state: Any, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any
    ) -> tuple[Any, Any]:
        """The state and the outlets after a step."""


def _passed(whole: bool, unit: Unit, inlets: Mapping[str, Stream]) -> Operated:
    figures: Any = None
    checks: tuple[Check, ...] = ()
    uses: dict[str, Any] = {}
    with flags.collect() as records:
        inside = unit.inside(**inlets)
        outlets = unit.outlets(inside, **inlets)
        for stream in (*inlets.values(), *outlets):
            if isinstance(stream, Stream) and stream.mixture.mixing is not None:
                stream.mixture.mixing.heard(stream.liquid, stream.temperature)
        if whole:
            figures = unit.figures(inside, outlets, **inlets)
            measured = unit.measured(inside, outlets, figures, **inlets)
            checks = tuple(unit._checked(x, measured[n]) for n, x in unit.limits.items() if n in measured)
            drawn = unit.drawn(inside, outlets, figures, **inlets)
            uses = {
                name: jnp.asarray(drawn[name], dtype=float)
                for name in unit.utilities
                if drawn[name] is not None
            }
    return Operated(outlets, figures, checks, inside, records, uses)


@compiled
def _run(whole: bool, noted: bool, unit: Unit, inlets: Mapping[str, Stream]) -> tuple[Operated, list[Step]]:
    with record_steps() if noted else nullcontext([]) as steps:
        return _passed(whole, unit, inlets), steps
