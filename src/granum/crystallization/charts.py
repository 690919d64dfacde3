"""Charts of crystallization: solubility with its zones and the path of a batch, the batch over time, its
sizes, the seed chart.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp
import numpy as np

from granum.core import chart
from granum.core.charts import (
    ACCENT,
    GAS,
    HEAT,
    LIQUID,
    OUT,
    SOLID,
    add_band,
    add_line,
    add_right_axis,
    axis_title,
    figure,
)
from granum.core.constants import ZERO_CELSIUS
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Length,
    MassRatio,
    PositiveNumber,
    Series,
    Temperature,
    TemperatureDifference,
    Time,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Growth, Nucleation, Program, Solubility
from granum.crystallization.population.lagrangian import Course, Model, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import Packets
from granum.crystallization.vessels.batch import classes_of, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal

STEPS = 300


@chart(
    source="mullin2001, ch. 3 and 5",
    title="Solubility, metastable zone and path of a batch",
    typical={"temperature_cold": (280.0, 290.0), "temperature_hot": (320.0, 340.0)},
)
def solubility_chart(
    solubility: Solubility,
    temperature_cold: Temperature,
    temperature_hot: Temperature,
    metastable_width: TemperatureDifference = 5.0,
    path_temperature: Annotated[Temperature, Series("points")] | None = None,
    path_solute_per_solvent: Annotated[MassRatio, Series("points")] | None = None,
) -> Any:
    """Solubility curve with the stable, metastable and labile zones, and the path of a batch through them.

    The limit of the metastable zone is the solubility curve moved by the zone width towards lower temperature
    where the solubility rises, as measured with cooling experiments (lab test ``metastable_zone``), and
    towards higher temperature where it falls. Pass the temperature and composition of a simulated batch as
    the path.

    >>> drawing = solubility_chart(
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     temperature_cold="10 degC",
    ...     temperature_hot="50 degC",
    ... )
    >>> [trace.name for trace in drawing.data][:2]
    ['solubility', 'metastable limit']
    """
    T = np.linspace(temperature_cold, temperature_hot, 120)
    saturated = np.asarray(solubility(T))
    limit = np.max(
        [solubility(T + shift) for shift in np.linspace(-metastable_width, metastable_width, 21)], axis=0
    )
    x = T - ZERO_CELSIUS
    drawing = figure(
        axis_title("temperature", "degC"),
        axis_title("solute_per_solvent", "kg/kg"),
        title=_("Solubility and zones"),
    )
    add_line(drawing, x, saturated, _("solubility"), color=LIQUID, width=3)
    add_line(drawing, x, limit, _("metastable limit"), color=OUT, dash="dash")
    add_band(drawing, x, saturated, limit, _("2 metastable"), color=GAS)
    for word, across, upward, color in ((_("3 labile"), 0.3, 0.85, OUT), (_("1 stable"), 0.75, 0.15, LIQUID)):
        drawing.add_annotation(
            x=across,
            y=upward,
            xref="paper",
            yref="paper",
            text=word,
            showarrow=False,
            font={"color": color, "size": 13},
        )
    if path_temperature is not None and path_solute_per_solvent is not None:
        path = np.asarray(path_temperature) - ZERO_CELSIUS
        add_line(drawing, path, np.asarray(path_solute_per_solvent), _("batch"), color=ACCENT, width=3)
    return drawing


def _simulated(
    solute_per_solvent: Any,
    solubility: Any,
    growth: Any,
    nucleation: Any,
    program: Any,
    duration: Any,
    density: Any,
    seed_mass: Any,
    seed_size: Any,
    seed_width: Any,
    shape: Any,
) -> tuple[Course, Any]:
    crystal = Crystal(density, shape)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(1000.0))
    seeds = narrow_seeds(seed_size, seed_width, seed_mass, crystal.mass_per_cube)
    return march(
        model, Programmed(program), seeds, solute_per_solvent, 1.0, jnp.linspace(0.0, duration, STEPS + 1)
    ), seeds


@chart(
    source="miller1994; mullin2001, ch. 9",
    title="Cooling batch over time",
    typical={"duration": (3600.0, 7200.0)},
)
def batch_chart(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Any:
    """Dissolved solute, solubility and crystals of a cooling batch against time, with its temperature.

    >>> drawing = batch_chart(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     duration="80 min",
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 305.15,
    ...         "temperature_end": 301.15,
    ...         "duration": "80 min",
    ...     },
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.0005,
    ... )
    >>> len(drawing.data)
    4
    """
    course, _seeds = _simulated(
        solute_per_solvent,
        solubility,
        growth,
        nucleation,
        temperature_program,
        duration,
        crystal_density,
        seed_mass_per_solvent,
        seed_size,
        seed_width,
        volume_shape_factor,
    )
    t = np.asarray(course.time) / 60
    drawing = figure(
        axis_title("time", "min"), axis_title("solute_per_solvent", "kg/kg"), title=_("Cooling batch")
    )
    add_line(drawing, t, np.asarray(course.solute_per_solvent), _("dissolved"), color=ACCENT, width=3)
    add_line(
        drawing, t, np.asarray(course.solubility_per_solvent), _("solubility"), color=LIQUID, dash="dash"
    )
    add_line(drawing, t, np.asarray(course.crystals), _("crystals"), color=SOLID)
    add_line(
        drawing,
        t,
        np.asarray(course.temperature) - ZERO_CELSIUS,
        _("temperature"),
        color=HEAT,
        dash="dot",
        yaxis="y2",
    )
    add_right_axis(drawing, axis_title("temperature", "degC"), tickmode="auto", nticks=6)
    drawing.update_layout(
        margin={"r": 70, "t": 80},
        legend={"orientation": "h", "y": 1.08},
    )
    return drawing


@chart(
    source="miller1994; randolph1988, ch. 4",
    title="Size distribution over time",
    typical={"duration": (3600.0, 7200.0)},
)
def size_distribution_chart(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Any:
    """Crystal size distribution by mass at five times of a cooling batch: seeds growing, nuclei following.

    >>> drawing = size_distribution_chart(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     duration="80 min",
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 305.15,
    ...         "temperature_end": 301.15,
    ...         "duration": "80 min",
    ...     },
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.0005,
    ...     seed_width="20 um",
    ... )
    >>> len(drawing.data)
    5
    """
    course, seeds = _simulated(
        solute_per_solvent,
        solubility,
        growth,
        nucleation,
        temperature_program,
        duration,
        crystal_density,
        seed_mass_per_solvent,
        seed_size,
        seed_width,
        volume_shape_factor,
    )
    path, born = np.asarray(course.path), np.asarray(course.born)
    edges = np.linspace(0.0, 1.05 * float(jnp.max(course.final.high)), 161)
    middle = 0.5 * (edges[1:] + edges[:-1]) * 1e6
    drawing = figure(
        axis_title("crystal_size", "um"),
        _("crystals by mass / (g/kg µm)"),
        title=_("Size distribution over time"),
        y_log=True,
    )
    highest = 0.0
    for k, color in zip(
        np.linspace(0, STEPS, 5).astype(int), (GAS, LIQUID, ACCENT, SOLID, HEAT), strict=True
    ):
        there = np.arange(STEPS) < k  # births so far; the others have no number
        low, high = (np.where(there, path[k] - end, 0.0) for end in (path[1:], path[:-1]))
        here = Packets(
            np.append(seeds.low + path[k], low),
            np.append(seeds.high + path[k], high),
            np.append(seeds.number, np.where(there, born, 0.0)),
        )
        mass = np.asarray(classes_of(here, edges)) * crystal_density * volume_shape_factor
        density = mass * 1e3 / (np.diff(edges) * 1e6)
        highest = max(highest, float(density.max()))
        add_line(
            drawing,
            middle,
            np.where(density > 0, density, np.nan),
            f"{float(course.time[k]) / 60:.0f} min",
            color=color,
        )
    top = np.log10(max(highest, 1e-300))
    drawing.update_yaxes(range=[top - 4.0, top + 0.2])
    return drawing


@chart(source="kubota2001; mullin2001, ch. 9", title="Seed chart", typical={})
def seed_chart_figure() -> Any:
    """Product over seed size against seed loading on the ideal growth line.

    Batches whose product lies on the line have grown without nucleation; points below it tell of nuclei.

    >>> len(seed_chart_figure().data)
    1
    """
    loading = np.geomspace(1e-3, 1.0, 80)
    drawing = figure(
        axis_title("seed_loading", ""), axis_title("growth_ratio", ""), title=_("Seed chart"), x_log=True
    )
    add_line(drawing, loading, ((1 + loading) / loading) ** (1 / 3), _("ideal growth"))
    return drawing
