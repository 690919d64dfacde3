"""Flocculator: stirred tanks in which grains join to flocs that settle faster."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Fraction,
    Frequency,
    MassFlow,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.settling.formulas.coagulation import Dose, capture_efficiency_dose
from granum.settling.formulas.flocculation import (
    aggregation_constant_shear,
    flocculation_ratio_tanks,
    power_stirring,
    settling_growth_fractal,
    velocity_gradient_stirred,
)
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import driven

FASTEST = 1e-9  # m³/s, a trickle for which a stay is still told
LARGEST = 1e12  # grains per floc


class Flocculated(NamedTuple):
    """The slurry with its flocs."""

    product: Stream


class FlocculatorFigures(NamedTuple):
    """Figures of a flocculator."""

    residence_time: Time
    camp_number: Ratio
    aggregation_constant: Ratio
    flocculation_ratio: PositiveNumber
    equivalent_growth: PositiveNumber
    shaft_power: Power
    coagulant_flow: MassFlow


def coarsen(edges: Any, growth: Any) -> Any:
    """Transfer operator (target × source) that moves every class to sizes ``growth`` times as large; what
    would lie beyond the largest class gathers in it.
    """
    bounds = jnp.asarray(edges)
    low, high = growth * bounds[:-1], growth * bounds[1:]
    inside = jnp.clip((bounds[:, None] - low) / (high - low), 0.0, 1.0)
    inside = inside.at[0].set(0.0).at[-1].set(1.0)
    return jnp.diff(inside, axis=0)


@equipment(
    "flocculator",
    source="argaman1970; camp1943; jiang1991; reerink1954; stumm1968",
    title="Flocculator",
    equation=r"\frac{N_0}{N} = \frac{(1 + K_A G T/m)^m}{1 + K_B G^2\,\frac{T}{m}\sum_i (1 + K_A G T/m)^i}",
)
class Flocculator(Unit):
    """Equal stirred tanks in series after a coagulant: shear brings grains together and breaks flocs, and
    what leaves settles, or rises, faster.

    The stream goes on with the size of the compact grain that settles as fast as the floc: all classes grow
    by one factor, each by the same number of grains. The constant of aggregation follows from the volume of
    the grains and the share of collisions that last, unless a jar test gives it. With the best dose and the
    sharpness that a jar test finds, a dose beside the best one leaves fewer collisions that last. The
    stirring is given by its velocity gradient, or by the power at the paddles that all tanks share.
    """

    volume: Annotated[Volume, Within(1e-6)]
    velocity_gradient: Frequency | None = None
    tank_number: PositiveNumber = 3.0
    _: KW_ONLY
    capture_efficiency: Fraction = 0.3
    aggregation_constant: Ratio | None = None
    breakage_constant: Time = 1e-7
    fractal_dimension: Annotated[Ratio, Within(1.5, 3.0)] = 2.2
    coagulant_dose: Concentration = 0.0
    dose_optimum: Dose | None = None
    charge_sharpness: PositiveNumber | None = None
    shaft_power: Annotated[Power, Within(1e-3)] | None = None

    instead: ClassVar[Mapping[str, str]] = {
        "shaft_power": "velocity_gradient",
        "velocity_gradient": "shaft_power",
    }

    limits: ClassVar[Limits] = {
        "gradient": Limit("velocity gradient", 10.0, 100.0, "1/s", "camp1955"),
        "camp": Limit("velocity gradient times stay", 2e4, 2.1e5, "dimensionless", "camp1955"),
        "held": Limit("solids gathered in the largest class", 0.0, 0.05, "dimensionless", "argaman1970"),
    }

    utilities: ClassVar[Utilities] = {
        "electric_power_agitator": Utility("camp1943"),
        "consumption_coagulant": Utility("davis2010, p. 6-18"),
    }

    def __check_init__(self) -> None:
        if (self.velocity_gradient is None) == (self.shaft_power is None):
            raise InputError(
                _("The stirring is given by 'velocity_gradient' or by 'shaft_power': give one of the two."),
                name="velocity_gradient",
            )
        if (self.dose_optimum is None) != (self.charge_sharpness is None):
            raise InputError(
                _(
                    "What a dose does needs both the best dose ('dose_optimum') and the "
                    "'charge_sharpness' of a jar test."
                ),
                name="dose_optimum",
            )

    def gradient(self, feed: Stream) -> Any:
        """The mean velocity gradient, also where the power that is stirred in is given."""
        if self.velocity_gradient is not None:
            return self.velocity_gradient
        return velocity_gradient_stirred.function(self.shaft_power, self.volume, feed.liquid_viscosity)

    def _lasting(self) -> Any:
        """Share of the collisions that last at the dose given, of those at the best dose."""
        if self.dose_optimum is None or self.charge_sharpness is None:
            return 1.0
        return capture_efficiency_dose.function(self.coagulant_dose, self.dose_optimum, self.charge_sharpness)

    def inside(self, feed: Stream) -> FlocculatorFigures:
        flow, gradient = jnp.maximum(feed.slurry_volume_flow, FASTEST), self.gradient(feed)
        stay = self.volume / flow
        constant = self._lasting() * (
            aggregation_constant_shear(feed.solids_volume_fraction, self.capture_efficiency)
            if self.aggregation_constant is None
            else jnp.asarray(self.aggregation_constant, dtype=float)
        )
        number = flocculation_ratio_tanks(gradient, stay, constant, self.breakage_constant, self.tank_number)
        number = jnp.clip(number, 1.0, LARGEST)
        return FlocculatorFigures(
            stay,
            gradient * stay,
            constant,
            number,
            settling_growth_fractal(number, self.fractal_dimension),
            power_stirring(gradient, self.volume, feed.liquid_viscosity),
            self.coagulant_dose * feed.slurry_volume_flow,
        )

    def outlets(self, inside: FlocculatorFigures, feed: Stream) -> Flocculated:
        return Flocculated(feed.regraded(coarsen(feed.mixture.edges, inside.equivalent_growth)))

    def figures(self, inside: FlocculatorFigures, outlets: Flocculated, feed: Stream) -> FlocculatorFigures:
        return inside

    def measured(
        self, inside: FlocculatorFigures, outlets: Flocculated, figures: FlocculatorFigures, feed: Stream
    ) -> dict[str, Any]:
        gathered = outlets.product.size_fractions[-1] - feed.size_fractions[-1]
        return {
            "gradient": self.gradient(feed),
            "camp": figures.camp_number,
            "held": jnp.maximum(gathered, 0.0),
        }

    def drawn(
        self, inside: FlocculatorFigures, outlets: Flocculated, figures: FlocculatorFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_agitator": driven(figures.shaft_power),
            "consumption_coagulant": figures.coagulant_flow,
        }
