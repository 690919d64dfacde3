"""The figures with sliders of the handbook, by name."""

from __future__ import annotations

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import plotly.graph_objects as go
from scipy.special import ndtr

import granum as gr
from granum.core import registry
from granum.core.charts import ACCENT, CAUTION, INK, LINES, SOLID, add_line, add_points, axis_title, figure
from granum.core.errors import unknown_name
from granum.core.i18n import _
from granum.core.units import format_number
from granum.numerics import Anderson
from granum.reports.moving import MovingFigure, Slider, thin
from granum.reports.moving_thermal import THERMAL

WATER = {"fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}
LIMESTONE = {"law": "vesilind", "vesilind_velocity": "1.20 m/hour", "vesilind_coefficient": "8.8 mL/g"}
PASSES, COMPONENTS = 100, 24  # through a recycle, and in it
GRAIN = {"particle_density": 2630.0, "fluid_density": 1020.0, "dynamic_viscosity": 1.2e-3}  # in brine
MEAN, FALL = 85e-6, 1.5  # m: its mean size, and what it is to sink
LEAF = {  # Geankoplis, example 14.2-1
    "area": "0.0439 m2",
    "pressure_drop": "338 kPa",
    "dynamic_viscosity": "0.8937 cP",
    "dry_cake_per_filtrate": "23.47 g/L",
}


def drag(particle_diameter: str) -> go.Figure:
    """The point of a quartz grain that settles in water, on the curves of drag."""
    drawn = gr.particles.drag_chart(particle_diameter, 2650, **WATER)
    thin(drawn, 45)
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
    thin(drawn, 25)
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
    thin(drawn, 40)
    drawn.update_xaxes(range=[-0.5, 2.0])
    drawn.update_yaxes(range=[0.0, 100.0])
    return drawn


def fluidization(particle_diameter: str, particle_density: str, height: str) -> go.Figure:
    """Pressure drop of the sharp sand of Kunii and Levenspiel in air, or of another one of its shape."""
    drawn = gr.fluidization.pressure_velocity_chart(
        height, particle_diameter, particle_density, 1.2, "18 uPa s", 0.55, 0.50, 0.67
    )
    thin(drawn, 24)
    drawn.update_xaxes(range=[-3.0, 1.0])
    drawn.update_yaxes(range=[0.0, 25.0])
    return drawn


@partial(jax.jit, static_argnums=0)
def _passes(method: Anderson | None, returned: Any, damping: Any) -> Any:
    """Distance from rest before each pass through a loop of many components, of which shares from nothing to
    the most come back; by a method, or by substitution with damped steps.
    """
    shares = returned * jnp.linspace(0.0, 1.0, COMPONENTS)
    fed = jnp.ones(COMPONENTS)
    rest = fed / (1.0 - shares)

    def far(state: Any) -> Any:
        return jnp.max(jnp.abs(state - rest)) / jnp.max(rest)

    def change(state: Any) -> Any:
        return fed + shares * state - state

    start = jnp.zeros(COMPONENTS)
    if method is None:
        return jax.lax.scan(lambda x, _n: (x + damping * change(x), far(x)), start, length=PASSES + 1)[1]
    return jax.lax.scan(
        lambda carry, _n: (method.proceed(carry, change(carry[0])), far(carry[0])),
        method.begin(start),
        length=PASSES + 1,
    )[1]


def recycle(returned_fraction: str, damping: str) -> go.Figure:
    """A recycle that comes to rest, by repeated substitution and by the method that lines are solved with."""
    numbers = float(returned_fraction), float(damping)
    count = np.arange(0, PASSES + 1, 2)
    drawn = figure(
        axis_title("", "", _("passes through the loop")),
        axis_title("", "", _("distance from rest")),
        y_log=True,
    )
    for method, name, color in (
        (None, _("repeated substitution"), SOLID),
        (Anderson(), _("Anderson's method"), ACCENT),
    ):
        far = np.asarray(_passes(method, *numbers))[count]
        add_line(drawn, count, np.where(far > 1e-13, far, np.nan), name, color=color)  # below is rounding
    drawn.update_xaxes(range=[0.0, PASSES])
    drawn.update_yaxes(range=[-10.0, 1.0], dtick=2)
    return drawn


@jax.jit
def _fall(size: Any) -> Any:
    """Velocities of grains in brine, and how much each gains per size."""
    return jax.jvp(lambda d: gr.particles.terminal_velocity(d, **GRAIN), (size,), (jnp.ones_like(size),))


def spreading(standard_deviation: str, time: str) -> go.Figure:
    """Share of grains slower than a velocity where their size spreads: a lognormal law through the model, and
    the straight line at the mean with a normal one.
    """
    spread = 1e-6 * float(standard_deviation.split()[0])
    least = FALL / (60.0 * float(time.split()[0]))
    sigma = np.sqrt(np.log1p((spread / MEAN) ** 2))
    place = np.linspace(-5.0, 5.0, 81)  # standard deviations
    speed = np.asarray(_fall(MEAN * np.exp(sigma * place - 0.5 * sigma**2))[0])  # larger grains are faster
    middle, gain = (float(x) for x in _fall(jnp.asarray(MEAN)))
    slow = [float(np.interp(least, speed, place)), (least - middle) / (gain * spread)]
    drawn = figure(
        axis_title("terminal_velocity", "mm/s"),
        axis_title("", "percent", _("slower than that")),
    )
    for name, speeds, at, color, dash in (
        (_("through the model: {share} % too slow"), speed, slow[0], ACCENT, "solid"),
        (_("by the derivative: {share} % too slow"), middle + gain * spread * place, slow[1], SOLID, "dash"),
    ):
        told = name.format(share=format_number(round(100.0 * float(ndtr(at)), 2), 2))
        add_line(drawn, 1e3 * speeds, 100.0 * ndtr(place), told, color=color, dash=dash)
    needed = _("needed: {velocity} mm/s").format(velocity=format_number(1e3 * least, 3))
    add_line(drawn, [1e3 * least] * 2, [0.0, 100.0], needed, color=INK, dash="dot")
    add_points(drawn, [1e3 * least] * 2, 100.0 * ndtr(slow), _("too slow"), color=INK)
    drawn.update_xaxes(range=[-1.0, 14.0])
    drawn.update_yaxes(range=[0.0, 100.0])
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
    "fluidization": MovingFigure(
        (
            Slider("particle_diameter", "um", 80, 500, 160, 7, True),
            Slider("particle_density", "kg/m^3", 1500, 3000, 2600, 4),
            Slider("height", "m", 0.5, 1.5, 1.0, 3),
        ),
        fluidization,
    ),
    "recycle": MovingFigure(
        (
            Slider("returned_fraction", "", 0.5, 0.98, 0.76, 13),
            Slider("damping", "", 0.4, 2.0, 1.0, 9),
        ),
        recycle,
    ),
    "spreading": MovingFigure(
        (
            Slider("standard_deviation", "um", 2, 42, 17, 9),
            Slider("time", "min", 5, 20, 10, 7, True),
        ),
        spreading,
    ),
} | THERMAL


def moving_figure(name: str) -> MovingFigure:
    """A figure by name."""
    if name not in FIGURES:
        raise unknown_name(_("Figure with sliders"), name, FIGURES, quantities=False)
    return FIGURES[name]
