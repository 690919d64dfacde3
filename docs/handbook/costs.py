"""What the chapter on costs states, calculated."""

from functools import cache
from math import log2
from typing import Any

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.cases import read_text
from granum.core.charts import DASHES, LINES, add_line, figure

c = gr.costs
YEAR = 365.25 * 86400.0
HOURS = 8000.0 * 3600.0 / YEAR
"""Part of the year that the plant runs."""
INDEX = c.cost_index_annual(year=2023.0)
TONNE = 1e3

# ---- sizes


def filter_cost(area: float, kind: Any = "plate_and_frame_filter", index: float = 397.0):
    return c.equipment_cost_by_area(area, kind, index).purchased_cost


def exponent(cost, size):
    """Exponent of a cost curve between a size and twice that."""
    return log2(cost(2 * size) / cost(size))


def exchanger(area):
    return c.purchased_cost_exchanger(area)


def film(area):
    return c.purchased_cost_evaporator(area, "falling_film_evaporator")


def decanter(diameter):
    return c.equipment_cost_by_diameter(diameter).purchased_cost


bought = filter_cost(50.0)
bought_now = filter_cost(50.0, index=INDEX)
installed_now = c.equipment_cost_by_area(50.0, "plate_and_frame_filter", INDEX).bare_module_cost
lang_now = c.capital_cost_lang(bought_now, "solids_and_fluids")

rise = c.cost_index_annual(year=2022.0) / c.cost_index_annual(year=2020.0) - 1.0

# ---- money


def charge(rate, years):
    """Part of the capital to be paid each year."""
    return c.annual_capital_charge(1.0, rate, years * YEAR) * YEAR


# ---- evaporators
PRICES = {"steam": 35.0 / TONNE, "electricity": 0.12 / 3.6e6}
"""USD/kg and USD/J, of the chapter alone."""
CASE = """
title = "Evaporator"
[mixture]
liquids = ["water", "sucrose"]
gases = ["water"]
sizes = {{ smallest = "10 um", largest = "4 mm", classes = 3 }}
[feeds.juice]
to = "evaporator.feed"
temperature = "60 degC"
liquid_flow = "12.5 t/h"
liquid = {{ water = "90 %", sucrose = "10 %" }}
[units.evaporator]
{unit}
[streams]
syrup = ["evaporator.product"]
vapor = ["evaporator.vapor"]
condensate = ["evaporator.condensate"]
[specifications.strong]
vary = "evaporator.area"
so_that = "evaporator.solute_mass_fraction"
equals = "50 %"
lower = "{lower} m2"
upper = "{upper} m2"
"""
EFFECTS = 'model = "evaporation.multiple_effect_evaporator"\narea = "{} m2"\npressure = "0.2 bar"\n' + (
    'pressure_steam = "2 bar"\neffect_count = "{}"\nfeeding = "forward"\n'
    'heat_transfer_coefficient_first = "2500 W/(m2*K)"\nheat_transfer_coefficient_last = "1200 W/(m2*K)"'
)
ONE = (
    'model = "evaporation.evaporator"\narea = "60 m2"\npressure = "0.2 bar"\npressure_steam = "2 bar"\n'
    'heat_transfer_coefficient = "1700 W/(m2*K)"'
)
OWN = (
    'model = "evaporation.recompression_evaporator"\narea = "300 m2"\npressure = "0.7 bar"\n'
    'pressure_steam = "1.1 bar"\nheat_transfer_coefficient = "1700 W/(m2*K)"'
)


@cache
def solved(effects):
    """The evaporator of so many effects; 0 with recompression."""
    unit = {0: OWN, 1: ONE}.get(effects) or EFFECTS.format(40 + 20 * effects, effects)
    case = CASE.format(unit=unit, lower=5, upper=2000)
    if effects == 1:
        case = case.replace('condensate = ["evaporator.condensate"]\n', "")
    return read_text(case).solve()


def wall(effects):
    """Area of all effects, m²."""
    return max(effects, 1) * float(solved(effects).sheet.units["evaporator"].area)


def steam(effects):
    """Steam bought, kg/s."""
    return float(solved(effects).units["evaporator"].values.steam_flow)


def power(effects):
    return solved(effects).carriers.get("electricity", 0.0)


def capital(effects):
    """Falling films, one an effect, with all that belongs to them; the compressor is not among them."""
    count = max(effects, 1)
    each = c.purchased_cost_evaporator(wall(effects) / count, "falling_film_evaporator", INDEX)
    return c.capital_cost_lang(count * each, "fluids")


