"""Mother liquor shut in by crystals: the size from which they do it at their growth rate, and how much."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law
from granum.core.kinds import (
    Concentration,
    Density,
    Diffusivity,
    Distance,
    GrowthRate,
    KinematicViscosity,
    Length,
    MassRatio,
    Temperature,
    Velocity,
)
from granum.crystallization.kinds import ForwardGrowthRate, Growth, InclusionShare, Solubility

CARLSON = 0.214
LARGEST = 1e3  # m, of a crystal that never shuts anything in
_LIQUOR = {"liquor_velocity": (0.01, 0.2), "diffusivity": (5e-10, 2e-9), "kinematic_viscosity": (5e-7, 3e-6)}
_SUPERSATURATED = {"supersaturation_concentration": (1.0, 20.0), "crystal_density": (1500.0, 2500.0)}


@formula(
    source="carlson1958; elwell1975, ch. 6",
    title="Growth rate up to which crystals stay clear (Carlson)",
    equation=(
        r"G_{max} = 2\left(\frac{0.214\,D\,u}{\mathrm{Sc}^{1/3} L}\right)^{1/2}\frac{\Delta c}{\rho_c},\quad "
        r"\mathrm{Sc} = \frac{\nu}{D}"
    ),
    output="growth_rate_clear",
    typical=_LIQUOR | _SUPERSATURATED | {"crystal_size": (1e-4, 2e-3)},
)
def growth_rate_clear_carlson(
    crystal_size: Length,
    liquor_velocity: Velocity,
    supersaturation_concentration: Concentration,
    crystal_density: Density,
    diffusivity: Diffusivity,
    kinematic_viscosity: KinematicViscosity,
) -> GrowthRate:
    """Growth rate of size at which the liquor at the far end of a face is just used up: beyond it the middle
    of the face stays behind, is roofed over, and liquor is shut in.

    A laminar boundary layer along a face that takes up solute evenly; the rate of size is that of two faces.
    For crystals large enough to have a boundary layer thinner than themselves. Carlson's factor is recalled
    through Elwell and Scheel, not opened; the mass transfer of a plate with an even flux, 0.453 Re^½ Sc^⅓,
    makes it 0.205.

    A face of 1 mm in liquor at 10 cm/s with 6 kg/m³ to give off:

    >>> found = growth_rate_clear_carlson("1 mm", "10 cm/s", 6.0, 2000.0, 1e-9, 1e-6)
    >>> round(found * 1e9)
    278
    """
    Sc = kinematic_viscosity / diffusivity
    reach = CARLSON * diffusivity * liquor_velocity / (jnp.cbrt(Sc) * crystal_size)
    return 2.0 * jnp.sqrt(reach) * supersaturation_concentration / crystal_density


@formula(
    source="carlson1958; elwell1975, ch. 6",
    title="Size from which crystals shut in liquor at a growth rate (Carlson)",
    equation=(
        r"L_i = \frac{0.214\,D\,u}{\mathrm{Sc}^{1/3}}\left(\frac{2\,\Delta c}{\rho_c G}\right)^2,\quad "
        r"\mathrm{Sc} = \frac{\nu}{D}"
    ),
    output="inclusion_onset_size",
    typical=_LIQUOR | _SUPERSATURATED | {"growth_rate": (5e-8, 5e-7)},
)
def inclusion_onset_size_carlson(
    growth_rate: ForwardGrowthRate,
    liquor_velocity: Velocity,
    supersaturation_concentration: Concentration,
    crystal_density: Density,
    diffusivity: Diffusivity,
    kinematic_viscosity: KinematicViscosity,
) -> Distance:
    """Size beyond which a crystal that grows at a rate shuts in mother liquor; the inverse of the greatest
    rate of clear growth.

    Half the growth rate at the same supersaturation makes four times the size. What grows at a rate in
    proportion to its supersaturation has one size whatever the supersaturation; what grows with its square
    stays clear to a larger size the more slowly it grows. A crystal that does not grow has no such size: a
    kilometer is given.

    >>> round(inclusion_onset_size_carlson("278 nm/s", "10 cm/s", 6.0, 2000.0, 1e-9, 1e-6) * 1e3, 2)
    1.0
    """
    Sc = kinematic_viscosity / diffusivity
    grows = growth_rate > 0.0
    face = 0.5 * crystal_density * jnp.where(grows, growth_rate, 1.0)
    size = (
        CARLSON * diffusivity * liquor_velocity / jnp.cbrt(Sc) * (supersaturation_concentration / face) ** 2
    )
    return jnp.where(grows, jnp.minimum(size, LARGEST), LARGEST)


@formula(
    source="denbigh1966",
    title="Liquor in a crystal that shuts it in from a size on",
    equation=r"\bar\varphi = \varphi\left(1 - \min(1, L_i/L)^3\right)",
    output="inclusion_fraction_mean",
    typical={"crystal_size": (1e-4, 2e-3), "inclusion_onset_size": (5e-5, 1e-3)},
)
def inclusion_fraction_mean(
    crystal_size: Length, inclusion_onset_size: Distance, inclusion_fraction: InclusionShare
) -> InclusionShare:
    """Share of a crystal's volume that is liquor, where it grew clear up to a size and has a constant share
    in all that grew on later.

    That inclusions begin at a size is what Denbigh and White saw in hexamine, at some 65 µm (recalled, not
    opened); the share beyond it must be measured, as the water that dry crystals lose when they are ground
    or melted. A crystal of twice the size where they begin has seven eighths of that share.

    >>> inclusion_fraction_mean("130 um", "65 um", "1.6 %")
    0.014
    """
    clear = jnp.minimum(inclusion_onset_size / crystal_size, 1.0)
    return inclusion_fraction * (1.0 - clear**3)


class InclusionOnset(eqx.Module):
    """Size from which crystals shut in liquor, from the liquor that they grow in."""

    @abstractmethod
    def __call__(
        self,
        solute_per_solvent: MassRatio,
        temperature: Temperature,
        liquid_density: Density,
        crystal_density: Density,
    ) -> Distance:
        """Size up to which they grow clear."""


@law(
    "inclusion_onset",
    name="onset_size",
    source="denbigh1966",
    title="Inclusions from a measured size on",
    equation=r"L_s = L_i",
)
class OnsetSize(InclusionOnset):
    """Crystals shut in liquor from a size on that the microscope has shown, at the growth rate of the
    plant.
    """

    inclusion_onset_size: Distance

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        temperature: Temperature,
        liquid_density: Density,
        crystal_density: Density,
    ) -> Distance:
        return jnp.asarray(self.inclusion_onset_size) + 0.0 * crystal_density


@law(
    "inclusion_onset",
    name="onset_by_growth",
    source="carlson1958; elwell1975, ch. 6",
    title="Inclusions from the size that the growth rate leaves clear (Carlson)",
    equation=(
        r"L_s = 0.214\,D\,u\left(\frac{D}{\nu}\right)^{1/3}\left(\frac{2\,\Delta c}{\rho_c G}\right)^2,\quad "
        r"\Delta c = \rho_l\left(\frac{C}{1+C} - \frac{C^*}{1+C^*}\right)"
    ),
    typical=_LIQUOR,
)
class OnsetByGrowth(InclusionOnset):
    """Size from which crystals shut in liquor, by Carlson's bound, at the growth rate that the liquor gives
    them.

    Solubility and growth are those of the crystallizer before it; the velocity is that of the liquor past the
    crystals, in a suspension about their settling velocity. For crystals that leave with the liquor they grew
    in, as from a mixed vessel or a bed: a batch that has run down to saturation no longer tells how fast it
    grew.
    """

    growth: Growth
    solubility: Solubility
    liquor_velocity: Velocity
    diffusivity: Diffusivity
    kinematic_viscosity: KinematicViscosity

    def __call__(
        self,
        solute_per_solvent: MassRatio,
        temperature: Temperature,
        liquid_density: Density,
        crystal_density: Density,
    ) -> Distance:
        saturated = self.solubility(temperature)
        shares: list[Any] = [c / (1.0 + c) for c in (solute_per_solvent, saturated)]
        return inclusion_onset_size_carlson.function(
            self.growth(solute_per_solvent, saturated, temperature),
            self.liquor_velocity,
            liquid_density * jnp.maximum(shares[0] - shares[1], 0.0),
            crystal_density,
            self.diffusivity,
            self.kinematic_viscosity,
        )
