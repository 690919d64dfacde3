"""Charts of dryers: the path of the air, and where the heat goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from granum.core import chart
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    MassFlow,
    MoistureDryBasis,
    Power,
    Pressure,
    RelativeHumidity,
    Temperature,
)
from granum.core.units import format_number
from granum.drying.balances.convective import DryerBalance, dryer_balance
from granum.humid_gas.charts import mollier_chart, psychrometric_chart

if TYPE_CHECKING:
    import plotly.graph_objects as go


def _balance(**given: Any) -> DryerBalance:
    """The balance, or one sentence that says why there is none."""
    found = dryer_balance.evaluate(**{name: value for name, value in given.items() if value is not None})
    found.check()
    return found.value


def _round(value: float, step: float, up: bool) -> float:
    return float((np.ceil if up else np.floor)(value / step) * step)


@chart(source="keey1978; bonazzi2003", title="Path of the air in a dryer")
def dryer_air_path(
    temperature_fresh: Temperature,
    relative_humidity_fresh: RelativeHumidity,
    temperature_inlet: Temperature,
    relative_humidity_outlet: RelativeHumidity | None = None,
    temperature_outlet: Temperature | None = None,
    recirculated_fraction: Fraction = 0.0,
    temperature_product_inlet: Temperature | None = None,
    temperature_product_outlet: Temperature | None = None,
    moisture_dry_basis_inlet: MoistureDryBasis = 0.54,
    moisture_dry_basis_outlet: MoistureDryBasis = 0.18,
    heat_loss: Power | None = None,
    mass_flow_inlet: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    diagram: Literal["psychrometric", "mollier"] = "psychrometric",
) -> go.Figure:
    """Fresh, mixed, heated and outlet air of a dryer on the psychrometric chart or the Mollier chart, with
    the states beneath.

    Air that is recirculated returns to the mixing point (dashed).

    >>> figure = dryer_air_path("25 degC", "50 %", "50 degC", "100 %")
    >>> figure.layout.title.text.split(" ·")[0]
    'Path of the air in a dryer'
    """
    v = _balance(
        temperature_fresh=temperature_fresh,
        relative_humidity_fresh=relative_humidity_fresh,
        temperature_inlet=temperature_inlet,
        relative_humidity_outlet=relative_humidity_outlet,
        temperature_outlet=temperature_outlet,
        recirculated_fraction=recirculated_fraction,
        temperature_product_inlet=temperature_product_inlet,
        temperature_product_outlet=temperature_product_outlet,
        moisture_dry_basis_inlet=moisture_dry_basis_inlet,
        moisture_dry_basis_outlet=moisture_dry_basis_outlet,
        heat_loss=heat_loss,
        mass_flow_inlet=mass_flow_inlet,
        pressure=pressure,
    )
    states = [(v.temperature_fresh, v.humidity_ratio_fresh)]
    if recirculated_fraction > 0:
        from granum.humid_gas.formulas.processes import mixing

        r = recirculated_fraction
        mixed = mixing(
            1.0 - r,
            v.humidity_ratio_fresh,
            v.enthalpy_fresh,
            r,
            v.humidity_ratio_outlet,
            v.enthalpy_outlet,
            pressure,
        )
        states.append((mixed.temperature, mixed.humidity_ratio))
    states += [(v.temperature_inlet, v.humidity_ratio_inlet), (v.temperature_outlet, v.humidity_ratio_outlet)]
    T, w = (np.array(column) for column in zip(*states, strict=True))
    draw = {"psychrometric": psychrometric_chart, "mollier": mollier_chart}[diagram]
    low, high = (
        _round(T.min() - 273.15 - 10.0, 5.0, False) + 273.15,
        _round(T.max() - 273.15 + 8.0, 5.0, True) + 273.15,
    )
    figure = draw(
        temperature_low=low,
        temperature_high=high,
        humidity_ratio_high=_round(1.35 * w.max(), 0.005, True),
        pressure=pressure,
        temperature=T,
        humidity_ratio=w,
    )
    if recirculated_fraction > 0:  # the outlet air returns to the mixing point
        from granum.core.charts import ACCENT, add_line

        places = next(trace for trace in figure.data if getattr(trace, "mode", "") == "markers+text")
        add_line(
            figure,
            [places.x[3], places.x[1]],
            [places.y[3], places.y[1]],
            _("recirculated air"),
            color=ACCENT,
            dash="dash",
        )
    text = figure.layout.title.text
    figure.update_layout(title=f"{_('Path of the air in a dryer')} · {text.split(' · ', 1)[1]}")
    return figure


@chart(source="keey1978; mujumdar2014", title="Where a dryer's heat goes")
def dryer_energy_chart(
    temperature_fresh: Temperature,
    relative_humidity_fresh: RelativeHumidity,
    temperature_inlet: Temperature,
    relative_humidity_outlet: RelativeHumidity | None = None,
    temperature_outlet: Temperature | None = None,
    mass_flow_inlet: MassFlow = 1.0,
    moisture_dry_basis_inlet: MoistureDryBasis = 0.54,
    moisture_dry_basis_outlet: MoistureDryBasis = 0.18,
    recirculated_fraction: Fraction = 0.0,
    leak_fraction: Fraction = 0.0,
    shaft_power: Power = 0.0,
    heat_duty_inside: Power = 0.0,
    heat_loss: Power = 0.0,
    temperature_product_inlet: Temperature | None = None,
    temperature_product_outlet: Temperature | None = None,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> go.Figure:
    """Energy flows of a dryer per kilogram of evaporated water: what heater, fan and inner heating give, and
    what evaporates, warms or is lost.

    Evaporation counts from the liquid at the product's temperature (or, isenthalpic, at 0 °C) to vapor at the
    wet bulb; the warm exhaust is the rest of what the air carries away above the fresh air.

    >>> figure = dryer_energy_chart("25 degC", "50 %", "80 degC", "60 %", heat_loss="100 kW")
    >>> [name.split("<")[0] for name in figure.data[0].node.label]
    ['heater', 'dryer', 'evaporation', 'warm exhaust', 'losses']
    """
    import plotly.graph_objects as go

    from granum.core.charts import ACCENT, CAUTION, GAS, HEAT, INK, LIQUID, SOLID, template

    v = _balance(
        temperature_fresh=temperature_fresh,
        relative_humidity_fresh=relative_humidity_fresh,
        temperature_inlet=temperature_inlet,
        relative_humidity_outlet=relative_humidity_outlet,
        temperature_outlet=temperature_outlet,
        mass_flow_inlet=mass_flow_inlet,
        moisture_dry_basis_inlet=moisture_dry_basis_inlet,
        moisture_dry_basis_outlet=moisture_dry_basis_outlet,
        recirculated_fraction=recirculated_fraction,
        leak_fraction=leak_fraction,
        shaft_power=shaft_power,
        heat_duty_inside=heat_duty_inside,
        heat_loss=heat_loss,
        temperature_product_inlet=temperature_product_inlet,
        temperature_product_outlet=temperature_product_outlet,
        pressure=pressure,
    )
    W = v.evaporation_rate
    given = [
        (_("heater"), v.heat_duty, HEAT),
        (_("fan"), v.shaft_power, ACCENT),
        (_("heat inside"), v.heat_duty_inside, CAUTION),
    ]
    # with the vapor of the water taken up
    carried = v.dry_gas_flow_fresh * (v.enthalpy_outlet - v.enthalpy_fresh)
    # negative: the product's water brings its own
    product = v.heat_duty + v.shaft_power + v.heat_duty_inside - v.heat_loss - carried
    evaporation = v.heat_duty_minimum
    taken = [
        (_("evaporation"), evaporation, LIQUID),
        (_("warm exhaust"), carried - evaporation + min(product, 0.0), GAS),
        (_("product"), max(product, 0.0), SOLID),
        (_("losses"), v.heat_loss, INK),
    ]
    given, taken = ([row for row in rows if row[1] > 1.0 * W] for rows in (given, taken))
    unit = W * 1e3  # kJ/kg

    def label(name: str, value: float) -> str:
        return f"{name}<br>{format_number(value / unit, 4)} kJ/kg"

    labels = [label(n, x) for n, x, _c in given] + [_("dryer")] + [label(n, x) for n, x, _c in taken]
    middle = len(given)
    links = [(i, middle, x / unit, color) for i, (_n, x, color) in enumerate(given)]
    links += [(middle, middle + 1 + i, x / unit, color) for i, (_n, x, color) in enumerate(taken)]
    source, target, value, colors = zip(*links, strict=True)
    drawing = go.Figure(
        go.Sankey(
            arrangement="snap",
            valueformat=".4~g",
            valuesuffix=" kJ/kg",
            node={
                "label": labels,
                "color": [c for _n, _x, c in given] + [INK] + [c for _n, _x, c in taken],
                "pad": 28,
                "thickness": 16,
                "line": {"width": 0},
            },
            link={"source": source, "target": target, "value": value, "color": [_pale(c) for c in colors]},
        )
    )
    title = _("Where a dryer's heat goes") + f" · CEM {format_number(v.energy_per_water / 1e3, 4)} kJ/kg"
    drawing.update_layout(
        template=template(),
        title=title,
        height=480,
        font={"size": 13},
        margin={"l": 20, "r": 20, "t": 60, "b": 20},
    )
    return drawing


def _pale(color: str) -> str:
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return f"rgba({red},{green},{blue},0.35)"
