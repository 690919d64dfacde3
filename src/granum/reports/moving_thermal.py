"""The figures with sliders of crystallization, humid gas and drying, by name."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import numpy as np
import plotly.graph_objects as go

import granum as gr
from granum.core.charts import (
    CAUTION,
    GAS,
    HEAT,
    INK,
    LIQUID,
    add_label,
    add_line,
    add_points,
    axis_title,
    figure,
)
from granum.core.constants import ZERO_CELSIUS
from granum.core.i18n import _
from granum.core.units import format_number
from granum.drying.formulas.vials import dry, vial_of
from granum.reports.moving import MovingFigure, Slider

NITRATE = {  # Miller and Rawlings (1994), with the data of Chung, Ma and Braatz (1999)
    "solute_per_solvent": 0.4929904,
    "solubility": {"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    "growth": {"law": "power_law_growth", "growth_coefficient": "6967 um/min", "growth_order": 1.32},
    "nucleation": {
        "law": "secondary_nucleation",
        "nucleation_coefficient": 2.78e-5 * 1e18 / 60 / 2110,
        "nucleation_order": 1.78,
    },
    "crystal_density": 2110,
    "seed_size": "100 um",
    "seed_width": "20 um",
}
SEEN = 1e-5  # g/(kg µm): below the axis of the packets, where rounding is
COOLING = {"law": "power_cooling", "temperature_start": "32 degC", "temperature_end": "28 degC"}
TRAY = {  # Geankoplis, problem 9.7-2: the moistures of its drying curve
    "start": 0.29,
    "equilibrium": 0.05,
    "end": 0.06,
    "bulk_density": 800.0,  # kg/m³ of dry solid, assumed
}
VIAL = {  # the example of Shivkumar and others (2019), SI
    "area": 3.8e-4,
    "area_product": 3.14e-4,
    "concentration": 50.0,
    "solid_density": 1500.0,
    "contact": 2.75e-4 * 41840.0,
    "gas": 8.93e-4 * 41840.0 / 133.322,
    "saturation": 0.46 / 133.322,
    "R0": 1.4 * 4.7996e4,
    "A1": 16.0 * 4.7996e6,
    "A2": 0.0,
}
FROZEN, RAMP = ZERO_CELSIUS - 35.0, 1.0 / 60.0  # shelf at first, K, and its warming, K/s


def _number(text: str) -> float:
    return float(text.split()[0])


def population(growth_rate: str, residence_time: str) -> go.Figure:
    """Population density of crystals in an MSMPR with a given birth of nuclei; the point is the median by
    mass.
    """
    size = np.linspace(0.0, 2e-3, 30)  # m
    length = 1e-3 * _number(growth_rate) * _number(residence_time)  # mm
    density = gr.crystallization.population_density(size, 1.0, growth_rate, residence_time)
    drawn = figure(
        axis_title("crystal_size", "mm"),
        axis_title("", "", _("crystals over those of size zero")),
        y_log=True,
    )
    add_line(drawn, 1e3 * size, np.asarray(density), _("population density"))
    median = 3.672 * length  # half of the mass of an exponential distribution lies below
    add_points(drawn, [median], [np.exp(-3.672)], _("median of the mass"), color=CAUTION)
    drawn.update_xaxes(range=[0.0, 2.0])
    drawn.update_yaxes(range=[-6.0, 0.0])
    return drawn


def plate(thickness: str, diffusivity: str) -> go.Figure:
    """Moisture ratio of a plate that dries from both faces."""
    hours = np.linspace(0.05, 12.0, 40)
    half = 0.5 * _number(thickness)
    ratio = gr.drying.moisture_ratio_plate(3600 * hours, f"{half} mm", diffusivity)
    drawn = figure(axis_title("drying_time", "hour"), axis_title("moisture_ratio"))
    add_line(drawn, hours, np.asarray(ratio), _("moisture ratio"))
    drawn.update_xaxes(range=[0.0, 12.0])
    drawn.update_yaxes(range=[0.0, 1.0])
    return drawn


def batch(seed_mass_per_solvent: str, duration: str) -> go.Figure:
    """Packets of crystals of a cooling batch at five times: the seeds, and behind them what was born."""
    drawn = gr.crystallization.size_distribution_chart(
        **NITRATE,
        temperature_program=COOLING | {"duration": duration},
        duration=duration,
        seed_mass_per_solvent=seed_mass_per_solvent,
    )
    for trace in drawn.data:
        trace.x, trace.y = _runs(np.asarray(trace.x), np.asarray(trace.y))
    drawn.update_xaxes(range=[0.0, 700.0])
    drawn.update_yaxes(range=[-4.0, 1.0])
    return drawn


def _runs(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Each stretch of a line that is seen, with sixteen points at most and a gap behind it."""
    there = np.flatnonzero(y > SEEN)
    stretches = np.split(there, np.flatnonzero(np.diff(there) > 1) + 1)
    kept = [s[np.linspace(0, len(s) - 1, min(len(s), 16)).round().astype(int)] for s in stretches if len(s)]
    gap = [np.nan]
    return tuple(np.concatenate([part for k in kept for part in (v[k], gap)]) for v in (x, y))  # type: ignore[return-value]


