"""Correlations side by side: spread of minimum fluidization, disengaging height and entrainment. Geldart's
groups and the regime.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import flags, procedure
from granum.core.constants import STANDARD_GRAVITY
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MassFlux,
    PositiveNumber,
    Ratio,
    Series,
    Speed,
    Sphericity,
    VoidFraction,
)
from granum.core.units import format_number
from granum.fluidization.formulas import freeboard, minimum, minimum_beds, minimum_powers, regimes

GEL_LIQUID = 100.0  # kg/m³: above it the fluid counts as a liquid
GROUP_A_B, GROUP_B_D = 0.225, 1e-3  # kg/m² and kg/m, Geldart's lines 225 g/cm³ µm and 10⁶ g/cm³ µm²
ADHESION, WEIGHT_SHARE = 8.76e-8, 0.01  # N; Molerus: 10 times the weight over the adhesion at the line C–A


def denser(particle_density: float, fluid_density: float) -> None:
    """One clear error for particles that float."""
    if particle_density <= fluid_density:
        raise ApplicabilityError(
            _(
                "Particles of {particle} kg/m³ cannot be fluidized upwards by a fluid of {fluid} kg/m³: "
                "they must be denser."
            ).format(particle=format_number(particle_density), fluid=format_number(fluid_density))
        )


def _words(words: Iterable[str]) -> Any:
    """A column of words."""
    return tuple(words)


class FluidizationSpread(NamedTuple):
    """Every correlation of the minimum fluidization velocity, slowest first; median and spread of those in
    range.
    """

    correlation: Annotated[str, Series("correlations")]
    minimum_fluidization_velocity: Annotated[Speed, Series("correlations")]
    in_range: Annotated[Fraction, Series("correlations")]
    remarks: Annotated[str, Series("correlations")]
    median_velocity: Speed
    spread: Ratio


@procedure(source="couderc1985; kunii1991, ch. 3", title="Minimum fluidization velocity by every correlation")
def minimum_fluidization_spread(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction = 0.4,
    sphericity: Sphericity = 1.0,
) -> FluidizationSpread:
    """Minimum fluidization velocity by every correlation, each marked in or out of its range, with their
    median and spread.

    The spread is the ratio of highest to lowest among those in range; ±30 % is the usual scatter of a good
    correlation. Void fraction and sphericity serve those that use them.

    >>> found = minimum_fluidization_spread("200 um", 2500, 1.2, 1.8e-5)
    >>> 0.02 < found.median_velocity < 0.06
    True
    """
    denser(particle_density, fluid_density)
    fluid = {
        "particle_diameter": particle_diameter,
        "particle_density": particle_density,
        "fluid_density": fluid_density,
        "dynamic_viscosity": dynamic_viscosity,
    }
    rows = []
    for name, law in [
        pair for module in (minimum, minimum_beds, minimum_powers) for pair in vars(module).items()
    ]:
        if not name.startswith("minimum_fluidization_velocity_"):
            continue
        asked = {p.name for p in law.card.parameters}
        own = {"void_fraction": void_fraction, "sphericity": sphericity}
        with flags.collect():  # told as the remark of its row
            result = law.evaluate(**fluid, **{k: v for k, v in own.items() if k in asked})
        remark = "; ".join(notice["message"] for notice in result.notices)
        suits = not remark and (
            name.endswith("riba") == (fluid_density > GEL_LIQUID) or "ergun" in name or "wen_yu" in name
        )
        rows.append((float(result.value), name.removeprefix("minimum_fluidization_velocity_"), suits, remark))
    rows.sort()
    values = np.array([row[0] for row in rows])
    trusted = values[[row[2] for row in rows]]
    return FluidizationSpread(
        _words(row[1] for row in rows),
        values,
        np.array([float(row[2]) for row in rows]),
        _words(row[3] for row in rows),
        float(np.median(trusted)),
        float(trusted.max() / trusted.min()),
    )


class Spread(NamedTuple):
    """Correlations from lowest to highest, with the median."""

    correlation: Annotated[str, Series("correlations")]
    disengaging_height: Annotated[Length, Series("correlations")]
    in_range: Annotated[Fraction, Series("correlations")]
    median_height: Length


@procedure(source="smolders2001; kunii1991, ch. 7", title="Disengaging height by every correlation")
def disengaging_height_spread(
    superficial_velocity: Speed, minimum_fluidization_velocity: Speed, bubble_diameter: Length
) -> Spread:
    """Transport disengaging height by every correlation: they differ by a factor of several.

    >>> found = disengaging_height_spread(0.5, 0.05, 0.1)
    >>> len(found.correlation)
    6
    """
    known = {
        "superficial_velocity": superficial_velocity,
        "minimum_fluidization_velocity": minimum_fluidization_velocity,
        "bubble_diameter": bubble_diameter,
    }
    rows = _every(freeboard, "disengaging_height_", known)
    return Spread(
        _words(row[1] for row in rows),
        np.array([row[0] for row in rows]),
        np.array([row[2] for row in rows]),
        float(np.median([row[0] for row in rows])),
    )


class ElutriationSpread(NamedTuple):
    """Correlations from lowest to highest, with the median."""

    correlation: Annotated[str, Series("correlations")]
    elutriation_flux: Annotated[MassFlux, Series("correlations")]
    in_range: Annotated[Fraction, Series("correlations")]
    median_flux: MassFlux


@procedure(
    source="kunii1991, ch. 7; geldart1986",
    title="Elutriation rate constant by every correlation",
    typical={"terminal_velocity": (0.05, 0.4)},
)
def elutriation_spread(
    superficial_velocity: Speed,
    terminal_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> ElutriationSpread:
    """Elutriation rate constant of one size class by every correlation: they differ by orders of magnitude,
    so trust the band.

    >>> found = elutriation_spread(1.0, 0.2, "60 um", 1500, 1.2, 1.8e-5)
    >>> found.elutriation_flux[-1] > 3 * found.elutriation_flux[0]
    True
    """
    denser(particle_density, fluid_density)
    rows = _every(freeboard, "elutriation_flux_", locals())
    return ElutriationSpread(
        _words(row[1] for row in rows),
        np.array([row[0] for row in rows]),
        np.array([row[2] for row in rows]),
        float(np.median([row[0] for row in rows])),
    )


def _every(module: Any, start: str, known: dict[str, Any]) -> list[tuple[float, str, float]]:
    """Value and author of every law of a module whose name starts so, lowest first, and 1 where it is in its
    range.
    """
    rows = []
    for name, law in vars(module).items():
        if name.startswith(start):
            asked = {p.name: known[p.name] for p in law.card.parameters if p.name in known}
            with flags.collect():  # told in its row
                found = law.evaluate(**asked)
            rows.append((float(found.value), name.removeprefix(start), float(not found.notices)))
    return sorted(rows)


class GeldartGroup(NamedTuple):
    """Geldart's group with the sizes at its borders for these densities."""

    geldart_group: str
    behavior: str
    border_size: Annotated[Length, Series("borders")]
    bubbling_ratio: PositiveNumber


