"""Energy of size reduction: Rittinger, Kick, Bond, Walker, Hukki's ranges and Morrell; the work index and its
test.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.comminution.kinds import EnergyPerSurface, MassPerRevolution, RittingerConstant, WorkIndex
from granum.core import formula, impossible, procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Length,
    MassFlow,
    PositiveNumber,
    Power,
    Ratio,
    SpecificEnergy,
    SpecificSurface,
    Within,
)
from granum.numerics.smooth import safe_divide

HUNDRED_MICROMETERS = 1e-4
KWH_PER_SHORT_TON = 3.6e6 / 907.18474  # J/kg
KWH_PER_TONNE = 3.6e3  # J/kg
_SMALL = 1e-9


def _reduction(energy: Any, feed_size: Any, product_size: Any) -> Any:
    """No value where the product is coarser than the feed."""
    impossible(product_size > feed_size, product_size, "product_size", 0.0, feed_size)
    return jnp.where(product_size <= feed_size, energy, jnp.nan)


@formula(
    source="rittinger1867; richardson2002, ch. 2",
    equation=r"E = K_R f_c \left(\frac{1}{P} - \frac{1}{F}\right)",
    fitted={"product_size": (0.0, 1e-3)},
)
def specific_energy_rittinger(
    feed_size: Length, product_size: Length, rittinger_constant: RittingerConstant
) -> SpecificEnergy:
    """Energy in proportion to the new surface (Rittinger): for fine grinding, below 1 mm.

    The constant holds the machine's factor and the material's. A product coarser than the feed gives no
    value.

    >>> round(specific_energy_rittinger("1 mm", "0.1 mm", "10 kJ*mm/kg") / 1e3, 3)
    90.0
    >>> round(specific_energy_rittinger("75 mm", "25 mm", "162.5 kJ*mm/kg") / 1e3, 3)
    4.333
    """
    return _reduction(rittinger_constant * (1.0 / product_size - 1.0 / feed_size), feed_size, product_size)


@formula(
    source="rittinger1867; richardson2002, ch. 2",
    fitted={"specific_surface_product": (6000.0, jnp.inf)},
    equation=r"E = \frac{K\,(a_{g2} - a_{g1})}{\rho_s}",
    title="Specific energy from the new surface (Rittinger)",
    typical={"specific_surface_feed": (1e3, 5e3), "specific_surface_product": (1e4, 1e5)},
)
def specific_energy_rittinger_surface(
    specific_surface_feed: SpecificSurface,
    specific_surface_product: SpecificSurface,
    surface_energy: EnergyPerSurface,
    solid_density: Density,
) -> SpecificEnergy:
    """Energy in proportion to the new surface, from the specific surfaces per volume before and after.

    For fine grinding, as ``specific_energy_rittinger``: spheres of 1 mm have 6000 m²/m³.

    >>> round(specific_energy_rittinger_surface(6e3, 6e4, surface_energy=100.0, solid_density=2700), 3)
    2000.0
    """
    energy = surface_energy * (specific_surface_product - specific_surface_feed) / solid_density
    impossible(
        energy < 0.0, specific_surface_product, "specific_surface_product", specific_surface_feed, jnp.inf
    )
    return jnp.where(energy >= 0.0, energy, jnp.nan)


@formula(
    source="kick1885; richardson2002, ch. 2",
    equation=r"E = K_K f_c \ln\frac{F}{P}",
    fitted={"product_size": (1e-2, jnp.inf)},
    typical={"feed_size": (0.06, 0.3), "product_size": (0.011, 0.05)},
)
def specific_energy_kick(
    feed_size: Length, product_size: Length, kick_constant: SpecificEnergy
) -> SpecificEnergy:
    """Energy in proportion to the logarithm of the reduction ratio (Kick): for coarse crushing, sizes of
    centimeters.

    A product coarser than the feed gives no value.

    >>> round(specific_energy_kick("75 mm", "25 mm", "8.077 kJ/kg") / 1e3, 2)
    8.87
    """
    return _reduction(kick_constant * jnp.log(feed_size / product_size), feed_size, product_size)


@formula(
    source="bond1952; bond1961",
    fitted={"product_size": (4e-5, 2.5e-2)},
    equation=(
        r"E = 10\,W_i\left(\frac{1}{\sqrt{P_{80}}} - \frac{1}{\sqrt{F_{80}}}\right),\ P_{80}, "
        r"F_{80}\text{ in }\mathrm{µm}"
    ),
    symbols={"feed_size": "F_{80}", "product_size": "P_{80}"},
)
def specific_energy_bond(feed_size: Length, product_size: Length, work_index: WorkIndex) -> SpecificEnergy:
    """Energy by Bond's third theory, from the sizes that 80 % of feed and product pass.

    The work index is the energy from a very large size down to 100 µm. Tables often give it in kWh per short
    ton: write that unit. The exponent is minus one half; the course notes print 2.5. A product coarser than
    the feed gives no value.

    >>> round(specific_energy_bond("18 mm", "1.2 mm", "13.2 kWh/tonne") / 3600, 2)
    2.83
    """
    wi, d = work_index, HUNDRED_MICROMETERS
    return _reduction(wi * (jnp.sqrt(d / product_size) - jnp.sqrt(d / feed_size)), feed_size, product_size)


@formula(
    source="bond1952; bond1961",
    fitted={"product_size": (4e-5, 0.025)},
    equation=r"P_{80} = \left(\frac{E}{10\,W_i} + \frac{1}{\sqrt{F_{80}}}\right)^{-2}",
    output="product_size",
    title="Product size by Bond's law",
    typical={"specific_energy": (1e3, 5e4)},
    symbols={"feed_size": "F_{80}", "product_size": "P_{80}"},
)
def product_size_bond(
    feed_size: Length, specific_energy: Annotated[SpecificEnergy, Within(0.0)], work_index: WorkIndex
) -> Length:
    """Size that 80 % of the product passes after a given energy.

    The range is that of ``specific_energy_bond``.

    >>> round(product_size_bond("21.7 mm", "1.38889 kWh/tonne", "15.51 kWh/tonne") * 1e3, 2)
    4.03
    """
    root = specific_energy / work_index + jnp.sqrt(HUNDRED_MICROMETERS / feed_size)
    return HUNDRED_MICROMETERS / root**2


@formula(
    source="bond1961; rowland1976",
    fitted={"product_size": (4e-5, 0.025)},
    equation=r"W_{io} = \frac{E}{10\,(1/\sqrt{P_{80}} - 1/\sqrt{F_{80}})}",
    output="work_index",
    title="Operating work index",
    typical={"specific_energy": (1e3, 5e4)},
    symbols={"feed_size": "F_{80}", "product_size": "P_{80}", "work_index": "W_{io}"},
)
def work_index_operating(
    feed_size: Length, product_size: Length, specific_energy: Annotated[SpecificEnergy, Within(0.0)]
) -> WorkIndex:
    """Work index that a running mill shows; compared with the laboratory's it gives the efficiency of the
    mill.

    The range is that of ``specific_energy_bond``.

    >>> round(work_index_operating("18 mm", "1.2 mm", "2.827 kWh/tonne") / 3600, 2)
    13.2
    """
    d = HUNDRED_MICROMETERS
    fall = jnp.sqrt(d / product_size) - jnp.sqrt(d / feed_size)
    impossible(fall <= 0.0, product_size, "product_size", 0.0, feed_size)
    return jnp.where(fall > 0, safe_divide(specific_energy, fall), jnp.nan)


@formula(
    source="bond1961",
    equation=(
        r"W_i = \frac{44.5}{P_1^{0.23}\,G^{0.82}\left(\frac{10}{\sqrt{P_{80}}} - "
        r"\frac{10}{\sqrt{F_{80}}}\right)}\ \mathrm{kWh}/\text{short ton},"
        r"\quad P_1, P_{80}, F_{80}\text{ in }\mathrm{µm},\ G\text{ in }\mathrm g"
    ),
    title="Work index from the ball mill grindability test",
    output="work_index",
    fitted={"closing_aperture": (2.8e-5, 6e-4)},
    typical={"feed_size": (1.5e-3, 3e-3), "product_size": (4e-5, 1.5e-4), "closing_aperture": (5e-5, 3e-4)},
    symbols={"feed_size": "F_{80}", "product_size": "P_{80}"},
)
def work_index_ball_mill_test(
    closing_aperture: Length,
    net_undersize_per_revolution: MassPerRevolution,
    feed_size: Length,
    product_size: Length,
) -> WorkIndex:
    """Bond's ball mill work index from the closing sieve, the net grams per revolution and the 80 % sizes.

    >>> round(work_index_ball_mill_test("150 um", "1.6 g", "2250 um", "115 um") / (3.6e6 / 907.18474), 2)
    13.25
    """
    p1, g = closing_aperture * 1e6, net_undersize_per_revolution * 1e3
    fall = 10.0 / jnp.sqrt(product_size * 1e6) - 10.0 / jnp.sqrt(feed_size * 1e6)
    impossible(fall <= 0.0, product_size, "product_size", 0.0, feed_size)
    return jnp.where(fall > 0, safe_divide(44.5, p1**0.23 * g**0.82 * fall), jnp.nan) * KWH_PER_SHORT_TON


@formula(
    source="walker1937",
    equation=r"E = K\,\frac{(P/L_0)^{1-n} - (F/L_0)^{1-n}}{n - 1};\quad n = 1:\ K \ln\frac{F}{P}",
)
def specific_energy_walker(
    feed_size: Length,
    product_size: Length,
    walker_constant: SpecificEnergy,
    walker_exponent: PositiveNumber,
    reference_size: Length = 1e-3,
) -> SpecificEnergy:
    """Integral of dE = -K (x/L0)^-n dx/L0: Kick for n = 1, Bond for 1.5, Rittinger for 2.

    >>> specific_energy_walker("4 mm", "1 mm", walker_constant=2000.0, walker_exponent=1.5)
    2000.0
    """
    m = walker_exponent - 1.0
    near = abs(m) < _SMALL

    def part(size: Any) -> Any:
        log = jnp.log(size / reference_size)
        return jnp.where(near, -log, jnp.expm1(-m * log) / jnp.where(near, 1.0, m))

    return _reduction(walker_constant * (part(product_size) - part(feed_size)), feed_size, product_size)


@formula(
    source="hukki1961; bond1952",
    title="Specific energy over Hukki's three ranges",
    equation=(
        r"E = \int_P^F -\frac{dE}{dx}\,dx,\quad \frac{dE}{dx} = -\tfrac12 W_i \sqrt{d}\,x^{-3/2}\ (x_R "
        r"< x < x_K),\ \propto x^{-1}\ (x > x_K),\ \propto x^{-2}\ (x < x_R)"
    ),
    typical={"feed_size": (1e-2, 0.3), "product_size": (1e-5, 5e-3)},
)
def specific_energy_hukki(
    feed_size: Length,
    product_size: Length,
    work_index: WorkIndex,
    kick_limit: Length = 5e-2,
    rittinger_limit: Length = 5e-5,
) -> SpecificEnergy:
    """Kick above a limit, Bond between, Rittinger below, joined so that the slope dE/dx is continuous.

    Hukki found that the exponent changes with the size; his ranges for conventional machines meet near 50 mm
    and 50 µm.

    >>> round(specific_energy_hukki("18 mm", "1.2 mm", "13.2 kWh/tonne") / 3600, 2)
    2.83
    """
    half = 0.5 * work_index * jnp.sqrt(HUNDRED_MICROMETERS)
    clip = jnp.clip
    coarse = (
        half
        / jnp.sqrt(kick_limit)
        * jnp.log(jnp.maximum(feed_size, kick_limit) / jnp.maximum(product_size, kick_limit))
    )
    high, low = (clip(x, rittinger_limit, kick_limit) for x in (feed_size, product_size))
    middle = 2.0 * half * (low**-0.5 - high**-0.5)
    fine = (
        half
        * jnp.sqrt(rittinger_limit)
        * (1.0 / jnp.minimum(product_size, rittinger_limit) - 1.0 / jnp.minimum(feed_size, rittinger_limit))
    )
    return _reduction(coarse + middle + fine, feed_size, product_size)


@formula(
    source="morrell2004; morrell2009",
    equation=(
        r"E = 4\,W_i\left(P_{80}^{\,f(P_{80})} - F_{80}^{\,f(F_{80})}\right),\ f(x) = -(0.295 + "
        r"x/10^6),\ x\text{ in }\mathrm{µm},\ \mathrm{kWh/t}"
    ),
    typical={"feed_size": (5e-3, 5e-2), "product_size": (1e-4, 7.5e-4)},
    symbols={"feed_size": "F_{80}", "product_size": "P_{80}"},
)
def specific_energy_morrell(feed_size: Length, product_size: Length, work_index: WorkIndex) -> SpecificEnergy:
    """Energy by Morrell's relation, from 80 % sizes and the work index of the kind of grinding (Mia, Mib,
    Mic, Mih).

    Coarse tumbling runs from the feed to 750 µm with Mia, fine tumbling from 750 µm on with Mib.

    >>> round(specific_energy_morrell("750 um", "106 um", "18.8 kWh/tonne") / 3600, 1)
    8.4
    """

    def part(size: Any) -> Any:
        return (size * 1e6) ** (-(0.295 + size))

    return _reduction(4.0 * work_index * (part(product_size) - part(feed_size)), feed_size, product_size)


@formula(
    source="richardson2002, ch. 2",
    equation=r"P = \dot m\,E",
    title="Power of a crusher or mill",
    output="shaft_power",
    typical={"specific_energy": (1e3, 1e5)},
)
def shaft_power_comminution(mass_flow: MassFlow, specific_energy: SpecificEnergy) -> Power:
    """Power drawn at a throughput.

    >>> round(shaft_power_comminution("500 tonne/hour", "2.83 kWh/tonne") / 1e3, 1)
    1415.0
    """
    return mass_flow * specific_energy


@formula(source="richardson2002, ch. 2", equation=r"R_r = \frac{F}{P}")
def reduction_ratio(feed_size: Length, product_size: Length) -> Ratio:
    """Size of the feed over that of the product.

    >>> reduction_ratio(10.0, 2.0)
    5.0
    """
    return feed_size / product_size


class LawAdvice(NamedTuple):
    """Which energy law suits a reduction."""

    energy_law: str
    walker_exponent: PositiveNumber


@procedure(
    source="hukki1961; richardson2002, ch. 2",
    title="Energy law for a size range",
    typical={"feed_size": (1e-2, 0.1)},
)
def energy_law(feed_size: Length, product_size: Length) -> LawAdvice:
    """The law that suits a reduction, by its product: Rittinger below 1 mm, Kick around 60 mm and above, Bond
    between.

    Grinding to between 50 µm and 1 mm is served by Bond's law too, for which tables of work indices exist.

    >>> energy_law("200 mm", "70 mm").energy_law
    'kick'
    """
    if product_size > feed_size:
        raise InputError(
            _("The product is coarser than the feed: this is no size reduction."),
            name="product_size",
            value=product_size,
        )
    if product_size < 1e-3:
        return LawAdvice("rittinger", 2.0)
    return LawAdvice("kick", 1.0) if product_size >= 6e-2 else LawAdvice("bond", 1.5)
