"""Coagulant dose: what share of collisions lasts, and what turbidity a jar keeps."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.flags import impossible
from granum.core.kinds import Concentration, Fraction, PositiveNumber, Within

Dose = Annotated[Concentration, Within(1e-9)]
Turbidity = Annotated[PositiveNumber, Within(1e-9)]
CLEARER = "The least residual turbidity lies below that of the raw water."
_DOSES = {"coagulant_dose": (1e-3, 0.1), "dose_optimum": (5e-3, 0.06)}
_JARS = _DOSES | {
    "raw_turbidity": (20.0, 500.0),
    "residual_turbidity_least": (0.5, 10.0),
    "dose_half_width": (2e-3, 0.05),
}


@formula(
    source="reerink1954; fuchs1934; stumm1968",
    equation=r"\psi = \exp\left(-b\left(1 - \frac{D}{D^*}\right)^2\right)",
    output="capture_efficiency",
    title="Share of collisions that last, by the dose",
    typical=_DOSES | {"charge_sharpness": (0.5, 30.0)},
)
def capture_efficiency_dose(
    coagulant_dose: Concentration, dose_optimum: Dose, charge_sharpness: PositiveNumber
) -> Fraction:
    """Share of collisions that last when a coagulant neutralizes the charge of the grains, relative to that
    at the best dose.

    The charge is taken to fall in proportion to the dose (Stumm and O'Melia) and the barrier that slows
    collisions (Fuchs) to grow as the square of what is left of it (Reerink and Overbeek, low potentials), so
    that twice the best dose is as bad as none. By hand, at half the best dose with b = 4: exp(−1).

    >>> round(capture_efficiency_dose("5 mg/L", "10 mg/L", 4.0), 4)
    0.3679
    """
    return jnp.exp(-charge_sharpness * (1.0 - coagulant_dose / dose_optimum) ** 2)


@formula(
    source="reerink1954; fuchs1934; stumm1968",
    equation=(r"b = \left(\frac{D^*}{w}\right)^2 \ln\frac{\ln(T_0/T_m)}{\ln\frac{2 T_0}{T_0 + T_m}}"),
    output="charge_sharpness",
    title="Sharpness of the charge from a jar test",
    typical=_JARS,
)
def charge_sharpness_jar(
    raw_turbidity: Turbidity, residual_turbidity_least: Turbidity, dose_optimum: Dose, dose_half_width: Dose
) -> PositiveNumber:
    """How sharply collisions cease to last away from the best dose, from the dose at which half of the
    turbidity that the best dose takes out stays in.

    By hand, a quarter left and a half width as large as the dose: ln(ln 4/ln 1.6) = 1.0816.

    >>> round(charge_sharpness_jar(100.0, 25.0, "10 mg/L", "10 mg/L"), 4)
    1.0816
    """
    T0, Tm = raw_turbidity, residual_turbidity_least
    clears = Tm < T0
    impossible(~clears, Tm, "residual_turbidity_least", 0.0, T0, CLEARER)
    ratio = jnp.where(clears, T0 / Tm, 2.0)
    wanted = jnp.log(ratio) / jnp.log(2.0 * ratio / (1.0 + ratio))
    return (dose_optimum / dose_half_width) ** 2 * jnp.log(wanted)


@formula(
    source="smoluchowski1917; reerink1954; stumm1968",
    equation=(
        r"T = T_0\left(\frac{T_m}{T_0}\right)^{\psi}, \quad "
        r"\psi = \exp\left(-\left(\frac{D - D^*}{w}\right)^2 "
        r"\ln\frac{\ln(T_0/T_m)}{\ln\frac{2 T_0}{T_0 + T_m}}\right)"
    ),
    output="residual_turbidity",
    title="Residual turbidity by charge neutralization",
    typical=_JARS,
)
def residual_turbidity_neutralization(
    coagulant_dose: Concentration,
    raw_turbidity: Turbidity,
    residual_turbidity_least: Turbidity,
    dose_optimum: Dose,
    dose_half_width: Dose,
) -> PositiveNumber:
    """Turbidity that a jar keeps after stirring and settling, when what is left falls exponentially with the
    share of collisions that last.

    Too little coagulant leaves the charge, too much turns it around: both ends approach the raw water. At the
    half width from the best dose it lies midway between the least and that of the raw water.

    >>> round(residual_turbidity_neutralization("15 mg/L", 100.0, 4.0, "10 mg/L", "5 mg/L"), 6)
    52.0
    """
    sharpness = charge_sharpness_jar(raw_turbidity, residual_turbidity_least, dose_optimum, dose_half_width)
    share = capture_efficiency_dose(coagulant_dose, dose_optimum, sharpness)
    return raw_turbidity * jnp.exp(-share * jnp.log(raw_turbidity / residual_turbidity_least))


@formula(
    source="box1951; trinh2011",
    equation=r"T = T_m + \frac{T_0 - T_m}{2}\left(\frac{D - D^*}{w}\right)^2",
    output="residual_turbidity",
    title="Residual turbidity by a parabola",
    typical=_JARS,
)
def residual_turbidity_parabola(
    coagulant_dose: Concentration,
    raw_turbidity: Turbidity,
    residual_turbidity_least: Turbidity,
    dose_optimum: Dose,
    dose_half_width: Dose,
) -> PositiveNumber:
    """Turbidity that a jar keeps near the best dose: the response surface of second order in one factor.

    It holds near its least value and rises without limit; with jars of little or no coagulant take the law of
    charge neutralization.

    >>> residual_turbidity_parabola("15 mg/L", 100.0, 4.0, "10 mg/L", "5 mg/L")
    52.0
    """
    apart = (coagulant_dose - dose_optimum) / dose_half_width
    return residual_turbidity_least + 0.5 * (raw_turbidity - residual_turbidity_least) * apart**2
