"""Validation shown in the documentation: the package's charts with published data in them, and printed worked
examples recalculated.

Two charts show how a test is read instead, on made data, and say so. Printed numbers stand in ``docs/data``,
``examples`` and ``tests/references``, each file with its source beside it; what Granum finds is calculated
while the site is built.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import granum as gr
from granum.core import charts, registry
from granum.core.i18n import current_language
from granum.core.units import format_number, from_si, pretty_unit, read_quantity
from granum.reports.quantities import figure_named, value_text

EXAMPLES = Path(__file__).parent.parent / "examples"
DATA = Path(__file__).parent / "data"
TESTED = Path(__file__).parent.parent / "tests" / "references" / "worked_examples_opened2026.csv"
ZERO = 273.15


@dataclass(frozen=True)
class Shown:
    """A figure with its caption and, where the numbers matter, a table."""

    figure: Any
    caption: str
    table: str = ""


@dataclass(frozen=True)
class Printed:
    """One number of a worked example beside what Granum finds, as text with its unit."""

    what: str
    printed: str
    found: str
    difference: float


def _data(name: str) -> dict[str, list[str]]:
    """The columns of a file of ``docs/data`` as text."""
    with (DATA / name).open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {head: [row[head] for row in rows] for head in rows[0]}


def _table(heads: list[str], rows: list[list[str]]) -> str:
    return "\n".join(
        [
            "| " + " | ".join(heads) + " |",
            "|---" + "|--:" * (len(heads) - 1) + "|",
            *("| " + " | ".join(r) + " |" for r in rows),
        ]
    )


# ---- figures ---------------------------------------------------------------------------------------
def particles_sizes() -> Shown:
    """A sieve analysis with its Rosin–Rammler fit."""
    test = gr.particles.SieveAnalysis.read(
        EXAMPLES / "size-analysis" / "crushed_quartz_mccabe2005.csv", pan_mass="0.75 g", sample_mass="100 g"
    )
    return Shown(
        test.chart(),
        "Crushed quartz on Tyler sieves (McCabe, Smith and Harriott) and the Rosin–Rammler distribution fitted to it.",  # noqa: E501
    )


def porous_bed() -> Shown:
    """Packed bed: permeametry."""
    test = gr.porous.Permeametry.read(
        EXAMPLES / "packed-bed" / "water_test.csv",
        length="20 cm",
        dynamic_viscosity="1.0 cP",
        fluid_density=998,
        void_fraction=0.40,
        kozeny_coefficient=150 / 36,
    )
    return Shown(
        test.chart(),
        "A made water test (Ergun's equation for 0.50 mm grains, rounded to two digits) and the fit that must find the grain size again.",  # noqa: E501
    )


def settling_curve() -> Shown:
    """Settling curve of limestone."""
    test = gr.settling.BatchTest.read(
        EXAMPLES / "batch-settling" / "limestone.csv",
        initial_concentration="236 g/L",
        underflow_concentration="550 g/L",
    )
    figure = gr.settling.settling_curve_chart(test.time, test.interface_height, test.initial_concentration)
    return Shown(
        figure,
        "Limestone slurry of 236 g/L (Foust et al.): measured interface, tangents found by the program, zones.",  # noqa: E501
    )


def filtration_leaf() -> Shown:
    """Leaf test of Ruth and Kempe."""
    test = gr.filtration.LeafTest.read(
        EXAMPLES / "leaf-filter" / "leaf_geankoplis.csv",
        area="0.0439 m2",
        pressure_drop="338 kPa",
        dynamic_viscosity="0.8937 cP",
        dry_cake_per_filtrate=23.47,
    )
    return Shown(
        test.chart(),
        "Calcium carbonate at 338 kPa: data of Ruth and Kempe (1937) as printed by Geankoplis, with the fitted line.",  # noqa: E501
    )


def filtration_pressures() -> Shown:
    """Compressibility from five pressures."""
    test = gr.filtration.Compressibility.read(
        EXAMPLES / "leaf-filter" / "pressures_mccabe.csv",
        area="440 cm2",
        dynamic_viscosity="0.8937 cP",
        dry_cake_per_filtrate="23.5 g/L",
    )
    return Shown(
        test.chart(),
        "Cake resistance against pressure drop: five tests of calcium carbonate (data of Ruth, printed by McCabe, Smith and Harriott).",  # noqa: E501
    )


def crystallization_msmpr() -> Shown:
    """Population density of urea."""
    test = gr.crystallization.MsmprAnalysis.read(
        EXAMPLES / "msmpr-analysis" / "urea_bennett1969.csv", residence_time="3.38 hour", crystal_density=1335
    )
    return Shown(
        test.chart(),
        "Urea crystallizer of Bennett and Van Buren (1969): population density and the straight line of an MSMPR crystallizer.",  # noqa: E501
    )


def drying_curve() -> Shown:
    """Drying test of Geankoplis."""
    test = gr.drying.DryingCurve.read(
        EXAMPLES / "drying-curve" / "foodstuff_geankoplis.csv",
        dry_solid_mass="3.765 kg",
        area="0.186 m2",
        equilibrium_moisture=0.190 / 3.765,
        warm_up_time="0.4 h",
    )
    return Shown(
        test.chart(),
        "Tray of foodstuff (Geankoplis, problem 9.7-2): measured mass and the drying curve in two periods.",
    )


def humid_gas_saturation() -> Shown:
    """Saturated humidity ratio against ASHRAE's table."""
    celsius, printed = (
        np.array(column, dtype=float) for column in _data("saturated_air_ashrae2017.csv").values()
    )
    figure = charts.figure(
        charts.axis_title("temperature", "degC"), charts.axis_title("humidity_ratio", "kg/kg"), y_log=True
    )
    fine = np.linspace(-60, 92, 120)
    charts.add_line(
        figure,
        fine,
        np.asarray(gr.humid_gas.humidity_ratio_saturated(temperature=fine + ZERO)),
        "Granum, ideal gas",
    )
    charts.add_points(figure, celsius, printed, "ASHRAE, table of moist air")
    found = np.asarray(gr.humid_gas.humidity_ratio_saturated(temperature=celsius + ZERO))
    rows = [
        [f"{t:g}", f"{a:.4g}", f"{b:.4g}", f"{100 * (b / a - 1):+.2f}"]
        for t, a, b in zip(celsius, printed, found, strict=True)
    ]
    return Shown(
        figure,
        "Humidity ratio of saturated air at 101 325 Pa: ASHRAE Handbook (real gas) and the ideal-gas formula; the enhancement factor explains the half percent.",  # noqa: E501
        _table(["temperature / °C", "printed", "Granum", "difference / %"], rows),
    )