@procedure(source="geldart1973; molerus1982; abrahamsen1980", title="Geldart group of a powder")
def geldart_group(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    fines_fraction: Fraction = 0.1,
) -> GeldartGroup:
    """Group of a powder in a gas: C cohesive, A aeratable, B sand-like, D spoutable.

    A–B and B–D are Geldart's lines for air; C–A is Molerus' balance of weight and adhesion, soft in practice.
    The ratio of bubbling to minimum fluidization velocity above 1 is the other sign of group A. Sizes at the
    borders C–A, A–B, B–D.

    >>> (
    ...     geldart_group("60 um", 1500).geldart_group,
    ...     geldart_group("300 um", 2600).geldart_group,
    ...     geldart_group("2 mm", 2600).geldart_group,
    ... )
    ('A', 'B', 'D')
    """
    denser(particle_density, fluid_density)
    heavy = particle_density - fluid_density
    borders = np.array(
        [
            (WEIGHT_SHARE * 6.0 * ADHESION / (10.0 * np.pi * STANDARD_GRAVITY * heavy)) ** (1.0 / 3.0),
            GROUP_A_B / heavy,
            np.sqrt(GROUP_B_D / heavy),
        ]
    )
    group = "CABD"[int(np.sum(particle_diameter > borders))]
    words = {
        "C": _("cohesive: channels and lifts as a plug; fluidizes only with stirring or vibration"),
        "A": _("aeratable: expands smoothly before it bubbles"),
        "B": _("sand-like: bubbles from minimum fluidization on"),
        "D": _("spoutable: large slow bubbles, spouts in a cone"),
    }
    first = minimum_powers.minimum_fluidization_velocity_baeyens_geldart(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity
    )
    bubbling = minimum_powers.minimum_bubbling_velocity_abrahamsen_geldart(
        particle_diameter, fluid_density, dynamic_viscosity, fines_fraction
    )
    return GeldartGroup(group, words[group], borders, bubbling / first)


class Regime(NamedTuple):
    """Regime of a bed and the velocities that bound it, from slow to fast."""

    regime: str
    limit_names: Annotated[str, Series("limits")]
    limit_velocities: Annotated[Speed, Series("limits")]
    dimensionless_diameter: PositiveNumber
    dimensionless_velocity: Ratio


@procedure(
    source="grace1986; bi1995; stewart1967",
    title="Regime of a gas-fluidized bed",
    typical={"superficial_velocity": (0.05, 3.0)},
)
def fluidization_regime(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    diameter: Length,
) -> Regime:
    """Regime of a gas-fluidized bed in a vessel: fixed, bubbling, slugging, turbulent or fast, with the
    velocities between them.

    A limit that lies above the next one does not occur: wide vessels do not slug, coarse particles pass from
    bubbling to transport.

    >>> fluidization_regime(0.01, "200 um", 2600, 1.2, 1.8e-5, 1.0).regime
    'fixed bed'
    """
    denser(particle_density, fluid_density)
    fluid = (particle_diameter, particle_density, fluid_density, dynamic_viscosity)
    first = minimum.minimum_fluidization_velocity_wen_yu(*fluid)
    turbulent = regimes.turbulent_onset_velocity_bi_grace(*fluid)
    limits = [
        (first, _("bubbling bed")),
        (regimes.minimum_slugging_velocity(first, diameter), _("slugging bed")),
        (turbulent, _("turbulent bed")),
        (
            max(regimes.entrainment_onset_velocity_bi_grace(*fluid), turbulent),
            _("fast fluidization or transport"),
        ),
    ]
    regime = _("fixed bed")
    stable = 2.0 * turbulent**2 / STANDARD_GRAVITY
    if stable < 0.6 * diameter or limits[1][0] > limits[2][0]:  # bubbles never grow to the vessel
        del limits[1]
    for velocity, name in limits:
        if superficial_velocity >= velocity:
            regime = name
    at = regimes.grace_coordinates(superficial_velocity, *fluid)
    return Regime(
        regime,
        _words(n for _v, n in limits),
        np.array([v for v, _n in limits]),
        at.dimensionless_diameter,
        at.dimensionless_velocity,
    )
