"""Agglomeration kernels: how often two crystals meet and stay together."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law, watch
from granum.core.constants import BOLTZMANN
from granum.core.kinds import (
    DynamicViscosity,
    Fraction,
    Frequency,
    KinematicViscosity,
    Length,
    Ratio,
    SpecificPower,
    Temperature,
)
from granum.crystallization.kinds import AgglomerationRate, AgglomerationRatePerVolumes

SMALL_EDDIES = (8.0 * math.pi / 15.0) ** 0.5  # Saffman and Turner, 1.2944
WATER_VISCOSITY = 1e-6  # m²/s, kinematic, at 20 °C


class AgglomerationKernel(eqx.Module):
    """Collisions that last, per pair and volume, m³/s."""

    @abstractmethod
    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        """Kernel for two sizes."""


@law(
    "agglomeration_kernel",
    name="constant_kernel",
    source="smoluchowski1917",
    title="Constant agglomeration kernel",
    equation=r"\beta = \beta_0",
    symbols={"crystal_size_other": r"\lambda"},
)
class ConstantKernel(AgglomerationKernel):
    """The same kernel for every pair, in m³/s."""

    agglomeration_coefficient: AgglomerationRate

    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        return self.agglomeration_coefficient + 0.0 * (crystal_size + crystal_size_other)


@law(
    "agglomeration_kernel",
    name="sum_kernel",
    source="golovin1963; kumar2006",
    title="Sum kernel",
    equation=r"\beta = \beta_0 (L^3 + \lambda^3)",
    symbols={"crystal_size_other": r"\lambda"},
)
class SumKernel(AgglomerationKernel):
    """Kernel proportional to the sum of the cubes of the sizes, the coefficient in 1/s."""

    agglomeration_coefficient: Frequency

    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        return self.agglomeration_coefficient * (crystal_size**3 + crystal_size_other**3)


@law(
    "agglomeration_kernel",
    name="product_kernel",
    source="kumar2006",
    title="Product kernel",
    equation=r"\beta = \beta_0 L^3 \lambda^3",
    symbols={"crystal_size_other": r"\lambda"},
)
class ProductKernel(AgglomerationKernel):
    """Kernel proportional to the product of the cubes of the sizes; the coefficient is in 1/(m³ s) and
    everything gels at a finite time.
    """

    agglomeration_coefficient: AgglomerationRatePerVolumes

    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        return self.agglomeration_coefficient * crystal_size**3 * crystal_size_other**3


@formula(
    source="smoluchowski1917; mullin2001, ch. 7",
    title="Agglomeration by Brownian motion",
    fitted={"crystal_size": (0.0, 1e-6), "crystal_size_other": (0.0, 1e-6)},
    equation=r"\beta = \frac{2 k T}{3\eta}\,\frac{(L+\lambda)^2}{L\lambda}",
    output="agglomeration_coefficient",
    typical={"crystal_size": (1e-7, 1e-6), "crystal_size_other": (1e-7, 1e-6)},
    symbols={"agglomeration_coefficient": r"\beta", "crystal_size_other": r"\lambda"},
)
def agglomeration_coefficient_brownian(
    crystal_size: Length,
    crystal_size_other: Length,
    dynamic_viscosity: DynamicViscosity,
    temperature: Temperature = 298.15,
) -> AgglomerationRate:
    """Kernel of agglomeration by Brownian motion (perikinetic), m³/s, every collision lasting.

    For equal sizes it is 8kT/(3η), whatever the size.

    Brownian motion rules below a micrometer; above, shear does.

    >>> k = agglomeration_coefficient_brownian(
    ...     crystal_size=1e-6, crystal_size_other=1e-6, dynamic_viscosity=1e-3
    ... )
    >>> round(k * 1e17, 3)
    1.098
    """
    L, other = crystal_size, crystal_size_other
    return 2.0 * BOLTZMANN * temperature / (3.0 * dynamic_viscosity) * (L + other) ** 2 / (L * other)


@formula(
    source="saffman1956; smoluchowski1917",
    title="Agglomeration by turbulent shear",
    fitted={"eddy_ratio": (0.0, 1.0)},
    equation=r"\beta = \sqrt{\tfrac{8\pi}{15}}\,\psi\,\dot\gamma\,\frac{(L+\lambda)^3}{8}",
    output="agglomeration_coefficient",
    typical={"shear_rate": (10.0, 1000.0), "capture_efficiency": (0.01, 1.0)},
    symbols={"agglomeration_coefficient": r"\beta", "crystal_size_other": r"\lambda"},
)
def agglomeration_coefficient_turbulent(
    crystal_size: Length,
    crystal_size_other: Length,
    shear_rate: Frequency,
    capture_efficiency: Fraction = 1.0,
) -> AgglomerationRate:
    """Kernel of agglomeration in the small eddies of turbulence (orthokinetic) after Saffman and Turner,
    m³/s.

    The shear rate is ``sqrt(power per mass / kinematic viscosity)``; sizes below the smallest eddies. In
    laminar shear the factor is 4/3.

    The smallest eddies are taken as those of water, √(10⁻⁶ m²/s over the shear rate); a thicker liquid has
    larger ones.

    >>> k = agglomeration_coefficient_turbulent(
    ...     crystal_size=10e-6, crystal_size_other=10e-6, shear_rate=100.0
    ... )
    >>> round(k * 1e13, 3)
    1.294
    """
    eddy = jnp.sqrt(WATER_VISCOSITY / shear_rate)
    watch(eddy_ratio=jnp.maximum(crystal_size, crystal_size_other) / eddy)
    return SMALL_EDDIES * capture_efficiency * shear_rate * (crystal_size + crystal_size_other) ** 3 / 8.0


@formula(
    source="saffman1956",
    title="Shear rate in turbulence",
    equation=r"\dot\gamma = \sqrt{\varepsilon/\nu}",
    output="shear_rate",
)
def shear_rate_turbulent(
    specific_power_input: SpecificPower, kinematic_viscosity: KinematicViscosity
) -> Frequency:
    """Mean shear rate in the smallest eddies of a stirred suspension, from the power per mass in W/kg.

    >>> round(shear_rate_turbulent(specific_power_input=1.0, kinematic_viscosity=1e-6))
    1000
    """
    return jnp.sqrt(specific_power_input / kinematic_viscosity)


@law(
    "agglomeration_kernel",
    name="brownian_kernel",
    source="smoluchowski1917; mullin2001, ch. 7",
    fitted={"crystal_size": (0.0, 1e-6), "crystal_size_other": (0.0, 1e-6)},
    title="Brownian (perikinetic) kernel",
    equation=r"\beta = \frac{2 k T}{3\eta}\frac{(L+\lambda)^2}{L\lambda}",
    symbols={"crystal_size_other": r"\lambda"},
)
class BrownianKernel(AgglomerationKernel):
    """Agglomeration by Brownian motion, for crystals below a micrometer.

    Brownian motion rules below a micrometer; above, shear does.
    """

    dynamic_viscosity: DynamicViscosity
    temperature: Temperature = 298.15
    capture_efficiency: Fraction = 1.0

    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        L, other = crystal_size, crystal_size_other
        return (
            self.capture_efficiency
            * 2.0
            * BOLTZMANN
            * self.temperature
            / (3.0 * self.dynamic_viscosity)
            * (L + other) ** 2
            / (L * other)
        )


@law(
    "agglomeration_kernel",
    name="turbulent_kernel",
    source="saffman1956",
    title="Turbulent shear (orthokinetic) kernel",
    equation=r"\beta = \sqrt{\tfrac{8\pi}{15}}\,\psi\,\dot\gamma\,(L+\lambda)^3/8",
    symbols={"crystal_size_other": r"\lambda"},
)
class TurbulentKernel(AgglomerationKernel):
    """Agglomeration in the small eddies of a stirred suspension, with the share of collisions that last."""

    shear_rate: Frequency
    capture_efficiency: Fraction = 1.0

    def __call__(self, crystal_size: Length, crystal_size_other: Length) -> AgglomerationRate:
        return (
            SMALL_EDDIES
            * self.capture_efficiency
            * self.shear_rate
            * (crystal_size + crystal_size_other) ** 3
            / 8.0
        )


class Breakage(eqx.Module):
    """How often a crystal breaks and into what."""

    @abstractmethod
    def __call__(self, crystal_size: Length) -> Frequency:
        """Breakages per second of a crystal."""

    @abstractmethod
    def daughters(self, low: Any, high: Any, parent: Any) -> tuple[Any, Any]:
        """Number, and volume share, of the fragments of a parent (its volume) that lie between two
        volumes.
        """


@law(
    "breakage_law",
    name="power_breakage",
    source="ziff1985; austin1984",
    title="Breakage with a power of size, uniform fragments",
    equation=r"S = S_0 (L/L_{ref})^p,\quad b(v, v') = 2/v'",
    symbols={"reference_size": "L_{ref}"},
)
class PowerBreakage(Breakage):
    """Breakage frequency as a power of size; each break gives two fragments, every split of the volume being
    as likely.
    """

    breakage_frequency: Frequency
    reference_size: Length
    breakage_exponent: Ratio = 3.0

    def __call__(self, crystal_size: Length) -> Frequency:
        return (
            self.breakage_frequency
            * (jnp.asarray(crystal_size) / self.reference_size) ** self.breakage_exponent
        )

    def daughters(self, low: Any, high: Any, parent: Any) -> tuple[Any, Any]:
        a, b = jnp.minimum(low, parent), jnp.minimum(high, parent)
        return 2.0 * (b - a) / parent, (b**2 - a**2) / parent**2


@law(
    "breakage_law",
    name="attrition",
    source="garside1985",
    fitted={"chip_fraction": (0.0, 0.5)},
    title="Attrition: small chips from large crystals",
    equation=r"S = S_0 (L/L_{ref})^p,\quad \text{chips of volume share } w",
    symbols={"reference_size": "L_{ref}"},
)
class Attrition(Breakage):
    """Chipping: each event takes a small share of the volume off a crystal as chips spread evenly in volume
    up to that share.

    The parent keeps the rest; the number of chips follows from their mean volume.

    A chip can be no larger than what is left: the share of an event is at most a half.
    """

    breakage_frequency: Frequency
    reference_size: Length
    breakage_exponent: Ratio = 3.0
    chip_fraction: Fraction = 0.01

    def __call__(self, crystal_size: Length) -> Frequency:
        return (
            self.breakage_frequency
            * (jnp.asarray(crystal_size) / self.reference_size) ** self.breakage_exponent
        )

    def daughters(self, low: Any, high: Any, parent: Any) -> tuple[Any, Any]:
        w = self.chip_fraction
        top = w * parent
        a, b = jnp.minimum(low, top), jnp.minimum(high, top)
        # Chips even in volume on [0, w v]: number n with mean w v / 2 holding the volume w v makes n = 2.
        core = (1.0 - w) * parent
        here = (core >= low) & (core < high)
        return 2.0 * (b - a) / top + here, w * (b**2 - a**2) / top**2 + (1.0 - w) * here
