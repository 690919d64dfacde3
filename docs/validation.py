"""Validation shown in the documentation: the package's charts with published data in them, and printed worked examples recalculated.

Every number called ``printed`` comes from the source named beside it; what Granum finds is calculated while the site is built.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

import granum as gr
from granum.core import charts
from granum.core.units import format_number

EXAMPLES = Path(__file__).parent.parent / "examples"
ZERO = 273.15


@dataclass(frozen=True)
class Shown:
    """A figure with its caption and, where the numbers matter, a table."""

    figure: Any
    caption: str
    table: str = ""


@dataclass(frozen=True)
class Printed:
    """One number of a worked example; ``find`` calculates it in the unit of the print."""

    what: str
    printed: float
    unit: str
    find: Callable[[], Any]

    @cached_property
    def found(self) -> float:
        """What Granum calculates."""
        return float(self.find())


def _table(heads: list[str], rows: list[list[str]]) -> str:
    return "\n".join(
        ["| " + " | ".join(heads) + " |", "|---" + "|--:" * (len(heads) - 1) + "|", *("| " + " | ".join(r) + " |" for r in rows)]
    )


# ---- figures ---------------------------------------------------------------------------------------
def particles_drag() -> Shown:
    """Every drag law against measured drag."""
    ranking = gr.particles.drag_ranking()
    rows = [
        [str(name).replace("_", "–").title(), f"{100 * float(rms):.1f}", f"{100 * float(mean):+.1f}", f"{100 * float(largest):.0f}", f"{100 * float(covered):.0f}",
         f"{format_number(float(low), 2)} … {format_number(float(high), 2)}"]
        for name, rms, mean, largest, covered, low, high in zip(
            ranking.drag, ranking.deviation_rms, ranking.deviation_mean, ranking.deviation_largest, ranking.measurements_covered,
            ranking.reynolds_lowest, ranking.reynolds_highest, strict=True)
    ]  # fmt: skip
    caption = (
        "Deviation of every drag law of a sphere from the means of measurements tabulated by Morsi and Alexander (1972), inside the range each law claims. "
        "Table: the same laws against these means and the measurements of Roos and Willmarth (1971) together; laws that cover all measurements first."
    )
    heads = ["law", "rms deviation / %", "mean / %", "largest / %", "measurements covered / %", "range of Re"]
    return Shown(gr.particles.drag_deviation_chart(deviation_largest=0.25), caption, _table(heads, rows))


def particles_sizes() -> Shown:
    """A sieve analysis with its Rosin–Rammler fit."""
    test = gr.particles.SieveAnalysis.read(
        EXAMPLES / "size-analysis" / "crushed_quartz_mccabe2005.csv", pan_mass="0.75 g", sample_mass="100 g"
    )
    return Shown(
        test.chart(), "Crushed quartz on Tyler sieves (McCabe, Smith and Harriott) and the Rosin–Rammler distribution fitted to it."
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
        "A made water test (Ergun's equation for 0.50 mm grains, rounded to two digits) and the fit that must find the grain size again.",
    )


def settling_curve() -> Shown:
    """Settling curve of limestone."""
    test = gr.settling.BatchTest.read(
        EXAMPLES / "batch-settling" / "limestone.csv", initial_concentration="236 g/L", underflow_concentration="550 g/L"
    )
    figure = gr.settling.settling_curve_chart(test.time, test.interface_height, test.initial_concentration)
    return Shown(figure, "Limestone slurry of 236 g/L (Foust et al.): measured interface, tangents found by the program, zones.")


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
        test.chart(), "Calcium carbonate at 338 kPa: data of Ruth and Kempe (1937) as printed by Geankoplis, with the fitted line."
    )


def filtration_pressures() -> Shown:
    """Compressibility from five pressures."""
    test = gr.filtration.Compressibility.read(
        EXAMPLES / "leaf-filter" / "pressures_mccabe.csv", area="440 cm2", dynamic_viscosity="0.8937 cP", dry_cake_per_filtrate="23.5 g/L"
    )
    return Shown(
        test.chart(),
        "Cake resistance against pressure drop: five tests of calcium carbonate (data of Ruth, printed by McCabe, Smith and Harriott).",
    )


def crystallization_msmpr() -> Shown:
    """Population density of urea."""
    test = gr.crystallization.MsmprAnalysis.read(
        EXAMPLES / "msmpr-analysis" / "urea_bennett1969.csv", residence_time="3.38 hour", crystal_density=1335
    )
    return Shown(
        test.chart(),
        "Urea crystallizer of Bennett and Van Buren (1969): population density and the straight line of an MSMPR crystallizer.",
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
    return Shown(test.chart(), "Tray of foodstuff (Geankoplis, problem 9.7-2): measured mass and the drying curve in two periods.")


def humid_gas_saturation() -> Shown:
    """Saturated humidity ratio against ASHRAE's table."""
    celsius = np.array([-60.0, -40.0, -20.0, 0.0, 10.0, 20.0, 30.0, 50.0, 80.0, 90.0])
    printed = np.array([0.0000067, 0.0000793, 0.0006373, 0.0037895, 0.0076606, 0.014758, 0.027329, 0.086858, 0.55295, 1.42031])
    figure = charts.figure(charts.axis_title("temperature", "degC"), charts.axis_title("humidity_ratio", "kg/kg"), y_log=True)
    fine = np.linspace(-60, 92, 120)
    charts.add_line(figure, fine, np.asarray(gr.humid_gas.humidity_ratio_saturated(temperature=fine + ZERO)), "Granum, ideal gas")
    charts.add_points(figure, celsius, printed, "ASHRAE, table of moist air")
    found = np.asarray(gr.humid_gas.humidity_ratio_saturated(temperature=celsius + ZERO))
    rows = [[f"{t:g}", f"{a:.4g}", f"{b:.4g}", f"{100 * (b / a - 1):+.2f}"] for t, a, b in zip(celsius, printed, found, strict=True)]
    return Shown(
        figure,
        "Humidity ratio of saturated air at 101 325 Pa: ASHRAE Handbook (real gas) and the ideal-gas formula; the enhancement factor explains the half percent.",
        _table(["temperature / °C", "printed", "Granum", "difference / %"], rows),
    )