@cache
def _isolines() -> dict[float, tuple[np.ndarray, np.ndarray]]:
    """Temperature, °C, and humidity, g/kg, along relative humidities."""
    found = {}
    for share, hottest in ((1.0, 42.0), (0.5, 55.0), (0.2, 75.0), (0.1, 93.0), (0.05, 113.0)):
        t = np.linspace(0.0, hottest, 25)
        state = gr.humid_gas.state(temperature=t + ZERO_CELSIUS, relative_humidity=share)
        found[share] = (t, 1e3 * np.asarray(state.humidity_ratio))
    return found


def dryer_air(temperature_fresh: str, temperature_inlet: str, relative_humidity_outlet: str) -> go.Figure:
    """The way of the air through heater and dryer on the humid chart."""
    drawn = figure(axis_title("temperature", "degC"), axis_title("humidity_ratio", "g/kg"))
    for share, (t, w) in _isolines().items():
        add_line(drawn, t, w, _("relative humidity"), color=GAS, width=1, showlegend=False)
        there = float(np.interp(47.0, w, t))
        add_label(drawn, there, 47.0, f"{format_number(100 * share)} %", color=GAS, bgcolor="white")
    air = gr.drying.dryer_balance(
        dry_solid_flow="1 kg/hour",
        moisture_dry_basis_inlet=0.54,
        moisture_dry_basis_outlet=0.18,
        temperature_fresh=temperature_fresh,
        relative_humidity_fresh="50 %",
        temperature_inlet=temperature_inlet,
        relative_humidity_outlet=relative_humidity_outlet,
    )
    wet = 1e3 * np.asarray(
        [air.humidity_ratio_fresh, air.humidity_ratio_outlet, air.humidity_ratio_equilibrium]
    )
    fresh, hot, out, bulb = (
        float(t) - ZERO_CELSIUS
        for t in (
            air.temperature_fresh,
            air.temperature_inlet,
            air.temperature_outlet,
            air.wet_bulb_temperature,
        )
    )
    energy = format_number(float(air.energy_per_water) / 1e6, 3)
    heated = _("heater: {energy} MJ per kilogram of water").format(energy=energy)
    dried = _("dryer: the air leaves at {temperature} °C").format(temperature=format_number(out, 3))
    add_line(drawn, [fresh, hot], [wet[0], wet[0]], heated, color=HEAT, width=3)
    add_line(drawn, [hot, out], [wet[0], wet[1]], dried, width=3)
    unused = _("what it could still take up, to {temperature} °C").format(temperature=format_number(bulb, 3))
    add_line(drawn, [out, bulb], [wet[1], wet[2]], unused, color=CAUTION, dash="dot")
    add_points(drawn, [fresh, hot, out], [wet[0], wet[0], wet[1]], _("states of the air"), color=INK)
    drawn.data[-1].showlegend = False
    drawn.update_xaxes(range=[0.0, 125.0])
    drawn.update_yaxes(range=[0.0, 50.0])
    return drawn


def drying_curve(temperature: str, thickness: str, critical_moisture: str) -> go.Figure:
    """Moisture of a tray over time at a constant and a falling rate."""
    start, floor = TRAY["start"], TRAY["equilibrium"]
    critical = float(critical_moisture.split()[0])
    air = gr.humid_gas.state(temperature=temperature, humidity_ratio="12.9 g/kg")
    transfer = gr.drying.heat_transfer_coefficient_parallel("3 kg/(m^2*s)")
    flux = float(gr.drying.drying_rate_constant(transfer, temperature, float(air.wet_bulb_temperature)))
    load = TRAY["bulk_density"] * 1e-3 * _number(thickness)
    hours = np.linspace(0.0, 12.0, 37)
    moisture = gr.drying.moisture_dry_basis_after(start, 3600 * hours, flux, load, critical, floor)
    whole = gr.drying.drying_time(load, "1 m2", flux, start, TRAY["end"], critical, floor)
    drawn = figure(axis_title("drying_time", "hour"), axis_title("moisture_dry_basis", "kg/kg"))
    words = _("moisture; {end} after {hours} h").format(
        end=format_number(TRAY["end"]), hours=format_number(float(whole.drying_time) / 3600, 3)
    )
    never = (start - floor) * load / flux / 3600
    add_line(drawn, [0.0, never], [start, floor], _("if the rate stayed constant"), color=GAS, dash="dash")
    add_line(drawn, hours, np.asarray(moisture), words)
    first = float(whole.drying_time_constant_rate) / 3600
    add_points(drawn, [first], [critical], axis_title("critical_moisture"), color=CAUTION)
    drawn.update_xaxes(range=[0.0, 12.0])
    drawn.update_yaxes(range=[0.0, 0.3])
    return drawn