def materials_solubility() -> Shown:
    """Solubilities against a handbook that was not used for the fit."""
    names, temperatures, found = _data("solubility_perry2008.csv").values()
    tables: dict[str, dict[float, float]] = {}
    for name, celsius, value in zip(names, temperatures, found, strict=True):
        tables.setdefault(name, {})[float(celsius)] = float(value)
    figure = charts.figure(
        charts.axis_title("temperature", "degC"), "solubility / g per 100 g of water", y_log=True
    )
    figure.update_yaxes(dtick=None)
    for (name, table), color in zip(tables.items(), charts.LINES, strict=False):
        celsius = np.array(list(table), dtype=float)
        fine = np.linspace(celsius[0], celsius[-1], 60)
        charts.add_line(
            figure,
            fine,
            100 * np.asarray(gr.materials.solute(name).solubility(fine + ZERO)),
            name,
            color=color,
        )
        charts.add_points(
            figure, celsius, list(table.values()), f"{name}, Perry", color=color, showlegend=False
        )
    return Shown(
        figure,
        "Solubility in water: library (fitted to the CRC Handbook) as lines, Perry's Handbook, table 2-120, as points.",  # noqa: E501
    )


def materials_water() -> Shown:
    """Vapor pressure of water."""
    kelvin, pressure = (
        np.array(column, dtype=float) for column in _data("vapor_pressure_iapws2012.csv").values()
    )
    figure = charts.figure(charts.axis_title("temperature", "degC"), "vapor pressure / bar", y_log=True)
    fine = np.linspace(273.16, 640.0, 150)
    charts.add_line(figure, fine - ZERO, np.asarray(gr.materials.water_vapor_pressure(fine)) / 1e5, "Granum")
    charts.add_points(figure, kelvin - ZERO, pressure * 10, "IAPWS-IF97, table 35")
    return Shown(figure, "Vapor pressure of water with the check values of the IAPWS release.")


