"""Moisture from which a heap of wet cake can flow like a liquid: the limits of the code for cargoes."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import Density, Fraction, MoistureWetBasis, VoidFraction
from granum.filtration.formulas.deliquoring import moisture_dry_basis_cake


@formula(
    source="imsbc2008, app. 2",
    title="Transportable moisture limit from the flow moisture point",
    equation=r"x_t = 0.9\,x_f",
    output="transportable_moisture_limit",
    typical={"flow_moisture_point": (0.05, 0.2)},
)
def transportable_moisture_limit_flow(flow_moisture_point: MoistureWetBasis) -> MoistureWetBasis:
    """Highest moisture at which a cake that can liquefy may go into a ship: nine tenths of that at which a
    sample begins to flow on the table.

    The flow table is for fines up to some 1 mm. Of iron ore fines it sometimes tells nothing, and the three
    methods of the code differ; repeated, the table scattered by 0.08 % of moisture, the Proctor–Fagerberg
    method by 0.03 (slides of the industry's workshop of 2013, opened). By hand: 0.9 of 10 %.

    >>> round(transportable_moisture_limit_flow("10 %"), 6)
    0.09
    """
    return 0.9 * flow_moisture_point


@formula(
    source="imsbc2008, app. 2",
    title="Transportable moisture limit from a compacted cake",
    equation=(r"x_t = \frac{w}{1 + w},\qquad w = \frac{S_k\,\varepsilon\,\rho_l}{(1 - \varepsilon)\,\rho_s}"),
    output="transportable_moisture_limit",
    typical={"void_fraction": (0.3, 0.5), "saturation_critical": (0.7, 0.8), "solid_density": (2500, 5000)},
    symbols={"void_fraction": r"\varepsilon", "liquid_density": r"\rho_l", "solid_density": r"\rho_s"},
)
def transportable_moisture_limit_compacted(
    void_fraction: VoidFraction,
    liquid_density: Density,
    solid_density: Density,
    saturation_critical: Fraction = 0.7,
) -> MoistureWetBasis:
    """Highest moisture at which a cake may go into a ship, by the Proctor–Fagerberg method: that which fills
    a stated share of the voids of the compacted cake.

    The share is 0.7 for concentrates and 0.8 for iron ore fines. At the same voids a heavier solid has a
    lower limit. By hand: 0.7 of a void fraction of 0.4 is 280 kg of water with 0.6 · 4200 kg of solid, a
    tenth.

    >>> round(transportable_moisture_limit_compacted(0.4, 1000.0, 4200.0), 6)
    0.1
    """
    w = moisture_dry_basis_cake.function(saturation_critical, void_fraction, liquid_density, solid_density)
    return w / (1.0 + w)
