"""Which separator for a slurry: settlers, centrifuges and filters ranked, with reasons."""

from __future__ import annotations

from math import ceil, exp, floor, inf, log, sqrt
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
    Time,
    VolumeFlow,
    VolumeFraction,
    Within,
)
from granum.core.units import format_number

# Settling velocity, m/s, below which a machine of that effect cannot be made large enough: the flow over area
# of common machines.
LEAST_GRAVITY, LEAST_SPUN = 3e-5, 1e-4
VOIDS = 0.45  # of the cake by which filters are judged
DECADE_OUT = log(10.0)
# What speaks against a machine that is within all its ranges, as natural logarithms: at the end of a range,
# per decade of needless speed or pressure, for a product that is all liquid, for the polymer of its flocs.
AT_THE_END, NEEDLESS, WET, FLOCCULANT = 0.5, 0.15 * DECADE_OUT, 0.4, 0.3
AMPLE = 100.0  # times faster than needed, from where a machine does more than it has to


class Separators(NamedTuple):
    """Separators, best first."""

    separator: Annotated[str, Series("machines")]
    suitability: Annotated[Fraction, Series("machines")]
    separator_size: Annotated[str, Series("machines")]
    speaks_for: Annotated[str, Series("machines")]
    speaks_against: Annotated[str, Series("machines")]


class _Case(NamedTuple):
    """What is asked: SI, the velocity of sinking (negative: rising) under gravity."""

    size: float
    falling: float
    solids: float
    flow: float
    wanted: float
    viscosity: float
    washing: bool
    drops: bool


class _Judged:
    """What speaks for and against one machine, and how much, as a natural logarithm."""

    def __init__(self) -> None:
        self.missing = 0.0
        self.good: list[str] = []
        self.why: list[str] = []

    def against(self, much: float, reason: str) -> None:
        self.missing += much
        self.why.append(reason)

    def ranged(self, value: float, ends: tuple[float, float], weight: float, told: tuple[str, ...]) -> None:
        """A range of use: outside by the logarithm of how far, inside by how near its ends (``told``: inside,
        near an end, outside).
        """
        low, high = max(ends[0], 1e-7), ends[1]
        within, near, outside = told
        off = _outside(value, low, high)
        if off > 0.0:
            self.against(off * weight, outside)
            return
        half = 0.5 * log(high / low)
        edge = abs(log(max(value, low) / low) - half) / half
        # A range that begins at nothing has no lower end to be near to.
        edge = 0.0 if ends[0] == 0.0 and value < sqrt(low * high) else edge
        self.missing += AT_THE_END * weight * edge**2
        (self.why if edge > 0.85 else self.good).append(near if edge > 0.85 else within)


def _outside(value: float, low: float, high: float) -> float:
    """By how much a value lies outside a range, as a natural logarithm."""
    if value < low:
        return log(low / max(value, 1e-12))
    return log(value / high) if value > high else 0.0


def _judge_ranges(machine: dict[str, Any], case: _Case, found: _Judged) -> None:
    # several machines side by side, or one at part load, are possible: flow counts a third
    for value, span, scale, weight, words in (
        (
            case.size,
            "size",
            1e6,
            1.0,
            (
                _("made for {low} to {high} µm"),
                _("near the end of its {low} to {high} µm"),
                _("particle size outside {low} to {high} µm"),
            ),
        ),
        (
            case.flow,
            "flow",
            3600.0,
            1.0 / 3.0,
            (
                _("made for {low} to {high} m³/h"),
                _("near the end of its {low} to {high} m³/h"),
                _("flow outside {low} to {high} m³/h"),
            ),
        ),
        (
            case.solids,
            "solids",
            100.0,
            1.0,
            (
                _("made for {low} to {high} % by volume"),
                _("near the end of its {low} to {high} % by volume"),
                _("solids outside {low} to {high} % by volume"),
            ),
        ),
    ):
        low, high = machine[f"{span}_low"], machine[f"{span}_high"]
        ends = {
            "low": format_number(low * scale, 3),
            "high": format_number(high * scale, 3),
        }
        found.ranged(value, (low, high), weight, tuple(word.format(**ends) for word in words))


