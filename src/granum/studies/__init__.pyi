"""Studies: Monte Carlo, Sobol indices, sweeps, maps, scenarios, optimization and Pareto fronts of any line or
formula.

``monte_carlo(line, {"filter.cake_resistance": fit})`` and its neighbours take a line (``granum.read``), a
flowsheet, a formula or the key of a card; ``Study`` is a study declared in a table (case file or form). See
``granum.studies.study``."""

from granum.studies.engine import (
    Progress as Progress,
    evaluate as evaluate,
)
from granum.studies.ensembles import (
    monte_carlo as monte_carlo,
    sobol as sobol,
)
from granum.studies.fronts import (
    pareto as pareto,
)
from granum.studies.grids import (
    parameter_map as parameter_map,
    scenarios as scenarios,
    sweep as sweep,
)
from granum.studies.lines import (
    LineSubject as LineSubject,
    subject_of as subject_of,
)
from granum.studies.optimizing import (
    optimize as optimize,
)
from granum.studies.outcome import (
    Outcome as Outcome,
)
from granum.studies.study import (
    Study as Study,
)
from granum.studies.subjects import (
    FormulaSubject as FormulaSubject,
)
