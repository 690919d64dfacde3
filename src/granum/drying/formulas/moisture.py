"""Moisture of a solid: bases, ratios, kinds of water, equilibrium with humid gas, heat of sorption."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Fraction,
    Law,
    Mass,
    MassFlow,
    MoistureDryBasis,
    MoistureWetBasis,
    Number,
    SignedMassFlow,
    SpecificEnergy,
    Temperature,
    TemperatureDifference,
    WaterActivity,
)
from granum.drying.isotherms.adsorption import Gab
from granum.drying.kinds import PerTemperature
from granum.materials.formulas.steam import water_heat_of_vaporization

IsothermLaw = Annotated[Any, Law("isotherm")]
POTATO = Gab(monolayer_moisture=0.209, monolayer_constant=4.416, multilayer_constant=0.976)


@formula(
    source="keey1978",
    equation=r"X = \frac{x}{1-x}",
    typical={"moisture_wet_basis": (0.05, 0.8)},
    title="Moisture, wet to dry basis",
)
def moisture_dry_basis(moisture_wet_basis: MoistureWetBasis) -> MoistureDryBasis:
    """Kilograms of water per kilogram of dry solid, from the fraction of the whole that is water.

    >>> round(moisture_dry_basis(moisture_wet_basis="80 %"), 9)
    4.0
    """
    return moisture_wet_basis / (1.0 - moisture_wet_basis)


@formula(
    source="keey1978",
    equation=r"x = \frac{X}{1+X}",
    typical={"moisture_dry_basis": (0.05, 4.0)},
    title="Moisture, dry to wet basis",
)
def moisture_wet_basis(moisture_dry_basis: MoistureDryBasis) -> MoistureWetBasis:
    """Fraction of the whole that is water, from kilograms of water per kilogram of dry solid.

    >>> moisture_wet_basis(moisture_dry_basis=4.0)
    0.8
    """
    return moisture_dry_basis / (1.0 + moisture_dry_basis)


@formula(
    source="keey1978",
    equation=r"X = \frac{m - m_s}{m_s}",
    typical={"mass": (1.2, 5.0), "dry_solid_mass": (0.5, 1.0)},
    title="Moisture from masses",
    output="moisture_dry_basis",
)
def moisture_dry_basis_from_mass(mass: Mass, dry_solid_mass: Mass) -> MoistureDryBasis:
    """Moisture of a sample from its mass and the mass left when it is bone dry.

    >>> moisture_dry_basis_from_mass(mass="500 g", dry_solid_mass="100 g")
    4.0
    """
    impossible(mass < dry_solid_mass, mass, "mass", dry_solid_mass, jnp.inf)
    return (mass - dry_solid_mass) / dry_solid_mass


@formula(
    source="keey1978",
    equation=r"\dot m_e = \dot m_s\,(X_1 - X_2)",
    typical={
        "moisture_dry_basis_inlet": (0.5, 1.0),
        "moisture_dry_basis_outlet": (0.05, 0.2),
        "dry_solid_flow": (0.1, 1.0),
    },
    title="Water evaporated from a solid",
    symbols={"moisture_dry_basis_inlet": "X_1", "moisture_dry_basis_outlet": "X_2"},
)
def evaporation_rate(
    dry_solid_flow: MassFlow,
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_dry_basis_outlet: MoistureDryBasis,
) -> SignedMassFlow:
    """Water that a dryer takes from a flow of dry solid; negative where the solid leaves wetter.

    >>> evaporation_rate(dry_solid_flow=0.5, moisture_dry_basis_inlet=0.5, moisture_dry_basis_outlet=0.1)
    0.2
    """
    return dry_solid_flow * (moisture_dry_basis_inlet - moisture_dry_basis_outlet)


class WaterKinds(NamedTuple):
    """The water of a solid by how it is held and by what can be removed."""

    moisture_dry_basis_unbound: MoistureDryBasis
    moisture_dry_basis_bound: MoistureDryBasis
    moisture_dry_basis_free: MoistureDryBasis
    moisture_dry_basis_equilibrium: MoistureDryBasis


@formula(
    source="treybal1980, ch. 12; keey1978",
    equation=(
        r"X_{unbound} = X - X_{bound},\quad X_{bound} = \min(X, X_h),\quad X_{free} = \max(X - X_e, "
        r"0),\quad X_e = X_e(a_w)"
    ),
    typical={"moisture_dry_basis": (0.3, 1.0), "water_activity": (0.2, 0.6)},
    title="Free, bound and unbound water",
    output="moisture_dry_basis",
    symbols={
        "moisture_dry_basis_unbound": "X_{unbound}",
        "moisture_dry_basis_bound": "X_{bound}",
        "moisture_dry_basis_free": "X_{free}",
        "moisture_dry_basis_equilibrium": "X_e",
    },
)
def kinds_of_water(
    moisture_dry_basis: MoistureDryBasis,
    water_activity: WaterActivity,
    isotherm: IsothermLaw = POTATO,
    temperature: Temperature = 298.15,
    water_activity_hygroscopic: WaterActivity = 0.95,
) -> WaterKinds:
    """Split of a solid's water in contact with gas of a relative humidity.

    Bound water lowers the vapor pressure: it reaches to the end of the hygroscopic range, taken at the water
    activity given. Free water is what the gas can remove, down to equilibrium. Water of constitution belongs
    to the dry solid.

    >>> kinds = kinds_of_water(moisture_dry_basis=5.0, water_activity=0.5)
    >>> round(kinds.moisture_dry_basis_free + kinds.moisture_dry_basis_equilibrium, 6)
    5.0
    """
    X = moisture_dry_basis
    hygroscopic = isotherm(water_activity_hygroscopic, temperature)
    equilibrium = isotherm(water_activity, temperature) + 0.0 * X
    bound = jnp.minimum(X, hygroscopic)
    return WaterKinds(X - bound, bound, jnp.maximum(X - equilibrium, 0.0), equilibrium)


@formula(
    source="keey1978",
    equation=r"X_e = X(a_w, T)",
    typical={"water_activity": (0.1, 0.8)},
    title="Equilibrium moisture",
    output="moisture_dry_basis",
    symbols={"moisture_dry_basis": "X_e"},
)
def equilibrium_moisture(
    water_activity: WaterActivity, isotherm: IsothermLaw = POTATO, temperature: Temperature = 298.15
) -> MoistureDryBasis:
    """Moisture of a product in equilibrium with gas whose relative humidity is the water activity; isotherms
    by name or with constants.

    Wood Handbook, table: 9.2 % at 21.1 °C and 50 %.

    >>> round(
    ...     equilibrium_moisture(
    ...         water_activity="50 %", isotherm="hailwood_horrobin", temperature="21.1 degC"
    ...     ),
    ...     3,
    ... )
    0.092
    """
    return isotherm(water_activity, temperature) + 0.0 * water_activity


@formula(
    source="keey1978",
    equation=r"a_w = X^{-1}(X, T)",
    typical={"moisture_dry_basis": (0.05, 0.2)},
    title="Water activity of a product",
)
def water_activity(
    moisture_dry_basis: MoistureDryBasis, isotherm: IsothermLaw = POTATO, temperature: Temperature = 298.15
) -> WaterActivity:
    """Water activity of a product of known moisture: the relative humidity of the air with which it keeps.

    >>> round(
    ...     water_activity(moisture_dry_basis=0.092, isotherm="hailwood_horrobin", temperature="21.1 degC"), 2
    ... )
    0.5
    """
    return (
        isotherm.told_activity(jnp.asarray(moisture_dry_basis, dtype=float), temperature)
        + 0.0 * moisture_dry_basis
    )


class SorptionHeat(NamedTuple):
    """Heat of sorption per kilogram of water."""

    isosteric_heat_net: SpecificEnergy
    isosteric_heat: SpecificEnergy


@formula(
    source="keey1978; iglesias1976; iapwsif97",
    fitted={"temperature": (273.15, 623.15)},
    equation=(
        r"q_n = -\frac{R}{M_w}\left[\frac{\partial\ln a_w}{\partial(1/T)}\right]_X,\qquad q_{st} = "
        r"q_n + L_v"
    ),
    typical={"moisture_dry_basis": (0.08, 0.2)},
    title="Isosteric heat of sorption",
    output="isosteric_heat",
)
def isosteric_heat(
    moisture_dry_basis: MoistureDryBasis, isotherm: IsothermLaw = POTATO, temperature: Temperature = 298.15
) -> SorptionHeat:
    """Heat to evaporate bound water: net part from the isotherm's shift with temperature, plus the latent
    heat.

    Zero net heat for an isotherm without temperature. A negative value says that the printed constants let
    isotherms cross.

    The latent heat is that of water from 0 to 350 °C.

    >>> from granum.drying.isotherms.grains import ChungPfost
    >>> corn = ChungPfost(
    ...     isotherm_coefficient=312.30, isotherm_exponent=16.958, isotherm_temperature_offset=30.205
    ... )
    >>> round(isosteric_heat(moisture_dry_basis=0.15, isotherm=corn).isosteric_heat_net / 1e3)
    330
    """
    net = isotherm.net_isosteric_heat(moisture_dry_basis, temperature)
    return SorptionHeat(net, net + water_heat_of_vaporization.function(temperature))


@formula(
    source="keey1978",
    equation=r"X = s\,X_{des}(a_w) + (1-s)\,X_{ads}(a_w)",
    typical={"water_activity": (0.2, 0.8)},
    title="Moisture between the branches of hysteresis",
    output="moisture_dry_basis",
)
def hysteresis_moisture(
    water_activity: WaterActivity,
    isotherm_desorption: IsothermLaw = POTATO,
    isotherm_adsorption: IsothermLaw = POTATO,
    desorption_share: Fraction = 1.0,
    temperature: Temperature = 298.15,
) -> MoistureDryBasis:
    """Moisture on a scanning curve as a linear mix of the desorption branch, which dryers follow, and the
    adsorption branch.

    >>> a = Gab(0.06, 10.0, 0.9)
    >>> d = Gab(0.08, 10.0, 0.9)
    >>> round(hysteresis_moisture(0.5, d, a, 0.5) / (0.5 * float(a(0.5)) + 0.5 * float(d(0.5))), 9)
    1.0
    """
    desorbed = isotherm_desorption(water_activity, temperature)
    return desorption_share * desorbed + (1.0 - desorption_share) * isotherm_adsorption(
        water_activity, temperature
    )


@formula(
    source="gordon1952",
    equation=r"T_g = \frac{T_{gs} + k\,X\,T_{gw}}{1 + k X}",
    typical={"moisture_dry_basis": (0.02, 0.2), "glass_transition_temperature_dry": (330.0, 380.0)},
    title="Glass transition of a moist solid (Gordon–Taylor)",
    symbols={"glass_transition_temperature_dry": "T_{gs}"},
)
def glass_transition_temperature(
    moisture_dry_basis: MoistureDryBasis,
    glass_transition_temperature_dry: Temperature,
    gordon_taylor_constant: Number,
    glass_transition_temperature_water: Temperature = 138.15,
) -> Temperature:
    """Temperature above which an amorphous product softens, sticks and cakes; water lowers it.

    >>> round(glass_transition_temperature(0.05, "101 degC", 6.7) - 273.15, 0)
    42.0
    """
    impossible(gordon_taylor_constant < 0.0, gordon_taylor_constant, "gordon_taylor_constant", 0.0, jnp.inf)
    k = gordon_taylor_constant * moisture_dry_basis
    return (glass_transition_temperature_dry + k * glass_transition_temperature_water) / (1.0 + k)


@formula(
    source="murti2009",
    equation=r"s = b\,\left(T - T_g - \Delta T_c\right),\quad 0 \le s \le 1",
    typical={
        "temperature": (330.0, 370.0),
        "glass_transition_temperature": (290.0, 340.0),
        "sticking_margin": (20.0, 40.0),
        "sticking_slope": (0.01, 0.05),
    },
    title="Share of a powder that sticks where it hits a wall (particle gun)",
)
def sticking_share_particle_gun(
    temperature: Temperature,
    glass_transition_temperature: Temperature,
    sticking_margin: TemperatureDifference = 33.6,
    sticking_slope: PerTemperature = 0.031,
) -> Fraction:
    """Share of an amorphous powder blown on a plate that stays there, by how much it is warmer than its glass
    transition.

    The constants are those measured for skim milk powder, 33.6 ± 0.8 K and 3.1 ± 0.7 % per kelvin; the same
    laboratory found a margin of 28 K for cheese powder and of 38 K for a rich cream powder (abstracts read).

    By hand: 10 K beyond the margin.

    >>> round(sticking_share_particle_gun("83.6 degC", "40 degC"), 3)
    0.31
    """
    beyond = temperature - glass_transition_temperature - sticking_margin
    return jnp.clip(sticking_slope * beyond, 0.0, 1.0)
