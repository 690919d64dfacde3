"""Charts of what happens inside batch crystallizers, over the time of a batch."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core.i18n import _
from granum.crystallization.population.lagrangian import Course
from granum.crystallization.population.rivals import Row
from granum.crystallization.vessels.needles import NeedleMarch
from granum.streams.inside_charts import Axis, Curve, drawn_along

TEMPERATURE = Axis("temperature", "Temperature", "degC", zero=False)
CONTENT = Axis("solute_per_solvent", "MassRatio", zero=False)
DRIVING = Axis("relative_supersaturation", "Fraction", "percent")


def drawn_course(course: Course | NeedleMarch, heading: str) -> dict[str, Any]:
    """Under a heading what is dissolved and what would be, with the temperature; and what drives growth, with
    what grows.
    """
    time = np.asarray(course.time)
    dissolved, saturated = (np.asarray(x) for x in (course.solute_per_solvent, course.solubility_per_solvent))
    driving = Curve(_("supersaturation"), dissolved / saturated - 1.0, "LIQUID")
    return {
        heading: drawn_along(
            Axis("time", "Time"),
            time,
            (
                CONTENT,
                [
                    Curve(_("dissolved"), dissolved, "LIQUID"),
                    Curve(_("solubility"), saturated, "LIQUID", "dot"),
                ],
            ),
            (TEMPERATURE, [Curve(_("temperature"), course.temperature, "HEAT", "dash")]),
        ),
        _("What drives the growth"): drawn_along(
            Axis("time", "Time"), time, (DRIVING, [driving]), _grown(course)
        ),
    }


def _grown(course: Course | NeedleMarch) -> tuple[Axis, list[Curve]]:
    """Mean size by mass of the crystals; of needles how fast both of their sizes grow."""
    if isinstance(course, NeedleMarch):
        length, width = np.asarray(course.rates).T
        return Axis("growth_rate", "Speed", zero=False), [
            Curve(_("growth of the length"), length, "SOLID", "dash"),
            Curve(_("growth of the width"), width, "SOLID", "dot"),
        ]
    moments = np.asarray(course.moments)
    some = moments[:, 3] > 0.0
    size = np.where(some, moments[:, 4] / np.where(some, moments[:, 3], 1.0), np.nan)
    return Axis("crystal_size", "Length"), [Curve(_("mean size by mass"), size, "SOLID", "dash")]


def drawn_resolution(times: Any, course: Row, leaving: Any) -> dict[str, Any]:
    """Crystals of both enantiomers that would leave if the batch ended, and their purity."""
    wanted, other = np.maximum(np.asarray(leaving), 0.0).T
    whole = wanted + other
    pure = np.where(whole > 0.0, wanted / np.where(whole > 0.0, whole, 1.0), np.nan)
    ratios, saturated = np.asarray(course.ratios), np.asarray(course.saturated)
    one, two = (np.maximum(ratios[:, i] / saturated[:, i] - 1.0, 0.0) for i in range(2))
    return {
        _("Crystals of both enantiomers over time"): drawn_along(
            Axis("time", "Time"),
            times,
            (
                Axis("crystal_mass_per_solvent", "MassRatio", label=_("crystals per solvent")),
                [
                    Curve(_("of the wanted enantiomer"), wanted, "SOLID"),
                    Curve(_("of the other"), other, "GAS"),
                ],
            ),
            (
                Axis("enantiomer_fraction", "Fraction", "percent", _("purity")),
                [Curve(_("purity if the batch ended"), pure, "ACCENT", "dash")],
            ),
        ),
        _("What drives the growth"): drawn_along(
            Axis("time", "Time"),
            times,
            (
                DRIVING,
                [
                    Curve(_("of the wanted enantiomer"), one, "SOLID"),
                    Curve(_("of the other"), two, "GAS"),
                ],
            ),
            (TEMPERATURE, [Curve(_("temperature"), course.temperature, "HEAT", "dash")]),
        ),
    }


def drawn_forms(times: Any, course: Row) -> dict[str, Any]:
    """Crystals of two forms of one substance with the share of the stable one, and what is dissolved between
    both solubilities.
    """
    old, new = np.maximum(np.asarray(course.masses), 0.0).T
    whole = old + new
    share = np.where(whole > 0.0, new / np.where(whole > 0.0, whole, 1.0), np.nan)
    saturated = np.asarray(course.saturated)
    return {
        _("Crystals of both forms over time"): drawn_along(
            Axis("time", "Time"),
            times,
            (
                Axis("crystal_mass_per_solvent", "MassRatio", label=_("crystals per solvent")),
                [Curve(_("metastable form"), old, "GAS"), Curve(_("stable form"), new, "SOLID")],
            ),
            (
                Axis("stable_fraction", "Fraction", "percent"),
                [Curve(_("share of the stable form"), share, "ACCENT", "dash")],
            ),
        ),
        _("What is dissolved, between both solubilities"): drawn_along(
            Axis("time", "Time"),
            times,
            (
                CONTENT,
                [
                    Curve(_("dissolved"), np.asarray(course.ratios)[:, 0], "LIQUID"),
                    Curve(_("solubility of the metastable form"), saturated[:, 0], "GAS", "dot"),
                    Curve(_("solubility of the stable form"), saturated[:, 1], "SOLID", "dot"),
                ],
            ),
            (TEMPERATURE, [Curve(_("temperature"), course.temperature, "HEAT", "dash")]),
        ),
    }
