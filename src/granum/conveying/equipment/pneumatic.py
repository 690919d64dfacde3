"""A line that blows or sucks a solid through pipes as a thin suspension."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.conveying.formulas.pipes import pressure_gradient_pipe
from granum.conveying.formulas.pneumatic import (
    particle_friction_factor_hinkle,
    particle_velocity_hinkle,
    pressure_drop_bend,
    pressure_gradient_solid_hinkle,
    pressure_gradient_solid_konno_saito,
)
from granum.conveying.formulas.thresholds import (
    choking_punwani,
    diameter_pneumatic,
    pickup_velocity_kalman,
    saltation_velocity_matsumoto,
    saltation_velocity_rizk,
    saltation_velocity_schade,
    saltation_velocity_weber,
)
from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Distance,
    Law,
    Length,
    MassRatio,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Speed,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import FANNED, fanned

STEPS = 24
LEAST = 0.3  # of the pressure at the entrance
SOURCE = "rhodes2008, ch. 8"
UNSOLVED = (
    "The line would lose more than 70 % of the pressure at its entrance, or the gas cannot lift the solid: "
    "give a wider pipe, more gas, less solid or a shorter way."
)


class Conveyed(NamedTuple):
    """Gas and solid together at the end of the line."""

    product: Stream


class PneumaticFigures(NamedTuple):
    """Figures of a pneumatic line; velocities over the whole section, those of the gas where the solid enters
    and at the end.
    """

    gas_velocity_inlet: Speed
    gas_velocity_outlet: Speed
    saltation_velocity: Speed
    choking_velocity: Speed
    pickup_velocity: Speed
    particle_diameter: Length
    solids_loading: MassRatio
    pressure_drop: PressureDrop


class Blown(NamedTuple):
    """What the line works out: the mixed stream as it enters, gas velocity there, thresholds, particle size,
    loading, share of the volume that is solid, pressure at the end and after each step of the way.
    """

    mixed: Stream
    velocity: Any
    saltation: Any
    choking: Any
    pickup: Any
    size: Any
    loading: Any
    share: Any
    pressure: Any
    pressures: Any


@equipment(
    "pneumatic_conveyor",
    source="rhodes2008, ch. 8",
    title="Pneumatic conveyor (dilute phase)",
    equation=r"-\frac{dp}{ds} = \left(\frac{f\rho_f U_g^2}{2D} + 0.057\,G\sqrt{\frac gD}\right)(L_h + L_v) + g\left(\rho_f + \frac{G}{U_g - v_t}\right) L_v + N_b\,\Delta p_b",  # noqa: E501
)
class PneumaticConveyor(Unit):
    """Gas carries a solid through a pipe as a thin suspension: blown, with a fan before it, or sucked, with
    one behind.

    The gas brings the pressure at which the solid enters; what the line takes from it is found step by step,
    as the gas expands at constant temperature. Rise and bends lie evenly spread along the way. Particles
    count with their mass median size; gas and solid leave at the temperature of their mixture, and moisture
    neither dries nor condenses on the way. Where the solid enters, the gas speeds up without loss and then
    gives the solid its momentum. Friction of the solid is that of Konno and Saito; Hinkle's, for coarse
    grains in level pipes, is several times as much. ``particle_friction_factor``, as measured or from a
    table, takes the place of both in all straight pipe: 2 f_p G v_p/D per length with Hinkle's velocity of
    the particles. The factor λ of books that write λ μ ρ U²/(2D) is 4 f_p v_p/U.
    """

    diameter: Length
    length_horizontal: Distance
    length_vertical: Distance = 0.0
    bends: Ratio = 0.0
    bend_coefficient: Ratio = 0.5
    pipe_roughness: Length = 5e-5
    velocity_margin: PositiveNumber = 1.5
    saltation: Literal["rizk", "matsumoto", "schade", "weber"] = "rizk"
    level_friction: Literal["konno_saito", "hinkle"] = "konno_saito"
    drag: Annotated[Any, Law("drag_coefficient")] = drag_coefficient_brown_lawler
    particle_friction_factor: Ratio | None = None

    limits: ClassVar[Limits] = {
        "saltation": Limit(
            "gas velocity over that of saltation", "velocity_margin", math.inf, "dimensionless", SOURCE
        ),
        "choking": Limit(
            "gas velocity over that of choking", "velocity_margin", math.inf, "dimensionless", SOURCE
        ),
        "dilute": Limit("solid in the pipe by volume", 0.0, 0.01, "dimensionless", SOURCE),
        "gradient": Limit("pressure drop per length", 0.0, 5.0, "mbar/m", SOURCE),
        "wear": Limit("gas velocity at the end of the line", 0.0, 40.0, "m/s", "mills2016, ch. 8"),
    }

    utilities: ClassVar[Utilities] = FANNED

    def inside(self, feed: Stream, gas: Stream) -> Blown:
        mixed = (feed + gas).replace(pressure=gas.pressure)
        section = 0.25 * jnp.pi * jnp.asarray(self.diameter) ** 2
        flow = mixed.gas_volume_flow
        velocity = flow / section
        density = jnp.where(flow > 0.0, mixed.gas_density, 1.0)
        viscosity = mixed.gas_viscosity
        flux = (mixed.solid_flow + mixed.liquid_flow) / section
        some = flux > 0.0
        size = median_of(mixed.size_fractions, mixed.mixture.edges)
        size = jnp.where(mixed.solid_flow > 0.0, jnp.maximum(size, 1e-9), 1e-4)
        heavy = jnp.maximum(mixed.solid_density, 1.001 * density)
        fall = jnp.maximum(terminal_velocity(size, heavy, density, viscosity, drag=self.drag), 0.0)
        choked = choking_punwani(flux, heavy, density, fall, self.diameter)
        pickup = pickup_velocity_kalman(size, heavy, density, viscosity, self.diameter)
        loading = safe_divide(flux, density * velocity)
        lag = particle_velocity_hinkle(1.0, size, heavy)

        def gradient(pressure: Any) -> Any:
            expanded = mixed.pressure / pressure
            rho, u = density / expanded, velocity * expanded
            v, given = lag * u, self.particle_friction_factor
            if given is None:
                rubbed = pressure_gradient_solid_konno_saito.function(flux, self.diameter)
            else:
                rubbed = pressure_gradient_solid_hinkle.function(flux, v, self.diameter, given)
            level = rubbed
            if given is None and self.level_friction == "hinkle":
                reynolds = jnp.maximum(rho * (u - v) * size / viscosity, 1e-9)
                factor = particle_friction_factor_hinkle.function(
                    u, v, size, heavy, rho, self.diameter, self.drag(reynolds)
                )
                level = pressure_gradient_solid_hinkle.function(flux, v, self.diameter, factor)
            lifted = jnp.maximum(u - fall, 0.05 * u)
            weight = STANDARD_GRAVITY * (rho + safe_divide(flux, lifted))
            alone = pressure_gradient_pipe.function(u, self.diameter, rho, viscosity, self.pipe_roughness)
            way = self.length_horizontal + self.length_vertical
            bend = pressure_drop_bend.function(u, rho, loading, self.bend_coefficient)
            return (
                way * alone
                + self.length_horizontal * level
                + self.length_vertical * (rubbed + weight)
                + self.bends * bend
            )

        started = mixed.pressure - flux * lag * velocity - 0.5 * density * velocity**2
        pressures = _marched(gradient, started, LEAST * mixed.pressure)
        end = pressures[-1]
        stands = (end > LEAST * mixed.pressure) & ((velocity > 0.0) | ~some)
        unsolved(stands, type(self).card, reason=UNSOLVED)
        share = safe_divide(flux, heavy * jnp.maximum(lag * velocity, 1e-9))
        return Blown(
            mixed,
            velocity,
            self._saltation(flux, size, heavy, density, fall),
            jnp.where(some, choked.choking_velocity, 0.0),
            jnp.where(some, pickup, 0.0),
            size,
            loading,
            share,
            end,
            pressures,
        )

    def _saltation(self, flux: Any, size: Any, heavy: Any, density: Any, fall: Any) -> Any:
        d = self.diameter
        match self.saltation:
            case "rizk":
                return saltation_velocity_rizk(flux, size, density, d)
            case "matsumoto":
                return saltation_velocity_matsumoto(flux, size, heavy, density, fall, d)
            case "schade":
                return saltation_velocity_schade(flux, size, heavy, density, d)
            case _:
                return saltation_velocity_weber(flux, size, density, fall, d)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        blown: Blown = made.inside
        first = float(blown.mixed.pressure)
        if not float(blown.velocity) > 0.0:
            return {}
        way = float(self.length_horizontal) + float(self.length_vertical)
        place = np.concatenate([[0.0], way * np.linspace(0.0, 1.0, STEPS + 1)])
        pressure = np.concatenate([[first], np.asarray(blown.pressures)])
        velocity = float(blown.velocity) * first / pressure
        least = {_("saltation, where the solid enters"): blown.saltation, _("choking"): blown.choking}
        lines = [
            Curve(name, np.full(place.shape, float(speed)), "SOLID", dash)
            for (name, speed), dash in zip(least.items(), ("dash", "dot"), strict=True)
            if float(speed) > 0.0
        ]
        drawn = drawn_along(
            Axis("length", "Distance", label=_("way along the line")),
            place,
            (
                Axis("gas_velocity", "Speed"),
                [Curve(_("gas"), velocity, "GAS"), *lines],
            ),
            (
                Axis("pressure", "Pressure", zero=False),
                [Curve(_("pressure"), pressure, "ACCENT", "dashdot")],
            ),
        )
        return {_("Along the conveying line"): drawn}

    def outlets(self, inside: Blown, feed: Stream, gas: Stream) -> Conveyed:
        return Conveyed(inside.mixed.replace(pressure=inside.pressure))

    def figures(self, inside: Blown, outlets: Conveyed, feed: Stream, gas: Stream) -> PneumaticFigures:
        p = inside.mixed.pressure
        return PneumaticFigures(
            inside.velocity,
            inside.velocity * p / inside.pressure,
            inside.saltation,
            inside.choking,
            inside.pickup,
            inside.size,
            inside.loading,
            p - inside.pressure,
        )

    def measured(
        self, inside: Blown, outlets: Conveyed, figures: PneumaticFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        way = self.length_horizontal + self.length_vertical
        found = {
            "saltation": _over(inside.velocity, inside.saltation),
            "dilute": inside.share,
            "gradient": safe_divide(figures.pressure_drop, way) / 100.0,
            "wear": figures.gas_velocity_outlet,
        }
        return found | {"choking": _over(inside.velocity, inside.choking)}

    def drawn(
        self, inside: Blown, outlets: Conveyed, figures: PneumaticFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        expanded = outlets.product.gas_volume_flow  # what a blower before or behind draws in
        return {"electric_power_fan": fanned(expanded, figures.pressure_drop)}

    @classmethod
    def size(
        cls,
        solid_flow: Any,
        solids_loading: Any,
        particle_diameter: Any,
        gas_density: Any,
        velocity_margin: Any = 1.5,
        **more: Any,
    ) -> PneumaticConveyor:
        """The line whose pipe keeps a duty a margin above saltation by Rizk where the solid enters."""
        wide = diameter_pneumatic(solid_flow, solids_loading, particle_diameter, gas_density, velocity_margin)
        return cls(wide, velocity_margin=velocity_margin, **more)


def _over(velocity: Any, threshold: Any) -> Any:
    """Ratio of the two; a large number where nothing settles out."""
    return jnp.where(threshold > 0.0, safe_divide(velocity, threshold), 1e3)


def _marched(gradient: Any, pressure: Any, least: Any) -> Any:
    """Pressure at the beginning and after each step of the way by Runge and Kutta, not below the least."""
    h = 1.0 / STEPS

    def loss(p: Any) -> Any:
        return -gradient(jnp.maximum(p, least))

    def step(p: Any, _row: None) -> tuple[Any, Any]:
        a = loss(p)
        b = loss(p + 0.5 * h * a)
        c = loss(p + 0.5 * h * b)
        d = loss(p + h * c)
        after = jnp.maximum(p + h / 6.0 * (a + 2.0 * b + 2.0 * c + d), least)
        return after, after

    start = jnp.maximum(jnp.asarray(pressure, dtype=float), least)
    return jnp.append(start, jax.lax.scan(step, start, None, length=STEPS)[1])
