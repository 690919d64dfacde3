"""Which separator for a slurry: settlers, centrifuges and filters ranked, with reasons."""

from __future__ import annotations

from math import ceil, exp, log
from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.constants import STANDARD_GRAVITY
from granum.core.datasets import dataset
from granum.core.i18n import _
from granum.core.kinds import (
    DensityDifference,
    DynamicViscosity,
    Fraction,
    Length,
    Series,
    VolumeFlow,
    VolumeFraction,
)
from granum.core.units import format_number

# Settling velocity, m/s, below which a machine of that effect cannot be made large enough: the flow over area
# of common machines.
LEAST_GRAVITY, LEAST_SPUN = 3e-5, 1e-4
DECADE_OUT = log(10.0)


class Separators(NamedTuple):
    """Separators, best first."""

    separator: Annotated[str, Series("machines")]
    suitability: Annotated[Fraction, Series("machines")]
    separator_size: Annotated[str, Series("machines")]
    speaks_for: Annotated[str, Series("machines")]
    speaks_against: Annotated[str, Series("machines")]


def _outside(value: float, low: float, high: float) -> float:
    """By how much a value lies outside a range, as a natural logarithm."""
    if value < low:
        return log(low / max(value, 1e-12))
    return log(value / high) if value > high else 0.0


def _size(machine: dict[str, Any], flow: float, falling: float) -> str:
    """How many of the largest ones take the flow, and the settling area that they need between them, or
    stand for where they spin.
    """
    count = max(ceil(flow / machine["flow_high"] - 1e-9), 1)
    told = [_("1 machine") if count == 1 else _("{count} machines").format(count=count)]
    if machine["settles"] and falling > 0.0:
        area = format_number(flow / falling, 2)
        least = (
            _("settling area {area} m²") if machine["effect"] == 1 else _("like {area} m² of settling area")
        )
        told.append(least.format(area=area))
    return ", ".join(told)


@procedure(
    source="svarovsky2001, ch. 1; perry2008, § 18; wakeman2005; robatel1989",
    title="Choice of a solid–liquid separator",
)
def separator_choice(
    particle_diameter: Length,
    density_difference: DensityDifference,
    solids_volume_fraction: VolumeFraction,
    volume_flow: VolumeFlow,
    liquid_left_wanted: Fraction = 1.0,
    dynamic_viscosity: DynamicViscosity = 1e-3,
    washing: bool = False,
) -> Separators:
    """Settlers, centrifuges and filters ranked for a slurry by size, settling velocity, concentration, flow,
    dryness and washing.

    The suitability is 1 where every figure lies in the range the machine is commonly used for, and falls by a
    factor e for each decade outside. The ranges are orders of magnitude: use the list to decide what to test.

    The size tells how many machines of the largest kind take the flow and, of those in which solids settle,
    the area Q/v on which such grains settle out by Stokes' law: in plan, or as the Σ of what spins.

    >>> separator_choice(
    ...     "300 um", 1100, 0.35, "20 m^3/hour", liquid_left_wanted=0.15, washing=True
    ... ).separator[0]
    'pusher centrifuge'
    """
    falling = particle_diameter**2 * abs(density_difference) * STANDARD_GRAVITY / (18.0 * dynamic_viscosity)
    rows = []
    for number in dataset("filtration", "separators_svarovsky2001"):
        missing, good, why = 0.0, [], []
        # several machines side by side, or one at part load, are possible: flow counts a third
        for value, span, scale, weight, within, outside in (
            (
                particle_diameter,
                "size",
                1e6,
                1.0,
                _("made for {low} to {high} µm"),
                _("particle size outside {low} to {high} µm"),
            ),
            (
                volume_flow,
                "flow",
                3600.0,
                1.0 / 3.0,
                _("made for {low} to {high} m³/h"),
                _("flow outside {low} to {high} m³/h"),
            ),
            (
                solids_volume_fraction,
                "solids",
                100.0,
                1.0,
                _("made for {low} to {high} % by volume"),
                _("solids outside {low} to {high} % by volume"),
            ),
        ):
            low, high = max(number[f"{span}_low"], 1e-7), number[f"{span}_high"]
            off = _outside(value, low, high)
            told = (outside if off > 0 else within).format(
                low=format_number(low * scale, 3), high=format_number(high * scale, 3)
            )
            (why if off > 0 else good).append(told)
            missing += max(off, 0.0) * weight
        if number["settles"]:
            least = LEAST_GRAVITY if number["effect"] == 1 else LEAST_SPUN
            off = _outside(falling * number["effect"], least, np.inf)
            if off > 0:
                why.append(_("settles too slowly"))
                missing += off
            else:
                good.append(_("settles fast enough"))
        if number["liquid_left"] > liquid_left_wanted:
            why.append(
                _("leaves more liquid ({value} % by volume)").format(
                    value=format_number(100 * number["liquid_left"], 2)
                )
            )
            missing += 2.0 * log(number["liquid_left"] / max(liquid_left_wanted, 0.01))
        elif liquid_left_wanted < 1.0:
            good.append(
                _("leaves {value} % of liquid by volume").format(
                    value=format_number(100 * number["liquid_left"], 2)
                )
            )
        if washing and not number["washes"]:
            why.append(_("cannot wash"))
            missing += DECADE_OUT
        elif washing:
            good.append(_("washes the cake"))
        rows.append(
            (
                exp(-missing / DECADE_OUT),
                number["liquid_left"],
                number["name"],
                _size(number, volume_flow, falling),
                "; ".join(good),
                "; ".join(why),
            )
        )
    rows.sort(key=lambda row: (-row[0], row[1]))
    columns: Any = list(zip(*rows, strict=True))
    names: Any = tuple(map(_, columns[2]))
    return Separators(names, np.array(columns[0]), *columns[3:])


# EN 1822: least efficiency at the most penetrating particle size
CLASSES = (
    ("U17", 0.99999995),
    ("U16", 0.9999995),
    ("U15", 0.999995),
    ("H14", 0.99995),
    ("H13", 0.9995),
    ("E12", 0.995),
    ("E11", 0.95),
    ("E10", 0.85),
)


@procedure(source="en1822", title="Class of a high-efficiency air filter")
def air_filter_class(filter_efficiency: Fraction) -> str:
    """Class of an air filter by EN 1822 from its efficiency at the most penetrating particle size; coarse and
    fine filters have none.

    >>> air_filter_class(filter_efficiency="99.97 %")
    'H13'
    """
    found = next((name for name, least in CLASSES if filter_efficiency >= least), None)
    return found or _("below E10: a coarse or fine filter (ISO 16890)")
