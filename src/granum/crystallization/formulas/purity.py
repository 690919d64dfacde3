"""What makes crystals from a solution impure: lattice, inclusions, liquor that adheres."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Density, Fraction, MassFraction, MassRatio, PositiveNumber, Ratio, Within
from granum.crystallization.kinds import InclusionShare
from granum.numerics.smooth import safe_divide

TOO_MUCH = "Solute and impurity are more than the whole liquor: lower one of the two."


class Purity(NamedTuple):
    """Impurity of dry crystals and where it sits, all over the mass of the product."""

    impurity_fraction_product: MassFraction
    impurity_lattice: MassFraction
    impurity_inclusions: MassFraction
    impurity_adhering: MassFraction
    purification_factor: PositiveNumber


@formula(
    source="nyvlt1995; mullin2001, ch. 7",
    title="Purity of crystals after filter, wash and drying",
    equation=(
        r"w_P = \frac{D\,x_i/x + (b + f)\,x_i}{1 + D\,x_i/x + b + f\,(x + x_i)},\quad b = "
        r"\frac{\varphi\,\rho_l}{(1-\varphi)\,\rho_c},\quad f = r\,(1 - \eta_w)"
    ),
    output="purity",
    typical={
        "impurity_fraction_liquor": (0.005, 0.05),
        "solute_mass_fraction": (0.2, 0.5),
        "distribution_coefficient_solution": (0.001, 0.1),
        "inclusion_fraction": (0.0, 0.01),
        "liquor_per_crystals": (0.03, 0.2),
        "wash_displacement": (0.5, 0.98),
        "crystal_density": (1500.0, 2500.0),
        "liquid_density": (1050.0, 1300.0),
    },
)
def purity_of_crystals(
    impurity_fraction_liquor: MassFraction,
    solute_mass_fraction: Annotated[MassFraction, Within(1e-6, 1.0)],
    distribution_coefficient_solution: Ratio,
    inclusion_fraction: InclusionShare,
    liquor_per_crystals: MassRatio,
    wash_displacement: Fraction,
    crystal_density: Density,
    liquid_density: Density,
) -> Purity:
    """Impurity of dried crystals from the mother liquor that they grew in: built into the lattice, shut in as
    inclusions, and dried on from the liquor that filter and wash leave.

    A mass balance on the pure crystal. Inclusions keep their solvent; adhering liquor leaves its solute
    and impurity behind. The displacement is the share of that liquor which the wash replaces by pure
    solvent; what the wash dissolves is not counted. The purification factor is impurity per solute in the
    liquor over that in the product. Washing takes off only what adheres: the rest needs slower growth or
    another crystallization.

    Without lattice and inclusions: 0.1 kg of liquor with 30 % solute and 2 % impurity dries to 0.03 kg and
    0.002 kg.

    >>> out = purity_of_crystals(0.02, 0.3, 0.0, 0.0, 0.1, 0.0, 2000.0, 1200.0)
    >>> round(out.impurity_fraction_product / (0.002 / 1.032), 6)
    1.0
    """
    xi, x = impurity_fraction_liquor, solute_mass_fraction
    impossible(xi + x > 1.0, xi, "impurity_fraction_liquor", 0.0, 1.0 - x, TOO_MUCH)
    b = inclusion_fraction * liquid_density / ((1.0 - inclusion_fraction) * crystal_density)
    f = liquor_per_crystals * (1.0 - wash_displacement)
    built_in = distribution_coefficient_solution * xi / x
    total = 1.0 + built_in + b + f * (x + xi)
    solute = 1.0 + (b + f) * x
    # impurity per solute of the liquor over that of the product, without dividing by the impurity
    factor = solute / (distribution_coefficient_solution + (b + f) * x + 1e-12)
    return Purity((built_in + (b + f) * xi) / total, built_in / total, b * xi / total, f * xi / total, factor)


class SharedOut(NamedTuple):
    """Share of an impurity that the crystals hold, by either law of distribution."""

    impurity_share_homogeneous: Fraction
    impurity_share_logarithmic: Fraction


@formula(
    source="iupac1997; choppin2002, eq. 9.3; doerner1925",
    title="Impurity in crystals by homogeneous and logarithmic distribution",
    equation=r"f_h = \frac{D\,R}{1 - R + D\,R},\quad f_l = 1 - (1 - R)^D",
    output="impurity",
    typical={"distribution_coefficient_solution": (0.01, 5.0), "yield_fraction": (0.2, 0.95)},
)
def impurity_share_crystallized(
    distribution_coefficient_solution: Ratio, yield_fraction: Fraction
) -> SharedOut:
    """Share of an impurity that goes into the lattice with a share of the solute, by crystals that are even
    throughout or in layers that each keep what the liquor had when they grew (Doerner and Hoskins).

    Even: crystals that had time to recrystallize, and those of a mixed continuous vessel, whose liquor stays
    the same. Layers: a batch. Both agree while little has crystallized. Where the lattice rejects the
    impurity early layers are the purer ones, and layers hold less of it than even crystals; where it
    prefers it, more. Real crystals lie between. Barium in lead sulfate from homogeneous solution followed the
    logarithmic law with 2.33 (Bunseki Kagaku 28, 531, abstract opened): half of the lead takes four fifths of
    the barium along.

    >>> round(impurity_share_crystallized(2.33, 0.5).impurity_share_logarithmic, 3)
    0.801
    """
    D, R = distribution_coefficient_solution, yield_fraction
    left = jnp.where(R < 1.0, 1.0 - R, 1.0)
    layers = jnp.where(R < 1.0, -jnp.expm1(D * jnp.log(left)), jnp.where(D > 0.0, 1.0, 0.0))
    return SharedOut(safe_divide(D * R, 1.0 - R + D * R, 0.0), layers)
