"""Cake, depth and membrane filtration."""

from granum.filtration.adsorption import (
    FreundlichIsotherm as FreundlichIsotherm,
    LangmuirIsotherm as LangmuirIsotherm,
)
from granum.filtration.charts import (
    cake_profile_chart as cake_profile_chart,
    filtration_cycle_chart as filtration_cycle_chart,
    washing_chart as washing_chart,
)
from granum.filtration.equipment.batch import (
    BatchFilter as BatchFilter,
    CandleFilter as CandleFilter,
    ChamberPress as ChamberPress,
    FlatFilter as FlatFilter,
    MembranePress as MembranePress,
    Nutsche as Nutsche,
    PlateAndFramePress as PlateAndFramePress,
    Press as Press,
    PressureLeafFilter as PressureLeafFilter,
    SqueezingFilter as SqueezingFilter,
)
from granum.filtration.equipment.belt_press import (
    BeltPress as BeltPress,
    Course as Course,
    PressFigures as PressFigures,
    Pressed as Pressed,
)
from granum.filtration.equipment.cake_filter import (
    CakeFigures as CakeFigures,
    CakeFilter as CakeFilter,
    Caked as Caked,
    Plan as Plan,
    Slurry as Slurry,
)
from granum.filtration.equipment.carbon import (
    Bedded as Bedded,
    CarbonBed as CarbonBed,
    CarbonFigures as CarbonFigures,
    Fluid as Fluid,
    GasCarbonBed as GasCarbonBed,
    LiquidCarbonBed as LiquidCarbonBed,
    Purified as Purified,
)
from granum.filtration.equipment.cartridge import (
    CartridgeFigures as CartridgeFigures,
    CartridgeFilter as CartridgeFilter,
    CartridgeOutlets as CartridgeOutlets,
    Held as Held,
)
from granum.filtration.equipment.continuous import (
    ContinuousFilter as ContinuousFilter,
    HorizontalBeltFilter as HorizontalBeltFilter,
    PrecoatDrum as PrecoatDrum,
    RotaryDiscFilter as RotaryDiscFilter,
    RotaryVacuumDrum as RotaryVacuumDrum,
    VacuumFilter as VacuumFilter,
)
from granum.filtration.equipment.deep_bed import (
    DeepBedFigures as DeepBedFigures,
    DeepBedFilter as DeepBedFilter,
    DeepBedOutlets as DeepBedOutlets,
    FilterRun as FilterRun,
)
from granum.filtration.equipment.gravity import (
    Batch as Batch,
    Drained as Drained,
    GravityFigures as GravityFigures,
    GravityFilter as GravityFilter,
)
from granum.filtration.equipment.high_presses import (
    HighPress as HighPress,
    TowerPress as TowerPress,
    TubePress as TubePress,
)
from granum.filtration.equipment.membranes import (
    Chain as Chain,
    MembraneFigures as MembraneFigures,
    OsmosisFigures as OsmosisFigures,
    Parted as Parted,
    ReverseOsmosis as ReverseOsmosis,
    Ultrafiltration as Ultrafiltration,
)
from granum.filtration.equipment.screw_press import (
    Passage as Passage,
    ScrewFigures as ScrewFigures,
    ScrewPress as ScrewPress,
)
from granum.filtration.equipment.thickening import (
    Pulsed as Pulsed,
    Thickened as Thickened,
    ThickeningFigures as ThickeningFigures,
    ThickeningFilter as ThickeningFilter,
)
from granum.filtration.flux_laws import (
    MeasuredFlux as MeasuredFlux,
    MeasuredFluxPressure as MeasuredFluxPressure,
)
from granum.filtration.formulas.adsorption import (
    adsorption_rate_lodewyckx as adsorption_rate_lodewyckx,
    breakthrough_fraction_bohart_adams as breakthrough_fraction_bohart_adams,
    breakthrough_time_wheeler_jonas as breakthrough_time_wheeler_jonas,
)
from granum.filtration.formulas.backwash import (
    backwash_velocity as backwash_velocity,
    head_loss_backwash as head_loss_backwash,
)
from granum.filtration.formulas.blocking import (
    dirt_held_blocking as dirt_held_blocking,
    filtrate_volume_blocking as filtrate_volume_blocking,
)
from granum.filtration.formulas.cake_growth import (
    standard_cake_formation_time as standard_cake_formation_time,
)
from granum.filtration.formulas.compressible import (
    CakeProfile as CakeProfile,
    cake_profile as cake_profile,
    cake_resistance_local_power as cake_resistance_local_power,
    cake_resistance_tiller as cake_resistance_tiller,
    void_fraction_mean_tiller as void_fraction_mean_tiller,
)
from granum.filtration.formulas.constant_pressure import (
    Ruth as Ruth,
    filtrate_flow_washing as filtrate_flow_washing,
    filtrate_flux as filtrate_flux,
    filtrate_volume_constant_pressure as filtrate_volume_constant_pressure,
    filtration_time_constant_pressure as filtration_time_constant_pressure,
    ruth_constants as ruth_constants,
)
from granum.filtration.formulas.constant_rate import (
    cake_thickness_constant_rate as cake_thickness_constant_rate,
    filtration_time_rate_then_pressure as filtration_time_rate_then_pressure,
    pressure_drop_constant_rate as pressure_drop_constant_rate,
    pressure_drop_constant_rate_compressible as pressure_drop_constant_rate_compressible,
)
from granum.filtration.formulas.cracking import (
    cake_thickness_crack_free_singh as cake_thickness_crack_free_singh,
)
from granum.filtration.formulas.cycle import (
    Cycle as Cycle,
    filtrate_flow_drum as filtrate_flow_drum,
    filtrate_volume_optimum as filtrate_volume_optimum,
    filtration_cycle as filtration_cycle,
    filtration_time_pump as filtration_time_pump,
)
from granum.filtration.formulas.deliquoring import (
    capillary_number_cake as capillary_number_cake,
    gas_velocity_deliquoring as gas_velocity_deliquoring,
    irreducible_saturation as irreducible_saturation,
    moisture_dry_basis_cake as moisture_dry_basis_cake,
    saturation_after_deliquoring as saturation_after_deliquoring,
    threshold_pressure_cake as threshold_pressure_cake,
)
from granum.filtration.formulas.depth import (
    collector_efficiency_tufenkji as collector_efficiency_tufenkji,
    concentration_iwasaki as concentration_iwasaki,
    filter_coefficient as filter_coefficient,
    head_loss_clean_bed as head_loss_clean_bed,
    head_loss_deep_bed as head_loss_deep_bed,
    run_time_deep_bed as run_time_deep_bed,
    specific_deposit_iwasaki as specific_deposit_iwasaki,
)
from granum.filtration.formulas.expression import (
    consolidation_ratio_shirato as consolidation_ratio_shirato,
    consolidation_ratio_terzaghi as consolidation_ratio_terzaghi,
    consolidation_time as consolidation_time,
)
from granum.filtration.formulas.fibers import (
    fiber_efficiency_lee_liu as fiber_efficiency_lee_liu,
)
from granum.filtration.formulas.flowability import (
    transportable_moisture_limit_compacted as transportable_moisture_limit_compacted,
    transportable_moisture_limit_flow as transportable_moisture_limit_flow,
)
from granum.filtration.formulas.fouling_index import (
    filterability_number as filterability_number,
    modified_fouling_index as modified_fouling_index,
    silt_density_index as silt_density_index,
    silt_density_index_cake as silt_density_index_cake,
)
from granum.filtration.formulas.gas_filters import (
    penetration_fibers as penetration_fibers,
    pressure_drop_dust_cake as pressure_drop_dust_cake,
    pressure_drop_fibers as pressure_drop_fibers,
)
from granum.filtration.formulas.gravity import (
    filtrate_depth_falling_head as filtrate_depth_falling_head,
    filtration_time_falling_head as filtration_time_falling_head,
    filtration_time_settling as filtration_time_settling,
)
from granum.filtration.formulas.mass_balance import (
    cake_thickness as cake_thickness,
    dry_cake_per_filtrate as dry_cake_per_filtrate,
    solids_mass_fraction_mixed as solids_mass_fraction_mixed,
    solids_mass_fraction_sampled as solids_mass_fraction_sampled,
    solids_mass_fraction_weighed as solids_mass_fraction_weighed,
    void_fraction_cake as void_fraction_cake,
    wet_to_dry_mass_ratio as wet_to_dry_mass_ratio,
)
from granum.filtration.formulas.membrane_transport import (
    mass_transfer_coefficient_channel as mass_transfer_coefficient_channel,
    molecule_diameter as molecule_diameter,
    osmotic_pressure_activity as osmotic_pressure_activity,
    polarization_modulus as polarization_modulus,
    pore_diameter_cut_off as pore_diameter_cut_off,
    rejection_ferry as rejection_ferry,
    rejection_observed as rejection_observed,
    solute_remaining_diafiltration as solute_remaining_diafiltration,
    solute_remaining_diafiltration_stages as solute_remaining_diafiltration_stages,
)
from granum.filtration.formulas.membranes import (
    concentration_retentate_batch as concentration_retentate_batch,
    filtrate_flux_limiting as filtrate_flux_limiting,
    filtrate_flux_membrane as filtrate_flux_membrane,
    filtrate_flux_permeance as filtrate_flux_permeance,
    filtration_area_membrane as filtration_area_membrane,
    osmotic_pressure as osmotic_pressure,
    rejection_solution_diffusion as rejection_solution_diffusion,
)
from granum.filtration.formulas.non_newtonian import (
    filtration_time_power_law as filtration_time_power_law,
)
from granum.filtration.formulas.pleats import (
    pleat_pitch_best as pleat_pitch_best,
    pressure_drop_pleated as pressure_drop_pleated,
)
from granum.filtration.formulas.readings import (
    filtration_time_ruth as filtration_time_ruth,
    resistances_constant_pressure as resistances_constant_pressure,
    resistances_constant_rate as resistances_constant_rate,
    ruth_constants_readings as ruth_constants_readings,
)
from granum.filtration.formulas.resistance import (
    cake_permeability as cake_permeability,
    cake_resistance_kozeny_carman as cake_resistance_kozeny_carman,
    cake_resistance_power_law as cake_resistance_power_law,
    cake_resistance_threshold as cake_resistance_threshold,
)
from granum.filtration.formulas.screw import (
    screw_torque as screw_torque,
)
from granum.filtration.formulas.suction import (
    capillary_suction_time as capillary_suction_time,
    filterability_constant as filterability_constant,
    suction_constant_calibration as suction_constant_calibration,
)
from granum.filtration.formulas.two_readings import (
    Compressed as Compressed,
    Resistances as Resistances,
    compressibility_two_resistances as compressibility_two_resistances,
    resistances_two_pressures as resistances_two_pressures,
    resistances_two_volumes as resistances_two_volumes,
)
from granum.filtration.formulas.washing import (
    axial_dispersion_cake as axial_dispersion_cake,
    dispersion_number as dispersion_number,
    solute_remaining_dahlstrom as solute_remaining_dahlstrom,
    solute_remaining_dispersion as solute_remaining_dispersion,
    solute_remaining_reslurry as solute_remaining_reslurry,
    wash_effluent_concentration as wash_effluent_concentration,
)
from granum.filtration.lab_tests.adsorption import (
    AdsorptionTest as AdsorptionTest,
)
from granum.filtration.lab_tests.blocking import (
    BlockingTest as BlockingTest,
)
from granum.filtration.lab_tests.cake_formation import (
    CakeFormationTest as CakeFormationTest,
)
from granum.filtration.lab_tests.cake_tests import (
    CompressionCell as CompressionCell,
    DeliquoringCurve as DeliquoringCurve,
    WashingCurve as WashingCurve,
)
from granum.filtration.lab_tests.capillary_suction import (
    CapillarySuctionTest as CapillarySuctionTest,
)
from granum.filtration.lab_tests.compressibility import (
    Compressibility as Compressibility,
)
from granum.filtration.lab_tests.expression import (
    ExpressionTest as ExpressionTest,
)
from granum.filtration.lab_tests.flowability import (
    ProctorFagerbergTest as ProctorFagerbergTest,
)
from granum.filtration.lab_tests.leaf_test import (
    ConstantPressureTest as ConstantPressureTest,
    FoulingIndexTest as FoulingIndexTest,
    LeafTest as LeafTest,
)
from granum.filtration.lab_tests.rate_tests import (
    ConstantRateTest as ConstantRateTest,
    VariablePressureTest as VariablePressureTest,
)
from granum.filtration.lab_tests.slurry import (
    PumpCurve as PumpCurve,
    SlurryJar as SlurryJar,
)
from granum.filtration.lab_tests.stepped import (
    SteppedPressureTest as SteppedPressureTest,
)
from granum.filtration.membranes import (
    Membrane as Membrane,
    Osmosis as Osmosis,
    Staged as Staged,
)
from granum.filtration.selection import (
    Separators as Separators,
    air_filter_class as air_filter_class,
    air_filter_class_particulate as air_filter_class_particulate,
    filtering_class as filtering_class,
    separator_choice as separator_choice,
)
