"""Studies of uncertainty: Monte Carlo and Sobol indices."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import scipy

from granum.core.i18n import _
from granum.studies.declared import MOST_CASES, limits_of, prepare, sources_of, whole
from granum.studies.distributions import Source
from granum.studies.engine import evaluate
from granum.studies.lines import subject_of
from granum.studies.outcome import Limits, Outcome, kind_in_words, meets, number, wilson
from granum.studies.sampling import inputs_at, unit_points
from granum.studies.subjects import NOT_RUN

if TYPE_CHECKING:
    import plotly.graph_objects as go


@dataclass(frozen=True)
class Ensemble(Outcome):
    """Figures under uncertainty: percentiles, probability of keeping limits, which input matters."""

    sources: tuple[Source, ...]
    limits: Limits = field(default_factory=dict)
    kind: ClassVar[str] = "monte_carlo"

    def chances(self) -> dict[str, dict[str, Any]]:
        """Probability of keeping each limit and all of them; a case that failed keeps none."""
        run = self.cases.codes != NOT_RUN
        found = {}
        together = run.copy()
        for path, limit in self.limits.items():
            kept = meets(self.column(path), limit) & run
            together &= kept
            found[path] = {"lower": limit[0], "upper": limit[1], **_chance(kept, run)}
        if len(self.limits) > 1:
            found[""] = {"lower": None, "upper": None, **_chance(together, run)}
        return found

    def rank_correlations(self) -> dict[str, dict[str, float | None]]:
        """Spearman's rank correlation of each figure with each uncertain input."""
        good = self.cases.fine
        if good.sum() < 3:
            return {}
        ranks = np.apply_along_axis(scipy.stats.rankdata, 0, self.cases.x[good])
        found = {}
        for j, path in enumerate(self.cases.outputs):
            y = scipy.stats.rankdata(self.cases.y[good, j])
            with np.errstate(invalid="ignore", divide="ignore"):
                rho = [
                    float(np.corrcoef(ranks[:, i], y)[0, 1]) if np.ptp(y) and np.ptp(ranks[:, i]) else np.nan
                    for i in range(ranks.shape[1])
                ]
            found[path] = {name: number(r) for name, r in zip(self.cases.inputs, rho, strict=True)}
        return found

    def findings(self) -> dict[str, Any]:
        return {
            "uncertain": [s.as_json() for s in self.sources],
            "statistics": self.statistics(),
            "limits": self.chances(),
            "rank_correlation": self.rank_correlations(),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_ensemble(self)


def _chance(kept: np.ndarray, run: np.ndarray) -> dict[str, Any]:
    of = int(run.sum())
    met = int(kept.sum())
    return {
        "probability": met / of if of else None,
        "interval_95": list(wilson(met, of)) if of else [None, None],
    }


def monte_carlo(
    thing: Any,
    uncertain: Mapping[str, Any],
    *,
    samples: int = 1000,
    outputs: Sequence[str] | None = None,
    limits: Mapping[str, Any] | None = None,
    method: str = "latin_hypercube",
    seed: int = 0,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    **how: Any,
) -> Ensemble:
    """Figures of a line or a formula when inputs are uncertain.

    Parameters
    ----------
    thing: a line (``granum.read``), a formula or its key, with ``fixed`` inputs.
    uncertain: distributions by input, see ``sources_of``.
    samples: cases. method: ``latin_hypercube``, ``random`` or ``sobol_sequence``.
    limits: ``{figure: {lower, upper}}``; the probability of keeping them is found.
    how: ``progress``, ``cancel``, ``folder``, ``workers`` of ``granum.studies.engine.evaluate``.

    >>> from granum.core.units import from_si
    >>> found = monte_carlo(
    ...     "particles.terminal_velocity",
    ...     {"particle_diameter": {"distribution": "normal", "mean": "85 um", "standard_deviation": "5 um"}},
    ...     fixed={"particle_density": 2630, "fluid_density": 1020, "dynamic_viscosity": "1.2 cP"},
    ... )
    >>> found.counts()["failed"]
    0
    """
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    sources = sources_of(subject, uncertain)
    names = tuple(n for s in sources for n in s.names)
    subject, kept = limits_of(subject, limits or {}, _("in 'limits' for"))
    subject, paths = prepare(subject, outputs, names)
    paths = tuple(dict.fromkeys((*paths, *kept)))
    count = whole(samples, "samples", 1, MOST_CASES)
    x = inputs_at(
        sources, unit_points(method, count, sum(s.dimensions for s in sources), whole(seed, "seed", 0, 2**31))
    )
    cases = evaluate(subject, names, paths, x, **how)
    return Ensemble(
        title or kind_in_words("monte_carlo"),
        cases,
        tuple(sources),
        kept,
        elapsed=time.perf_counter() - began,
    )


@dataclass(frozen=True)
class Sensitivity(Outcome):
    """First-order and total Sobol indices with 95 % intervals; inputs from one fit count as one group."""

    sources: tuple[Source, ...]
    groups: tuple[str, ...]
    seed: int
    kind: ClassVar[str] = "sobol"

    @property
    def blocks(self) -> np.ndarray:
        """Which blocks of cases are whole: the estimator needs all of a block, so one failed case discards
        its block.
        """
        return np.all(self.cases.fine.reshape(-1, len(self.groups) + 2), axis=1)

    def indices(self) -> dict[str, dict[str, dict[str, float | None]]]:
        """``{figure: {input or group: {first, first_interval, total, total_interval}}}``; intervals are half
        widths at 95 %.
        """
        from SALib.analyze import sobol

        kept = np.repeat(self.blocks, len(self.groups) + 2)
        problem = {
            "num_vars": len(self.groups),
            "names": list(self.groups),
            "bounds": [[0.0, 1.0]] * len(self.groups),
        }
        found = {}
        for path in self.cases.outputs:
            y = self.column(path)[kept]
            if len(y) < 4 * (len(self.groups) + 2) or np.ptp(y) <= 1e-12 * np.max(np.abs(y)):
                found[path] = {
                    g: dict.fromkeys(("first", "first_interval", "total", "total_interval"))
                    for g in self.groups
                }
                continue
            s = sobol.analyze(
                problem,
                y,
                calc_second_order=False,
                conf_level=0.95,
                seed=self.seed + 1,  # SALib takes 0 for none, and its intervals then differ each time
                print_to_console=False,
            )
            found[path] = {
                g: {
                    "first": number(s["S1"][i]),
                    "first_interval": number(s["S1_conf"][i]),
                    "total": number(s["ST"][i]),
                    "total_interval": number(s["ST_conf"][i]),
                }
                for i, g in enumerate(self.groups)
            }
        return found

    def findings(self) -> dict[str, Any]:
        return {
            "uncertain": [s.as_json() for s in self.sources],
            "statistics": self.statistics(),
            "indices": self.indices() if self.complete else {},
            "blocks": len(self.blocks),
            "blocks_used": int(self.blocks.sum()),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_sensitivity(self)


def sobol(
    thing: Any,
    uncertain: Mapping[str, Any],
    *,
    samples: int = 512,
    outputs: Sequence[str] | None = None,
    seed: int = 0,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    **how: Any,
) -> Sensitivity:
    """How much of the variance of each figure comes from each uncertain input (Saltelli's design, SALib).

    ``samples`` is the base number, made a power of two; (inputs + 2) times as many cases are computed. The
    parameters of one fit are one group, because indices are defined for independent inputs.
    """
    from SALib.sample import sobol as design

    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    sources = sources_of(subject, uncertain)
    names = tuple(n for s in sources for n in s.names)
    subject, paths = prepare(subject, outputs, names)
    groups = tuple(s.names[0] if len(s.names) == 1 else " + ".join(s.names) for s in sources)
    labels = [g for g, s in zip(groups, sources, strict=True) for _dimension in range(s.dimensions)]
    most = 1 << (MOST_CASES // (len(groups) + 2)).bit_length() - 1
    base = 1 << (whole(samples, "samples", 4, most) - 1).bit_length()
    problem = {
        "num_vars": len(labels),
        "names": [f"{n}#{i}" for i, n in enumerate(labels)],
        "groups": labels,
        "bounds": [[0.0, 1.0]] * len(labels),
    }
    points = design.sample(
        problem, base, calc_second_order=False, scramble=True, seed=whole(seed, "seed", 0, 2**31)
    )
    cases = evaluate(subject, names, paths, inputs_at(sources, points), **how)
    return Sensitivity(
        title or kind_in_words("sobol"),
        cases,
        tuple(sources),
        groups,
        seed,
        elapsed=time.perf_counter() - began,
    )
