"""How a batch is driven: what happens to temperature, solute and solvent in one time step.

An operation maps the contents at the start of a step and the crystal mass at its end to the contents at its
end, so that the one unknown of a step stays the growth path. Solute and solvent are totals, those inside
crystals included: a closed batch keeps them, whatever crystallizes.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.numerics.smooth import safe_divide

NEWTON_STEPS = 3  # from the temperature of the step before; what is left is corrected in the next one
DRAWS = 1024  # readings of a sensor before its errors repeat


class Contents(NamedTuple):
    """Temperature (K), total solute and solvent (kg, those in crystals included), antisolvent within the
    solvent (kg).
    """

    temperature: Any
    solute: Any
    solvent: Any
    antisolvent: Any


class Operation(eqx.Module):
    """One way of driving a batch."""

    @abstractmethod
    def start(self, solute: Any, solvent: Any) -> Contents:
        """Contents at time zero."""

    @abstractmethod
    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        """Contents at the end of a step that leaves a mass of crystals."""

    def seeing(self, moments: Any) -> Operation:
        """The same over a step that begins with crystals of such moments, where a probe looks at them."""
        return self


class Addition(eqx.Module):
    """What is added or taken off over time: functions of time that give the cumulative mass, kg.

    Parameters
    ----------
    evaporated: solvent taken off. antisolvent: antisolvent added. solute, solvent: feed solution added.
    """

    evaporated: Callable[[Any], Any] | None = None
    antisolvent: Callable[[Any], Any] | None = None
    solute: Callable[[Any], Any] | None = None
    solvent: Callable[[Any], Any] | None = None

    def applied(self, old: Contents, start: Any, end: Any) -> tuple[Any, Any, Any]:
        """Solute, solvent and antisolvent after a step."""

        def added(what: Callable[[Any], Any] | None) -> Any:
            return 0.0 if what is None else what(end) - what(start)

        more = added(self.antisolvent)
        return (
            old.solute + added(self.solute),
            old.solvent + added(self.solvent) + more - added(self.evaporated),
            old.antisolvent + more,
        )


class Programmed(Operation):
    """Temperature as a function of time, with solvent evaporated, antisolvent or feed added as given."""

    temperature: Callable[[Any], Any]
    addition: Addition = Addition()

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(jnp.asarray(self.temperature(0.0), dtype=float), solute, solvent, jnp.zeros(()))

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        return Contents(self.temperature(end), *self.addition.applied(old, start, end))


class Sensor(eqx.Module):
    """Concentrations or counts as a sensor reads them: a relative error drawn anew at each reading and kept
    until the next one.

    The draws are the same in every run, so that recipes are compared under equal errors.
    """

    deviation: Any
    interval: Any

    def read(self, true: Any, time: Any) -> Any:
        """What is read of a true value at a time."""
        draws = np.random.default_rng(1).standard_normal(DRAWS)
        turn = jnp.floor(time / self.interval).astype(int) % DRAWS
        return true * (1.0 + self.deviation * jnp.asarray(draws)[turn])


class Held(Operation):
    """Temperature by feedback from the concentration, so that the relative supersaturation is kept.

    Parameters
    ----------
    model: of the vessel, which tells concentration and solubility. supersaturation: relative, wanted.
    temperature_start, temperature_end: K, between which the temperature stays. fastest: cooling or heating,
        K/s. sensor: how the concentration is read; None without error.
    """

    model: Any
    supersaturation: Any
    temperature_start: Any
    temperature_end: Any
    fastest: Any
    sensor: Sensor | None = None

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(jnp.asarray(self.temperature_start, dtype=float), solute, solvent, jnp.zeros(()))

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        ratio = self.model.ratio(old, crystals)
        read = ratio if self.sensor is None else self.sensor.read(ratio, end)
        wanted = read / (1.0 + self.supersaturation)
        reach = self.fastest * (end - start)
        low = jnp.maximum(self.temperature_end, old.temperature - reach)
        high = jnp.minimum(self.temperature_start, old.temperature + reach)

        def saturated(T: Any) -> Any:
            return jnp.asarray(self.model.saturated(old._replace(temperature=T), crystals), dtype=float)

        T = old.temperature
        for _step in range(NEWTON_STEPS):
            value, slope = jax.jvp(saturated, (T,), (jnp.ones_like(T),))
            T = jnp.clip(T + safe_divide(wanted - value, slope), low, high)
        return old._replace(temperature=T)


class Counted(Operation):
    """Heating while the crystals in a volume of suspension are more than an upper bound, cooling while they
    are fewer than a lower one, and more slowly in between.

    Parameters
    ----------
    model: of the vessel, which tells the volume. lower, upper: 1/m³. temperature_start, temperature_end: K,
        between which the temperature stays. cooling, between, heating: K/s. sensor: how crystals are counted;
        None without error. number: crystals at the start of the step.
    """

    model: Any
    lower: Any
    upper: Any
    temperature_start: Any
    temperature_end: Any
    cooling: Any
    between: Any
    heating: Any
    sensor: Sensor | None = None
    number: Any = 0.0

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(jnp.asarray(self.temperature_start, dtype=float), solute, solvent, jnp.zeros(()))

    def seeing(self, moments: Any) -> Counted:
        return eqx.tree_at(lambda o: o.number, self, moments[0])

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        count = safe_divide(self.number, self.model.suspension(old, crystals_before), 0.0)
        read = count if self.sensor is None else self.sensor.read(count, start)
        cooled = jnp.where(read < self.lower, self.cooling, self.between)
        rate = jnp.where(read > self.upper, self.heating, -cooled)
        T = jnp.clip(old.temperature + rate * (end - start), self.temperature_end, self.temperature_start)
        return old._replace(temperature=T)


class Heat(eqx.Module):
    """Heat balance of the contents of a vessel."""

    @abstractmethod
    def capacity(self, contents: Contents, crystals: Any) -> Any:
        """Heat capacity of the suspension, J/K."""

    @abstractmethod
    def freed(self, old: Contents, crystals_before: Any, temperature: Any, crystals: Any) -> Any:
        """Heat given off (J) by contents that go to a temperature while crystals form, no solvent leaving."""


class HeatData(Heat):
    """Constant heat capacities and heat of crystallization.

    Parameters
    ----------
    liquid, crystal: J/(kg K). released: J per kg of crystal that forms.
    """

    liquid: Any
    crystal: Any
    released: Any

    def capacity(self, contents: Contents, crystals: Any) -> Any:
        return (contents.solute + contents.solvent - crystals) * self.liquid + crystals * self.crystal

    def freed(self, old: Contents, crystals_before: Any, temperature: Any, crystals: Any) -> Any:
        return self.capacity(old, crystals_before) * (old.temperature - temperature) + self.released * (
            crystals - crystals_before
        )


class Jacketed(Operation):
    """A vessel cooled through a jacket: temperature from the heat balance, exact for a step of constant heat
    release.

    Parameters
    ----------
    initial_temperature: K. jacket: jacket temperature (K) as a function of time. exchange: UA, W/K.
    """

    initial_temperature: Any
    jacket: Callable[[Any], Any]
    exchange: Any
    heat: Heat
    addition: Addition = Addition()

    def start(self, solute: Any, solvent: Any) -> Contents:
        return Contents(jnp.asarray(self.initial_temperature, dtype=float), solute, solvent, jnp.zeros(()))

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        span = end - start
        capacity = self.heat.capacity(old, crystals_before)
        rate = self.exchange * span / capacity
        fall = jnp.where(rate > 1e-9, -safe_divide(jnp.expm1(-rate), rate, 1.0), 1.0)
        jacket = 0.5 * (self.jacket(start) + self.jacket(end))
        released = self.heat.freed(old, crystals_before, old.temperature, crystals)
        gained = self.exchange * span * (jacket - old.temperature) + released
        return Contents(old.temperature + gained * fall / capacity, *self.addition.applied(old, start, end))


class Flashing(Operation):
    """A batch under vacuum: the pressure program sets the temperature, heat balance gives the solvent that
    flashes off.

    Parameters
    ----------
    temperature: K as a function of time, the boiling point of the solution at the pressure of that time.
    heat_of_vaporization: J/kg as a function of temperature.
    initial_temperature: of the charge, which flashes down to the program in the first step, K; None where it
        starts there.
    """

    temperature: Callable[[Any], Any]
    heat_of_vaporization: Callable[[Any], Any]
    heat: Heat
    initial_temperature: Any = None

    def start(self, solute: Any, solvent: Any) -> Contents:
        T = self.temperature(0.0) if self.initial_temperature is None else self.initial_temperature
        return Contents(jnp.asarray(T, dtype=float), solute, solvent, jnp.zeros(()))

    def step(self, old: Contents, start: Any, end: Any, crystals_before: Any, crystals: Any) -> Contents:
        T = self.temperature(end)
        freed = self.heat.freed(old, crystals_before, T, crystals)
        flashed = freed / self.heat_of_vaporization(0.5 * (old.temperature + T))
        return Contents(T, old.solute, old.solvent - flashed, old.antisolvent)
