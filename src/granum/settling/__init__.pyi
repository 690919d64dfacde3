"""Settling, clarifying and thickening."""

from granum.settling.charts import (
    flux_diagram as flux_diagram,
    settler_layers_chart as settler_layers_chart,
    settling_course_chart as settling_course_chart,
    settling_curve_chart as settling_curve_chart,
)
from granum.settling.column import (
    Cone as Cone,
    Operation as Operation,
    Simulation as Simulation,
    Steps as Steps,
    Suspension as Suspension,
)
from granum.settling.compression import (
    LogarithmicStress as LogarithmicStress,
    PowerStress as PowerStress,
)
from granum.settling.equipment.api_separator import (
    ApiSeparator as ApiSeparator,
    SeparatorFigures as SeparatorFigures,
    Skimmed as Skimmed,
)
from granum.settling.equipment.carriers import (
    Carried as Carried,
    Carrier as Carrier,
)
from granum.settling.equipment.clarifier_thickener import (
    ClarifierThickener as ClarifierThickener,
    ClarifierThickenerFigures as ClarifierThickenerFigures,
    Sludge as Sludge,
)
from granum.settling.equipment.clarifiers import (
    AbstractBasin as AbstractBasin,
    CircularClarifier as CircularClarifier,
    Clarifier as Clarifier,
    GritChamber as GritChamber,
    Lamella as Lamella,
    RectangularClarifier as RectangularClarifier,
)
from granum.settling.equipment.decantation import (
    CountercurrentDecantation as CountercurrentDecantation,
    DecantationFigures as DecantationFigures,
    Loads as Loads,
)
from granum.settling.equipment.flocculator import (
    Flocculated as Flocculated,
    Flocculator as Flocculator,
    FlocculatorFigures as FlocculatorFigures,
)
from granum.settling.equipment.flotation import (
    DissolvedAirFlotation as DissolvedAirFlotation,
    Floated as Floated,
    FlotationFigures as FlotationFigures,
    Whitened as Whitened,
)
from granum.settling.equipment.gravity import (
    AbstractSettler as AbstractSettler,
    Figures as Figures,
    Outlets as Outlets,
    Settled as Settled,
)
from granum.settling.equipment.secondary_settler import (
    Layers as Layers,
    SecondarySettler as SecondarySettler,
    SecondarySettlerFigures as SecondarySettlerFigures,
)
from granum.settling.equipment.thickener import (
    Thickener as Thickener,
    ThickenerFigures as ThickenerFigures,
)
from granum.settling.flux import (
    Limit as Limit,
    StatePoint as StatePoint,
    limiting_flux_underflow as limiting_flux_underflow,
    limiting_flux_withdrawal as limiting_flux_withdrawal,
    solids_flux_settling as solids_flux_settling,
    state_point_clarifier as state_point_clarifier,
    thickener_area_flux as thickener_area_flux,
)
from granum.settling.formulas.api import (
    basin_area_api as basin_area_api,
    basin_length_api as basin_length_api,
    horizontal_velocity_api as horizontal_velocity_api,
    rise_velocity_api as rise_velocity_api,
    turbulence_factor_api as turbulence_factor_api,
)
from granum.settling.formulas.basins import (
    basin_area as basin_area,
    basin_length as basin_length,
    horizontal_velocity_basin as horizontal_velocity_basin,
    overflow_rate_basin as overflow_rate_basin,
    removal_efficiency_camp as removal_efficiency_camp,
    removal_efficiency_classes as removal_efficiency_classes,
    removal_efficiency_hazen as removal_efficiency_hazen,
    scour_velocity_camp as scour_velocity_camp,
)
from granum.settling.formulas.coagulation import (
    capture_efficiency_dose as capture_efficiency_dose,
    charge_sharpness_jar as charge_sharpness_jar,
    residual_turbidity_neutralization as residual_turbidity_neutralization,
    residual_turbidity_parabola as residual_turbidity_parabola,
)
from granum.settling.formulas.decantation import (
    soluble_loss_countercurrent as soluble_loss_countercurrent,
)
from granum.settling.formulas.flocculation import (
    aggregation_constant_shear as aggregation_constant_shear,
    flocculation_ratio_tanks as flocculation_ratio_tanks,
    power_stirring as power_stirring,
    settling_growth_fractal as settling_growth_fractal,
    velocity_gradient_stirred as velocity_gradient_stirred,
)
from granum.settling.formulas.flotation import (
    air_released as air_released,
    air_solubility as air_solubility,
    air_to_solids_ratio as air_to_solids_ratio,
    collector_efficiency_bubble as collector_efficiency_bubble,
    removal_efficiency_contact as removal_efficiency_contact,
)
from granum.settling.formulas.lamella import (
    critical_velocity_cocurrent as critical_velocity_cocurrent,
    critical_velocity_countercurrent as critical_velocity_countercurrent,
    critical_velocity_crosscurrent as critical_velocity_crosscurrent,
    lamella_area as lamella_area,
    relative_length_transition_yao as relative_length_transition_yao,
)
from granum.settling.formulas.rakes import (
    rake_torque as rake_torque,
)
from granum.settling.formulas.sludge_index import (
    Velocities as Velocities,
    sludge_volume_index as sludge_volume_index,
    sludge_volume_index_diluted as sludge_volume_index_diluted,
    stirred_sludge_volume_index as stirred_sludge_volume_index,
    underflow_concentration_index as underflow_concentration_index,
    vesilind_velocity_daigger_roper as vesilind_velocity_daigger_roper,
    vesilind_velocity_hartel_popel as vesilind_velocity_hartel_popel,
)
from granum.settling.formulas.thickening import (
    interface_height_underflow as interface_height_underflow,
    settling_velocity_kynch as settling_velocity_kynch,
    shock_velocity_kynch as shock_velocity_kynch,
    solids_concentration_kynch as solids_concentration_kynch,
    solids_flux_layer as solids_flux_layer,
    thickener_area_coe_clevenger as thickener_area_coe_clevenger,
    thickener_area_liquid_ratio as thickener_area_liquid_ratio,
    thickener_area_talmage_fitch as thickener_area_talmage_fitch,
    unit_area_coe_clevenger as unit_area_coe_clevenger,
    unit_area_talmage_fitch as unit_area_talmage_fitch,
)
from granum.settling.lab_tests.batch_test import (
    BatchSeries as BatchSeries,
    BatchTest as BatchTest,
    FluxCurve as FluxCurve,
)
from granum.settling.lab_tests.coe_clevenger_series import (
    CoeClevengerSeries as CoeClevengerSeries,
)
from granum.settling.lab_tests.compression_test import (
    CompressionTest as CompressionTest,
)
from granum.settling.lab_tests.curve import (
    Compression as Compression,
    Convex as Convex,
    Curve as Curve,
    Straight as Straight,
    Tangents as Tangents,
)
from granum.settling.lab_tests.flocculent_column import (
    FlocculentColumn as FlocculentColumn,
)
from granum.settling.lab_tests.jar_test import (
    JarTest as JarTest,
)
from granum.settling.lab_tests.sludge_index_test import (
    SludgeIndexTest as SludgeIndexTest,
)
from granum.settling.layers import (
    Rest as Rest,
    SettlerLayers as SettlerLayers,
    Tank as Tank,
    settler_layers as settler_layers,
)
from granum.settling.simulations import (
    BatchCourse as BatchCourse,
    ContinuousCourse as ContinuousCourse,
    batch_simulation as batch_simulation,
    continuous_simulation as continuous_simulation,
)
from granum.settling.velocities import (
    Cole as Cole,
    Diehl as Diehl,
    HinderedParticles as HinderedParticles,
    MeasuredSettling as MeasuredSettling,
    RichardsonZakiConcentration as RichardsonZakiConcentration,
    Takacs as Takacs,
    Vesilind as Vesilind,
)