CHARGE = charge(0.10, 10)


def energy(effects):
    """Yearly cost of steam and electricity."""
    rate = c.material_cost_rate(steam(effects), PRICES["steam"], HOURS)
    return (rate + c.energy_cost_rate(power(effects), PRICES["electricity"], HOURS)) * YEAR


def yearly(effects):
    return CHARGE * capital(effects) + energy(effects)


def best_count(capital_times=1.0, steam_times=1.0):
    """Effects of least yearly cost with all capital or steam dearer."""
    return min(range(1, 6), key=lambda n: capital_times * CHARGE * capital(n) + steam_times * energy(n))


def per_water(effects):
    return solved(effects).utilities.energy_per_water


def gas_per_water(effects):
    return solved(effects).utilities.greenhouse_gas_rate / solved(effects).utilities.evaporation_rate


compressor_worth = (yearly(best_count()) - yearly(0)) / CHARGE
saved_steam = (steam(best_count()) - steam(0)) * 3600.0
break_even_power = (CHARGE * (capital(best_count()) - capital(0)) + (energy(best_count()) - energy(0))) / (
    power(0) * HOURS * YEAR
) + PRICES["electricity"]
gas_france = (
    solved(0).carriers["low_pressure_steam"] * c.emission_factor("low_pressure_steam")
    + power(0) * c.emission_factor("electricity", "electricity_france")
) / solved(0).utilities.evaporation_rate

steam_price = PRICES["steam"] / (solved(1).utilities.heat_input / steam(1)) * 3.6e9
"""USD per megawatt-hour of heat."""
by_line = solved(3).utility_cost({"low_pressure_steam": f"{steam_price} USD/MWh"}) * YEAR * HOURS

# ---- cake
DRYER = 3.0e6
"""J per kilogram of water in a good convective dryer."""
HEAT_PRICE = 45.0 / 3.6e9


def water_left(solids):
    """Water per dry solid of a cake."""
    return (1.0 - solids) / solids


at_22, at_32 = water_left(0.22), water_left(0.32)
spared = water_left(0.22) - water_left(0.32)
spared_heat = spared * DRYER


def worth_of_point(solids):
    """Yearly heat that one percent more of dry solids in the cake spares, for 1 t/h of dry solids, USD."""
    water = TONNE / 3600.0 * (water_left(solids - 0.005) - water_left(solids + 0.005))
    return c.energy_cost_rate(water * DRYER, HEAT_PRICE, HOURS) * YEAR


press_step = (
    c.equipment_cost_by_area(80.0, "plate_and_frame_filter", INDEX).bare_module_cost
    - c.equipment_cost_by_area(40.0, "plate_and_frame_filter", INDEX).bare_module_cost
)


def figure_sizes():
    drawing = figure(
        said("size over smallest size", "taille sur la plus petite"),
        said("price over smallest price", "prix sur le plus petit"),
    )
    drawing.update_xaxes(type="log")
    drawing.update_yaxes(type="log")
    kinds = (
        (said("filter press", "filtre-presse"), filter_cost, 0.5, 80.0),
        (
            said("falling film", "film tombant"),
            film,
            50.0,
            500.0,
        ),
        (said("exchanger", "échangeur"), exchanger, 10.0, 1000.0),
        (said("decanter", "décanteuse"), decanter, 0.3, 2.0),
    )
    for place, (name, cost, low, high) in enumerate(kinds):
        sizes = np.geomspace(low, high, 25)
        prices = np.array([float(cost(float(s))) for s in sizes])
        add_line(
            drawing,
            sizes / low,
            prices / prices[0],
            name,
            color=LINES[place],
            dash=DASHES[place % len(DASHES)],
        )
    span = np.geomspace(1.0, 160.0, 9)
    add_line(drawing, span, span**0.6, said("six tenths", "six dixièmes"), color=LINES[4])
    return drawing


def figure_effects():
    drawing = figure(said("effects", "effets"), said("yearly cost, million USD", "coût annuel, millions USD"))
    drawing.update_yaxes(rangemode="tozero")
    counts = list(range(1, 6))
    lines = (
        (said("steam", "vapeur"), energy),
        (said("charge of the capital", "charge du capital"), lambda n: CHARGE * capital(n)),
        (said("together", "ensemble"), yearly),
    )
    for place, (name, cost) in enumerate(lines):
        add_line(
            drawing, counts, [cost(n) / 1e6 for n in counts], name, color=LINES[place], dash=DASHES[place]
        )
    return drawing