def materials_solubility() -> Shown:
    """Solubilities against a handbook that was not used for the fit."""
    perry = {
        "potassium nitrate": {0: 13.3, 10: 20.9, 20: 31.6, 30: 45.8, 40: 63.9, 50: 85.5, 60: 110, 70: 138, 80: 169, 90: 202, 100: 246},
        "sodium sulfate": {20: 19.4, 30: 40.8, 40: 48.8, 60: 45.3, 80: 43.7, 100: 42.5},
        "copper sulfate": {0: 14.3, 10: 17.4, 20: 20.7, 30: 25.0, 40: 28.5, 60: 40.0, 80: 55.0},
        "sodium chloride": {0: 35.7, 20: 36.0, 40: 36.6, 60: 37.3, 80: 38.4, 100: 39.8},
    }
    figure = charts.figure(charts.axis_title("temperature", "degC"), "solubility / g per 100 g of water", y_log=True)
    figure.update_yaxes(dtick=None)
    for (name, table), color in zip(perry.items(), charts.LINES, strict=False):
        celsius = np.array(list(table), dtype=float)
        fine = np.linspace(celsius[0], celsius[-1], 60)
        charts.add_line(figure, fine, 100 * np.asarray(gr.materials.solute(name).solubility(fine + ZERO)), name, color=color)
        charts.add_points(figure, celsius, list(table.values()), f"{name}, Perry", color=color, showlegend=False)
    return Shown(figure, "Solubility in water: library (fitted to the CRC Handbook) as lines, Perry's Handbook, table 2-120, as points.")