def fluidization_curve() -> Shown:
    """Pressure curve of a made test."""
    test = gr.fluidization.PressureCurve.read(
        EXAMPLES / "fluidized-bed" / "pressure_curve_made.csv",
        height="30 cm",
        particle_density=2500.0,
        fluid_density=1.2,
    )
    return Shown(
        test.chart(),
        "A made pressure curve (4.0 cm/s, void fraction 0.43, with random errors) and the minimum fluidization velocity read from it.",  # noqa: E501
    )


FIGURES = {
    f.__name__: f
    for f in (
        particles_sizes,
        porous_bed,
        settling_curve,
        filtration_leaf,
        filtration_pressures,
        crystallization_msmpr,
        drying_curve,
        humid_gas_saturation,
        materials_solubility,
        materials_water,
        fluidization_curve,
    )
}


# ---- printed worked examples -----------------------------------------------------------------------
@cache
def _rows(domain: str) -> list[dict[str, str]]:
    """The worked examples of a domain: those of ``docs/data`` and those that the tests recalculate."""
    found = []
    for path in (DATA / "worked_examples.csv", TESTED):
        with path.open(encoding="utf-8") as file:
            found += [row for row in csv.DictReader(file) if row["card"].startswith(f"{domain}.")]
    return found


def _inputs(row: dict[str, str]) -> dict[str, str]:
    return dict(item.split("=", 1) for item in row["inputs"].split("; "))


@cache
def _fitted(card: str, inputs: tuple[tuple[str, str], ...]) -> Any:
    given = dict(inputs)
    return registry.find(card).read(EXAMPLES / given.pop("file"), **given).fit()


def printed(domain: str) -> list[Printed]:
    """Every printed result of a domain, recalculated."""
    return [_compared(row) for row in _rows(domain)]


def _compared(row: dict[str, str]) -> Printed:
    inputs, card = _inputs(row), registry.find(row["card"]).card
    if "file" in inputs:
        name = row["output"]
        estimate = _fitted(row["card"], tuple(inputs.items()))[name]
        found, figure = estimate.value, figure_named(name, estimate.unit, row["card"])
    else:
        result = registry.find(row["card"]).evaluate(**inputs)
        name = row["output"] or card.outputs[0].name
        found, figure = float(result.outputs[name]), next(p for p in card.outputs if p.name == name)
    if row.get("less"):
        less = next(p for p in card.parameters if p.name == row["less"])
        found = abs(found - read_quantity(inputs[less.name], less.kind))
    if "expected [SI]" in row:
        wanted = float(row["expected [SI]"])
        return Printed(
            f"{card.title} ({row['source']})",
            value_text(wanted, figure),
            value_text(found, figure),
            found / wanted - 1,
        )
    number, _blank, unit = row["printed"].partition(" ")
    wanted = read_quantity(row["printed"], figure.kind)
    shown = float(from_si(found, unit or "dimensionless", figure.kind))
    texts = (f"{format_number(x, 5)} {pretty_unit(unit)}".strip() for x in (float(number), shown))
    what = row["what"] if current_language() == "en" else card.title
    return Printed(f"{what} ({row['source']})", *texts, found / wanted - 1)
