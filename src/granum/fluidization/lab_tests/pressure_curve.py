"""Pressure drop against gas or liquid velocity: minimum fluidization velocity and void fraction with
intervals.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.constants import STANDARD_GRAVITY
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Area, Density, Fraction, Length, Mass, PressureDrop, Ratio, Series, Speed
from granum.core.units import format_number
from granum.estimation import Fit, LabTest
from granum.fluidization.ranking import denser

OVERSHOOT, LEAST_BRANCH, CARRIED = 1.05, 4, (0.9, 1.05)


@lab_test(
    "pressure_curve",
    source="davidson1963; kunii1991, ch. 3",
    title="Minimum fluidization from the pressure-drop curve",
    equation=(
        r"\Delta p = \Delta p_w \min\left[b\,x + (1-b)\,x^2,\,1\right],\ x = U/U_{mf},\ \varepsilon_{mf} = "
        r"1 - \frac{\Delta p_w}{H_{mf} g (\rho_p - \rho_f)}"
    ),
)
class PressureCurve(LabTest):
    """Minimum fluidization velocity where the line of the fixed bed meets the plateau of the carried bed, and
    the void fraction there.

    The fixed bed is Ergun's: a viscous and an inertial part. Rows may rise and then fall in velocity: then
    the falling branch alone is fitted, since a packed bed sticks before it lifts. Points above the plateau on
    a rising branch are left out. Height is that of the bed at minimum fluidization. With mass and area the
    plateau is compared with the weight of the bed.
    """

    superficial_velocity: Annotated[Speed, Series("points")]
    pressure_drop: Annotated[PressureDrop, Series("points")]
    height: Length
    particle_density: Density
    fluid_density: Density
    mass: Mass | None = None
    area: Area | None = None

    estimates: ClassVar = {
        "minimum_fluidization_velocity": Speed,
        "plateau_pressure_drop": PressureDrop,
        "viscous_share": Fraction,
    }
    axes: ClassVar = {"superficial_velocity": Speed, "pressure_drop": PressureDrop}
    least_points: ClassVar = 6

    def fit(self) -> Fit:
        """Velocity, plateau and viscous share with 95 % intervals; the void fraction beside them."""
        denser(self.particle_density, self.fluid_density)
        U, dp = (
            np.asarray(self.superficial_velocity, dtype=float),
            np.asarray(self.pressure_drop, dtype=float),
        )
        flags: list[dict[str, Any]] = []
        keep = U > 0.0
        if not keep.any():
            raise InputError(_("The curve needs at least 2 points on the fixed bed and 2 on the plateau."))
        top = int(np.argmax(U))
        if len(U) - top >= LEAST_BRANCH and U[-1] < U[top]:
            keep &= np.arange(len(U)) >= top
            if top:
                flags.append(
                    self.note(
                        "falling branch",
                        _("The falling branch is fitted; the rising one is left out."),
                        "superficial_velocity",
                    )
                )
        high = keep & (0.7 * U[keep].max() < U)
        plateau = float(np.median(dp[high]))
        above = keep & (dp > OVERSHOOT * plateau)
        if above.any():
            keep &= ~above
            flags.append(
                self.note(
                    "overshoot",
                    _("Points above the plateau left out: {count}.").format(count=int(above.sum())),
                    "pressure_drop",
                )
            )
        low = keep & (dp < 0.9 * plateau)
        if low.sum() < 2 or (keep & ~low).sum() < 2:
            raise InputError(_("The curve needs at least 2 points on the fixed bed and 2 on the plateau."))
        start = {
            "minimum_fluidization_velocity": float(np.median(U[low] / dp[low])) * plateau,
            "plateau_pressure_drop": plateau,
            "viscous_share": 0.9,
        }

        def model(p: dict[str, Any], u: Any) -> Any:
            x, b = u / p["minimum_fluidization_velocity"], p["viscous_share"]
            return p["plateau_pressure_drop"] * jnp.minimum(b * x + (1.0 - b) * x**2, 1.0)

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            depth = self.height * STANDARD_GRAVITY * (self.particle_density - self.fluid_density)
            found: dict[str, Any] = {"bed_void_fraction": 1.0 - p["plateau_pressure_drop"] / depth}
            if self.mass is not None and self.area is not None:
                found["carried_share"] = p["plateau_pressure_drop"] / self._weight()
            return found

        if self.mass is not None and self.area is not None:
            share = plateau / self._weight()
            if not CARRIED[0] <= share <= CARRIED[1]:
                text = _(
                    "The plateau carries {share} % of the weight of the bed: channels, wall friction, "
                    "or a wrong mass."
                )
                flags.append(
                    self.note(
                        "plateau", text.format(share=format_number(100 * share, 3)), "plateau_pressure_drop"
                    )
                )
        return self.fitted(
            model,
            start,
            U,
            dp,
            keep=keep,
            derived=derived,
            flags=flags,
            bounds={"viscous_share": (0.0, 1.0), "minimum_fluidization_velocity": (0.0, np.inf)},
            kinds={"bed_void_fraction": Fraction, "carried_share": Ratio},
        )

    def _weight(self) -> Any:
        """Weight of the bed less buoyancy, per area, Pa."""
        assert self.mass is not None
        assert self.area is not None
        return self.mass * STANDARD_GRAVITY * (1.0 - self.fluid_density / self.particle_density) / self.area
