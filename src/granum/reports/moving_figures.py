"""The figures with sliders of the handbook, by name."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go

import granum as gr
from granum.core import registry
from granum.core.charts import ACCENT, CAUTION, LINES, add_line, add_points, axis_title, figure
from granum.core.errors import unknown_name
from granum.core.i18n import _
from granum.reports.moving import MovingFigure, Slider

WATER = {"fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}
LIMESTONE = {"law": "vesilind", "vesilind_velocity": "1.20 m/hour", "vesilind_coefficient": "8.8 mL/g"}
LEAF = {  # Geankoplis, example 14.2-1
    "area": "0.0439 m2",
    "pressure_drop": "338 kPa",
    "dynamic_viscosity": "0.8937 cP",
    "dry_cake_per_filtrate": "23.47 g/L",
}


def _thin(drawn: go.Figure, points: int) -> None:
    """Lines with fewer points, their ends among them: a page carries them many times."""
    for trace in drawn.data:
        if trace.mode == "lines" and len(trace.x) > points:
            kept = np.linspace(0, len(trace.x) - 1, points).round().astype(int)
            trace.x, trace.y = np.asarray(trace.x)[kept], np.asarray(trace.y)[kept]


def drag(particle_diameter: str) -> go.Figure:
    """The point of a quartz grain that settles in water, on the curves of drag."""
    drawn = gr.particles.drag_chart(particle_diameter, 2650, **WATER)
    _thin(drawn, 45)
    drawn.update_yaxes(range=[-1.2, 5.0])
    drawn.update_xaxes(range=[-3.0, 6.0])
    return drawn


def hindrance(reynolds: str) -> go.Figure:
    """Three laws of hindered settling from creeping to turbulent flow."""
    drawn = figure(axis_title("solids_volume_fraction"), axis_title("hindrance"))
    share = np.linspace(0.001, 0.5, 60)
    laws = ("Richardson–Zaki", "Garside–Al-Dibouni", "Barnea–Mizrahi")
    for authors, color in zip(laws, LINES, strict=False):
        law = registry.find("particles.hindrance_" + authors.lower().replace("–", "_").replace("-", "_"))
        add_line(drawn, share, np.asarray(law(share, float(reynolds))), authors, color=color)
    drawn.update_xaxes(range=[0.0, 0.5])
    drawn.update_yaxes(range=[0.0, 1.0])
    return drawn


def thickener(area: str, underflow_volume_flow: str) -> go.Figure:
    """The flux diagram of 20 t/h of limestone at 236 g/L."""
    drawn = gr.settling.flux_diagram(
        volume_flow=20e3 / 3600 / 236,
        feed_concentration=236,
        underflow_volume_flow=underflow_volume_flow,
        area=area,
        settling=LIMESTONE,
    )
    _thin(drawn, 25)
    drawn.update_xaxes(range=[0.0, 900.0])
    drawn.update_yaxes(range=[0.0, 100.0])
    return drawn


def leaf(cake_resistance: str, medium_resistance: str) -> go.Figure:
    """Time over filtrate against filtrate in a leaf test, and the share of the medium."""
    volume = np.linspace(0.05e-3, 6e-3, 30)  # m³
    time, cloth = (
        np.asarray(
            gr.filtration.filtration_time_constant_pressure(
                filtrate_volume=volume, cake_resistance=alpha, medium_resistance=medium_resistance, **LEAF
            )
        )
        for alpha in (cake_resistance, 1.0)
    )
    drawn = figure(
        axis_title("filtrate_volume", "L"), axis_title("", "s/L", _("time over filtrate <i>t/V</i>"))
    )
    add_line(drawn, 1e3 * volume, 1e-3 * time / volume, _("cake and medium"))
    add_line(drawn, 1e3 * volume, 1e-3 * cloth / volume, _("medium alone"), color=CAUTION, dash="dash")
    drawn.update_xaxes(range=[0.0, 6.0])
    drawn.update_yaxes(range=[0.0, 60.0])
    return drawn


def compressible(compressibility: str) -> go.Figure:
    """Cake resistance and flux against pressure, over their values at one bar."""
    pressure = np.geomspace(0.1, 10.0, 40)  # bar
    resistance = np.asarray(
        gr.filtration.cake_resistance_power_law(1e5 * pressure, 1e11, float(compressibility), 1e5)
    )
    drawn = figure(
        axis_title("pressure_drop", "bar"),
        axis_title("", "", _("over the value at 1 bar")),
        x_log=True,
        y_log=True,
    )
    add_line(drawn, pressure, resistance / 1e11, _("resistance of the cake"), color=CAUTION)
    add_line(drawn, pressure, pressure / (resistance / 1e11), _("flux through the same cake"), color=ACCENT)
    drawn.update_xaxes(range=[-1.0, 1.0])
    drawn.update_yaxes(range=[-1.0, 1.0])
    return drawn


def cyclone(volume_flow: str, diameter: str) -> go.Figure:
    """Grade efficiency of a Stairmand cyclone by five theories."""
    drawn = gr.cyclones.gas_cyclone_chart(volume_flow, 2000, diameter)
    _thin(drawn, 40)
    drawn.update_xaxes(range=[-0.5, 2.0])
    drawn.update_yaxes(range=[0.0, 100.0])
    return drawn


def population(growth_rate: str, residence_time: str) -> go.Figure:
    """Population density of crystals in an MSMPR with a given birth of nuclei; the point is the median by
    mass.
    """
    size = np.linspace(0.0, 2e-3, 30)  # m
    length = 1e-3 * float(growth_rate.split()[0]) * float(residence_time.split()[0])  # mm
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
    half = 0.5 * float(thickness.split()[0])
    ratio = gr.drying.moisture_ratio_plate(3600 * hours, f"{half} mm", diffusivity)
    drawn = figure(axis_title("drying_time", "hour"), axis_title("moisture_ratio"))
    add_line(drawn, hours, np.asarray(ratio), _("moisture ratio"))
    drawn.update_xaxes(range=[0.0, 12.0])
    drawn.update_yaxes(range=[0.0, 1.0])
    return drawn


FIGURES = {
    "drag": MovingFigure((Slider("particle_diameter", "um", 5, 2000, 85, 21, True),), drag),
    "hindrance": MovingFigure((Slider("reynolds", "", 0.01, 1000, 0.01, 16, True),), hindrance),
    "thickener": MovingFigure(
        (
            Slider("area", "m^2", 250, 500, 350, 6),
            Slider("underflow_volume_flow", "m^3/hour", 30, 60, 40, 4),
        ),
        thickener,
    ),
    "leaf": MovingFigure(
        (
            Slider("cake_resistance", "m/kg", 2e10, 5e11, 1.86e11, 9, True),
            Slider("medium_resistance", "1/m", 1e10, 1e12, 1.06e11, 9, True),
        ),
        leaf,
    ),
    "compressible": MovingFigure((Slider("compressibility", "", 0, 1, 0.25, 21),), compressible),
    "cyclone": MovingFigure(
        (
            Slider("volume_flow", "m^3/hour", 100, 500, 223, 5),
            Slider("diameter", "mm", 100, 400, 203, 5, True),
        ),
        cyclone,
    ),
    "population": MovingFigure(
        (
            Slider("growth_rate", "um/hour", 20, 200, 32, 9, True),
            Slider("residence_time", "hour", 0.5, 8, 3.4, 9, True),
        ),
        population,
    ),
    "plate": MovingFigure(
        (
            Slider("thickness", "mm", 2, 12, 5, 9),
            Slider("diffusivity", "m^2/s", 1e-10, 1e-9, 3e-10, 7, True),
        ),
        plate,
    ),
}


def moving_figure(name: str) -> MovingFigure:
    """A figure by name."""
    if name not in FIGURES:
        raise unknown_name(_("Figure"), name, FIGURES)
    return FIGURES[name]
