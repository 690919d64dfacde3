"""Tests on a finished cake: compression–permeability cell, washing curve, deliquoring curve."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.kinds import (
    CakeResistance,
    DynamicViscosity,
    Fraction,
    Length,
    Number,
    Permeability,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Series,
    Time,
    VoidFraction,
)
from granum.estimation import Fit, LabTest
from granum.estimation.lines import straight_line
from granum.filtration.formulas.deliquoring import saturation_after_deliquoring
from granum.filtration.formulas.washing import wash_effluent_concentration


@lab_test(
    "compression_cell",
    source="tiller1953; tiller1987",
    title="Compression–permeability cell",
    equation=(
        r"\alpha_z = \alpha_0\left(1 + \frac{p_g}{p_a}\right)^n,\qquad 1-\varepsilon_z = "
        r"(1-\varepsilon_0)\left(1 + \frac{p_g}{p_a}\right)^\beta"
    ),
)
class CompressionCell(LabTest):
    """Local resistance and void fraction of a cake against the pressure on its solid, fitted together with
    one characteristic pressure.

    The scatter of either column is taken proportional to its value, and how large it is found with the fit:
    resistances scatter more than void fractions. The result feeds ``cake_profile``.
    """

    solids_pressure: Annotated[PressureDrop, Series("points")]
    cake_resistance: Annotated[CakeResistance, Series("points")]
    void_fraction: Annotated[VoidFraction, Series("points")]

    least_points: ClassVar[int] = 4
    estimates: ClassVar = {
        "cake_resistance_unloaded": CakeResistance,
        "compressibility": Number,
        "void_fraction_unloaded": VoidFraction,
        "compaction_exponent": Number,
        "characteristic_pressure": PressureDrop,
    }
    holds_for: ClassVar = ("solids_pressure",)
    axes: ClassVar = {"solids_pressure": PressureDrop, "cake_resistance": CakeResistance}

    def fit(self) -> Fit:
        """Tiller and Leu's constants with 95 % intervals."""
        self.above_zero("solids_pressure", "cake_resistance")
        p, alpha, solid = (
            np.asarray(self.solids_pressure),
            np.asarray(self.cake_resistance),
            1.0 - np.asarray(self.void_fraction),
        )
        n, _level = straight_line(np.log(p), np.log(alpha))
        b, _level = straight_line(np.log(p), np.log(solid))
        low = float(np.median(p))
        start = {
            "cake_resistance_unloaded": float(alpha[np.argmin(p)]),
            "compressibility": float(n) or 0.1,
            "void_fraction_unloaded": float(1.0 - solid.min()),
            "compaction_exponent": float(b) or 0.01,
            "characteristic_pressure": low,
        }

        def model(c: dict[str, Any], p: Any) -> Any:
            load = jnp.log1p(p / c["characteristic_pressure"])
            return (
                jnp.log(c["cake_resistance_unloaded"]) + c["compressibility"] * load,
                jnp.log1p(-c["void_fraction_unloaded"]) + c["compaction_exponent"] * load,
            )

        measured = np.log(alpha), np.log(solid)
        bounds = {
            "cake_resistance_unloaded": (0.0, np.inf),
            "void_fraction_unloaded": (0.0, 0.999),
            "characteristic_pressure": (1e-3 * float(p.min()), 1e2 * float(p.max())),
        }
        bent = tuple(n for n in start if n != "void_fraction_unloaded")
        return self.fitted(model, start, p, measured, bounds=bounds, apart=True, logarithmic=bent)

    def chart(self) -> Any:
        """Resistance against solids pressure on logarithmic axes, with the law."""
        from granum.core.charts import add_line, add_points, axis_title, figure
        from granum.core.i18n import _

        found, p = self.fit(), np.asarray(self.solids_pressure)
        grid = np.geomspace(0.5 * p.min(), 2.0 * p.max(), 80)
        line = (
            found["cake_resistance_unloaded"].value
            * (1.0 + grid / found["characteristic_pressure"].value) ** found["compressibility"].value
        )
        drawing = figure(
            axis_title("solids_pressure", "bar"),
            axis_title("cake_resistance", "m/kg"),
            title=type(self).card.title,
            x_log=True,
            y_log=True,
        )
        add_line(drawing, grid / 1e5, line, _("model"))
        add_points(drawing, p / 1e5, np.asarray(self.cake_resistance), _("data"))
        return drawing


@lab_test(
    "washing_curve",
    source="sherman1964",
    title="Washing curve of a cake",
    equation=r"\varphi = 1 - \tfrac12\left[\operatorname{erfc}\left(\tfrac{1-w}{2\sqrt w}\sqrt{D_n}\right)"
    r" + e^{D_n}\operatorname{erfc}\left(\tfrac{1+w}{2\sqrt w}\sqrt{D_n}\right)\right]",
)
class WashingCurve(LabTest):
    """Dispersion number of a cake from the concentration of its wash effluent against wash volume per void
    volume.
    """

    wash_ratio: Annotated[Ratio, Series("points")]
    wash_effluent_concentration: Annotated[Fraction, Series("points")]

    estimates: ClassVar = {"dispersion_number": PositiveNumber}
    axes: ClassVar = {"wash_ratio": Ratio, "wash_effluent_concentration": Fraction}

    def fit(self) -> Fit:
        """Dispersion number with its 95 % interval."""
        return self.fitted(
            lambda p, w: wash_effluent_concentration(w, p["dispersion_number"]),
            {"dispersion_number": 5.0},
            jnp.asarray(self.wash_ratio),
            np.asarray(self.wash_effluent_concentration),
            bounds={"dispersion_number": (1e-3, 1e4)},
        )


@lab_test("deliquoring_curve", source="wakeman2005", title="Deliquoring curve of a cake")
class DeliquoringCurve(LabTest):
    """Permeability and irreducible saturation of a cake from its saturation against time of blowing, by
    Wakeman's correlation.
    """

    time: Annotated[Time, Series("points")]
    cake_saturation: Annotated[Fraction, Series("points")]
    pressure_drop: PressureDrop
    dynamic_viscosity: DynamicViscosity
    void_fraction: VoidFraction
    cake_thickness: Length

    estimates: ClassVar = {"cake_permeability": Permeability, "irreducible_saturation": Fraction}
    holds_for: ClassVar = ("pressure_drop",)
    axes: ClassVar = {"time": Time, "cake_saturation": Fraction}

    def fit(self) -> Fit:
        """Permeability and irreducible saturation with 95 % intervals."""
        self.increasing("time")
        t, S = np.asarray(self.time), np.asarray(self.cake_saturation)

        def model(p: dict[str, Any], t: Any) -> Any:
            return saturation_after_deliquoring(
                t,
                self.pressure_drop,
                p["cake_permeability"],
                self.dynamic_viscosity,
                self.void_fraction,
                self.cake_thickness,
                p["irreducible_saturation"],
            )

        middle = float(np.median(t[t > 0])) if np.any(t > 0) else 1.0
        guess = (
            2.0
            * self.dynamic_viscosity
            * self.void_fraction
            * self.cake_thickness**2
            / (self.pressure_drop * middle)
        )
        return self.fitted(
            model,
            {"cake_permeability": guess, "irreducible_saturation": 0.8 * float(S.min())},
            jnp.asarray(t),
            S,
            bounds={"cake_permeability": (0.0, np.inf), "irreducible_saturation": (0.0, float(S.min()))},
        ).by_profile("irreducible_saturation")
