"""Chart of a gas cyclone: grade efficiency by every law."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import Density, DynamicViscosity, Law, Length, VolumeFlow
from granum.cyclones.formulas import efficiency
from granum.cyclones.geometry import StandardCyclone


@chart(source="hoffmann2008; leith1972", title="Grade efficiency of a gas cyclone", typical={"volume_flow": (1.0, 2.0)})
def gas_cyclone_chart(
    volume_flow: VolumeFlow,
    particle_density: Density,
    diameter: Length,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone(),
) -> Any:
    """Grade efficiency against size by Lapple, Leith and Licht, Barth, and Muschelknautz: their spread is what one knows beforehand."""
    from granum.core.charts import LINES, add_line, axis_title, figure

    size = np.geomspace(0.3e-6, 1e-4, 120)
    shape = cyclone_geometry(diameter)
    drawing = figure(axis_title("particle_diameter", "um"), axis_title("cyclone_efficiency", "%"), x_log=True,
                     title=_("Grade efficiency of a gas cyclone"))  # fmt: skip
    for color, (name, word) in zip(LINES, (("lapple", "Lapple"), ("leith_licht", "Leith–Licht"), ("barth", "Barth"),
                                           ("muschelknautz", "Muschelknautz")), strict=False):  # fmt: skip
        law = getattr(efficiency, f"cyclone_efficiency_{name}")
        share = np.asarray(law(size, volume_flow, particle_density, fluid_density, dynamic_viscosity, *shape))
        add_line(drawing, size * 1e6, 100.0 * share, word, color=color)
    return drawing