@jax.jit
def _vial(shelf: Any, pressure: Any, volume: Any) -> Any:
    """Time and history of a vial in primary drying, SI."""
    vial = vial_of(volume=volume, pressure=pressure, **VIAL)
    return dry(vial, FROZEN, shelf, RAMP)


def freeze_drying(temperature_shelf: str, pressure_chamber: str, frozen_height: str) -> go.Figure:
    """Temperatures of the ice front and below the ice in a vial, until the ice has gone."""
    per_volume = gr.drying.frozen_height(
        1.0, VIAL["area_product"], VIAL["concentration"], VIAL["solid_density"]
    )
    height = 1e-3 * _number(frozen_height)
    total, path = _vial(
        ZERO_CELSIUS + _number(temperature_shelf), _number(pressure_chamber), height / float(per_volume)
    )
    hours, depth = np.asarray(path.time) / 3600, np.asarray(path.depth) / height
    shelf, front, bottom = (np.asarray(t) - ZERO_CELSIUS for t in (path.shelf, path.front, path.bottom))
    drawn = figure(axis_title("time", "hour"), axis_title("temperature", "degC"))
    kept = np.r_[0 : len(hours) - 17 : 6, len(hours) - 17 : len(hours) : 2]  # the shelf warms in a short time
    add_line(
        drawn,
        hours[[0, -17, -1]],
        shelf[[0, -17, -1]],
        axis_title("temperature_shelf"),
        color=HEAT,
        dash="dash",
    )
    below = _("below the ice: {temperature} °C at most").format(temperature=format_number(bottom.max(), 3))
    add_line(drawn, hours[kept], bottom[kept], below)
    gone = _("ice front: through after {hours} h").format(hours=format_number(float(total) / 3600, 3))
    add_line(drawn, hours[kept], front[kept], gone, color=LIQUID)
    quarters = np.interp([0.25, 0.5, 0.75, 1.0], depth, hours)
    add_points(
        drawn,
        quarters,
        np.interp(quarters, hours, front),
        _("a quarter of the layer each"),
        color=LIQUID,
        hollow=True,
    )
    drawn.update_xaxes(range=[0.0, 36.0])
    drawn.update_yaxes(range=[-45.0, 30.0])
    return drawn


THERMAL = {
    "population": MovingFigure(
        (
            Slider("growth_rate", "um/hour", 20, 200, 32, 9, True),
            Slider("residence_time", "hour", 0.5, 8, 3.4, 9, True),
        ),
        population,
    ),
    "batch": MovingFigure(
        (
            Slider("seed_mass_per_solvent", "g/kg", 0.25, 8, 0.5, 6, True),
            Slider("duration", "min", 20, 160, 80, 5, True),
        ),
        batch,
    ),
    "dryer_air": MovingFigure(
        (
            Slider("temperature_fresh", "degC", 0, 30, 20, 4),
            Slider("temperature_inlet", "degC", 50, 120, 80, 8),
            Slider("relative_humidity_outlet", "percent", 20, 95, 50, 6),
        ),
        dryer_air,
    ),
    "drying_curve": MovingFigure(
        (
            Slider("temperature", "degC", 50, 100, 60, 6),
            Slider("thickness", "mm", 10, 40, 25, 5),
            Slider("critical_moisture", "kg/kg", 0.1, 0.25, 0.157, 4),
        ),
        drying_curve,
    ),
    "freeze_drying": MovingFigure(
        (
            Slider("temperature_shelf", "degC", -15, 25, 0, 9),
            Slider("pressure_chamber", "Pa", 5, 40, 20, 4, True),
            Slider("frozen_height", "mm", 4, 10, 7, 3),
        ),
        freeze_drying,
    ),
    "plate": MovingFigure(
        (
            Slider("thickness", "mm", 2, 12, 5, 9),
            Slider("diffusivity", "m^2/s", 1e-10, 1e-9, 3e-10, 7, True),
        ),
        plate,
    ),
}
