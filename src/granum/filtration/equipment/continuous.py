"""Continuous cake filters: each point of the area forms, washes, drains and drops one cake a turn."""

from __future__ import annotations

import abc
import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import RPM, STANDARD_ATMOSPHERE
from granum.core.flags import unsolved
from granum.core.kinds import Fraction, Length, Permeability, PowerPerArea, Speed, TurningSpeed, Within
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.filtration.equipment.cake_filter import Caked, CakeFigures, CakeFilter, Plan, Slurry
from granum.filtration.formulas.constant_pressure import filtrate_volume_constant_pressure
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, PUMPED, evacuated, pumped

NO_ZONE = (
    "Wash enters, and no share of the turn is for washing: leave it out, or give 'wash_share' where the "
    "filter has one."
)
HARDEST = 1e3  # Pa, below which no filter is evacuated
PRECOAT_DENSITY = 300.0  # kg/m³, of a settled layer of filter aid
DRIVES = (
    "wakeman2005, the filters only: 100 W per square meter of drums and discs, as nameplates of 1 to 7.5 kW "
    "on 5 to 80 m² have it, and 200 of belts are our own estimate"
)


class ContinuousFilter(CakeFilter):
    """Abstract continuous filter: a turn time, and its shares for forming, washing and draining.

    ``drive_power_per_area`` is the electric power that turns it, agitator of the tank included.
    """

    drive_power_per_area: PowerPerArea = eqx.field(kw_only=True, default=100.0)

    utilities: ClassVar[Utilities] = (
        PUMPED
        | AREA
        | {
            "electric_power_vacuum": Utility("wakeman2005; turton2018, ch. 11"),
            "electric_power_drive": Utility(DRIVES),
        }
    )

    @property
    @abc.abstractmethod
    def turn_time(self) -> Any:
        """Time of one turn."""

    @property
    @abc.abstractmethod
    def shares(self) -> tuple[Any, Any, Any]:
        """Shares of the turn for forming, washing and draining."""

    def plan(self, s: Slurry, feed: Stream, wash: Stream | None = None) -> Plan:
        turn = self.turn_time
        form, washed, drained = (share * turn for share in self.shares)
        filtrate = filtrate_volume_constant_pressure(
            form,
            1.0,
            self.pressure_drop,
            s.dynamic_viscosity,
            self.resistance,
            s.dry_cake_per_filtrate,
            self.media_resistance(),
        )
        most = s.dry_cake_per_filtrate * filtrate
        loading = s.solid_flow * turn / self.area
        wash_volume = jnp.zeros(()) if wash is None else wash.liquid_volume_flow * turn / self.area
        unsolved((washed > 0.0) | ~(wash_volume > 0.0), type(self).card, reason=NO_ZONE)
        use = safe_divide(wash_volume, self.wash_flux(loading, s) * washed, 0.0)
        return Plan(
            loading,
            self.thickness(loading, s.solid_density),
            form,
            washed,
            drained,
            turn,
            s.solid_flow * turn / most,
            use,
        )

    def drawn(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        vacuum = jnp.maximum(STANDARD_ATMOSPHERE - self.pressure_drop, HARDEST)
        draining = self.shares[2] * self.area
        gas = self.gas_flow(inside, feed, STANDARD_ATMOSPHERE, vacuum) * draining
        liquid = outlets.filtrate.liquid_volume_flow + outlets.washings.liquid_volume_flow
        return {
            "electric_power_pump": pumped(liquid, self.pressure_drop),
            "electric_power_vacuum": evacuated(gas, vacuum),
            "electric_power_drive": self.drive_power_per_area * self.area,
            "area_installed": self.area,
        }


class VacuumFilter(ContinuousFilter):
    """Abstract continuous filter that sucks, and drops a cake thick enough to come off."""

    if TYPE_CHECKING:
        discharge_thickness: Any

    limits: ClassVar[Limits] = ContinuousFilter.limits | {
        "thin": Limit(
            "cake thickness for discharge", "discharge_thickness", math.inf, "m", "perry2008, § 18"
        ),
        "sectors": Limit("sum of the shares of the cycle", 0.0, 1.0, "dimensionless", "perry2008, § 18"),
        "vacuum": Limit("pressure drop under vacuum", 1e4, 8.5e4, "Pa", "perry2008, § 18"),
    }

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "thin": inside.plan.cake_thickness,
            "sectors": sum(self.shares),
            "vacuum": self.pressure_drop,
        }


