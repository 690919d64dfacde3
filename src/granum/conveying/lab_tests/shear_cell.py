"""Shear cells: a yield locus with its Mohr circles, and the flow function of several."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.kinds import Angle, PositiveNumber, Ratio, Series, Stress, Within
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line

Strength = Annotated[Stress, Within(0.0, 1e9)]


def strength_of(cohesion: Any, angle: Any) -> Any:
    """Unconfined strength: the circle through the origin that touches the locus."""
    return 2.0 * cohesion * jnp.cos(angle) / (1.0 - jnp.sin(angle))


def circle_of(cohesion: Any, angle: Any, normal: Any, shear: Any) -> tuple[Any, Any]:
    """Center and radius of the circle through a point of steady flow that touches the locus to its left; of a
    point above the locus, which scatter makes, the circle whose locus passes nearest.
    """
    sine, cosine = jnp.sin(angle), jnp.cos(angle)
    middle = sine * cosine * cohesion + normal
    gap = middle**2 - cosine**2 * (normal**2 + shear**2 - (cosine * cohesion) ** 2)
    center = (middle - jnp.sqrt(jnp.where(gap > 0.0, gap, 0.0))) / cosine**2
    return center, sine * center + cohesion * cosine


@lab_test(
    "yield_locus",
    source="jenike1964; astm2016, D6128",
    title="Yield locus of a shear cell",
    equation=r"\tau = c + \sigma\tan\varphi",
)
class YieldLocus(LabTest):
    """Cohesion and angle of friction from shears to failure after one and the same consolidation; strength,
    consolidating stress and effective angle by Mohr's circles.

    The circle of steady flow passes through the point of preshear and touches the line. The intervals hold
    for the line of the given points; preshear counts as known.

    >>> test = YieldLocus(
    ...     stress_normal=[1000.0, 2000.0, 3000.0],
    ...     stress_shear=[1077.35, 1654.70, 2232.05],
    ...     preshear_normal=4000.0,
    ...     preshear_shear=2650.0,
    ... )
    >>> round(test.fit()["unconfined_strength"].value)
    1732
    """

    stress_normal: Annotated[Strength, Series("points")]
    stress_shear: Annotated[Strength, Series("points")]
    preshear_normal: Annotated[Stress, Within(1e-3, 1e9)]
    preshear_shear: Annotated[Stress, Within(1e-3, 1e9)]

    estimates: ClassVar = {"cohesion": Strength, "internal_friction_angle": Angle}
    holds_for: ClassVar = ("stress_normal",)
    axes: ClassVar = {"stress_normal": Stress, "stress_shear": Stress}

    def fit(self) -> Fit:
        """The line with 95 % intervals, and what its circles say."""
        x, y = np.asarray(self.stress_normal, dtype=float), np.asarray(self.stress_shear, dtype=float)
        self.above_zero("stress_shear")
        slope, intercept = straight_line(x, y)
        start = {
            "cohesion": max(intercept, 1e-3 * float(y.max())),
            "internal_friction_angle": float(np.clip(np.arctan(slope), 0.02, 1.4)),
        }
        return self.fitted(
            lambda p, s: p["cohesion"] + s * jnp.tan(p["internal_friction_angle"]),
            start,
            x,
            y,
            bounds={"cohesion": (0.0, np.inf), "internal_friction_angle": (0.0, 1.5)},
            derived=self._circles,
            kinds={
                "unconfined_strength": Strength,
                "consolidation_stress": Stress,
                "effective_friction_angle": Angle,
                "flowability": PositiveNumber,
            },
        )

    def _circles(self, p: dict[str, Any]) -> dict[str, Any]:
        cohesion, angle = p["cohesion"], p["internal_friction_angle"]
        strength = strength_of(cohesion, angle)
        center, radius = circle_of(cohesion, angle, self.preshear_normal, self.preshear_shear)
        return {
            "unconfined_strength": strength,
            "consolidation_stress": center + radius,
            "effective_friction_angle": jnp.arcsin(jnp.minimum(radius / center, 1.0 - 1e-12)),
            "flowability": (center + radius) / jnp.maximum(strength, 1e-9),
        }


@lab_test(
    "flow_function",
    source="jenike1964",
    title="Flow function of a powder",
    equation=r"\sigma_c = a + b\,\sigma_1",
)
class FlowFunction(LabTest):
    """The line of strength against consolidating stress, from the yield loci of several consolidations.

    Between the consolidations that were measured; flow functions bend towards the origin below them. With the
    flow factor of a hopper it gives ``critical_strength``.

    >>> test = FlowFunction([1300.0, 1600.0, 2000.0, 2400.0], [780.0, 850.0, 910.0, 970.0])
    >>> round(test.fit()["strength_slope"].value, 2)
    0.17
    """

    consolidation_stress: Annotated[Stress, Within(0.0, 1e9), Series("points")]
    unconfined_strength: Annotated[Strength, Series("points")]

    estimates: ClassVar = {"strength_intercept": Strength, "strength_slope": Ratio}
    holds_for: ClassVar = ("consolidation_stress",)
    axes: ClassVar = {"consolidation_stress": Stress, "unconfined_strength": Stress}

    def fit(self) -> Fit:
        """Intercept and slope with 95 % intervals."""
        x = np.asarray(self.consolidation_stress, dtype=float)
        y = np.asarray(self.unconfined_strength, dtype=float)
        slope, intercept = straight_line(x, y)
        start = {"strength_intercept": max(intercept, 0.0), "strength_slope": max(slope, 0.0)}
        return self.fitted(
            lambda p, s: p["strength_intercept"] + p["strength_slope"] * s,
            start,
            x,
            y,
            bounds={"strength_intercept": (0.0, np.inf), "strength_slope": (0.0, np.inf)},
        )
