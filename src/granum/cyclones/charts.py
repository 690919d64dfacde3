"""Charts of a gas cyclone: grade efficiency by every law; distributions of feed, dust and what escapes."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import Density, DynamicViscosity, Law, Length, VolumeFlow
from granum.core.units import format_number
from granum.cyclones.formulas import efficiency, mothes
from granum.cyclones.geometry import StandardCyclone
from granum.particles.size_laws import RosinRammler

PARTS = 400  # equal parts of the dust
USUAL_DUST = RosinRammler(size_modulus=2e-5, distribution_exponent=1.0)


@chart(
    source="hoffmann2008; leith1972",
    title="Grade efficiency of a gas cyclone",
    typical={"volume_flow": (1.0, 2.0)},
)
def gas_cyclone_chart(
    volume_flow: VolumeFlow,
    particle_density: Density,
    diameter: Length,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone(),
) -> Any:
    """Grade efficiency against size by Lapple, Leith and Licht, Barth, Muschelknautz, Mothes and Löffler:
    their spread is what one knows.
    """
    from granum.core.charts import LINES, add_line, axis_title, figure

    size = np.geomspace(0.3e-6, 1e-4, 120)
    shape = cyclone_geometry(diameter)
    drawing = figure(
        axis_title("particle_diameter", "um"),
        axis_title("cyclone_efficiency", "%"),
        x_log=True,
        title=_("Grade efficiency of a gas cyclone"),
    )
    for color, (name, word) in zip(
        LINES,
        (
            ("lapple", "Lapple"),
            ("leith_licht", "Leith–Licht"),
            ("barth", "Barth"),
            ("muschelknautz", "Muschelknautz"),
            ("mothes_loffler", "Mothes–Löffler"),
        ),
        strict=False,
    ):
        law = getattr(mothes if name == "mothes_loffler" else efficiency, f"cyclone_efficiency_{name}")
        share = np.asarray(law(size, volume_flow, particle_density, fluid_density, dynamic_viscosity, *shape))
        add_line(drawing, size * 1e6, 100.0 * share, word, color=color)
    return drawing


@chart(
    source="hoffmann2008; muschelknautz1972",
    title="Feed, dust and what escapes",
    typical={"volume_flow": (1.0, 2.0)},
)
def cyclone_distributions_chart(
    volume_flow: VolumeFlow,
    particle_density: Density,
    diameter: Length,
    size_distribution: Annotated[Any, Law("size_distribution")] = USUAL_DUST,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone(),
    cyclone_efficiency: Annotated[
        Any, Law("cyclone_efficiency")
    ] = efficiency.cyclone_efficiency_muschelknautz,
) -> Any:
    """Grade efficiency of a cyclone with the cumulative curves of feed, collected dust and what escapes, and
    the total efficiency.
    """
    from granum.core.charts import ACCENT, GAS, INK, SOLID, add_line, axis_title, figure

    part = (np.arange(PARTS) + 0.5) / PARTS
    size = np.asarray(size_distribution.percentile(part))
    grade = np.asarray(
        cyclone_efficiency(
            size, volume_flow, particle_density, fluid_density, dynamic_viscosity, *cyclone_geometry(diameter)
        )
    )
    total = float(np.mean(grade))
    title = _("Feed, dust and what escapes: {share} % collected").format(
        share=format_number(100.0 * total, 3)
    )
    drawing = figure(axis_title("particle_diameter", "um"), _("share") + " / %", x_log=True, title=title)
    add_line(drawing, size * 1e6, 100.0 * grade, _("grade efficiency"), color=ACCENT, width=3)
    add_line(drawing, size * 1e6, 100.0 * part, _("feed, below the size"), color=INK)
    add_line(
        drawing,
        size * 1e6,
        100.0 * np.cumsum(grade) / np.sum(grade),
        _("dust, below the size"),
        color=SOLID,
        dash="dash",
    )
    add_line(
        drawing,
        size * 1e6,
        100.0 * np.cumsum(1.0 - grade) / np.sum(1.0 - grade),
        _("escaping, below the size"),
        color=GAS,
        dash="dot",
    )
    return drawing