def materials_water() -> Shown:
    """Vapor pressure of water."""
    points = np.array([[300, 0.353658941e-2], [500, 0.263889776e1], [600, 0.123443146e2]])
    figure = charts.figure(charts.axis_title("temperature", "degC"), "vapor pressure / bar", y_log=True)
    fine = np.linspace(273.16, 640.0, 150)
    charts.add_line(figure, fine - ZERO, np.asarray(gr.materials.water_vapor_pressure(fine)) / 1e5, "Granum")
    charts.add_points(figure, points[:, 0] - ZERO, points[:, 1] * 10, "IAPWS-IF97, table 35")
    return Shown(figure, "Vapor pressure of water with the check values of the IAPWS release.")


def fluidization_curve() -> Shown:
    """Pressure curve of a made test."""
    test = gr.fluidization.PressureCurve.read(
        EXAMPLES / "fluidized-bed" / "pressure_curve_made.csv", height="30 cm", particle_density=2500.0, fluid_density=1.2
    )
    return Shown(
        test.chart(),
        "A made pressure curve (4.0 cm/s, void fraction 0.43, with random errors) and the minimum fluidization velocity read from it.",
    )


def cyclones_grade() -> Shown:
    """Grade efficiency of Stairmand's cyclone."""
    figure = gr.cyclones.gas_cyclone_chart(
        volume_flow=223 / 3600, particle_density=2000.0, fluid_density=1.2, dynamic_viscosity=1.8e-5, diameter=0.203
    )
    charts.add_points(figure, [1.4], [50.0], "Stairmand: 50 % at 1.4 µm", color=charts.OUT)
    return Shown(
        figure, "High-efficiency cyclone of 203 mm at 223 m³/h with dust of 2000 kg/m³; the point is the cut that Stairmand measured."
    )


def comminution_energy() -> Shown:
    """Bond's law with two printed mills on it."""
    figure = charts.figure(charts.axis_title("product_size", "um"), "specific energy / kWh/t", x_log=True, y_log=True)
    for (feed, product, index, printed), color in zip(
        ((18e-3, 1.2e-3, 13.2, 2.83), (1.2e-3, 175e-6, 11.7, 5.46)), charts.LINES, strict=False
    ):
        sizes = np.geomspace(product / 3, feed / 1.5, 50)
        energy = np.asarray(gr.comminution.specific_energy_bond(feed_size=feed, product_size=sizes, work_index=index * 3600)) / 3600
        charts.add_line(figure, sizes * 1e6, energy, f"feed {format_number(feed * 1e3)} mm, {index:g} kWh/t", color=color)
        charts.add_points(figure, [product * 1e6], [printed], "printed", color=color, showlegend=False)
    return Shown(figure, "Bond's law for the rod mill and the ball mill of Rowland and Kjos; points are the printed energies.")


FIGURES = {
    f.__name__: f
    for f in (particles_drag, particles_sizes, porous_bed, settling_curve, filtration_leaf, filtration_pressures, crystallization_msmpr, drying_curve,
              humid_gas_saturation, materials_solubility, materials_water, fluidization_curve, cyclones_grade, comminution_energy)
}  # fmt: skip


# ---- printed worked examples -----------------------------------------------------------------------
@cache
def _leaf() -> Any:
    return gr.filtration.LeafTest.read(
        EXAMPLES / "leaf-filter" / "leaf_geankoplis.csv",
        area="0.0439 m2",
        pressure_drop="338 kPa",
        dynamic_viscosity="0.8937 cP",
        dry_cake_per_filtrate=23.47,
    ).fit()


@cache
def _urea() -> Any:
    return gr.crystallization.MsmprAnalysis.read(
        EXAMPLES / "msmpr-analysis" / "urea_bennett1969.csv", residence_time="3.38 hour", crystal_density=1335
    ).fit()


@cache
def _tray() -> Any:
    return gr.drying.DryingCurve.read(
        EXAMPLES / "drying-curve" / "foodstuff_geankoplis.csv",
        dry_solid_mass="3.765 kg",
        area="0.186 m2",
        equilibrium_moisture=0.190 / 3.765,
        warm_up_time="0.4 h",
    ).fit()


