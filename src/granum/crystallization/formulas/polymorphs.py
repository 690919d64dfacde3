"""Two crystal forms of one substance: how their solubilities compare, and where they change places."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import PositiveNumber, Temperature
from granum.crystallization.kinds import PositiveMolarEnergy

_TYPICAL = {
    "enthalpy_of_fusion": (2.5e4, 2.7e4),
    "enthalpy_of_fusion_other": (2.9e4, 3.2e4),
    "melting_temperature": (455.0, 465.0),
    "melting_temperature_other": (440.0, 450.0),
    "temperature": (280.0, 320.0),
}

NO_TRANSITION = (
    "With these heats of fusion and melting points one form is more soluble at every temperature: there is "
    "no transition."
)


@formula(
    source="behme1991; mullin2001, ch. 7",
    title="Solubility ratio of two polymorphs",
    equation=(
        r"\ln\beta = \ln\frac{x}{x'} = \frac{\Delta H_f}{R}\left(\frac{1}{T_m} - \frac1T\right) - "
        r"\frac{\Delta H_f'}{R}\left(\frac{1}{T_m'} - \frac1T\right)"
    ),
    output="supersaturation_ratio",
    typical=_TYPICAL,
)
def supersaturation_ratio_polymorphs(
    enthalpy_of_fusion: PositiveMolarEnergy,
    melting_temperature: Temperature,
    enthalpy_of_fusion_other: PositiveMolarEnergy,
    melting_temperature_other: Temperature,
    temperature: Temperature = 298.15,
) -> PositiveNumber:
    """Solubility of one polymorph over that of another from their melting points and heats of fusion, in any
    solvent.

    It is the supersaturation against the other form of a solution saturated with this one. The heats of
    fusion are taken as constant, so that the ratio is the less certain the farther the temperature is from
    the melting points.

    >>> round(supersaturation_ratio_polymorphs(26400, 462.15, 29300, 447.15, temperature=299.15), 2)
    1.17
    """
    H, Hother, T = enthalpy_of_fusion, enthalpy_of_fusion_other, temperature
    ideal = H * (1.0 / melting_temperature - 1.0 / T) - Hother * (1.0 / melting_temperature_other - 1.0 / T)
    return jnp.exp(ideal / GAS_CONSTANT)


@formula(
    source="behme1991",
    title="Transition temperature of two polymorphs",
    equation=r"T_t = \frac{\Delta H_f' - \Delta H_f}{\Delta H_f'/T_m' - \Delta H_f/T_m}",
    output="temperature",
    typical=_TYPICAL,
    symbols={"temperature": "T_t"},
)
def temperature_transition_polymorphs(
    enthalpy_of_fusion: PositiveMolarEnergy,
    melting_temperature: Temperature,
    enthalpy_of_fusion_other: PositiveMolarEnergy,
    melting_temperature_other: Temperature,
) -> Temperature:
    """Temperature at which two polymorphs are equally soluble, from their melting points and heats of
    fusion.

    Below both melting points the forms are enantiotropic and change places there; otherwise one is the stable
    one throughout. Carbamazepine: form I melts at 189 °C with 26.4 kJ/mol, form III at 174 °C with
    29.3 kJ/mol; measured solubilities put the transition at 73 °C.

    >>> round(temperature_transition_polymorphs(26400, 462.15, 29300, 447.15) - 273.15)
    72
    """
    H, Hother = enthalpy_of_fusion, enthalpy_of_fusion_other
    entropy = Hother / melting_temperature_other - H / melting_temperature
    crossing = (Hother - H) / jnp.where(entropy == 0, jnp.nan, entropy)
    impossible(~(crossing > 0), crossing, "temperature", reason=NO_TRANSITION)
    return jnp.where(crossing > 0, crossing, jnp.nan)
