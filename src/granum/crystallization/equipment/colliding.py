"""Crystals that agglomerate and break in a vessel, where that is asked for."""

from __future__ import annotations

from typing import Annotated, Any

import equinox as eqx

from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import Law
from granum.crystallization.population.grid import Collisions

Kernel = Annotated[Any, Law("agglomeration_kernel")]
BreakageLaw = Annotated[Any, Law("breakage_law")]

UNSOLVED_CROWD = (
    "No steady suspension was found in which the crystals made are those that the balance leaves: they meet "
    "or break too often. Check the unit of the kernel, give larger size classes, a smaller kernel or "
    "breakage frequency, or a 'breakage_law' where they only meet."
)

UNSOLVED_BUSY = (
    "More than half of the crystals meet or break within one time step of the batch: check the unit of the "
    "kernel, or give a smaller kernel, breakage frequency or time."
)


class Colliding(eqx.Module):
    """A vessel in which crystals may agglomerate by a kernel and break or chip by a law."""

    agglomeration_kernel: Kernel | None = eqx.field(kw_only=True, default=None)
    breakage_law: BreakageLaw | None = eqx.field(kw_only=True, default=None)

    @property
    def collisions(self) -> Collisions | None:
        """What crystals do to each other; None where they only grow."""
        if self.agglomeration_kernel is None and self.breakage_law is None:
            return None
        return Collisions(self.agglomeration_kernel, self.breakage_law)

    def steady_only(self) -> None:
        """Refuse a run in time, which follows crystals that only grow."""
        if self.collisions is not None:
            raise CaseError(
                _(
                    "In a run in time crystals of a continuous vessel only grow: leave out "
                    "'agglomeration_kernel' and 'breakage_law', or solve the steady state."
                )
            )
