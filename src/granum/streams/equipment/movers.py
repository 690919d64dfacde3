"""Fans and pumps: what raises the pressure of a stream, drawn into the line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import PositiveNumber, Power, PressureDrop, Temperature, VolumeFlow, Within
from granum.core.limits import Limit
from granum.streams.formulas.drives import shaft_power_adiabatic, shaft_power_incompressible
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import DRIVE, FAN, MOTOR, PUMP

Efficiency = Annotated[PositiveNumber, Within(0.01, 1.0)]
SLURRY = 0.5  # of solid by volume, above which a slurry is no longer pumped


class Moved(NamedTuple):
    """The stream at a higher pressure, and the shaft power that it takes up."""

    product: Stream
    shaft_power: Any


class MoverFigures(NamedTuple):
    """Figures of a fan or a pump."""

    volume_flow: VolumeFlow
    shaft_power: Power
    temperature: Temperature


class _Mover(Unit):
    """What fans and pumps share: the shaft power warms the stream."""

    if TYPE_CHECKING:  # fields of both

        @property
        def pressure_rise(self) -> Any: ...

        @property
        def machine_efficiency(self) -> Any: ...

        @property
        def motor_efficiency(self) -> Any: ...

    utilities: ClassVar[Utilities] = DRIVE

    def outlets(self, inside: Any, feed: Stream) -> Moved:
        product = feed.replace(pressure=feed.pressure + self.pressure_rise).heated(inside)
        return Moved(product, inside)

    def drawn(self, inside: Any, outlets: Moved, figures: MoverFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_drive": outlets.shaft_power / self.motor_efficiency}


@equipment("fan", source="mccabe2005, ch. 8; turton2018, ch. 11", title="Fan or blower")
class Fan(_Mover):
    """Raises the pressure of a gas, adiabatically; dust and drops travel along.

    A line with a fan on the way of its gas counts no fan for the pressure that other units on that way lose.
    """

    pressure_rise: PressureDrop
    machine_efficiency: Efficiency = FAN
    motor_efficiency: Efficiency = MOTOR

    limits: ClassVar[Limits] = {
        "rise": Limit("pressure rise of a fan or blower", 0.0, 1e5, "Pa", "turton2018, ch. 11")
    }

    def inside(self, feed: Stream) -> Any:
        """Shaft power, W."""
        return shaft_power_adiabatic(
            feed.gas_volume_flow, feed.pressure, feed.pressure + self.pressure_rise, self.machine_efficiency
        )

    def figures(self, inside: Any, outlets: Moved, feed: Stream) -> MoverFigures:
        return MoverFigures(feed.gas_volume_flow, outlets.shaft_power, outlets.product.temperature)

    def measured(self, inside: Any, outlets: Moved, figures: MoverFigures, feed: Stream) -> dict[str, Any]:
        return {"rise": jnp.asarray(self.pressure_rise)}


@equipment("pump", source="mccabe2005, ch. 8; turton2018, ch. 11", title="Pump")
class Pump(_Mover):
    """Raises the pressure of a liquid or slurry; gas passes without work."""

    pressure_rise: PressureDrop
    machine_efficiency: Efficiency = PUMP
    motor_efficiency: Efficiency = MOTOR

    limits: ClassVar[Limits] = {
        "pumped": Limit("solids in the slurry by volume", 0.0, SLURRY, "dimensionless", "perry2008, § 18")
    }

    def inside(self, feed: Stream) -> Any:
        """Shaft power, W."""
        return shaft_power_incompressible(
            feed.slurry_volume_flow, self.pressure_rise, self.machine_efficiency
        )

    def figures(self, inside: Any, outlets: Moved, feed: Stream) -> MoverFigures:
        return MoverFigures(feed.slurry_volume_flow, outlets.shaft_power, outlets.product.temperature)

    def measured(self, inside: Any, outlets: Moved, figures: MoverFigures, feed: Stream) -> dict[str, Any]:
        return {"pumped": feed.solids_volume_fraction}
