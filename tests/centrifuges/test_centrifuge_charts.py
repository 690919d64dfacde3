"""The bowl drawing and the grade curve."""

from __future__ import annotations

import pytest

from granum.centrifuges.charts import bowl_chart, grade_efficiency_chart


def test_bowl_shows_the_interface_of_the_book():
    drawing = bowl_chart("10.414 mm", "10.160 mm", 980.3, 919.5, "22.25 mm", "19.7 cm")
    radii = sorted({shape.y0 for shape in drawing.layout.shapes if shape.type == "line"})
    assert radii[2] == pytest.approx(1.375, rel=0.005)  # Geankoplis, example 14.4-2
    assert any("interface" in note.text for note in drawing.layout.annotations)


def test_grade_curve_reaches_one():
    curve = grade_efficiency_chart("1 m^3/hour", 0.7, 0.02, 0.06, "15000 rpm", 1500, 1000, 1e-3).data[0]
    assert curve.y[-1] == 1.0
    assert curve.y[0] < 0.01
