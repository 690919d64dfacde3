"""Solids that go to vapor and back: the pressure of their vapor, and what a gas carries over from a vaporizer
to a condenser.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    MassRatio,
    MolarMass,
    PositiveNumber,
    Pressure,
    Ratio,
    Temperature,
)
from granum.crystallization.kinds import GasPressure, PositiveMolarEnergy, Saturated
from granum.numerics import find_root

BOILS = (
    "The vapor has the pressure of the gas and needs no carrier: give a colder vaporizer or more pressure."
)
NOTHING_CAUGHT = "The condenser leaves as much vapor in the gas as the vaporizer gives."
TRACE = 1e-9  # of all that may be in the gas: no less of it is looked for


class EntrainerBalance(NamedTuple):
    """Vapor per carrier, in and out of the condenser; share that is caught; carrier per product."""

    vapor_per_carrier_inlet: MassRatio
    vapor_per_carrier_outlet: MassRatio
    product_recovery: Ratio
    carrier_per_product: PositiveNumber


@formula(
    source="mullin2001, ch. 8; richardson2002, ch. 15",
    title="Pressure of the vapor of a solid (Clausius and Clapeyron)",
    equation=r"p_s = p_0 \exp\left[\frac{\Delta H_s}{R}\left(\frac{1}{T_0} - \frac1T\right)\right]",
    output="sublimation_pressure",
    typical={
        "temperature": (290.0, 350.0),
        "pressure_reference": (1.0, 100.0),
        "temperature_reference": (280.0, 320.0),
        "enthalpy_of_sublimation": (6e4, 1e5),
    },
)
def sublimation_pressure_clapeyron(
    temperature: Temperature,
    pressure_reference: GasPressure,
    temperature_reference: Temperature,
    enthalpy_of_sublimation: PositiveMolarEnergy,
) -> Pressure:
    """Pressure of the vapor over a solid from that at another temperature and the heat of sublimation, taken
    as constant.

    Above the triple point the solid melts, which this does not know.

    >>> round(sublimation_pressure_clapeyron(298.15, 0.4, 267.88, 74.4e3), 1)
    11.9
    """
    slope = enthalpy_of_sublimation / GAS_CONSTANT
    return pressure_reference * jnp.exp(slope * (1.0 / temperature_reference - 1.0 / temperature))


@formula(
    source="mullin2001, ch. 8; richardson2002, ch. 15",
    title="Entrainer sublimation: carrier and yield",
    equation=(
        r"Y_1 = \frac{M}{M_g}\,\frac{\varphi\,p_1}{P_1 - \varphi\,p_1},\quad "
        r"Y_2 = \frac{M}{M_g}\,\frac{p_2}{P_2 - p_2},\quad R = 1 - \frac{Y_2}{Y_1},\quad "
        r"\frac{m_g}{m_P} = \frac{1}{Y_1 - Y_2}"
    ),
    output="entrainer_balance",
    typical={
        "sublimation_pressure_inlet": (500.0, 5000.0),
        "sublimation_pressure_outlet": (0.1, 20.0),
        "pressure_inlet": (1e5, 1.1e5),
        "pressure_outlet": (8e4, 1e5),
        "molar_mass": (0.12, 0.18),
        "carrier_molar_mass": (0.028, 0.044),
    },
    symbols={"pressure_inlet": "P_1", "pressure_outlet": "P_2"},
)
def entrainer_balance(
    sublimation_pressure_inlet: Pressure,
    sublimation_pressure_outlet: Pressure,
    pressure_inlet: GasPressure,
    pressure_outlet: GasPressure,
    molar_mass: MolarMass,
    carrier_molar_mass: MolarMass,
    vapor_saturation: Saturated = 1.0,
) -> EntrainerBalance:
    """Vapor that a carrier gas takes up over a hot solid and what it still holds behind the condenser, with
    the carrier needed and the share that is lost if the gas is not used again.

    Pressures of the vapor are those at saturation, in the vaporizer and at the end of the condenser; the
    share says how near to saturation the gas comes in the vaporizer. A gas that goes round brings its vapor
    back, and only what is purged is lost.

    >>> out = entrainer_balance(1440, 2.3, 101.5e3, 85.6e3, 0.138, 0.029)
    >>> round(out.product_recovery, 4)
    0.9981
    """
    p, P = vapor_saturation * sublimation_pressure_inlet, pressure_inlet
    end, P_end = sublimation_pressure_outlet, pressure_outlet
    mass = molar_mass / carrier_molar_mass
    open_in, open_out = p < P, end < P_end
    impossible(~open_in, p, "sublimation_pressure_inlet", 0.0, P, BOILS)
    hot = mass * p / jnp.where(open_in, P - p, jnp.nan)
    cold = mass * end / jnp.where(open_out, P_end - end, jnp.nan)
    caught = hot > cold
    impossible(~caught, cold, "vapor_per_carrier_outlet", 0.0, hot, NOTHING_CAUGHT)
    gain = jnp.where(caught, hot - cold, jnp.nan)
    return EntrainerBalance(hot, cold, gain / jnp.where(caught, hot, 1.0), 1.0 / gain)


def vapors_held(others: Any, available: Any, shares: Any) -> Any:
    """Moles of each vapor in a gas: what there is, or what saturates it, whichever is less.

    ``others`` are the moles of gas that neither sublimes nor condenses, ``shares`` the pressures at
    saturation over that of the gas. Where the vapors reach the whole pressure all of them may be gas without
    a carrier.
    """
    available, shares = jnp.asarray(available, dtype=float), jnp.asarray(shares, dtype=float)
    highest = others + jnp.sum(available)
    some = highest > 0.0
    top = jnp.where(some, highest, 1.0)

    def missing(moles: Any) -> Any:
        return moles - others - jnp.sum(jnp.minimum(available, shares * moles))

    lowest = jnp.maximum(others, TRACE * top)
    # a little above the highest, which may miss zero by rounding
    near = jnp.where(missing(lowest) < 0.0, find_root(missing, lowest, 1.001 * top).value, lowest)
    # which vapors are all gas is known now, and what the others hold follows without error
    spent = available <= shares * near
    free = 1.0 - jnp.sum(jnp.where(spent, 0.0, shares))
    whole = (others + jnp.sum(jnp.where(spent, available, 0.0))) / jnp.where(free > 0.0, free, 1.0)
    moles = jnp.where(free > 0.0, whole, near)
    return jnp.where(some, jnp.minimum(available, shares * moles), 0.0)