def _judge_settling(machine: dict[str, Any], case: _Case, found: _Judged) -> None:
    if not machine["settles"]:
        return
    spun = machine["effect"] != 1
    least = LEAST_SPUN if spun else LEAST_GRAVITY
    speed = abs(case.falling) * machine["effect"]
    off = _outside(speed, least, inf)
    if off > 0:
        found.against(off, _("settles too slowly") if case.falling >= 0 else _("rises too slowly"))
    else:
        found.good.append(_("settles fast enough") if case.falling >= 0 else _("rises fast enough"))
        spare = log(speed / (AMPLE * least))
        if spun and spare > 0.0:
            found.against(NEEDLESS * spare / DECADE_OUT, _("spins harder than such grains need"))
    if case.falling < 0 and not machine["skims"]:
        found.against(2.0 * DECADE_OUT, _("has no outlet for what floats"))
    elif case.falling < 0:
        found.good.append(_("takes off what floats"))


def _judge_cake(machine: dict[str, Any], case: _Case, found: _Judged) -> None:
    """Whether the cake that the machine can discharge forms in the time it gives, by Kozeny and Carman."""
    if not machine["pressure"]:
        return
    resistance = 180.0 * (1.0 - VOIDS) ** 2 / (VOIDS**3 * case.size**2)
    per_filtrate = case.solids / max(1.0 - VOIDS - case.solids, 0.01)
    forming = (
        case.viscosity
        * resistance
        * machine["cake_thickness"] ** 2
        / (2.0 * max(per_filtrate, 1e-9) * machine["pressure"])
    )
    told = format_number(1e3 * machine["cake_thickness"], 2), _lasting(forming)
    spare = machine["form_time"] / forming
    if spare < 1.0:
        found.against(
            -log(spare), _("{thick} mm of cake take {time} to form").format(thick=told[0], time=told[1])
        )
    else:
        found.good.append(_("{thick} mm of cake form in {time}").format(thick=told[0], time=told[1]))
        if spare > AMPLE:
            found.against(
                NEEDLESS * log(spare / AMPLE) / DECADE_OUT,
                _("presses harder or longer than such a cake needs"),
            )


def _lasting(seconds: float) -> str:
    """A time as one says it to the second figure."""
    if seconds < 1.0:
        return _("less than a second")
    unit, size = ("s", 1.0) if seconds < 60.0 else ("min", 60.0) if seconds < 7200.0 else ("h", 3600.0)
    return f"{format_number(seconds / size, 2)} {unit}"


def _judge_product(machine: dict[str, Any], case: _Case, found: _Judged) -> None:
    left = machine["liquid_left"]
    told = format_number(100 * left, 2)
    if left > case.wanted:
        found.against(
            2.0 * log(left / max(case.wanted, 0.01)),
            _("leaves more liquid ({value} % by volume)").format(value=told),
        )
    else:
        found.good.append(_("leaves {value} % of liquid by volume").format(value=told))
    found.missing += WET * left
    if machine["flocculates"]:
        found.against(FLOCCULANT, _("needs flocs or fibers, mostly a polymer"))
    if case.drops and not machine["takes_drops"]:
        found.against(2.0 * DECADE_OUT, _("cannot hold drops"))
    if case.washing and not machine["washes"]:
        found.against(DECADE_OUT, _("cannot wash"))
    elif case.washing:
        found.good.append(_("washes the cake"))


def _size(machine: dict[str, Any], flow: float, falling: float) -> str:
    """How many of the largest ones take the flow, and the settling area that they need between them, or
    stand for where they spin.
    """
    count = max(ceil(flow / machine["flow_high"] - 1e-9), 1)
    told = [_("1 machine") if count == 1 else _("{count} machines").format(count=count)]
    if machine["settles"] and falling != 0.0:
        area = format_number(flow / abs(falling), 2)
        least = (
            _("settling area {area} m²") if machine["effect"] == 1 else _("like {area} m² of settling area")
        )
        told.append(least.format(area=area))
    return ", ".join(told)


