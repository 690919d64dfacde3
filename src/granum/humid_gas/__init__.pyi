"""Humid gas: psychrometrics of any gas–vapor pair, processes and charts."""

from granum.humid_gas.charts import (
    mollier_chart as mollier_chart,
    psychrometric_chart as psychrometric_chart,
)
from granum.humid_gas.dry_air import (
    AirComposition as AirComposition,
    air_composition as air_composition,
)
from granum.humid_gas.formulas.processes import (
    CombustionGas as CombustionGas,
    Duty as Duty,
    Process as Process,
    Recirculation as Recirculation,
    adiabatic_drying as adiabatic_drying,
    combustion_gas as combustion_gas,
    cooling as cooling,
    dehumidifying as dehumidifying,
    drying_slope as drying_slope,
    heating as heating,
    heating_by_duty as heating_by_duty,
    injection as injection,
    mixing as mixing,
    real_drying as real_drying,
    recirculation as recirculation,
)
from granum.humid_gas.formulas.properties import (
    adiabatic_saturation_temperature as adiabatic_saturation_temperature,
    dew_point_temperature as dew_point_temperature,
    enthalpy as enthalpy,
    enthalpy_linear as enthalpy_linear,
    gas_density as gas_density,
    humidity_ratio as humidity_ratio,
    humidity_ratio_saturated as humidity_ratio_saturated,
    pressure_at_altitude as pressure_at_altitude,
    relative_humidity as relative_humidity,
    specific_volume as specific_volume,
    vapor_pressure as vapor_pressure,
    wet_bulb_temperature as wet_bulb_temperature,
)
from granum.humid_gas.formulas.state import (
    HumidGasState as HumidGasState,
    state as state,
)
from granum.humid_gas.formulas.transport import (
    Transport as Transport,
    transport as transport,
)
from granum.humid_gas.inputs import (
    Solver as Solver,
)
from granum.humid_gas.isolines import (
    Isolines as Isolines,
)
from granum.humid_gas.pairs import (
    AbstractIdealPair as AbstractIdealPair,
    AbstractPair as AbstractPair,
    AirWater as AirWater,
)
from granum.humid_gas.real_air import (
    AirWaterReal as AirWaterReal,
)
from granum.humid_gas.relations import (
    Gas as Gas,
    WetSurface as WetSurface,
)
from granum.humid_gas.solvents import (
    AbstractFluidPair as AbstractFluidPair,
    AirAcetone as AirAcetone,
    AirEthanol as AirEthanol,
    AirMethanol as AirMethanol,
    AirToluene as AirToluene,
    GasAndVapor as GasAndVapor,
    NitrogenAcetone as NitrogenAcetone,
    NitrogenEthanol as NitrogenEthanol,
    NitrogenEthylAcetate as NitrogenEthylAcetate,
    NitrogenIsopropanol as NitrogenIsopropanol,
    NitrogenMethanol as NitrogenMethanol,
    NitrogenToluene as NitrogenToluene,
    NitrogenWater as NitrogenWater,
    PairOfMixture as PairOfMixture,
)
from granum.humid_gas.virials import (
    Fit as Fit,
    Virials as Virials,
)
