"""Filtration through a membrane at constant pressure: which way it blocks, and how fast."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Series, Time, Volume, VolumeFlow
from granum.estimation import Fit, LabTest
from granum.filtration.formulas.blocking import LAWS, BlockingLaw, BlockingTime, filtrate_volume_blocking

NO_BLOCKING = 1e3  # durations of the test: a blocking time beyond this is not seen


@lab_test(
    "blocking_test",
    source="hermia1982",
    title="Blocking test of a membrane",
    equation=r"\frac{d^2t}{dV^2} = k\left(\frac{dt}{dV}\right)^n,\qquad n = 2,\ \tfrac{3}{2},\ 1,\ 0",
)
class BlockingTest(LabTest):
    """First flow and blocking time of a membrane at constant pressure, by that of Hermia's four laws that
    fits best, or by a named one.

    All four laws have two parameters, so that the least scatter ranks them; the flags say how far the next
    one is behind. A flow that has hardly fallen tells no law from another.
    """

    time: Annotated[Time, Series("points")]
    filtrate_volume: Annotated[Volume, Series("points")]
    blocking_law: Literal["best", "complete", "standard", "intermediate", "cake"] = "best"

    estimates: ClassVar = {"filtrate_flow_initial": VolumeFlow, "blocking_time": BlockingTime}
    axes: ClassVar = {"time": Time, "filtrate_volume": Volume}
    least_points: ClassVar[int] = 5

    def _fit_one(self, law: BlockingLaw, *, judged: bool) -> Fit:
        t, V = np.asarray(self.time, dtype=float), np.asarray(self.filtrate_volume, dtype=float)
        ahead = t > 0.0
        first = float(V[ahead][0] / t[ahead][0])
        mean = float(V[-1] / t[-1])
        start = {
            "filtrate_flow_initial": first,
            "blocking_time": float(t[-1]) / max(2.0 * (first / mean - 1.0), 0.1),
        }

        def model(p: dict[str, Any], t: Any) -> Any:
            shape = filtrate_volume_blocking.function
            return shape(jnp.asarray(t), p["filtrate_flow_initial"], p["blocking_time"], law)

        bounds = {
            "filtrate_flow_initial": (0.0, np.inf),
            "blocking_time": (1e-3 * float(t[ahead][0]), NO_BLOCKING * float(t[-1])),
        }
        return self.fitted(model, start, t, V, bounds=bounds, judged=judged)

    def ranking(self) -> list[tuple[BlockingLaw, Fit]]:
        """The four laws, that of least scatter first."""
        found: list[tuple[BlockingLaw, Fit]] = [(law, self._fit_one(law, judged=False)) for law in LAWS]
        return sorted(found, key=lambda one: one[1].statistics["rmse"])

    def fit(self) -> Fit:
        """First flow and blocking time with 95 % intervals."""
        self.increasing("time")
        t, V = np.asarray(self.time, dtype=float), np.asarray(self.filtrate_volume, dtype=float)
        if not V[-1] > 0.0:
            raise InputError(_("No filtrate was collected: nothing to fit."), name="filtrate_volume")
        ahead = t > 0.0
        if not V[ahead][0] > 0.0:
            raise InputError(
                _("The first reading after the start has no filtrate: leave it out."), name="filtrate_volume"
            )
        if self.blocking_law != "best":
            return self._fit_one(self.blocking_law, judged=True)
        (name, lead), (second, other), *_rest = self.ranking()
        found = self.judged(lead, len(LAWS))
        behind = other.statistics["rmse"] / max(lead.statistics["rmse"], 1e-300)
        text = _("The {name} blocking law fits best; {second} has {ratio} times its scatter.")
        found.flags.append(
            self.note(
                "best law",
                text.format(name=_(name), second=_(second), ratio=f"{min(behind, 1e6):.3g}"),
                name,
            )
        )
        return found
