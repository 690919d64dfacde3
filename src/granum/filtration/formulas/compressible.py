"""Compressible cakes: mean resistance and void fraction from local laws, and the profiles through the
cake.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    CakeResistance,
    Fraction,
    Number,
    PressureDifference,
    PressureDrop,
    Ratio,
    Series,
    VoidFraction,
    Within,
)

_NEAR = 1e-9
_TILLER = {
    "compressibility": (0.1, 0.9),
    "compaction_exponent": (0.01, 0.15),
    "characteristic_pressure": (5e3, 3e4),
    "pressure_drop": (5e4, 1e6),
}


def _off_zero(m):
    """m, or a small number in its place: which gives the limit of the formulas below."""
    return jnp.where(jnp.abs(m) < _NEAR, _NEAR, m)


def _integral(m, load):
    """∫₀^P (1 + p/p_a)^(m−1) dp / p_a with load = ln(1 + P/p_a)."""
    m = _off_zero(m)
    return jnp.expm1(m * load) / m


@formula(
    source="tiller1987",
    equation=r"\bar\alpha = \frac{\Delta p}{\int_0^{\Delta p} dp_g/\alpha_z} = \frac{\alpha_0\,(1-n)\,\Delta p/p_a}{(1 + \Delta p/p_a)^{1-n} - 1}",  # noqa: E501
    typical=_TILLER,
    symbols={"cake_resistance": r"\bar\alpha", "cake_resistance_unloaded": r"\alpha_0"},
)
def cake_resistance_tiller(
    pressure_drop: PressureDrop,
    cake_resistance_unloaded: CakeResistance,
    compressibility: Ratio,
    characteristic_pressure: PressureDrop,
) -> CakeResistance:
    """Mean specific resistance of a cake whose local resistance grows as a power of one plus the pressure on
    its solid.

    Local law α₀ (1 + p_g/p_a)ⁿ, the medium resistance neglected.

    >>> round(cake_resistance_tiller(3e4, 1e10, compressibility=0.5, characteristic_pressure=1e4) / 1e10, 6)
    1.5
    """
    load = jnp.log1p(pressure_drop / characteristic_pressure)
    return (
        cake_resistance_unloaded
        * pressure_drop
        / characteristic_pressure
        / _integral(1.0 - compressibility, load)
    )


@formula(
    source="tiller1953",
    title="Mean cake resistance from a local power law",
    equation=r"\alpha_z = \alpha_1\left(\frac{p_g}{p_0}\right)^n \Rightarrow \bar\alpha = (1-n)\,\alpha_1\left(\frac{\Delta p}{p_0}\right)^n",  # noqa: E501
    typical={"compressibility": (0.05, 0.9)},
    symbols={"cake_resistance": r"\bar\alpha", "cake_resistance_local": r"\alpha_1"},
)
def cake_resistance_local_power(
    pressure_drop: PressureDrop,
    cake_resistance_local: CakeResistance,
    compressibility: Annotated[Ratio, Within(0.0, 0.99)],
    reference_pressure: PressureDrop = 1e5,
) -> CakeResistance:
    """Mean specific resistance of a cake whose local resistance is a plain power of the pressure on its
    solid.

    >>> round(cake_resistance_local_power(4e5, 1e10, compressibility=0.5) / 1e10, 6)
    1.0
    """
    return (
        (1.0 - compressibility)
        * cake_resistance_local
        * (pressure_drop / reference_pressure) ** compressibility
    )


@formula(
    source="tiller1987",
    title="Mean void fraction of a cake (Tiller)",
    equation=(
        r"1 - \bar\varepsilon = \frac{\int_0^{\Delta p} dp_g/\alpha_z}{\int_0^{\Delta p} "
        r"dp_g/[\alpha_z(1-\varepsilon_z)]},\quad \alpha_z \propto \left(1 + \frac{p_g}{p_a}\right)^n,\ "
        r"1 - \varepsilon_z = (1 - \varepsilon_0)\left(1 + \frac{p_g}{p_a}\right)^\beta"
    ),
    typical=_TILLER,
    output="void_fraction",
    symbols={"void_fraction": r"\bar\varepsilon", "void_fraction_unloaded": r"\varepsilon_0"},
)
def void_fraction_mean_tiller(
    pressure_drop: PressureDrop,
    void_fraction_unloaded: VoidFraction,
    compressibility: Ratio,
    compaction_exponent: Ratio,
    characteristic_pressure: PressureDrop,
) -> Number:
    """Mean void fraction of a compressible cake with local solid fraction (1 − ε₀)(1 + p_g/p_a)^β.

    >>> round(
    ...     void_fraction_mean_tiller(
    ...         1e5,
    ...         void_fraction_unloaded=0.7,
    ...         compressibility=0.5,
    ...         compaction_exponent=0.0,
    ...         characteristic_pressure=1e4,
    ...     ),
    ...     6,
    ... )
    0.7
    """
    load = jnp.log1p(pressure_drop / characteristic_pressure)
    n, b = compressibility, compaction_exponent
    return 1.0 - (1.0 - void_fraction_unloaded) * _integral(1.0 - n, load) / _integral(1.0 - n - b, load)


class CakeProfile(NamedTuple):
    """Local values through a cake."""

    liquid_pressure: Annotated[PressureDifference, Series("points")]
    solids_pressure: Annotated[PressureDifference, Series("points")]
    cake_resistance_local: Annotated[CakeResistance, Series("points")]
    void_fraction_local: Annotated[Number, Series("points")]


@formula(
    source="tiller1987",
    equation=(
        r"p_g(z) = p_a\left\{\left[1 + \left(1-\frac zZ\right)\left(\left(1+\tfrac{\Delta "
        r"p}{p_a}\right)^m - 1\right)\right]^{1/m} - 1\right\},\; m = 1 - n - \beta,\quad p + p_g = "
        r"p_1,\quad \alpha_z = \alpha_0\left(1 + \frac{p_g}{p_a}\right)^n,\ 1 - \varepsilon_z = (1 - "
        r"\varepsilon_0)\left(1 + \frac{p_g}{p_a}\right)^\beta"
    ),
    title="Profiles through a compressible cake",
    symbols={
        "cake_resistance_unloaded": r"\alpha_0",
        "void_fraction_unloaded": r"\varepsilon_0",
        "cake_resistance_local": r"\alpha_z",
        "void_fraction_local": r"\varepsilon_z",
    },
)
def cake_profile(
    relative_height: Annotated[Fraction, Series("points")],
    pressure_drop: PressureDrop,
    cake_resistance_unloaded: CakeResistance,
    void_fraction_unloaded: VoidFraction,
    compressibility: Ratio,
    compaction_exponent: Ratio,
    characteristic_pressure: PressureDrop,
) -> CakeProfile:
    """Liquid pressure, pressure on the solid, local resistance and void fraction at heights above the medium
    (0 there, 1 at the slurry).

    Liquid pressure is counted from that behind the medium, whose own resistance is neglected.

    >>> round(float(cake_profile([0.0, 1.0], 1e5, 1e10, 0.7, 0.5, 0.05, 1e4).solids_pressure[0]))
    100000
    """
    n, b, pa = compressibility, compaction_exponent, characteristic_pressure
    m = _off_zero(1.0 - n - b)
    load = jnp.log1p(pressure_drop / pa)
    local = jnp.log1p((1.0 - jnp.asarray(relative_height)) * jnp.expm1(m * load)) / m
    pg = pa * jnp.expm1(local)
    return CakeProfile(
        pressure_drop - pg,
        pg,
        cake_resistance_unloaded * jnp.exp(n * local),
        1.0 - (1.0 - void_fraction_unloaded) * jnp.exp(b * local),
    )
