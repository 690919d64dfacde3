"""Measured similarity numbers, Mothes and Löffler against their differential balance, wear, sizing for a
total efficiency, drawings.
"""

from __future__ import annotations

import runpy

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES

from granum.cases import read
from granum.cases.reading import read_text
from granum.core.errors import ApplicabilityError, InputError
from granum.cyclones.charts import cyclone_distributions_chart
from granum.cyclones.drawing import cyclone_drawing
from granum.cyclones.formulas import efficiency, erosion, mothes, pressure, similar
from granum.cyclones.geometry import StandardCyclone
from granum.cyclones.total import cyclone_for_efficiency
from granum.particles.size_laws import RosinRammler

FOLDER = EXAMPLES / "cyclone"
AIR = (2000.0, 1.2, 1.8e-5)


def test_rhodes_example_and_stairmands_designs() -> None:
    # Rhodes, worked example 9.1, from memory, not opened: 2 m³/s, 18.25 µPa s, 1000 kg/m³, 100 m of gas:
    # 1.014 m and 4.34 µm; two of 0.717 m and 3.65 µm
    for flow, D, cut in ((2.0, 1.014, 4.34e-6), (1.0, 0.717, 3.65e-6)):
        assert similar.diameter_similar(flow, 1177.0, 1.2) == pytest.approx(D, abs=1e-3)
        assert similar.cut_size_similar(flow, 1001.2, 1.2, 18.25e-6, D) == pytest.approx(cut, abs=5e-9)
    # Stairmand's heads give the Euler number measured on his high-efficiency design, 320, to 1 %: N_H
    # (π/(4·0.1))²
    shape = StandardCyclone()(0.203)
    assert pressure.inlet_heads_stairmand(*shape) * (np.pi / 0.4) ** 2 == pytest.approx(320.0, rel=0.01)
    # Muschelknautz' cut lies within 15 % of the one measured on the 203 mm cyclone at 223 m³/h (Stk = 1.4e-4:
    # 1.55 µm); Barth's above it
    measured = similar.cut_size_similar(223 / 3600, *AIR, 0.203)
    assert efficiency.cut_size_muschelknautz(223 / 3600, *AIR, *shape) == pytest.approx(measured, rel=0.15)
    assert measured < efficiency.cut_size_barth(223 / 3600, *AIR, *shape)
    # on the high-throughput design (Stk = 6e-3) Barth's is the nearer: within 6 %
    wide = StandardCyclone("stairmand_high_throughput")(0.203)
    measured = similar.cut_size_similar(669 / 3600, *AIR, 0.203, 6e-3)
    assert efficiency.cut_size_barth(669 / 3600, *AIR, *wide) == pytest.approx(measured, rel=0.06)


