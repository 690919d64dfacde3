"""Materials: fluids, solids, solutes and their solubility, gas–vapor pairs."""

from granum.materials.activities import (
    CausticActivity as CausticActivity,
    ElectrolyteActivity as ElectrolyteActivity,
    IdealActivity as IdealActivity,
    NoActivity as NoActivity,
    SucroseActivity as SucroseActivity,
)
from granum.materials.brines import (
    Boiling as Boiling,
    Brine as Brine,
    Equilibrium as Equilibrium,
    Forms as Forms,
    Mixing as Mixing,
)
from granum.materials.correlation import (
    Correlation as Correlation,
    Missing as Missing,
    Owner as Owner,
    Tabulated as Tabulated,
)
from granum.materials.double_salts import (
    DoubleSalt as DoubleSalt,
)
from granum.materials.fluids import (
    Combustion as Combustion,
    Flammability as Flammability,
    Fluid as Fluid,
)
from granum.materials.formulas.activity import (
    debye_huckel_slope as debye_huckel_slope,
    enthalpy_of_dissolution_williamson as enthalpy_of_dissolution_williamson,
    osmotic_coefficient_pitzer as osmotic_coefficient_pitzer,
    solvent_activity_raoult as solvent_activity_raoult,
    water_activity_osmotic as water_activity_osmotic,
    water_activity_starzak_peacock as water_activity_starzak_peacock,
)
from granum.materials.formulas.caustic import (
    caustic_enthalpy_olsson as caustic_enthalpy_olsson,
    caustic_vapor_pressure_olsson as caustic_vapor_pressure_olsson,
)
from granum.materials.formulas.correlations import (
    correlation_aly_lee as correlation_aly_lee,
    correlation_antoine as correlation_antoine,
    correlation_apelblat as correlation_apelblat,
    correlation_dippr101 as correlation_dippr101,
    correlation_dippr102 as correlation_dippr102,
    correlation_dippr114 as correlation_dippr114,
    correlation_exponential_celsius as correlation_exponential_celsius,
    correlation_maier_kelley as correlation_maier_kelley,
    correlation_mulero as correlation_mulero,
    correlation_polynomial as correlation_polynomial,
    correlation_polynomial_celsius as correlation_polynomial_celsius,
    correlation_rackett as correlation_rackett,
    correlation_vant_hoff as correlation_vant_hoff,
    correlation_vogel as correlation_vogel,
    correlation_wagner as correlation_wagner,
    correlation_walther as correlation_walther,
    correlation_watson as correlation_watson,
    kinematic_viscosity_walther as kinematic_viscosity_walther,
)
from granum.materials.formulas.diffusivity import (
    diffusivity_fuller as diffusivity_fuller,
    diffusivity_marrero_mason as diffusivity_marrero_mason,
    lewis_number as lewis_number,
)
from granum.materials.formulas.gases import (
    air_conductivity as air_conductivity,
    air_heat_capacity as air_heat_capacity,
    air_viscosity as air_viscosity,
    ideal_gas_density as ideal_gas_density,
    nitrogen_conductivity as nitrogen_conductivity,
    nitrogen_heat_capacity as nitrogen_heat_capacity,
    nitrogen_viscosity as nitrogen_viscosity,
)
from granum.materials.formulas.glycerol import (
    dynamic_viscosity_glycerol_water as dynamic_viscosity_glycerol_water,
    glycerol_viscosity as glycerol_viscosity,
)
from granum.materials.formulas.ice import (
    ice_melting_pressure as ice_melting_pressure,
    ice_vapor_pressure as ice_vapor_pressure,
)
from granum.materials.formulas.mixed_electrolytes import (
    Coefficients as Coefficients,
    electrostatic_mixing_function as electrostatic_mixing_function,
)
from granum.materials.formulas.precipitation import (
    activity_coefficient_davies as activity_coefficient_davies,
    deprotonated_fraction as deprotonated_fraction,
    ionization_exponent_water as ionization_exponent_water,
    salt_molality_from_product as salt_molality_from_product,
)
from granum.materials.formulas.properties import (
    GasProperties as GasProperties,
    LiquidProperties as LiquidProperties,
    SaltSaturation as SaltSaturation,
    Saturation as Saturation,
    Solubility as Solubility,
    SolutionProperties as SolutionProperties,
    VaporInGas as VaporInGas,
    gas_properties as gas_properties,
    liquid_properties as liquid_properties,
    salt_saturation as salt_saturation,
    saturated_solution as saturated_solution,
    solubility as solubility,
    solution_properties as solution_properties,
    vapor_in_gas as vapor_in_gas,
)
from granum.materials.formulas.seawater import (
    seawater_conductivity as seawater_conductivity,
    seawater_density as seawater_density,
    seawater_heat_capacity as seawater_heat_capacity,
    seawater_vapor_pressure as seawater_vapor_pressure,
    seawater_viscosity as seawater_viscosity,
)
from granum.materials.formulas.solutions import (
    dynamic_viscosity_genotelle as dynamic_viscosity_genotelle,
    dynamic_viscosity_jones_dole as dynamic_viscosity_jones_dole,
    dynamic_viscosity_laliberte as dynamic_viscosity_laliberte,
    liquid_density_laliberte as liquid_density_laliberte,
    specific_heat_capacity_laliberte as specific_heat_capacity_laliberte,
)
from granum.materials.formulas.steam import (
    steam_density as steam_density,
    steam_enthalpy as steam_enthalpy,
    steam_heat_capacity as steam_heat_capacity,
    steam_heat_capacity_ideal as steam_heat_capacity_ideal,
    water_heat_of_vaporization as water_heat_of_vaporization,
)
from granum.materials.formulas.water import (
    water_boiling_temperature as water_boiling_temperature,
    water_density as water_density,
    water_enthalpy as water_enthalpy,
    water_heat_capacity as water_heat_capacity,
    water_surface_tension as water_surface_tension,
    water_vapor_pressure as water_vapor_pressure,
)
from granum.materials.formulas.water_transport import (
    dynamic_viscosity_iapws as dynamic_viscosity_iapws,
    steam_conductivity as steam_conductivity,
    steam_viscosity as steam_viscosity,
    thermal_conductivity_iapws as thermal_conductivity_iapws,
    water_conductivity as water_conductivity,
    water_viscosity as water_viscosity,
)
from granum.materials.ions import (
    Ions as Ions,
)
from granum.materials.library import (
    Library as Library,
    fluid as fluid,
    load as load,
    names as names,
    salt as salt,
    solid as solid,
    solute as solute,
)
from granum.materials.mixing_heats import (
    CausticMixing as CausticMixing,
    ElectrolyteMixing as ElectrolyteMixing,
    IonMixing as IonMixing,
)
from granum.materials.pairs import (
    GasVapor as GasVapor,
    gas_vapor as gas_vapor,
)
from granum.materials.salts import (
    Salt as Salt,
)
from granum.materials.schema import (
    ActivityEntry as ActivityEntry,
    BranchEntry as BranchEntry,
    CombustionEntry as CombustionEntry,
    FlammabilityEntry as FlammabilityEntry,
    FluidEntry as FluidEntry,
    IonEntry as IonEntry,
    MaterialsFile as MaterialsFile,
    PropertyEntry as PropertyEntry,
    SaltEntry as SaltEntry,
    SolidEntry as SolidEntry,
    SoluteEntry as SoluteEntry,
)
from granum.materials.solids import (
    Solid as Solid,
)
from granum.materials.solutes import (
    AdditiveHeats as AdditiveHeats,
    AdditiveVolumes as AdditiveVolumes,
    Branch as Branch,
    DiluteViscosity as DiluteViscosity,
    LaliberteLaw as LaliberteLaw,
    NoLaw as NoLaw,
    SoluteSystem as SoluteSystem,
    SyrupViscosity as SyrupViscosity,
)
from granum.materials.stated import (
    StatedFluid as StatedFluid,
)
