"""Isotherms of several products on one chart, and what spoils a food at which water activity."""

from __future__ import annotations

import numpy as np
import pytest

import granum as gr
from granum.core.errors import InputError


def lines(drawing) -> dict:
    return {trace.name: trace for trace in drawing.data if trace.name}


def test_products_and_temperatures_lie_side_by_side() -> None:
    """As the law itself; maize at 25 °C and 0.70 holds the 14 % (wet basis) of its trade, less when warm."""
    drawing = gr.drying.isotherms_chart("maize", isotherm_second="wheat", temperature_second="40 degC")
    found = lines(drawing)
    shown = [n for n, trace in found.items() if trace.showlegend is not False]
    assert len(shown) == 3
    cold, warm = (
        found["Isotherm of shelled maize"],
        found["Isotherm of shelled maize, at the other temperature"],
    )
    X = float(np.interp(0.70, cold.x, cold.y))
    assert pytest.approx(0.14, abs=0.005) == X / (1 + X)
    assert (np.asarray(warm.y) < np.asarray(cold.y)).all()
    words = [a.text for a in drawing.layout.annotations]
    assert words == ["bound water", "multilayer", "capillary water"]
    edges = sorted({float(trace.x[0]) for trace in drawing.data if trace.name == "zone"})
    assert edges == [0.2, 0.6]


def test_the_loop_of_hysteresis_is_filled() -> None:
    plain = gr.drying.isotherms_chart("potato")
    wetted = {
        "law": "isotherm_gab",
        "monolayer_moisture": 0.19,
        "monolayer_constant": 4.0,
        "multilayer_constant": 0.96,
    }
    looped = gr.drying.isotherms_chart("potato", isotherm_adsorption=wetted)
    assert "hysteresis" not in lines(plain)
    assert lines(looped)["hysteresis"].fill is not None


def test_zones_that_overlap_are_refused() -> None:
    with pytest.raises(InputError, match="follow one another"):
        gr.drying.isotherms_chart("maize", zone_bound=0.7, zone_multilayer=0.3)


def test_the_map_has_the_limits_of_the_notes() -> None:
    """Table II.1: bacteria 0.91, yeasts 0.87, molds 0.70. Maize of 14 % (wet basis) lies at the molds."""
    drawing = gr.drying.stability_chart("maize", moisture_dry_basis=0.14 / 0.86)
    found = lines(drawing)
    for name, limit in (("bacteria", 0.91), ("yeasts", 0.87), ("molds", 0.70)):
        assert tuple(found[name].x) == (limit, 1.0)
    assert float(found["this moisture"].x[0]) == pytest.approx(0.70, abs=0.02)