def test_mothes_loffler_solves_its_balance() -> None:
    # outer vortex down, inner vortex up, wall, turbulence and drift between them, integrated from near the
    # bottom upwards
    shape, Q, D_t = StandardCyclone()(0.3), 0.1, 0.0125
    H, S = shape.height, shape.finder_length
    R, r_i, length = 0.15, shape.outlet_diameter / 2, H - S
    velocity = mothes.swirl(Q, shape, 0.0075)
    cone = (
        np.pi
        * (H - shape.cylinder_height)
        / 3
        * (R**2 + (shape.dust_outlet_diameter / 2) ** 2 + R * shape.dust_outlet_diameter / 2)
    )
    r_a = np.sqrt((np.pi * R**2 * shape.cylinder_height + cone) / (np.pi * H))
    for x in (0.4e-6, 1.2e-6, 4e-6):
        fall = 1998.8 * x**2 / (18 * 1.8e-5)
        w_a, w_i = fall * float(velocity(r_a)) ** 2 / r_a, fall * float(velocity(r_i)) ** 2 / r_i
        inward = Q / (2 * np.pi * r_i * length)

        # s = ln(1 - z/length); c outer, k core; flow Q(1 - z/length) in both
        def slopes(s, y, w_a=w_a, w_i=w_i, inward=inward):
            c, k = y
            wall = 2 * np.pi * r_a * length / Q * w_a * c
            outwards = (
                2
                * np.pi
                * r_i
                * length
                / Q
                * (D_t / (r_a - r_i) * (k - c) + (w_i - inward) * (k if w_i > inward else c))
            )
            # (1 - ζ) dc/dζ = c - wall + outwards; core: (1 - ζ) dk/dζ = k + outwards; d/ds = -(1 - ζ) d/dζ
            return [-(c - wall + outwards), -(k + outwards)]

        # any start near the bottom: the regular solution grows fastest upwards
        start = np.log(1e-12)
        run = solve_ivp(slopes, (start, 0.0), [1.0, 0.5], rtol=1e-10, atol=1e-300, method="DOP853")
        ratio = run.y[1, -1] / run.y[0, -1]
        entry = np.exp(-2 * np.pi * r_a * w_a / Q * (S - shape.inlet_height / 2))
        found = mothes.cyclone_efficiency_mothes_loffler(x, Q, *AIR, *shape)
        assert found == pytest.approx(1 - ratio * entry, rel=1e-6), x
    # the swirl keeps the balance of moments at the wall: v_e - v = λ ĥ v²/v_z
    v, v_z = float(velocity(R)), Q / (np.pi * R**2)
    entry = Q / (shape.inlet_height * shape.inlet_width * (0.889 - 0.204 * 0.4))
    bare = shape.cylinder_height / R - shape.inlet_height / R * np.arccos(0.6) / (2 * np.pi)
    assert entry - v == pytest.approx(0.0075 * bare * v**2 / v_z, rel=1e-9)
    # nothing of the finest, all of the coarsest, rising in between
    sizes = np.geomspace(1e-8, 2e-4, 60)
    grade = np.asarray(mothes.cyclone_efficiency_mothes_loffler(sizes, Q, *AIR, *shape))
    assert grade[0] < 1e-3 < 0.999 < grade[-1]
    assert np.all(np.diff(grade) >= 0)


def test_wear() -> None:
    # Finnie: both branches meet at tan α = 1/3 with 0.3; no wear at grazing and right angles
    low, high = np.asarray(
        erosion.wear_velocity_finnie(20.0, 0.1, np.arctan(1 / 3) + np.array([-1e-9, 1e-9]), 1e9)
    )
    assert low == pytest.approx(high, rel=1e-6)
    assert low == pytest.approx(0.1 * 0.1 * 400 / 4e9 * 0.3, rel=1e-6)
    assert erosion.wear_velocity_finnie(20.0, 0.1, 0.0, 1e9) == 0.0
    # coarse dust: the worst place opposite the inlet, by search over the angles reached
    angles = np.linspace(0.0, np.arccos(0.6), 20001)
    every = np.asarray(erosion.wear_velocity_finnie(20.0, 0.5 * np.sin(angles), angles, 1.2e9))
    found = np.asarray(
        erosion.wear_velocity_cyclone_inlet(
            20.0, 0.5, 1.0, 0.2, np.array([1e-6, 1e-3]), 2600.0, 1.8e-5, 1.2e9
        )
    )
    assert found[1] == pytest.approx(every.max(), rel=1e-6)
    # fine dust, by hand: St = 2 τ v/D = 3.21e-4, wear c m v²/(4p)·2 St²
    St = 2 * 2600e-12 / (18 * 1.8e-5) * 20.0
    assert found[0] == pytest.approx(0.1 * 0.5 * 400 / 4.8e9 * 2 * St**2, rel=2e-3)


def test_hardness_of_minerals() -> None:
    # Vickers: orthoclase 6.87, quartz 12.2 GPa (Broz and others, recalled); between them in proportion
    found = np.asarray(erosion.indentation_hardness_mohs(np.array([6.0, 6.5, 7.0])))
    assert found[[0, 2]] == pytest.approx([6.87e9, 12.2e9])
    assert found[1] == pytest.approx(np.sqrt(found[0] * found[2]))
    # Tabor (1954, recalled): a step on the scale is 60 % more hardness, from gypsum to corundum
    soft, hard = np.asarray(erosion.indentation_hardness_mohs(np.array([2.0, 9.0])))
    assert (hard / soft) ** (1 / 7) == pytest.approx(1.6, rel=0.05)
    assert np.all(np.diff(np.asarray(erosion.indentation_hardness_mohs(np.linspace(1.0, 9.0, 99)))) > 0.0)


