"""Settling velocity of a suspension against its solids concentration: the laws of the family
``settling_velocity``.

Each takes the concentration in kg/m³ and gives the velocity of the solids, downwards, in a vessel closed at
the bottom.
"""

from __future__ import annotations

from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law, points
from granum.core.kinds import (
    Concentration,
    Density,
    Law,
    PositiveNumber,
    Ratio,
    Series,
    Speed,
    VolumePerMass,
    Within,
)
from granum.numerics import falling, safe_power
from granum.particles.formulas.hindered import hindrance_richardson_zaki


@law(
    "settling_velocity",
    name="vesilind",
    source="vesilind1968",
    equation=r"v = v_0\,e^{-k C}",
    symbols={"settling_velocity": "v"},
    title="Vesilind settling velocity",
    typical={"solids_concentration": (0.5, 12.0)},
)
class Vesilind(eqx.Module):
    """Settling velocity falling exponentially with the concentration, for activated sludge.

    Good for hindered settling, about 1.5 to 12 kg/m³; below, flocs settle apart and the law runs too high.

    >>> round(float(Vesilind("6 m/hour", 0.4)(2.5)) * 3600, 4)
    2.2073
    """

    vesilind_velocity: Speed
    vesilind_coefficient: VolumePerMass

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        return self.vesilind_velocity * jnp.exp(-self.vesilind_coefficient * solids_concentration)


@law(
    "settling_velocity",
    name="takacs",
    source="takacs1991, eq. 6; alex2008",
    equation=(
        r"v = \max\left[0,\ \min\left(v_0',\ v_0\left(e^{-r_h(C-C_{ns})} - "
        r"e^{-r_p(C-C_{ns})}\right)\right)\right]"
    ),
    symbols={"settling_velocity": "v"},
    title="Takács settling velocity",
)
class Takacs(eqx.Module):
    """Settling velocity as the difference of two exponentials, from dilute flocs to hindered sludge.

    The defaults are those of the IWA benchmark plant (Alex et al. 2008); ``nonsettleable_concentration`` is
    there the fraction 0.00228 of the feed.

    >>> round(float(Takacs()(3.0)) * 86400, 2)
    84.11
    """

    takacs_velocity: Speed = 474.0 / 86400
    takacs_velocity_maximum: Speed = 250.0 / 86400
    takacs_hindered_coefficient: VolumePerMass = 0.576
    takacs_flocculant_coefficient: VolumePerMass = 2.86
    nonsettleable_concentration: Concentration = 0.0

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        X = jnp.maximum(solids_concentration - self.nonsettleable_concentration, 0.0)
        rise = jnp.exp(-self.takacs_hindered_coefficient * X) - jnp.exp(
            -self.takacs_flocculant_coefficient * X
        )
        return jnp.clip(self.takacs_velocity * rise, 0.0, self.takacs_velocity_maximum)


@law(
    "settling_velocity",
    name="cole",
    source="cole1968",
    equation=r"v = \min\left[v_{\max},\ v_1\,(C/C_1)^{-n}\right]",
    symbols={"settling_velocity": "v"},
    title="Cole settling velocity",
)
class Cole(eqx.Module):
    """Settling velocity as a falling power of the concentration, capped for dilute suspensions.

    Cole's constant ``a = v·Cⁿ`` has odd units; here it is the velocity at a reference concentration, 1 kg/m³
    unless given.

    >>> round(float(Cole("7 m/hour", 2.0)(2.5)) * 3600, 3)
    1.12
    """

    reference_velocity: Speed
    settling_exponent: PositiveNumber
    reference_concentration: Concentration = 1.0
    settling_velocity_maximum: Speed = 0.01

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        ratio = jnp.asarray(solids_concentration) / self.reference_concentration
        dilute = self.reference_velocity * safe_power(jnp.maximum(ratio, 1e-9), -self.settling_exponent)
        return jnp.minimum(self.settling_velocity_maximum, dilute)


