"""What a slurry yields: solids fraction, cake moisture, dry cake per volume of filtrate, cake thickness."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Distance,
    Mass,
    MassFraction,
    Ratio,
    VoidFraction,
    Volume,
)

NO_FILTRATE = "The cake would hold all the liquid of the slurry: no filtrate is left."
TOO_HEAVY = "The dry solid alone would take more room than that."


@formula(source="carman1938", title="Mass fraction of solids by weighing", equation=r"s = \frac{M_s}{M_p}")
def solids_mass_fraction_weighed(solid_mass: Mass, slurry_mass: Mass) -> MassFraction:
    """Mass fraction of solids of a slurry from a weighed sample and its dry solid.

    >>> round(solids_mass_fraction_weighed(solid_mass="15 g", slurry_mass="1 kg"), 6)
    0.015
    """
    impossible(solid_mass > slurry_mass, solid_mass, "solid_mass", 0.0, slurry_mass)
    return solid_mass / slurry_mass


@formula(
    source="carman1938",
    title="Mass fraction of solids of a sample",
    equation=r"s = \frac{M_s}{V_p\,\rho_l + M_s\,(1 - \rho_l/\rho_s)}",
    typical={"slurry_volume": (2e-3, 1e-2)},
)
def solids_mass_fraction_sampled(
    solid_mass: Mass, slurry_volume: Volume, liquid_density: Density, solid_density: Density
) -> MassFraction:
    """Mass fraction of solids of a slurry from a sample of known volume and its dry solid.

    >>> round(
    ...     solids_mass_fraction_sampled(
    ...         solid_mass=0.2, slurry_volume="1 L", liquid_density=1000, solid_density=2000
    ...     ),
    ...     6,
    ... )
    0.181818
    """
    most = slurry_volume * solid_density
    impossible(solid_mass > most, solid_mass, "solid_mass", 0.0, most, TOO_HEAVY)
    return solid_mass / (slurry_volume * liquid_density + solid_mass * (1.0 - liquid_density / solid_density))


@formula(
    source="carman1938",
    title="Mass fraction of solids after mixing",
    equation=r"s = \frac{M_s}{\rho_l V + M_s}",
    typical={"volume": (1e-3, 1e-2)},
)
def solids_mass_fraction_mixed(solid_mass: Mass, volume: Volume, liquid_density: Density) -> MassFraction:
    """Mass fraction of solids of a slurry made from a mass of solid and a volume of clear liquid.

    >>> round(solids_mass_fraction_mixed(solid_mass=0.25, volume="1 L", liquid_density=1000), 6)
    0.2
    """
    return solid_mass / (liquid_density * volume + solid_mass)


@formula(
    source="carman1938",
    title="Void fraction of a cake",
    equation=r"\varepsilon = 1 - \frac{M}{V_g\,\rho_s}",
    typical={"dry_cake_mass": (0.1, 0.2), "cake_volume": (1.4e-4, 2e-4)},
)
def void_fraction_cake(dry_cake_mass: Mass, cake_volume: Volume, solid_density: Density) -> VoidFraction:
    """Void fraction of a cake from its volume and its dry mass.

    >>> round(void_fraction_cake(dry_cake_mass=0.236, cake_volume="145 cm^3", solid_density=2630), 2)
    0.38
    """
    most = cake_volume * solid_density
    impossible(dry_cake_mass >= most, dry_cake_mass, "dry_cake_mass", 0.0, most, TOO_HEAVY)
    return 1.0 - dry_cake_mass / (cake_volume * solid_density)


@formula(source="carman1938", equation=r"m = 1 + \frac{\varepsilon\,\rho_l}{(1 - \varepsilon)\,\rho_s}")
def wet_to_dry_mass_ratio(
    void_fraction: VoidFraction, liquid_density: Density, solid_density: Density
) -> Ratio:
    """Mass of saturated wet cake per mass of dry cake.

    Differs from the print in the notes, which have 1 + ε for 1 − ε.

    >>> round(wet_to_dry_mass_ratio(void_fraction=0.38, liquid_density=1020, solid_density=2630), 2)
    1.24
    """
    return 1.0 + void_fraction * liquid_density / ((1.0 - void_fraction) * solid_density)


@formula(
    source="ruth1935; geankoplis2003, § 14.2",
    equation=r"W = \frac{\rho_l\,s}{1 - m\,s}",
    typical={"solids_mass_fraction": (0.01, 0.3), "wet_to_dry_mass_ratio": (1.1, 2.5)},
)
def dry_cake_per_filtrate(
    solids_mass_fraction: MassFraction, liquid_density: Density, wet_to_dry_mass_ratio: Ratio = 0.0
) -> Concentration:
    """Dry cake deposited per volume of filtrate, from the solids of the slurry and the moisture of the
    cake.

    With the default ratio of zero the liquid left in the cake is neglected (W = ρ s), which a dilute slurry
    allows.

    >>> round(
    ...     dry_cake_per_filtrate(
    ...         solids_mass_fraction=0.191, liquid_density=996.9, wet_to_dry_mass_ratio=2.0
    ...     ),
    ...     1,
    ... )
    308.1
    """
    left = 1.0 - wet_to_dry_mass_ratio * solids_mass_fraction
    most = 1.0 / jnp.maximum(wet_to_dry_mass_ratio, 1.0)
    impossible(~(left > 0), solids_mass_fraction, "solids_mass_fraction", 0.0, most, NO_FILTRATE)
    return liquid_density * solids_mass_fraction / (1.0 - wet_to_dry_mass_ratio * solids_mass_fraction)


@formula(
    source="ruth1935",
    equation=r"Z = \frac{W V}{A\,(1 - \varepsilon)\,\rho_s}",
    typical={"filtrate_volume": (0.01, 1.0), "area": (0.5, 10.0)},
)
def cake_thickness(
    filtrate_volume: Volume,
    area: Area,
    dry_cake_per_filtrate: Concentration,
    void_fraction: VoidFraction,
    solid_density: Density,
) -> Distance:
    """Thickness of the cake after a volume of filtrate.

    >>> round(
    ...     cake_thickness(
    ...         filtrate_volume=2.4,
    ...         area=0.5,
    ...         dry_cake_per_filtrate=15.3,
    ...         void_fraction=0.38,
    ...         solid_density=2630,
    ...     ),
    ...     3,
    ... )
    0.045
    """
    return dry_cake_per_filtrate * filtrate_volume / (area * (1.0 - void_fraction) * solid_density)