@equipment(
    "rotary_vacuum_drum",
    source="geankoplis2003, § 14.2; mccabe2005, ch. 29",
    title="Rotary vacuum drum filter",
    equation=(
        r"\frac{V}{\Omega\,t_c} = \sqrt{\frac{2 f \Delta p}{t_c\,\eta\,\alpha\,W} + \left(\frac{R_s}{\alpha "
        r"W t_c}\right)^2} - \frac{R_s}{\alpha W t_c}"
    ),
)
class RotaryVacuumDrum(VacuumFilter):
    """Drum that dips into the slurry, sucks its cake on, washes it with sprays, sucks it dry and scrapes it
    off.

    The cake carries all solids of the feed; ``capacity_use`` says whether the submerged share has time enough
    to form it.
    """

    rotation_speed: TurningSpeed
    submergence: Fraction = 0.33
    wash_share: Fraction = 0.25
    deliquoring_share: Fraction = 0.2
    discharge_thickness: Length = 0.006

    limits: ClassVar[Limits] = VacuumFilter.limits | {
        "turn": Limit("rotation speed", 0.1 * RPM, 3.0 * RPM, "radian/s", "perry2008, § 18"),
        "submerged": Limit("submerged share of the drum", 0.1, 0.4, "dimensionless", "perry2008, § 18"),
    }

    @property
    def turn_time(self) -> Any:
        return 2.0 * jnp.pi / self.rotation_speed

    @property
    def shares(self) -> tuple[Any, Any, Any]:
        return self.submergence, self.wash_share, self.deliquoring_share

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "turn": self.rotation_speed,
            "submerged": self.submergence,
        }


@equipment("rotary_disc_filter", source="wakeman2005", title="Rotary vacuum disc filter")
class RotaryDiscFilter(VacuumFilter):
    """Vertical discs on a shaft, cake on both faces: much area in little room, thin cakes, poor washing.

    The area is that of all disc faces.
    """

    rotation_speed: TurningSpeed
    submergence: Fraction = 0.35
    wash_share: Fraction = 0.0
    deliquoring_share: Fraction = 0.4
    discharge_thickness: Length = 0.01

    limits: ClassVar[Limits] = VacuumFilter.limits | {
        "submerged": Limit("submerged share of the drum", 0.1, 0.5, "dimensionless", "perry2008, § 18"),
    }

    @property
    def turn_time(self) -> Any:
        return 2.0 * jnp.pi / self.rotation_speed

    @property
    def shares(self) -> tuple[Any, Any, Any]:
        return self.submergence, self.wash_share, self.deliquoring_share

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {"submerged": self.submergence}


@equipment("horizontal_belt_filter", source="wakeman2005", title="Horizontal belt filter")
class HorizontalBeltFilter(VacuumFilter):
    """Vacuum belt fed on top: quick-settling, coarse crystals and thorough washing; the cake forms with
    gravity, not against it.
    """

    belt_length: Length
    belt_speed: Annotated[Speed, Within(1e-4)]
    formation_share: Fraction = 0.3
    wash_share: Fraction = 0.4
    deliquoring_share: Fraction = 0.3
    discharge_thickness: Length = 0.004
    drive_power_per_area: PowerPerArea = eqx.field(kw_only=True, default=200.0)

    limits: ClassVar[Limits] = VacuumFilter.limits | {
        "belt": Limit("belt speed", 0.01, 0.8, "m/s", "wakeman2005")
    }

    @property
    def turn_time(self) -> Any:
        return self.belt_length / self.belt_speed

    @property
    def shares(self) -> tuple[Any, Any, Any]:
        return self.formation_share, self.wash_share, self.deliquoring_share

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {"belt": self.belt_speed}


@equipment(
    "precoat_drum",
    source="perry2008, § 18; wakeman2005",
    title="Rotary precoat drum filter",
    equation=r"R = R_s + \frac{e}{2B_p},\qquad t_{life} = \frac{2\pi\,e}{a\,\omega}",
)
class PrecoatDrum(ContinuousFilter):
    """Drum with a thick layer of filter aid, of which a knife takes a little off each turn together with the
    thin cake: for clarifying.

    The precoat resists with half its first thickness, its mean over its life. No wash, little draining.
    """

    rotation_speed: TurningSpeed
    precoat_thickness: Length
    precoat_permeability: Permeability
    knife_advance: Length
    submergence: Fraction = 0.5
    deliquoring_share: Fraction = 0.3

    limits: ClassVar[Limits] = ContinuousFilter.limits | {
        "knife": Limit(
            "knife advance over cake thickness", 1.0, math.inf, "dimensionless", "perry2008, § 18"
        ),
        "life": Limit("life of the precoat", 8 * 3600.0, math.inf, "s", "perry2008, § 18"),
    }

    utilities: ClassVar[Utilities] = ContinuousFilter.utilities | {
        "consumption_filter_aid": Utility("wakeman2005")
    }

    @property
    def turn_time(self) -> Any:
        return 2.0 * jnp.pi / self.rotation_speed

    @property
    def shares(self) -> tuple[Any, Any, Any]:
        return self.submergence, 0.0, self.deliquoring_share

    def media_resistance(self) -> Any:
        return self.medium_resistance + 0.5 * self.precoat_thickness / self.precoat_permeability

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "knife": self.knife_advance / jnp.maximum(inside.plan.cake_thickness, 1e-12),
            "life": self.precoat_thickness / self.knife_advance * self.turn_time,
        }

    def drawn(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        cut = PRECOAT_DENSITY * self.area * self.knife_advance / self.turn_time
        return super().drawn(inside, outlets, figures, feed, wash) | {"consumption_filter_aid": cut}