@law(
    "settling_velocity",
    name="diehl",
    source="diehl2015",
    equation=r"v = \frac{v_0}{1 + (C/\bar{C})^q}",
    symbols={"settling_exponent": "q", "settling_velocity": "v"},
    title="Diehl settling velocity",
)
class Diehl(eqx.Module):
    """Settling velocity with a plateau for dilute and a power law for dense suspensions.

    >>> round(float(Diehl("10 m/hour", 3.0, 3.5)(3.0)) * 3600, 6)
    5.0
    """

    plateau_velocity: Speed
    half_velocity_concentration: Concentration
    settling_exponent: PositiveNumber

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        ratio = jnp.asarray(solids_concentration) / self.half_velocity_concentration
        return self.plateau_velocity / (1.0 + safe_power(ratio, self.settling_exponent))


@law(
    "settling_velocity",
    name="richardson_zaki",
    source="richardson1954",
    equation=r"v = v_0\left(1 - C/C_{\max}\right)^n",
    title="Richardson–Zaki settling velocity on concentration",
)
class RichardsonZakiConcentration(eqx.Module):
    """Settling velocity that vanishes at a packed concentration, in the form of Richardson and Zaki.

    For compact particles the packed concentration of the original law is the solid density (volume fraction
    one); for flocs it is a fitted parameter.

    >>> round(float(RichardsonZakiConcentration("1.1 mm/s", 4.65, 1200.0)(240.0)) * 1e3, 4)
    0.3897
    """

    unhindered_velocity: Speed
    settling_exponent: PositiveNumber
    packed_concentration: Concentration

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        free = 1.0 - jnp.asarray(solids_concentration) / self.packed_concentration
        return self.unhindered_velocity * safe_power(free, self.settling_exponent)


@law(
    "settling_velocity",
    name="hindered_particles",
    source="kynch1952; richardson1954",
    equation=r"v = v_t\,h(\varphi, \mathrm{Re}),\quad \varphi = C/\rho_s",
    symbols={"settling_velocity": "v"},
    title="Settling velocity of hindered particles",
)
class HinderedParticles(eqx.Module):
    """Settling velocity of particles of one terminal velocity, slowed by any hindrance law on the volume
    fraction.

    The Reynolds number is that of one particle at its terminal velocity.

    >>> round(float(HinderedParticles("1.1 mm/s", 1200.0, reynolds=0.11)(240.0)) * 1e3, 4)
    0.3897
    """

    terminal_velocity: Speed
    solid_density: Density
    reynolds: Ratio = 0.01
    hindrance: Annotated[Any, Law("hindrance")] = hindrance_richardson_zaki

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        share = jnp.clip(jnp.asarray(solids_concentration) / self.solid_density, 1e-12, 1.0 - 1e-9)
        return self.terminal_velocity * self.hindrance(share, self.reynolds)


@law(
    "settling_velocity",
    name="measured_settling",
    source="coe1916",
    equation=r"\ln v(\ln C) \text{ linear between points}\ (C_i,\ v_i)",
    symbols={"settling_velocity": "v"},
    title="Settling velocity by points",
)
class MeasuredSettling(eqx.Module):
    """Settling velocity as measured: that of each concentration that was tested, a power law from one to the
    next.

    From Coe and Clevenger's several jars, or read from one curve by Kynch's tangents. The order of the points
    does not matter. Thinner than the first it is that of the first; thicker than the last it goes on falling
    as between the last two.

    >>> round(float(MeasuredSettling([100.0, 400.0], [1e-3, 2.5e-4])(200.0)) * 1e3, 6)
    0.5
    """

    concentration_points: Annotated[Annotated[Concentration, Within(1e-3)], Series("points")]
    settling_velocity_points: Annotated[Annotated[Speed, Within(1e-12)], Series("points")]

    def __check_init__(self) -> None:
        velocities, concentrations = self.settling_velocity_points, self.concentration_points
        points.fall("settling_velocity_points", velocities, "concentration_points", concentrations)

    def __call__(self, solids_concentration: Concentration) -> Speed:
        """Velocity at a concentration."""
        known = jnp.log(jnp.asarray(self.concentration_points, dtype=float))
        velocities = jnp.log(jnp.asarray(self.settling_velocity_points, dtype=float))
        at = jnp.log(jnp.maximum(jnp.asarray(solids_concentration, dtype=float), 1e-12))
        return jnp.exp(falling(at, known, velocities))