@procedure(
    source="svarovsky2001, ch. 1; perry2008, § 18; wakeman2005; robatel1989; metcalf2003; epa2000; judd2022",
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
    drops: bool = False,
) -> Separators:
    """Settlers, centrifuges and filters ranked for a slurry by size, settling velocity, concentration, flow,
    cake formation, dryness and washing.

    Light solids and light drops have a negative difference of density: they need an outlet for what floats;
    drops smear through a cake. Of a slurry that is flocculated, give the size of its flocs. The suitability
    falls by a factor e for each decade outside a range of use, settling too slow or cake forming too slow,
    and less within: toward the ends of the ranges, with needless speed or pressure, with liquid left in the
    solid, for flocs that must be made. The ranges are orders of magnitude: use the list to decide what to
    test.

    The cake is judged by Kozeny and Carman at 45 % voids: the time that the thinnest cake a machine
    discharges well takes to form against the time that it commonly has. The size tells how many machines of
    the largest kind take the flow and, of those in which solids settle, the area Q/v on which such grains
    settle out by Stokes' law: in plan, or as the Σ of what spins.

    >>> separator_choice(
    ...     "300 um", 1100, 0.35, "20 m^3/hour", liquid_left_wanted=0.15, washing=True
    ... ).separator[0]
    'pusher centrifuge'
    """
    falling = particle_diameter**2 * density_difference * STANDARD_GRAVITY / (18.0 * dynamic_viscosity)
    case = _Case(
        particle_diameter,
        falling,
        solids_volume_fraction,
        volume_flow,
        liquid_left_wanted,
        dynamic_viscosity,
        washing,
        drops,
    )
    rows = []
    for machine in dataset("filtration", "separators_svarovsky2001"):
        found = _Judged()
        for judge in (_judge_ranges, _judge_settling, _judge_cake, _judge_product):
            judge(machine, case, found)
        rows.append(
            (
                exp(-found.missing / DECADE_OUT),
                machine["liquid_left"],
                machine["name"],
                _size(machine, volume_flow, falling),
                "; ".join(found.good),
                "; ".join(found.why),
            )
        )
    rows.sort(key=lambda row: (-row[0], row[1]))
    columns: Any = list(zip(*rows, strict=True))
    names: Any = tuple(map(_, columns[2]))
    return Separators(names, np.array(columns[0]), *columns[3:])


# Walas: growth of a cake on a vacuum leaf, at least 0.1 cm per second, minute, hour; and the eighth of an
# inch that a continuous filter has to form within five minutes
UNITS, LEAST_GROWTH = (1.0, 60.0, 3600.0), 1e-3
EIGHTH, CONTINUOUS, CENTIMETER = 3.175e-3, 300.0, 0.01


@procedure(source="walas1990, ch. 11; purchas1981", title="Class of a slurry by its cake formation")
def filtering_class(standard_cake_formation_time: Annotated[Time, Within(1e-3)]) -> str:
    """Whether a slurry filters rapidly, at a medium pace or slowly, by the time of a cake of one centimeter,
    and whether a continuous filter comes into question.

    The rates are those of the first centimeter; the thin cake of the continuous filter follows from it by the
    parabola of an open medium. Where the ranges of the source overlap the quicker class is told. The rules
    were opened in a public copy.

    >>> filtering_class(standard_cake_formation_time="2 min")
    'medium: for continuous and batch filters'
    """
    rate = CENTIMETER / standard_cake_formation_time
    per_second, per_minute, per_hour = (rate * unit >= LEAST_GROWTH * (1.0 - 1e-9) for unit in UNITS)
    if per_second:
        return _("rapid: for continuous filters and screens that drain")
    if standard_cake_formation_time * (EIGHTH / CENTIMETER) ** 2 <= CONTINUOUS:
        return (
            _("medium: for continuous and batch filters")
            if per_minute
            else _("slow: for batch filters, hardly for continuous ones")
        )
    if per_hour:
        return _("slow: for batch filters under pressure, not for continuous ones")
    return _("very slow: thicken, flocculate or use filter aid before")


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


# ISO 16890-1: groups, finest first
GROUPS = ("ISO ePM1", "ISO ePM2.5", "ISO ePM10")
LEAST_SHARE, STEP, HIGHEST = 0.5, 0.05, 0.95


@procedure(source="iso16890", title="Class of an air filter for particulate matter")
def air_filter_class_particulate(
    efficiency_pm1: Fraction, efficiency_pm25: Fraction, efficiency_pm10: Fraction
) -> str:
    """Class of an air filter by ISO 16890: the finest particulate matter of which it takes out half, with the
    share rounded down to 5 %.

    Give the mean of the new and of the discharged filter, of which the standard asks half too for the two
    finer groups. Recalled, not opened.

    >>> air_filter_class_particulate("67 %", "78 %", "92 %")
    'ISO ePM1 65 %'
    """
    for group, share in zip(GROUPS, (efficiency_pm1, efficiency_pm25, efficiency_pm10), strict=True):
        if share > HIGHEST:
            return f"{group} >{100 * HIGHEST:.0f} %"
        if share >= LEAST_SHARE:
            return f"{group} {100 * STEP * floor(share / STEP + 1e-9):.0f} %"
    return _("ISO coarse: less than half of the particulate matter of 10 µm")
