"""Flux of a membrane against what it holds back and against pressure, as measured: the laws of the family
``membrane_flux``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law, points
from granum.core.conversion import is_tracer
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS, Concentration, PressureDrop, Series, Speed, Within
from granum.core.units import show
from granum.numerics import falling

Held = Annotated[Concentration, Within(1e-3)]


@law(
    "membrane_flux",
    name="measured_flux",
    source="cheryan1998",
    equation=r"u(\ln c) \text{ linear between points}\ (c_i,\ u_i)",
    symbols={"concentration_retentate": "c", "membrane_flux": "u", "concentration_points": "c_i"},
    title="Membrane flux by points",
)
class MeasuredFlux(eqx.Module):
    """Flux as measured over the concentration of what is held back, straight over its logarithm from one to
    the next.

    Two points are the straight line of the gel theory, whose slope is the transfer coefficient and whose
    zero the concentration of the gel. The order of the points does not matter. Thinner than the first it is
    that of the first; thicker than the last it goes on falling as between the last two, to nothing.

    >>> round(float(MeasuredFlux([10.0, 100.0], [2e-5, 1e-5])(50.0)) * 1e6, 3)
    13.01
    """

    concentration_points: Annotated[Held, Series("points")]
    flux_points: Annotated[Speed, Series("points")]

    def __check_init__(self) -> None:
        points.fall("flux_points", self.flux_points, "concentration_points", self.concentration_points)

    def __call__(self, concentration_retentate: Concentration) -> Speed:
        """Flux at a concentration."""
        known = jnp.log(jnp.asarray(self.concentration_points, dtype=float))
        at = jnp.log(jnp.maximum(jnp.asarray(concentration_retentate, dtype=float), 1e-12))
        return jnp.maximum(falling(at, known, self.flux_points), 0.0)


@law(
    "membrane_flux",
    name="measured_flux_pressure",
    source="cheryan1998",
    equation=(
        r"u = u(\Delta p)\,\frac{\ln(c_g/c)}{\ln(c_g/c_t)},\quad "
        r"u(\Delta p) \text{ linear between points}\ (\Delta p_i,\ u_i)"
    ),
    symbols={
        "concentration_retentate": "c",
        "membrane_flux": "u",
        "pressure_drop": r"\Delta p",
        "concentration_tested": "c_t",
    },
    title="Membrane flux over the pressure by points",
)
class MeasuredFluxPressure(eqx.Module):
    """Flux as measured over the pressure across the membrane, straight from nothing through the points and
    level beyond the last.

    Without more it is the same whatever the membrane holds back, as in a trial at the concentration of the
    plant. With the concentration at which it was measured and that of the gel it falls with the logarithm to
    nothing at the gel, at every pressure in the same share: our own simplification, which is right where the
    gel limits. More pressure never lessens the flux here. The order of the points does not matter.

    >>> round(float(MeasuredFluxPressure([1e5, 3e5], [1e-5, 2e-5])(2e5, 10.0)) * 1e6, 3)
    15.0
    """

    pressure_points: Annotated[Annotated[PressureDrop, Within(1.0)], Series("points")]
    flux_points: Annotated[Speed, Series("points")]
    concentration_tested: Held | None = None
    concentration_gel: Held | None = None

    def __check_init__(self) -> None:
        points.rise("flux_points", self.flux_points, "pressure_points", self.pressure_points)
        gel, tested = self.concentration_gel, self.concentration_tested
        if gel is None and tested is None:
            return
        if gel is None or tested is None:
            raise InputError(
                _(
                    "How the flux falls asks for both 'concentration_tested', at which it was measured, and "
                    "'concentration_gel', at which there is none: only one was given."
                ),
                name="concentration_tested" if gel is None else "concentration_gel",
            )
        if not is_tracer(gel) and not is_tracer(tested) and not gel > tested:
            kind = KINDS["Concentration"]
            raise InputError(
                _(
                    "A gel forms at more than what was tested: 'concentration_gel' is {gel} and "
                    "'concentration_tested' {tested}."
                ).format(gel=show(gel, kind), tested=show(tested, kind)),
                name="concentration_gel",
            )

    def __call__(self, pressure_drop: PressureDrop, concentration_retentate: Concentration) -> Speed:
        """Flux at a pressure and a concentration."""
        known = jnp.concatenate([jnp.zeros(1), jnp.asarray(self.pressure_points, dtype=float)])
        fluxes = jnp.concatenate([jnp.zeros(1), jnp.asarray(self.flux_points, dtype=float)])
        order = jnp.argsort(known)
        flux = jnp.interp(jnp.asarray(pressure_drop, dtype=float), known[order], fluxes[order])
        held = jnp.asarray(concentration_retentate, dtype=float)
        gel, tested = self.concentration_gel, self.concentration_tested
        if gel is None or tested is None:
            return flux + 0.0 * held
        return flux * jnp.maximum(jnp.log(gel / jnp.maximum(held, 1e-12)) / jnp.log(gel / tested), 0.0)

    def at(self, pressure: Any) -> Callable[[Any], Any]:
        """Flux over the concentration at a pressure."""
        return lambda concentration: self(pressure, concentration)