def _bed_drop() -> float:
    inlet, flux = 1.10 * 101325.0, 0.358 / (np.pi / 4 * 0.61**2)
    return inlet - gr.porous.pressure_outlet_gas_bed(
        mass_flux=flux, pressure_inlet=inlet, length=2.44, temperature=311.0, molar_mass="28.97 g/mol", dynamic_viscosity=1.90e-5,
        particle_diameter="12.7 mm", void_fraction=0.38)  # fmt: skip


@cache
def _quartz() -> Any:
    return gr.particles.SieveAnalysis.read(
        EXAMPLES / "size-analysis" / "crushed_quartz_mccabe2005.csv", in_class=gr.particles.ArithmeticMidpoint()
    ).distribution()


@cache
def _sigma() -> Any:
    return gr.centrifuges.sigma_factor_tubular_half_thickness(
        bowl_length="0.1970 m", radius_inner="7.16 mm", radius_outer="22.25 mm", rotation_speed="23000 rpm"
    )


@cache
def _stairmand() -> tuple[float, ...]:
    from granum.cyclones.geometry import StandardCyclone

    return StandardCyclone()(1.0)


@cache
def _limestone() -> Any:
    return gr.settling.BatchTest.read(
        EXAMPLES / "batch-settling" / "limestone.csv", initial_concentration="236 g/L", underflow_concentration="550 g/L"
    ).fit()


SHARP = {"particle_diameter": 1.6e-4, "particle_density": 2600.0, "fluid_density": 1.2, "dynamic_viscosity": 1.8e-5}

