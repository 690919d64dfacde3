"""Growth and nucleation rates from the size distribution of a continuous crystallizer."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import formula, lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    Fraction,
    GrowthRate,
    Length,
    NucleationRate,
    PopulationDensity,
    PositiveNumber,
    Series,
    Time,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line


@formula(
    source="randolph1988, ch. 4; green2008, sec. 18",
    title="Population densities of sieve classes",
    equation=(
        r"n_i = \frac{M_T w_i}{k_v \rho_c \bar L_i^3 \Delta L_i},\quad \bar L_i = \tfrac12(L_{i-1} + "
        r"L_i),\ \Delta L_i = L_i - L_{i-1}"
    ),
    output="population_density",
    symbols={"class_edges": "L_i", "class_fractions": "w_i", "population_density": "n_i"},
)
def population_densities(
    class_edges: Annotated[Length, Series("edges")],
    class_fractions: Annotated[Fraction, Series("classes")],
    magma_density: Concentration,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Annotated[PopulationDensity, Series("classes")]:
    """Population densities at the middle of sieve classes from their mass fractions and the magma density.

    The urea of Bennett and Van Buren: 4.4 % of 450 g/L between 0.833 and 1.168 mm is 44 270 crystals per
    liter and millimeter.

    >>> n = population_densities(
    ...     class_edges="[0.833, 1.168] mm", class_fractions=[0.044], magma_density=450, crystal_density=1335
    ... )
    >>> round(float(n[0]) / 1e6)
    44207
    """
    edges, fractions = jnp.asarray(class_edges), jnp.asarray(class_fractions)
    if edges.size != fractions.size + 1:
        raise InputError(
            _(
                "{edges} class limits and {classes} fractions do not go together: n classes have n + "
                "1 limits."
            ).format(edges=edges.size, classes=fractions.size),
            name="class_edges",
        )
    middle = 0.5 * (edges[1:] + edges[:-1])
    mass = volume_shape_factor * crystal_density * middle**3 * jnp.diff(edges)
    return magma_density * fractions / mass


@lab_test(
    "msmpr_analysis",
    source="randolph1988, ch. 4; green2008, sec. 18",
    title="Size distribution of a continuous crystallizer (MSMPR analysis)",
    equation=r"\ln n = \ln n_0 - \frac{L}{G\tau}",
)
class MsmprAnalysis(LabTest):
    """Growth rate, population density of nuclei and nucleation rate from the straight line of log population
    density against size.

    Points at the small end often lie above the line (growth that depends on size, or dispersion): leave them
    out or fit a law of size. With crystal density and shape factor the magma density of the line is given for
    comparison with the measured one.
    """

    crystal_size: Annotated[Distance, Series("points")]
    population_density: Annotated[PopulationDensity, Series("points")]
    residence_time: Time
    crystal_density: Density | None = None
    volume_shape_factor: PositiveNumber = 1.0

    estimates: ClassVar = {"growth_rate": GrowthRate, "nuclei_population_density": PopulationDensity}
    axes: ClassVar = {"crystal_size": Distance, "population_density": PopulationDensity}

    def fit(self) -> Fit:
        """Growth rate and population density of nuclei with 95 % intervals; nucleation rate and dominant size
        from them.
        """
        L, n, tau = (
            np.asarray(self.crystal_size),
            np.asarray(self.population_density),
            float(self.residence_time),
        )
        if np.any(n <= 0):
            raise InputError(
                _("A population density of zero has no logarithm: leave that point out."),
                name="population_density",
            )
        slope, level = straight_line(L, np.log(n))
        if slope >= 0:
            raise InputError(
                _(
                    "The population density does not fall with size: this is no continuous crystallizer "
                    "at steady state."
                )
            )

        def derived(p: dict[str, Any]) -> dict[str, Any]:
            G, n0 = p["growth_rate"], p["nuclei_population_density"]
            out = {"nucleation_rate": G * n0, "dominant_size": 3.0 * G * tau}
            if self.crystal_density is not None:
                out["magma_density"] = (
                    6.0 * self.volume_shape_factor * self.crystal_density * n0 * (G * tau) ** 4
                )
            return out

        return self.fitted(
            lambda p, L: jnp.log(p["nuclei_population_density"]) - L / (p["growth_rate"] * tau),
            {"growth_rate": float(-1.0 / (slope * tau)), "nuclei_population_density": float(np.exp(level))},
            L,
            np.log(n),
            bounds={"growth_rate": (0.0, np.inf), "nuclei_population_density": (0.0, np.inf)},
            derived=derived,
            kinds={
                "nucleation_rate": NucleationRate,
                "dominant_size": Length,
                "magma_density": Concentration,
            },
        )

    def chart(self) -> Any:
        """Log population density against size, with the fitted line."""
        from granum.core.charts import add_line, add_points, axis_title, figure

        found = self.fit()
        L, n = np.asarray(self.crystal_size), np.asarray(self.population_density)
        grid = np.linspace(0.0, 1.05 * L.max(), 100)
        drawing = figure(
            axis_title("crystal_size", "um"),
            axis_title("population_density", "1/m^4"),
            title=type(self).card.title,
            y_log=True,
        )
        add_line(drawing, grid * 1e6, np.exp(found.predict(grid).value), _("model"))
        add_points(drawing, L * 1e6, n, _("data"))
        return drawing