@pytest.mark.parametrize(("solid", "wears"), [("quartz", True), ("talc", False), ("cellulose", None)])
def test_a_wall_is_worn_by_what_is_harder(solid: str, wears: bool | None) -> None:
    """Mild steel, 1.2 GPa, between talc (1 on Mohs' scale) and quartz (7); nobody knows of polymers."""
    text = (EXAMPLES / "cyclone" / "pair.toml").read_text(encoding="utf-8").replace("quartz", solid)
    run = read_text(text.replace('wall_hardness = "6 GPa"', "")).solve()
    figures = run.units["first"].values
    if wears is None:
        assert figures.wear_velocity is None
    else:
        assert (float(figures.wear_velocity) > 0.0) is wears
    told = [check.name for check in run.units["first"].checks]
    assert ("wear of the wall in a year of operation" in told) is bool(wears)


def test_sizing_for_a_total_efficiency() -> None:
    dust = RosinRammler(size_modulus=2e-5, distribution_exponent=1.0)
    found = cyclone_for_efficiency(4.0, 0.85, 2000.0, dust, pressure_drop=1200.0)
    assert found.parallel_number == int(found.parallel_number)
    assert found.removal_efficiency >= 0.85
    assert found.pressure_drop == pytest.approx(1200.0)
    # by an independent sum over the density of the distribution
    x = np.geomspace(1e-9, 1e-3, 20001)
    grade = efficiency.cyclone_efficiency_muschelknautz(
        x, 4.0 / found.parallel_number, *AIR, *StandardCyclone()(found.diameter)
    )
    assert found.removal_efficiency == pytest.approx(
        float(np.trapezoid(np.asarray(grade) * np.asarray(dust.density(x)), x)), abs=1e-3
    )
    # one cyclone fewer in parallel at the same drop would be wider and miss it
    wide = (4.0 / ((found.parallel_number - 1) * found.inlet_velocity * 0.1)) ** 0.5
    grade = efficiency.cyclone_efficiency_muschelknautz(
        x, 4.0 / (found.parallel_number - 1), *AIR, *StandardCyclone()(wide)
    )
    assert float(np.trapezoid(np.asarray(grade) * np.asarray(dust.density(x)), x)) < 0.85
    # in series: shares left multiply; the second stage sees finer dust; two wide stages do what one narrow
    # does
    pair = cyclone_for_efficiency(4.0, 0.85, 2000.0, dust, parallel_number=4.0, series_number=2)
    assert 1 - np.prod(1 - pair.stage_efficiency) == pytest.approx(0.85, abs=1e-9)
    assert pair.stage_efficiency[1] < pair.stage_efficiency[0]
    with pytest.raises(ApplicabilityError, match="No such cyclone"):
        cyclone_for_efficiency(4.0, 0.999999, 2000.0, dust, pressure_drop=50.0)
    with pytest.raises(InputError, match="either"):
        cyclone_for_efficiency(4.0, 0.9, 2000.0, dust)


def test_drawings() -> None:
    drawing = cyclone_drawing(1.0, StandardCyclone("lapple"))
    body = drawing.data[0]
    assert min(body.y) == pytest.approx(-4100.0)  # 4 m and the stub of the dust outlet
    assert drawing.layout.yaxis.scaleanchor == "x"
    chart = cyclone_distributions_chart(1.5, 2000.0, 1.0)
    grade, feed, dust, escaped = (np.asarray(t.y) for t in chart.data)
    total = grade.mean() / 100
    assert dust * total + escaped * (1 - total) == pytest.approx(np.cumsum(np.full(400, 0.25)), abs=1e-9)
    assert np.all(dust <= feed + 0.26)
    assert np.all(escaped >= feed - 1e-9)


def test_pair_of_the_example_and_its_script() -> None:
    found = read(FOLDER / "pair.toml").solve().as_json()
    assert found["audit"]["mass_closure"] < 1e-12
    assert all(check["ok"] for unit in found["units"].values() for check in unit["checks"])
    first, second = (
        found["units"][name]["results"]["removal_efficiency"]["value"] for name in ("first", "second")
    )
    streams = (
        {s["name"]: s for s in found["streams"]} if isinstance(found["streams"], list) else found["streams"]
    )
    assert "clean_air" in streams
    assert first > 0.9 > second  # the first is overloaded, the second sees the fines
    runpy.run_path(str(FOLDER / "cyclone.py"))
