"""From equipment to a plant, from capital to a yearly charge, from power to money."""

from __future__ import annotations

from typing import Annotated, Literal

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active
from granum.core.constants import DAY
from granum.core.kinds import (
    Cost,
    CostRate,
    EnergyPrice,
    Fraction,
    MassFlow,
    MassPrice,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    Within,
)
from granum.costs.tables import plant_cost_index
from granum.numerics.smooth import safe_divide

SHORT_LIFE = "A life of less than a day: a number without a unit is in seconds; write '10 year'."
NO_GAIN = "Without a gain nothing is paid back."
SHORT_PAYBACK = "Paid back within a day: a gain without a unit is per second; write '25000 USD/year'."
LANG = {"solids": 3.10, "solids_and_fluids": 3.63, "fluids": 4.74}


@formula(
    source="cepci",
    title="Plant cost index of a year",
    fitted={"year": (1990.0, 2023.0)},
    typical={"year": (1991.3, 2022.6)},
    equation=r"I = I(y)",
)
def cost_index_annual(year: Annotated[PositiveNumber, Within(1950.0, 2100.0)]) -> PositiveNumber:
    """Annual average of the Chemical Engineering Plant Cost Index, 1957–59 = 100, straight lines between
    years.

    Before 1990 and after 2023 the nearest value is kept and flagged.

    >>> cost_index_annual(year=2010.0)
    550.8
    """
    years, values = plant_cost_index()
    return jnp.interp(year, years, values)


@formula(
    source="peters2003, ch. 6",
    equation=r"C = C_0\,\frac{I}{I_0}",
    title="Cost carried to another year",
    symbols={"cost": "C_0", "cost_index_known": "I_0", "=cost": "C"},
)
def cost_updated(cost: Cost, cost_index_known: PositiveNumber, cost_index: PositiveNumber) -> Cost:
    """A cost of one year in the money of another, by the ratio of a price index.

    Good over about ten years.

    >>> round(cost_updated(cost=100.0, cost_index_known=397.0, cost_index=550.8), 1)
    138.7
    """
    return cost * cost_index / cost_index_known


@formula(
    source="lang1948",
    equation=r"C_T = F_L \sum C_p",
    title="Capital cost of a plant by Lang's factors",
    output="capital_cost",
)
def capital_cost_lang(
    purchased_cost: Cost, plant_type: Literal["solids_and_fluids", "solids", "fluids"] = "solids_and_fluids"
) -> Cost:
    """Capital cost of a plant from the purchased cost of its main equipment.

    Factors 3.10 for plants that handle solids, 3.63 for solids and fluids, 4.74 for fluids.
    Order-of-magnitude estimate.

    >>> round(capital_cost_lang(purchased_cost=1e6))
    3630000
    """
    return LANG[plant_type] * purchased_cost


@formula(
    source="peters2003, ch. 7",
    equation=r"A = C_T\,\frac{i(1+i)^n}{(1+i)^n-1}",
    title="Annual charge of capital",
    typical={"interest_rate": (0.02, 0.2), "lifetime": (1.6e8, 7.0e8)},
)
def annual_capital_charge(
    capital_cost: Cost, interest_rate: Annotated[Ratio, Within(0.0, 1.0)], lifetime: Time
) -> CostRate:
    """Constant charge that pays a capital back with interest over its life (annuity), per unit of time.

    The interest is per year and paid at the end of each. Without interest it is the capital over the life.
    The rate is that of the annuity spread evenly over the year of 365.25 days.

    >>> year = 365.25 * 86400.0
    >>> round(annual_capital_charge(capital_cost=1000.0, interest_rate=0.10, lifetime=10 * year) * year, 1)
    162.7
    """
    year = 365.25 * 86400.0
    limit_active(lifetime < DAY, lifetime, "lifetime", reason=SHORT_LIFE)
    n = lifetime / year
    growth = jnp.expm1(n * jnp.log1p(interest_rate))
    factor = jnp.where(
        interest_rate > 1e-9, safe_divide(interest_rate * (1.0 + growth), growth, 0.0), 1.0 / n
    )
    return capital_cost * factor / year


@formula(source="peters2003, ch. 6", equation=r"C_E = P\,p_E", title="Cost of energy")
def energy_cost_rate(power: Power, energy_price: EnergyPrice, operating_fraction: Fraction = 1.0) -> CostRate:
    """Cost of heat or electricity per unit of time, averaged over the year.

    ``operating_fraction`` is the part of the year that the plant runs (8000 h: 0.913).

    >>> rate = energy_cost_rate(power=1e6, energy_price="0.10 USD/kWh")
    >>> round(rate * 3600, 6)
    100.0
    """
    return power * energy_price * operating_fraction


@formula(source="peters2003, ch. 6", equation=r"C_M = \dot m\,p_M", title="Cost of a material")
def material_cost_rate(
    mass_flow: MassFlow, mass_price: MassPrice, operating_fraction: Fraction = 1.0
) -> CostRate:
    """Cost or worth of a stream per unit of time, averaged over the year.

    >>> round(material_cost_rate(mass_flow="1 tonne/hour", mass_price="500 USD/tonne") * 3600, 6)
    500.0
    """
    return mass_flow * mass_price * operating_fraction


@formula(
    source="peters2003, ch. 8",
    equation=r"t_p = \frac{C_T}{G}",
    title="Payback time",
    typical={"annual_gain": (0.001, 0.01)},
)
def payback_time(capital_cost: Cost, annual_gain: CostRate) -> Time:
    """Time in which the yearly gain returns the capital, without interest.

    >>> year = 365.25 * 86400.0
    >>> round(payback_time(capital_cost=3e6, annual_gain=1e6 / year) / year, 6)
    3.0
    """
    impossible(~(annual_gain > 0), annual_gain, "annual_gain", 0.0, jnp.inf, NO_GAIN)
    impossible(capital_cost < 0, capital_cost, "capital_cost", 0.0, jnp.inf)
    time = jnp.where(annual_gain > 0, safe_divide(capital_cost, annual_gain, 0.0), jnp.inf)
    limit_active((time > 0) & (time < DAY), time, "payback_time", reason=SHORT_PAYBACK)
    return time
