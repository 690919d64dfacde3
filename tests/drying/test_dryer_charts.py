"""The charts of a dryer carry the numbers of its balance."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError
from granum.core.i18n import language
from granum.drying.charts import dryer_air_path, dryer_energy_chart

MAIZE = ("25 degC", "50 %", "50 degC", "100 %")


def marked(figure):
    return next(trace for trace in figure.data if getattr(trace, "mode", "") == "markers+text")


def test_air_path_of_the_maize():
    path = marked(dryer_air_path(*MAIZE))
    np.testing.assert_allclose(path.x, [25.0, 50.0, 25.1], atol=0.3)
    np.testing.assert_allclose(path.y, [9.9, 9.9, 20.1], atol=0.15)
    mollier = marked(dryer_air_path(*MAIZE, diagram="mollier"))
    np.testing.assert_allclose(mollier.x, [9.9, 9.9, 20.1], atol=0.15)


def test_recirculated_air_returns_to_the_mixing_point():
    figure = dryer_air_path("20 degC", "60 %", "80 degC", "50 %", recirculated_fraction=0.7)
    path = marked(figure)
    assert len(path.x) == 4
    w = np.asarray(path.y)
    assert w[1] == pytest.approx(0.3 * w[0] + 0.7 * w[3])
    assert w[2] == pytest.approx(w[1])
    assert figure.data[-1].x[1] == pytest.approx(path.x[1])


def test_energy_flows_add_up_in_both_languages():
    for code, first in (("en", "heater"), ("fr", "batterie de chauffage")):
        with language(code):
            figure = dryer_energy_chart(
                "25 degC",
                "50 %",
                "80 degC",
                "60 %",
                heat_loss="100 kW",
                shaft_power="20 kW",
                temperature_product_inlet="20 degC",
                temperature_product_outlet="45 degC",
            )
        sankey = figure.data[0]
        assert sankey.node.label[0].startswith(first)
        flows = np.asarray(sankey.link.value)
        given = np.asarray(sankey.link.source) < 2
        assert flows[given].sum() == pytest.approx(flows[~given].sum(), rel=1e-9)


def test_an_impossible_dryer_has_no_chart():
    with pytest.raises(ApplicabilityError, match="relative humidity"):
        dryer_air_path("25 degC", "50 %", "50 degC", temperature_outlet="20 degC")