PRINTED: dict[str, list[Printed]] = {
    "materials": [
        Printed("Vapor pressure of water at 500 K (IAPWS-IF97, table 35)", 2.63889776, "MPa", lambda: gr.materials.water_vapor_pressure(500.0) / 1e6),
        Printed("Viscosity of water, 298.15 K and 998 kg/m³ (IAPWS 2008, table 4)", 889.7351, "µPa·s", lambda: gr.materials.dynamic_viscosity_iapws(298.15, 998.0) * 1e6),
        Printed("Enthalpy of liquid water at 300 K and 3 MPa (IAPWS-IF97, table 5)", 115.331273, "kJ/kg", lambda: gr.materials.water_enthalpy(300.0, 3e6) / 1e3),
    ],
    "particles": [
        Printed("Sauter mean of crushed quartz (McCabe, Smith and Harriott)", 1.207, "mm", lambda: _quartz().mean(3, 2) * 1e3 / 0.9925),
        Printed("Mass mean of the same quartz", 1.677, "mm", lambda: _quartz().mean(4, 3) * 1e3 * 0.9925),
    ],
    "porous": [Printed("Air through 2.44 m of 12.7 mm spheres (Geankoplis, example 3.1-4)", 4970, "Pa", _bed_drop)],
    "humid_gas": [
        Printed("Humidity ratio of saturated air at 20 °C (ASHRAE)", 0.014758, "kg/kg", lambda: gr.humid_gas.humidity_ratio_saturated(temperature=293.15)),
        Printed("Enthalpy of the room air of the course notes (U V.7)", 47.8, "kJ/kg",
                lambda: gr.humid_gas.state(temperature="22.2 degC", wet_bulb_temperature="17 degC").enthalpy / 1e3),
    ],
    "comminution": [
        Printed("Rod mill, 18 to 1.2 mm at 13.2 kWh/t (Rowland and Kjos)", 2.83, "kWh/t", lambda: gr.comminution.specific_energy_bond(18e-3, 1.2e-3, 13.2 * 3600) / 3600),
        Printed("Ball mill, 1.2 mm to 175 µm at 11.7 kWh/t (same)", 5.46, "kWh/t", lambda: gr.comminution.specific_energy_bond(1.2e-3, 175e-6, 11.7 * 3600) / 3600),
        Printed("Mib 18.8, 750 to 106 µm (Morrell 2009)", 8.4, "kWh/t", lambda: gr.comminution.specific_energy_morrell(750e-6, 106e-6, 18.8 * 3600) / 3600),
        Printed("Critical speed of a 1.2 m mill (Coulson and Richardson, example 2.3)", 4.04, "rad/s", lambda: gr.comminution.rotation_speed_critical(1.2, gravity=9.81)),
        Printed("Effectiveness of a screen (McCabe, Smith and Harriott)", 0.669, "", lambda: gr.comminution.screening_effectiveness(0.47, 0.85, 0.195)),
    ],
    "settling": [Printed("Constant rate of a limestone slurry (Foust et al.; a tangent by hand)", 15.65, "cm/h", lambda: _limestone()["settling_velocity"].value * 3.6e5)],
    "cyclones": [
        Printed("Cut size of the exercise of the course notes (P V-1-6)", 28.6, "µm",
                lambda: gr.cyclones.cut_size_turns(velocity="14.5 cm/s", diameter="0.7 m", particle_density="19 g/cm^3", fluid_density=1.2, dynamic_viscosity="0.018 mPa*s") * 1e6),
        Printed("Inlet heads of Stairmand's design (Shepherd and Lapple)", 6.4, "", lambda: gr.cyclones.inlet_heads_shepherd_lapple(*_stairmand())),
        Printed("Configuration number of Stairmand's design (Leith and Licht)", 551.3, "", lambda: gr.cyclones.configuration_number_leith_licht(*_stairmand())),
    ],
    "fluidization": [
        Printed("Sharp sand of 160 µm, measured (Kunii and Levenspiel, chapter 3)", 4.0, "cm/s",
                lambda: 100 * gr.fluidization.minimum_fluidization_velocity_ergun(**SHARP, void_fraction=0.55, sphericity=0.67)),
        Printed("Spheres of 3 mm in a liquid (Coulson and Richardson, volume 2, example 6.1)", 0.0364, "m/s",
                lambda: gr.fluidization.minimum_fluidization_velocity_ergun(particle_diameter=3e-3, particle_density=4200.0, fluid_density=1100.0, dynamic_viscosity=3e-3, void_fraction=0.4)),
    ],
    "filtration": [
        Printed("Cake resistance (Geankoplis, example 14.2-1)", 1.863e11, "m/kg", lambda: _leaf()["cake_resistance"].value),
        Printed("Medium resistance (same example)", 10.63e10, "1/m", lambda: _leaf()["medium_resistance"].value),
    ],
    "centrifuges": [
        Printed("Sigma of a tubular bowl (Geankoplis, example 14.4-1)", 196.3, "m²", _sigma),
        Printed("Critical diameter in that bowl", 0.746, "µm",
                lambda: 1e6 * gr.centrifuges.cut_size_centrifuge(volume_flow="0.002832 m3/hour", sigma_factor=_sigma(), particle_density=1461, fluid_density=801,
                                                                dynamic_viscosity="100 cP", flow_multiple=2.0)),
        Printed("Interface of two liquids (Geankoplis, example 14.4-2; its data give 13.69)", 13.75, "mm",
                lambda: 1e3 * gr.centrifuges.radius_interface(radius_heavy="10.414 mm", radius_light="10.160 mm", density_heavy=980.3, density_light=919.5)),
    ],
    "crystallization": [
        Printed("Growth rate of urea (Bennett and Van Buren 1969, in Perry)", 0.0324, "mm/h", lambda: _urea()["growth_rate"].value * 3.6e6),
        Printed("Decahydrate from 10 t of soda solution (Geankoplis, example 12.11-1)", 6630, "kg",
                lambda: gr.crystallization.crystallizer_balance(mass_flow=10000.0, solute_mass_fraction=0.30, solubility_per_solvent=0.215,
                                                               solute_fraction_of_crystal=106.0 / 286.2, evaporation=300.0).crystal_flow),
    ],
    "drying": [
        Printed("Constant drying rate (Geankoplis, problem 9.7-2)", 0.996, "kg/(m² h)", lambda: 3600 * _tray()["drying_rate_constant"].value),
        Printed("Critical free moisture (same problem, read by eye)", 0.12, "kg/kg", lambda: _tray()["critical_moisture"].value - 0.190 / 3.765),
    ],
}  # fmt: skip
