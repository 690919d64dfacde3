"""Rowland's efficiency factors, by which Bond's energy is multiplied for a real mill."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

import jax.numpy as jnp

from granum.comminution.formulas.energy import KWH_PER_SHORT_TON, specific_energy_bond
from granum.comminution.kinds import WorkIndex
from granum.core import formula, impossible, procedure
from granum.core.kinds import Fraction, Length, MassFlow, PositiveNumber, Power, SpecificEnergy, Within
from granum.numerics.interpolation import interpolate_linear

_PASSING = (0.50, 0.60, 0.70, 0.80, 0.90, 0.92, 0.95, 0.98)
_OPEN_CIRCUIT = (1.035, 1.05, 1.10, 1.20, 1.40, 1.46, 1.57, 1.70)
DRY = 1.3


@formula(
    source="rowland1980, EF2",
    equation=r"EF_2(q) = 1.035 \ldots 1.70,\quad q = 50 \ldots 98\ \%",
    title="EF2, open-circuit ball mill",
    fitted={"passing_fraction": (0.5, 0.98)},
    symbols={"efficiency_factor": "EF_2"},
)
def efficiency_factor_open_circuit(passing_fraction: Annotated[Fraction, Within(0.0, 1.0)]) -> PositiveNumber:
    """Rowland's EF2: extra energy of open-circuit ball milling, by the fraction that must pass the control
    size; interpolated.

    >>> round(efficiency_factor_open_circuit("80 %"), 3)
    1.2
    """
    return interpolate_linear(passing_fraction, jnp.array(_PASSING), jnp.array(_OPEN_CIRCUIT))[0]


@formula(
    source="rowland1980, EF3",
    equation=r"EF_3 = \left(\frac{2.44}{D}\right)^{0.2},\ D \le 3.81\ \mathrm{m};\ 0.914\ \text{above}",
    title="EF3, mill diameter",
    symbols={"efficiency_factor": "EF_3"},
)
def efficiency_factor_diameter(mill_diameter: Length) -> PositiveNumber:
    """Rowland's EF3: Bond's base mill is 2.44 m inside the liners; larger ones gain up to 3.81 m, and no more
    beyond.

    >>> round(efficiency_factor_diameter(3.81), 3)
    0.915
    """
    return (2.44 / jnp.minimum(mill_diameter, 3.81)) ** 0.2


@formula(
    source="rowland1980, EF4",
    title="EF4, oversized feed",
    equation=(
        r"EF_4 = \frac{R_r + (W_i - 7)\,\frac{F_{80} - F_o}{F_o}}{R_r},\ F_o = 4000\sqrt{13/W_i}\ "
        r"(\text{ball}),\ 16000\sqrt{13/W_i}\ (\text{rod}),\quad R_r = F_{80}/P_{80}"
    ),
    symbols={"efficiency_factor": "EF_4", "feed_size": "F_{80}", "product_size": "P_{80}"},
)
def efficiency_factor_oversize(
    feed_size: Length, product_size: Length, work_index: WorkIndex, mill: Literal["ball", "rod"] = "ball"
) -> PositiveNumber:
    """Rowland's EF4: extra energy for feed coarser than the best size of the mill; 1 below it.

    The source counts work indices in kWh per short ton, sizes in µm; any unit is taken here.

    >>> round(efficiency_factor_oversize("10 mm", "175 um", "13 kWh/short_ton"), 4)
    1.1575
    """
    wi = work_index / KWH_PER_SHORT_TON
    best = (4e-3 if mill == "ball" else 16e-3) * jnp.sqrt(13.0 / wi)
    ratio = feed_size / product_size
    return 1.0 + jnp.maximum((wi - 7.0) * (feed_size - best) / best, 0.0) / ratio * (feed_size > best)


@formula(
    source="rowland1980, EF5",
    equation=r"EF_5 = \frac{P_{80} + 10.3}{1.145\,P_{80}},\ P_{80} < 75\ \mathrm{µm}",
    title="EF5, fine product",
    typical={"product_size": (1.5e-5, 6e-5)},
    fitted={"product_size": (1.5e-5, jnp.inf)},
    symbols={"efficiency_factor": "EF_5", "product_size": "P_{80}"},
)
def efficiency_factor_fineness(product_size: Length) -> PositiveNumber:
    """Rowland's EF5: extra energy for products finer than 75 µm; 1 above, never above 5.

    >>> round(efficiency_factor_fineness("30 um"), 3)
    1.173
    """
    p = product_size * 1e6
    return jnp.where(p < 75.0, jnp.maximum((p + 10.3) / (1.145 * p), 1.0), 1.0)


@formula(
    source="rowland1980, EF6",
    equation=r"EF_6 = 1 + \frac{(R_r - R_{ro})^2}{150},\ R_{ro} = 8 + 5\,\frac{L}{D},\quad R_r = F/P",
    title="EF6, reduction ratio of a rod mill",
    typical={
        "feed_size": (1.5e-2, 2e-2),
        "product_size": (5e-4, 7e-4),
        "rod_length": (5.0, 5.5),
        "mill_diameter": (3.4, 3.6),
    },
    symbols={"efficiency_factor": "EF_6"},
)
def efficiency_factor_rod_ratio(
    feed_size: Length, product_size: Length, rod_length: Length, mill_diameter: Length
) -> PositiveNumber:
    """Rowland's EF6: extra energy of a rod mill whose reduction ratio differs from its best by more than 2; 1
    inside that band.

    >>> round(efficiency_factor_rod_ratio("18 mm", "0.9 mm", rod_length=4.5, mill_diameter=3.0), 3)
    1.135
    """
    away = feed_size / product_size - (8.0 + 5.0 * rod_length / mill_diameter)
    return jnp.where(abs(away) > 2.0, 1.0 + away**2 / 150.0, 1.0)


@formula(
    source="rowland1980, EF7",
    equation=r"EF_7 = \frac{2(R_r - 1.35) + 0.26}{2(R_r - 1.35)},\ R_r < 6,\quad R_r = F/P",
    title="EF7, low reduction ratio of a ball mill",
    typical={"feed_size": (3e-4, 5e-4), "product_size": (1e-4, 1.5e-4)},
    symbols={"efficiency_factor": "EF_7"},
)
def efficiency_factor_low_ratio(feed_size: Length, product_size: Length) -> PositiveNumber:
    """Rowland's EF7: extra energy of a ball mill with a reduction ratio below 6, as in regrinding; no value
    down to 1.35.

    >>> round(efficiency_factor_low_ratio("300 um", "100 um"), 4)
    1.0788
    """
    above = feed_size / product_size - 1.35
    impossible(above <= 0.0, product_size, "product_size", 0.0, feed_size / 1.35)
    low = (above > 0.0) & (above < 6.0 - 1.35)
    factor = 1.0 + 0.13 / jnp.where(low, above, 1.0)
    return jnp.where(above > 0.0, jnp.where(low, factor, 1.0), jnp.nan)


class MillDesign(NamedTuple):
    """Bond's energy with Rowland's factors, and the power."""

    specific_energy: SpecificEnergy
    efficiency_factor: PositiveNumber
    specific_energy_corrected: SpecificEnergy
    shaft_power: Power


@procedure(source="bond1961; rowland1980", title="Tumbling mill power (Bond and Rowland)")
def mill_power_bond(
    mass_flow: MassFlow,
    feed_size: Length,
    product_size: Length,
    work_index: WorkIndex,
    mill: Literal["ball", "rod"] = "ball",
    grinding: Literal["wet", "dry"] = "wet",
    circuit: Literal["closed", "open"] = "closed",
    passing_fraction: Fraction = 0.8,
    mill_diameter: Length = 2.44,
    rod_length: Length | None = None,
    rod_feed: Literal["closed_crushing", "open_crushing"] = "closed_crushing",
    single_stage: bool = True,
) -> MillDesign:
    """Power at the pinion of a rod or ball mill: Bond's energy times the factors EF1 to EF8 that apply.

    EF1 dry 1.3; EF2 open-circuit ball milling; EF3 diameter; EF4 oversized feed (ball mills: single stage
    only); EF5 fine product; EF6 and EF8 rod mills (EF8 1.2 after closed-circuit crushing, 1.4 after open;
    1 and 1.2 in a rod–ball circuit); EF7 low reduction ratio.

    >>> round(
    ...     mill_power_bond(
    ...         "500 tonne/hour",
    ...         "1200 um",
    ...         "175 um",
    ...         "11.7 kWh/tonne",
    ...         single_stage=False,
    ...         mill_diameter=2.44,
    ...     ).specific_energy
    ...     / 3600,
    ...     2,
    ... )
    5.47
    """
    base = float(specific_energy_bond(feed_size, product_size, work_index))
    factor = (DRY if grinding == "dry" else 1.0) * efficiency_factor_diameter(mill_diameter)
    if mill == "ball":
        factor *= efficiency_factor_open_circuit(passing_fraction) if circuit == "open" else 1.0
        factor *= efficiency_factor_fineness(product_size) * efficiency_factor_low_ratio(
            feed_size, product_size
        )
        factor *= efficiency_factor_oversize(feed_size, product_size, work_index) if single_stage else 1.0
    else:
        factor *= efficiency_factor_oversize(feed_size, product_size, work_index, "rod")
        factor *= (
            efficiency_factor_rod_ratio(feed_size, product_size, rod_length, mill_diameter)
            if rod_length is not None
            else 1.0
        )
        factor *= {
            True: {"closed_crushing": 1.2, "open_crushing": 1.4},
            False: {"closed_crushing": 1.0, "open_crushing": 1.2},
        }[single_stage][rod_feed]
    return MillDesign(base, float(factor), base * factor, base * factor * mass_flow)
