"""``Unit``: what every piece of equipment is. Checks with their source; figures as named tuples."""

from __future__ import annotations

import abc
import inspect
from collections.abc import Mapping
from typing import Any, NamedTuple, get_type_hints

import equinox as eqx

from granum.streams.stream import Stream


class Check(NamedTuple):
    """A practical limit: passes when ``low ≤ value ≤ high``. ``name`` is an English phrase that has a French translation."""

    name: str
    value: Any
    low: float
    high: float
    unit: str
    source: str

    @property
    def ok(self) -> bool:
        """Whether the limit is kept."""
        return bool(self.low <= float(self.value) <= self.high)


class Unit(eqx.Module):
    """Abstract equipment. A final subclass is a frozen module declared with ``@equipment``.

    * ``__call__(self, feed, …) -> Outlets``: named inlets in; a ``NamedTuple`` out whose fields are streams, or powers in W
      that the unit takes up from outside (``heat_duty``, ``shaft_power``; negative when it gives them off). The audit
      closes enthalpy in + powers = enthalpy out.
    * ``results(self, inlets, outlets) -> NamedTuple`` annotated with kinds: the figures of the data sheet.
    * ``checks(self, inlets, outlets)``: practical limits.
    * ``Type.size(...)`` (class method) where sizing has a closed statement: the same equations, another unknown.
    """

    @abc.abstractmethod
    def __call__(self, *args: Stream, **inlets: Stream) -> Any:
        """Outlet streams and powers."""

    @abc.abstractmethod
    def results(self, inlets: Mapping[str, Stream], outlets: Any) -> Any:
        """Figures of the data sheet."""

    def checks(self, inlets: Mapping[str, Stream], outlets: Any) -> tuple[Check, ...]:
        """Practical limits; none by default."""
        return ()

    def charts(self, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        """Pictures of what happens inside, by their heading, for the report; none by default."""
        return {}

    @classmethod
    def inlet_names(cls) -> tuple[str, ...] | None:
        """Names of the inlet ports; None when any number of any name is taken (a mixer)."""
        found = [p for name, p in inspect.signature(cls.__call__).parameters.items() if name != "self"]
        if any(p.kind is inspect.Parameter.VAR_KEYWORD for p in found):
            return None
        return tuple(p.name for p in found)

    @classmethod
    def optional_inlets(cls) -> tuple[str, ...]:
        """Inlet ports that may stay open."""
        return tuple(name for name, p in inspect.signature(cls.__call__).parameters.items() if p.default is None)

    @classmethod
    def outlet_type(cls) -> type:
        """The named tuple of outlets."""
        return get_type_hints(cls.__call__)["return"]

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

    The state is a pytree of arrays; ``advance`` returns it and the outlets (without powers) at the end of a step in which the inlets
    change linearly.
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
    def advance(self, state: Any, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any) -> tuple[Any, Any]:
        """The state and the outlets after a step."""
