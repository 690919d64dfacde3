"""Charts of solutions: what an antisolvent takes from one, two crystal forms in one."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core import chart
from granum.core.charts import ACCENT, LINES, LIQUID, OUT, SOLID, add_line, add_right_axis, axis_title, figure
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Density, Length, MassRatio, Ratio, Temperature, Time
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Growth, Nucleation, OpenShare, Program, Solubility
from granum.crystallization.vessels.polymorphs import Dissolution, polymorph_batch
from granum.materials.library import session


@chart(
    source="yalkowsky1981; mullin2001, ch. 8",
    title="Drowning out: solubility, dilution and yield",
    typical={"solute_per_solvent": (0.3, 0.36), "temperature": (290.0, 300.0)},
)
def antisolvent_chart(
    solubility: Solubility,
    solute_per_solvent: MassRatio,
    temperature: Temperature,
    antisolvent_fraction: OpenShare = 0.8,
) -> Any:
    """Solubility against the share of antisolvent, the solution as it is diluted, and the yield between them.

    Crystals form to the right of the crossing; the highest point of the yield is as much antisolvent as pays.

    >>> drawing = antisolvent_chart(
    ...     solubility={
    ...         "law": "antisolvent_solubility",
    ...         "pure_solubility": {"law": "library_solubility", "solute": "sodium chloride"},
    ...         "antisolvent_power": 2.0,
    ...         "antisolvent_curvature": 1.6,
    ...     },
    ...     solute_per_solvent=0.35,
    ...     temperature="25 degC",
    ... )
    >>> [trace.name for trace in drawing.data]
    ['solubility', 'diluted solution', 'yield']
    """
    if not getattr(solubility, "takes_antisolvent", False):
        raise InputError(
            _(
                "The solubility does not depend on an antisolvent: give a law that does, such as "
                "'antisolvent_solubility'."
            ),
            name="solubility",
        )
    w = np.linspace(0.0, float(antisolvent_fraction), 161)
    saturated = np.asarray(solubility(temperature, w)) + np.zeros_like(w)
    diluted = float(solute_per_solvent) * (1.0 - w)
    share = np.clip(1.0 - saturated / np.maximum(diluted, 1e-300), 0.0, None)
    drawing = figure(
        axis_title("antisolvent_fraction", "percent"),
        axis_title("solute_per_solvent", "kg/kg"),
        title=_("Drowning out"),
    )
    add_line(drawing, 100.0 * w, saturated, _("solubility"), color=LIQUID, width=3)
    add_line(drawing, 100.0 * w, diluted, _("diluted solution"), color=ACCENT, dash="dash")
    add_line(drawing, 100.0 * w, 100.0 * share, _("yield"), color=SOLID, yaxis="y2")
    add_right_axis(drawing, axis_title("yield_fraction", "percent"), range=[0, 100])
    drawing.update_layout(
        margin={"r": 70, "t": 80},
        legend={"orientation": "h", "y": 1.08},
    )
    return drawing


@chart(
    source="mullin2001, ch. 3",
    title="Solubility curves of several solutes",
    typical={"temperature_cold": (273.15, 295.0), "temperature_hot": (330.0, 370.0)},
)
def solubilities_chart(
    systems: str = "potassium nitrate, copper sulfate, sodium chloride",
    temperature_cold: Temperature = 273.15,
    temperature_hot: Temperature = 373.15,
) -> Any:
    """Solubility curves of some solutes of the library on one chart, each over its stable crystal: what rises
    steeply is cooled, what is flat is boiled down, what lies between is cooled under vacuum.

    Names are separated by commas. Where a curve goes beyond its data it is drawn thin.

    >>> drawing = solubilities_chart("potassium nitrate, copper sulfate, sodium chloride")
    >>> [trace.name for trace in drawing.data if trace.showlegend is not False]
    ['potassium nitrate in water', 'copper sulfate in water', 'sodium chloride in water']
    """
    if not temperature_hot > temperature_cold:
        raise InputError(_("The hot temperature must be above the cold one."), name="temperature_hot")
    names = list(dict.fromkeys(name.strip() for name in systems.split(",") if name.strip()))
    if not names:
        raise InputError(_("Name at least one solute of the library."), name="systems")
    drawing = figure(
        axis_title("temperature", "degC"),
        axis_title("solubility_per_solvent", "kg/kg"),
        title=_("Solubility curves"),
    )
    for name, color in zip(names, LINES * len(names), strict=False):
        solute = session().solute(name)
        low, high = solute.data_range
        T = np.unique(np.concatenate([np.linspace(temperature_cold, temperature_hot, 161), [low, high]]))
        T = T[(temperature_cold <= T) & (temperature_hot >= T)]
        ratio = np.asarray(solute.solubility(jnp.asarray(T)))
        known = (low <= T) & (high >= T)
        add_line(
            drawing,
            T - ZERO_CELSIUS,
            np.where(known, ratio, np.nan),
            solute.label,
            color=color,
            width=3,
        )
        for beyond in (low >= T, high <= T):
            if np.any(beyond & ~known):
                add_line(
                    drawing,
                    T[beyond] - ZERO_CELSIUS,
                    ratio[beyond],
                    solute.label,
                    color=color,
                    width=1,
                    showlegend=False,
                )
    return drawing


@chart(
    source="cardew1985; ono2004",
    title="Two polymorphs over time",
    typical={"duration": (3600.0, 36000.0)},
)
def polymorph_chart(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    solubility_law_stable: Solubility,
    growth: Growth,
    growth_stable: Growth,
    dissolution: Dissolution,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation_stable: Nucleation = NoNucleation(),
    cross_nucleation: Ratio = 0.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_mass_stable: MassRatio = 0.0,
    seed_size_stable: Length = 50e-6,
) -> Any:
    """Concentration between the two solubilities, and the share of the stable form in the crystals.

    >>> drawing = polymorph_chart(
    ...     solute_per_solvent=0.02,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.02]},
    ...     solubility_law_stable={"law": "polynomial_solubility", "coefficients": [0.015]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     growth_stable={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     dissolution={"law": "power_law_dissolution", "dissolution_coefficient": 1e-5},
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 298.15,
    ...         "temperature_end": 298.15,
    ...         "duration": 3600,
    ...     },
    ...     duration="8 hour",
    ...     crystal_density=1540,
    ...     seed_mass_per_solvent=0.01,
    ...     seed_mass_stable=0.001,
    ... )
    >>> len(drawing.data)
    4
    """
    out = polymorph_batch(
        solute_per_solvent,
        solubility,
        solubility_law_stable,
        growth,
        growth_stable,
        dissolution,
        temperature_program,
        duration,
        crystal_density,
        nucleation_stable=nucleation_stable,
        cross_nucleation=cross_nucleation,
        seed_mass_per_solvent=seed_mass_per_solvent,
        seed_size=seed_size,
        seed_mass_stable=seed_mass_stable,
        seed_size_stable=seed_size_stable,
    )
    t = np.asarray(out.time) / 3600.0
    drawing = figure(
        axis_title("time", "hour"),
        axis_title("solute_per_solvent", "kg/kg"),
        title=_("Two polymorphs"),
    )
    for values, word, color, dash in (
        (out.solute_per_solvent, _("dissolved"), ACCENT, "solid"),
        (out.solubility_per_solvent, _("solubility, metastable form"), OUT, "dash"),
        (out.solubility_stable, _("solubility, stable form"), LIQUID, "dash"),
    ):
        add_line(drawing, t, np.asarray(values), word, color=color, dash=dash)
    share = 100.0 * np.asarray(out.stable_fraction)
    add_line(drawing, t, share, _("stable form in the crystals"), color=SOLID, yaxis="y2")
    add_right_axis(drawing, axis_title("stable_fraction", "percent"), range=[0, 102])
    drawing.update_layout(
        margin={"r": 70, "t": 80},
        legend={"orientation": "h", "y": 1.08},
    )
    return drawing
