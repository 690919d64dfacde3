"""Permeametry: pressure drop against velocity through a layer."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    Permeability,
    PositiveNumber,
    PressureDrop,
    ReciprocalLength,
    Series,
    SpecificSurface,
    Speed,
    VoidFraction,
)
from granum.estimation import Fit, LabTest


@lab_test(
    "permeametry",
    source="forchheimer1901; carman1937",
    title="Permeametry",
    equation=r"\frac{\Delta p}{L} = \frac{\eta}{B}U + \beta\rho U^2",
)
class Permeametry(LabTest):
    """Permeability and inertial coefficient of a layer from pressure drops at several velocities; surface and
    size of its grains.

    With ``creeping`` the inertial term is left out (Darcy alone). A porosity gives the specific surface and
    the diameter of equal spheres by Kozeny and Carman, with intervals. Readings count with equal relative
    weight.

    >>> test = Permeametry(
    ...     superficial_velocity=[0.01, 0.05, 0.1, 0.2],
    ...     pressure_drop=[1.1e3, 7.5e3, 20e3, 60e3],
    ...     length=0.1,
    ...     dynamic_viscosity="1 cP",
    ...     fluid_density=1000,
    ... )
    >>> round(1e9 * test.fit()["permeability"].value, 6)
    1.0
    """

    superficial_velocity: Annotated[Speed, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]
    length: Length
    dynamic_viscosity: DynamicViscosity
    fluid_density: Density
    void_fraction: VoidFraction | None = None
    kozeny_coefficient: PositiveNumber = 5.0
    creeping: bool = False

    estimates: ClassVar = {"permeability": Permeability, "inertial_coefficient": ReciprocalLength}
    holds_for: ClassVar = ("superficial_velocity",)
    axes: ClassVar = {"superficial_velocity": Speed, "pressure_drop": PressureDrop}

    def fit(self) -> Fit:
        """Permeability, inertial coefficient and what follows from them, with 95 % intervals."""
        U, drop = (
            np.asarray(self.superficial_velocity, dtype=float),
            np.asarray(self.pressure_drop, dtype=float),
        )
        if not (U > 0.0).all():
            raise InputError(
                _("'superficial_velocity' must be above zero at every point; leave out the point at rest."),
                name="superficial_velocity",
            )
        self.above_zero("pressure_drop")
        # relative least squares, in closed form, for the start
        a, b = self.dynamic_viscosity * self.length * U / drop, self.fluid_density * self.length * U**2 / drop
        resistance = (a @ np.ones_like(a)) / (a @ a)
        start = {"permeability": 1.0 / resistance}
        if not self.creeping:
            solution = np.linalg.lstsq(np.stack([a, b], axis=1), np.ones_like(a), rcond=None)[0]
            start = {
                "permeability": 1.0 / max(solution[0], 1e-3 * resistance),
                "inertial_coefficient": max(
                    solution[1], 1e-6 * resistance * self.dynamic_viscosity / (self.fluid_density * U.max())
                ),
            }
        bounds = dict.fromkeys(start, (0.0, np.inf))
        if self.void_fraction is None:
            return self.fitted(self._model, start, U, drop, bounds=bounds, sigma=drop)
        return self.fitted(
            self._model,
            start,
            U,
            drop,
            bounds=bounds,
            sigma=drop,
            derived=self._grains,
            kinds={"specific_surface": SpecificSurface, "particle_diameter": Length},
        )

    def _model(self, p: dict[str, Any], U: Any) -> Any:
        inertial = p.get("inertial_coefficient", 0.0)
        return self.length * (
            self.dynamic_viscosity / p["permeability"] * U + inertial * self.fluid_density * U**2
        )

    def _grains(self, p: dict[str, Any]) -> dict[str, Any]:
        e = self.void_fraction
        assert e is not None
        surface = jnp.sqrt(e**3 / (self.kozeny_coefficient * p["permeability"])) / (1.0 - e)
        return {"specific_surface": surface, "particle_diameter": 6.0 / surface}
