"""Shapes of gas cyclones as ratios to the body diameter: the standard designs and free ones."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import cache, wraps
from typing import Any, Literal, NamedTuple, get_type_hints

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import impossible, law
from granum.core.datasets import dataset
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Length, PositiveNumber
from granum.core.stand_ins import designs

STANDARDS = Literal[
    "stairmand_high_efficiency",
    "swift_high_efficiency",
    "lapple",
    "swift_general_purpose",
    "peterson_whitby",
    "stairmand_high_throughput",
    "swift_high_throughput",
]


class Dimensions(NamedTuple):
    """Lengths of a cyclone: the one argument ``cyclone`` of the efficiency and pressure-drop laws."""

    diameter: Length
    inlet_height: Length
    inlet_width: Length
    outlet_diameter: Length
    finder_length: Length
    cylinder_height: Length
    height: Length
    dust_outlet_diameter: Length


WIDE_FINDER = "The vortex finder must be narrower than the body."
WIDE_DUST_OUTLET = "The dust outlet must not be wider than the body."
WIDE_INLET = "The inlet must not reach beyond the axis of the body."
LONG_CYLINDER = "The cylinder must be shorter than the cyclone."
LONG_FINDER = "The vortex finder must end inside the cyclone."


def misfits(cyclone: Dimensions) -> list[tuple[Any, Any, str, Any, str]]:
    """What no cyclone can be: where, the length, its name, the limit below which it must stay, and why."""
    D, _a, b, De, S, h, H, B = cyclone
    return [
        (~(De < D), De, "outlet_diameter", D, WIDE_FINDER),
        (~(B <= D), B, "dust_outlet_diameter", D, WIDE_DUST_OUTLET),
        (~(b <= D / 2.0), b, "inlet_width", D / 2.0, WIDE_INLET),
        (~(h < H), h, "cylinder_height", H, LONG_CYLINDER),
        (~(S < H), S, "finder_length", H, LONG_FINDER),
    ]


def takes_lengths(function: Callable[..., Any]) -> Callable[..., Any]:
    """Let a law written with one argument ``cyclone``, its ``Dimensions``, be declared and called with each
    length by its name.
    """
    hints = get_type_hints(function, include_extras=True)
    lengths = get_type_hints(Dimensions, include_extras=True)
    signature = inspect.signature(function)
    taken = list(signature.parameters.values())
    start = next(i for i, p in enumerate(taken) if p.name == "cyclone")
    stop = start + len(lengths)
    apart = [inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD) for name in lengths]

    @wraps(function)
    def flat(*values: Any) -> Any:
        cyclone = Dimensions(*map(jnp.asarray, values[start:stop]))
        for wrong, length, name, limit, reason in misfits(cyclone):
            impossible(wrong, length, name, 0.0, limit, reason)
        return function(*values[:start], cyclone, *values[stop:])

    flat.__signature__ = signature.replace(parameters=[*taken[:start], *apart, *taken[start + 1 :]])  # type: ignore[attr-defined]
    flat.__annotations__ = {name: hint for name, hint in hints.items() if name != "cyclone"} | lengths
    return flat


@cache
def standard_ratios() -> dict[str, tuple[float, ...]]:
    """Ratios of the standard designs by name."""
    return {
        name: tuple(ratios)
        for name, *ratios in (row.values() for row in dataset("cyclones", "geometries_leith1973"))
    }


@law("cyclone_geometry", name="standard_cyclone", source="leith1973; cooper2011", title="Standard cyclone")
class StandardCyclone(eqx.Module):
    """A standard tangential-entry design: Stairmand, Swift, Lapple, Peterson and Whitby.

    >>> float(StandardCyclone("lapple")(2.0).inlet_height)
    1.0
    """

    standard: STANDARDS = "stairmand_high_efficiency"

    def __call__(self, diameter: Length) -> Dimensions:
        """Lengths for a body diameter."""
        return Dimensions(diameter, *(ratio * diameter for ratio in standard_ratios()[self.standard]))


def _standard(name: Any, diameter: Any) -> dict[str, Any]:
    return StandardCyclone(name)(diameter)._asdict()


designs(Dimensions._fields, _standard)


@law("cyclone_geometry", name="free_cyclone", source="hoffmann2008", title="Cyclone of free proportions")
class FreeCyclone(eqx.Module):
    """Proportions of one's own, each length over the body diameter; what cannot be built is refused.

    >>> float(FreeCyclone(0.5, 0.2, 0.5, 0.5, 1.5, 4.0, 0.375)(2.0).inlet_width)
    0.4
    """

    inlet_height_ratio: PositiveNumber
    inlet_width_ratio: PositiveNumber
    outlet_diameter_ratio: PositiveNumber
    finder_length_ratio: PositiveNumber
    cylinder_height_ratio: PositiveNumber
    height_ratio: PositiveNumber
    dust_outlet_ratio: PositiveNumber

    def __check_init__(self) -> None:
        shape = self(1.0)
        if not all(isinstance(v, (int, float)) for v in shape):
            return
        broken = [
            _(reason) for wrong, *_rest, reason in misfits(Dimensions(*map(np.float64, shape))) if wrong
        ]
        if shape.inlet_width > (1 - shape.outlet_diameter) / 2 + 1e-9:
            broken.append(_("The inlet must fit between wall and vortex finder."))
        if shape.inlet_height > shape.cylinder_height:
            broken.append(_("The inlet must fit into the cylinder."))
        if broken:
            raise InputError(" ".join([_("This cyclone cannot be built."), *broken]))

    def __call__(self, diameter: Length) -> Dimensions:
        """Lengths for a body diameter."""
        ratios: tuple[Any, ...] = (
            self.inlet_height_ratio,
            self.inlet_width_ratio,
            self.outlet_diameter_ratio,
            self.finder_length_ratio,
            self.cylinder_height_ratio,
            self.height_ratio,
            self.dust_outlet_ratio,
        )
        return Dimensions(diameter, *(ratio * diameter for ratio in ratios))
