"""What the chapter on humid gas states, calculated."""

import numpy as np
from validation import humid_gas_saturation

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure

h = gr.humid_gas

# ---- state
air = h.air_composition()
nitrogen, oxygen, argon = (float(x) for x in air.mole_fraction[:3])
room = h.state(temperature="25 degC", relative_humidity="50 %")
hot = h.state(temperature="80 degC", humidity_ratio=float(room.humidity_ratio))
rule = {t: float(h.humidity_ratio_saturated(f"{t} degC")) for t in (10, 20, 30, 60, 90)}
doubled = rule[30] / rule[20]
volume_gain = float(hot.specific_volume) / float(room.specific_volume) - 1

# ---- mixed
first = h.state(enthalpy="100 kJ/kg", humidity_ratio=0.027)
second = h.state(enthalpy="160 kJ/kg", humidity_ratio=0.04)
mixed = h.mixing(1.5, 0.027, "100 kJ/kg", 2.5, 0.04, "160 kJ/kg")
# ---- fog
cold = h.state(temperature="0 degC", relative_humidity="90 %")
warm = h.state(temperature="45 degC", relative_humidity="85 %")
cold_air, warm_air = ((float(x.humidity_ratio), float(x.enthalpy)) for x in (cold, warm))
foggy = h.mixing(1.0, *cold_air, 0.5, *warm_air)

# ---- coil
fed = h.state(temperature="25 degC", relative_humidity="60 %")
coil = h.dehumidifying("25 degC", float(fed.humidity_ratio), "5 degC", coil_bypass_fraction=0.1)
reheated = h.heating(float(coil.temperature), float(coil.humidity_ratio), "30 degC")
only_heating = h.state(
    humidity_ratio=float(fed.humidity_ratio), relative_humidity=float(reheated.relative_humidity)
)
only_heat = float(only_heating.enthalpy) - float(fed.enthalpy)

# ---- bulbs
PAIRS = ("air_water", "air_ethanol", "air_acetone", "air_toluene")
bulbs = {
    pair: [
        float(f(temperature="60 degC", humidity_ratio=0.005, pair=pair))
        for f in (h.wet_bulb_temperature, h.adiabatic_saturation_temperature)
    ]
    for pair in PAIRS
}
apart = {pair: wet - saturated for pair, (wet, saturated) in bulbs.items()}

# ---- altitude
high = h.pressure_at_altitude("2000 m")
room_high = h.state(temperature="25 degC", relative_humidity="50 %", pressure=float(high))
wetter = float(room_high.humidity_ratio) / float(room.humidity_ratio) - 1
lighter = 1 - float(room_high.density) / float(room.density)
saturated_gain = float(h.humidity_ratio_saturated("60 degC", float(high))) / rule[60] - 1

# ---- instrument
exhaust = h.state(temperature="90 degC", humidity_ratio=0.05)
w = float(exhaust.humidity_ratio)


def off(**given):
    """Relative error of the humidity ratio read with an instrument that is off."""
    return abs(float(h.state(**given).humidity_ratio) / w - 1)


DRY = float(exhaust.temperature)
errors = {
    "relative": off(temperature=DRY, relative_humidity=float(exhaust.relative_humidity) + 0.02),
    "temperature": off(temperature=DRY + 1, relative_humidity=float(exhaust.relative_humidity)),
    "wet": off(temperature=DRY, wet_bulb_temperature=float(exhaust.wet_bulb_temperature) + 0.5),
    "dew": off(temperature=DRY, dew_point_temperature=float(exhaust.dew_point_temperature) + 0.5),
}

# ---- filter
flue = h.state(temperature="95 degC", humidity_ratio=0.12)
leaked = h.mixing(1.0, 0.12, float(flue.enthalpy), 0.1, *cold_air)
leaked_dew = h.dew_point_temperature(float(leaked.humidity_ratio))
margin = float(flue.temperature) - float(flue.dew_point_temperature)
steel = float(flue.dew_point_temperature) + 10


def figure_chart():
    drawing = h.psychrometric_chart("0 degC", "60 degC", 0.045)
    drawing.update_layout(width=None, height=560)
    return drawing


def figure_saturation():
    drawing = humid_gas_saturation().figure
    for trace in drawing.data:
        trace.name = {
            "Granum, ideal gas": said("Granum, ideal gas", "Granum, gaz parfait"),
            "ASHRAE, table of moist air": said("ASHRAE, table of moist air", "ASHRAE, table de l’air humide"),
        }.get(trace.name, trace.name)
    return drawing


def figure_fog():
    drawing = figure(axis_title("temperature", "degC"), axis_title("humidity_ratio", "g/kg"))
    celsius = np.linspace(-5, 50, 80)
    saturated = 1e3 * np.asarray(h.humidity_ratio_saturated(celsius + 273.15))
    add_line(drawing, celsius, saturated, said("saturation", "saturation"), color=LINES[2])
    ends = [(0.0, 1e3 * float(cold.humidity_ratio)), (45.0, 1e3 * float(warm.humidity_ratio))]
    add_line(
        drawing,
        [x for x, _y in ends],
        [y for _x, y in ends],
        said("mixtures of the two airs", "mélanges des deux airs"),
        color=LINES[0],
        dash=DASHES[1],
    )
    return drawing
