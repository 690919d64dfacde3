"""Moist solids, drying kinetics and dryers."""

from granum.drying.balances.convective import (
    DryerBalance as DryerBalance,
    dryer_balance as dryer_balance,
)
from granum.drying.balances.indices import (
    dry_gas_flow_evaporation as dry_gas_flow_evaporation,
    drying_efficiency as drying_efficiency,
    energy_consumption_ratio as energy_consumption_ratio,
    energy_per_water as energy_per_water,
    evaporative_capacity as evaporative_capacity,
    mass_efficiency as mass_efficiency,
    moisture_extraction_rate as moisture_extraction_rate,
)
from granum.drying.balances.savings import (
    DirectFiring as DirectFiring,
    HeatPump as HeatPump,
    HeatRecovery as HeatRecovery,
    Recompression as Recompression,
    StagedHeating as StagedHeating,
    SteamDrying as SteamDrying,
    direct_firing as direct_firing,
    exhaust_heat_recovery as exhaust_heat_recovery,
    heat_pump_dryer as heat_pump_dryer,
    staged_heating as staged_heating,
    superheated_steam_drying as superheated_steam_drying,
    vapor_recompression as vapor_recompression,
)
from granum.drying.balances.system import (
    Plan as Plan,
    Relation as Relation,
    Step as Step,
    System as System,
)
from granum.drying.boards import (
    Board as Board,
    BoardDrying as BoardDrying,
)
from granum.drying.bodies import (
    Body as Body,
    BodyDrying as BodyDrying,
    body_drying as body_drying,
)
from granum.drying.charts import (
    dryer_air_path as dryer_air_path,
    dryer_energy_chart as dryer_energy_chart,
)
from granum.drying.equipment.atomizers import (
    AbstractAtomizer as AbstractAtomizer,
    GivenDrops as GivenDrops,
    Liquor as Liquor,
    PressureNozzle as PressureNozzle,
    TwoFluidNozzle as TwoFluidNozzle,
    Wheel as Wheel,
)
from granum.drying.equipment.belt import (
    BeltDryer as BeltDryer,
)
from granum.drying.equipment.burner import (
    Burner as Burner,
    BurnerFigures as BurnerFigures,
    Fired as Fired,
)
from granum.drying.equipment.closed import (
    AbstractCircuit as AbstractCircuit,
    AbstractCoilCircuit as AbstractCoilCircuit,
    Circuit as Circuit,
    ClosedDryer as ClosedDryer,
    ClosedFigures as ClosedFigures,
    ClosedOutlets as ClosedOutlets,
    Coiled as Coiled,
    CondenserCircuit as CondenserCircuit,
    Duty as Duty,
    HeatPumpCircuit as HeatPumpCircuit,
    SteamCircuit as SteamCircuit,
)
from granum.drying.equipment.convective import (
    ConvectiveDryer as ConvectiveDryer,
    ConvectiveFigures as ConvectiveFigures,
    ConvectiveOutlets as ConvectiveOutlets,
    Inside as Inside,
)
from granum.drying.equipment.drum import (
    ContactDried as ContactDried,
    DrumDryer as DrumDryer,
    DrumFigures as DrumFigures,
)
from granum.drying.equipment.flash import (
    FlashDryer as FlashDryer,
)
from granum.drying.equipment.fluid_bed import (
    FluidBedDryer as FluidBedDryer,
    FluidBedFigures as FluidBedFigures,
)
from granum.drying.equipment.freeze import (
    FreezeDried as FreezeDried,
    FreezeDryer as FreezeDryer,
    FreezeFigures as FreezeFigures,
)
from granum.drying.equipment.freeze_trays import (
    TrayFreezeDryer as TrayFreezeDryer,
    TrayFreezeFigures as TrayFreezeFigures,
)
from granum.drying.equipment.grain_bin import (
    BinFigures as BinFigures,
    GrainBin as GrainBin,
)
from granum.drying.equipment.paddle import (
    ContactCurve as ContactCurve,
    Heat as Heat,
    Heated as Heated,
    PaddleDryer as PaddleDryer,
    PaddleFigures as PaddleFigures,
)
from granum.drying.equipment.paper import (
    CylinderPassage as CylinderPassage,
    PaperDried as PaperDried,
    PaperFigures as PaperFigures,
    PaperMachine as PaperMachine,
)
from granum.drying.equipment.rotary import (
    RotaryDryer as RotaryDryer,
)
from granum.drying.equipment.silo import (
    DriedGrain as DriedGrain,
    SiloDryer as SiloDryer,
)
from granum.drying.equipment.solar import (
    SolarDryer as SolarDryer,
    SolarFigures as SolarFigures,
)
from granum.drying.equipment.spouted_bed import (
    Spout as Spout,
    SpoutedBedDryer as SpoutedBedDryer,
    SpoutedBedFigures as SpoutedBedFigures,
)
from granum.drying.equipment.spray import (
    SprayDryer as SprayDryer,
)
from granum.drying.equipment.still_air import (
    Room as Room,
    StillAirDryer as StillAirDryer,
    StillAirFigures as StillAirFigures,
    StillDried as StillDried,
)
from granum.drying.equipment.tray import (
    Batch as Batch,
    TrayDried as TrayDried,
    TrayDryer as TrayDryer,
    TrayFigures as TrayFigures,
)
from granum.drying.equipment.tunnel import (
    TunnelDryer as TunnelDryer,
)
from granum.drying.equipment.vacuum_shelves import (
    Boiling as Boiling,
    ShelfDried as ShelfDried,
    ShelfFigures as ShelfFigures,
    VacuumShelfDryer as VacuumShelfDryer,
)
from granum.drying.equipment.vibrated_bed import (
    VibratedBedDryer as VibratedBedDryer,
    VibratedBedFigures as VibratedBedFigures,
)
from granum.drying.equipment.web_ovens import (
    AbstractWebOven as AbstractWebOven,
    ImpingementDryer as ImpingementDryer,
    RadiantDryer as RadiantDryer,
    WebDried as WebDried,
    WebFigures as WebFigures,
)
from granum.drying.equipment.well_mixed import (
    WellMixedDryer as WellMixedDryer,
    WellMixedFigures as WellMixedFigures,
)
from granum.drying.equipment.wood_kiln import (
    KilnDried as KilnDried,
    KilnFigures as KilnFigures,
    Run as Run,
    WoodKiln as WoodKiln,
)
from granum.drying.formulas.aeration import (
    Aerated as Aerated,
    Fronts as Fronts,
    aeration_fronts as aeration_fronts,
    bin_aeration as bin_aeration,
)
from granum.drying.formulas.assisted import (
    AssistedDrying as AssistedDrying,
    drying_rate_assisted as drying_rate_assisted,
    radiated_heat_microwave as radiated_heat_microwave,
)
from granum.drying.formulas.atomizers import (
    droplet_diameter_elkotb as droplet_diameter_elkotb,
    droplet_diameter_friedman as droplet_diameter_friedman,
    droplet_diameter_lefebvre as droplet_diameter_lefebvre,
    droplet_diameter_masters as droplet_diameter_masters,
    droplet_diameter_nukiyama_tanasawa as droplet_diameter_nukiyama_tanasawa,
    drying_time_droplet as drying_time_droplet,
)
from granum.drying.formulas.beds import (
    bypass_fraction_groenewold_tsotsas as bypass_fraction_groenewold_tsotsas,
    heat_transfer_coefficient_through_bed as heat_transfer_coefficient_through_bed,
    moisture_ratio_hukill as moisture_ratio_hukill,
    pressure_gradient_shedd as pressure_gradient_shedd,
    specific_surface_cylinders as specific_surface_cylinders,
)
from granum.drying.formulas.characteristic import (
    AbstractCharacteristicCurve as AbstractCharacteristicCurve,
    HyperbolicCurve as HyperbolicCurve,
    PowerCurve as PowerCurve,
)
from granum.drying.formulas.contact_drying import (
    Penetration as Penetration,
    contact_time_mixing as contact_time_mixing,
    heat_transfer_coefficient_wall_particles as heat_transfer_coefficient_wall_particles,
    moisture_dry_basis_after as moisture_dry_basis_after,
    penetration_drying as penetration_drying,
    temperature_outlet_tray as temperature_outlet_tray,
)
from granum.drying.formulas.contact_layers import (
    ContactLayer as ContactLayer,
    contact_layer_drying as contact_layer_drying,
)
from granum.drying.formulas.diffusion import (
    diffusivity_arrhenius as diffusivity_arrhenius,
    moisture_ratio_cylinder as moisture_ratio_cylinder,
    moisture_ratio_plate as moisture_ratio_plate,
    moisture_ratio_product as moisture_ratio_product,
    moisture_ratio_sphere as moisture_ratio_sphere,
    volume_ratio as volume_ratio,
)
from granum.drying.formulas.flights import (
    flight_filling_design as flight_filling_design,
    flight_repose_angle as flight_repose_angle,
)
from granum.drying.formulas.freeze_drying import (
    PrimaryDrying as PrimaryDrying,
    SlabFreezeDrying as SlabFreezeDrying,
    VialLimit as VialLimit,
    choked_flow_rate as choked_flow_rate,
    freeze_drying_limit as freeze_drying_limit,
    freeze_drying_slab as freeze_drying_slab,
    primary_drying as primary_drying,
    secondary_drying_time as secondary_drying_time,
)
from granum.drying.formulas.freeze_trays import (
    Layer as Layer,
    TrayDrying as TrayDrying,
    freeze_drying_tray as freeze_drying_tray,
)
from granum.drying.formulas.freezing import (
    freezing_time_pham as freezing_time_pham,
    freezing_time_plank as freezing_time_plank,
)
from granum.drying.formulas.heat import (
    colburn_factor_through_circulation as colburn_factor_through_circulation,
    dielectric_power_density as dielectric_power_density,
    drying_flux_boiling as drying_flux_boiling,
    heat_duty_radiation as heat_duty_radiation,
    heat_transfer_coefficient_channel as heat_transfer_coefficient_channel,
    heat_transfer_coefficient_parallel as heat_transfer_coefficient_parallel,
    heat_transfer_coefficient_penetration as heat_transfer_coefficient_penetration,
    heat_transfer_coefficient_perpendicular as heat_transfer_coefficient_perpendicular,
    heat_transfer_coefficient_series as heat_transfer_coefficient_series,
    nusselt_number_impinging as nusselt_number_impinging,
    penetration_depth as penetration_depth,
    saturation_share as saturation_share,
)
from granum.drying.formulas.impingement import (
    nusselt_number_impinging_slots as nusselt_number_impinging_slots,
)
from granum.drying.formulas.moisture import (
    SorptionHeat as SorptionHeat,
    WaterKinds as WaterKinds,
    equilibrium_moisture as equilibrium_moisture,
    evaporation_rate as evaporation_rate,
    glass_transition_temperature as glass_transition_temperature,
    hysteresis_moisture as hysteresis_moisture,
    isosteric_heat as isosteric_heat,
    kinds_of_water as kinds_of_water,
    moisture_dry_basis as moisture_dry_basis,
    moisture_dry_basis_from_mass as moisture_dry_basis_from_mass,
    moisture_wet_basis as moisture_wet_basis,
    sticking_share_particle_gun as sticking_share_particle_gun,
    water_activity as water_activity,
)
from granum.drying.formulas.moisture_ratios import (
    diffusivity_from_slope_plate as diffusivity_from_slope_plate,
    diffusivity_from_slope_sphere as diffusivity_from_slope_sphere,
    drying_time_diffusion as drying_time_diffusion,
    drying_time_thin_layer as drying_time_thin_layer,
    moisture_ratio_thin_layer as moisture_ratio_thin_layer,
)
from granum.drying.formulas.paper import (
    evaporation_per_area_tappi as evaporation_per_area_tappi,
    heat_transfer_coefficient_paper as heat_transfer_coefficient_paper,
    shaft_power_cylinders as shaft_power_cylinders,
)
from granum.drying.formulas.rotary import (
    residence_time_friedman_marshall as residence_time_friedman_marshall,
    residence_time_saeman_mitchell as residence_time_saeman_mitchell,
    shaft_power_rotary_drum as shaft_power_rotary_drum,
    volumetric_heat_transfer_rotary as volumetric_heat_transfer_rotary,
)
from granum.drying.formulas.scrapers import (
    shaft_power_scraper as shaft_power_scraper,
)
from granum.drying.formulas.solar import (
    Draft as Draft,
    SolarHeat as SolarHeat,
    chimney_draft as chimney_draft,
    drying_flux_penman as drying_flux_penman,
    solar_collector as solar_collector,
)
from granum.drying.formulas.still_air import (
    RoomAir as RoomAir,
    StillSurface as StillSurface,
    nusselt_number_plate_stable as nusselt_number_plate_stable,
    nusselt_number_plate_unstable as nusselt_number_plate_unstable,
    view_factor_rack as view_factor_rack,
)
from granum.drying.formulas.storage import (
    GrowthMargin as GrowthMargin,
    moisture_for_storage as moisture_for_storage,
    water_activity_margin as water_activity_margin,
)
from granum.drying.formulas.times import (
    DryingTime as DryingTime,
    drying_flux_rea as drying_flux_rea,
    drying_flux_receding_front as drying_flux_receding_front,
    drying_rate_constant as drying_rate_constant,
    drying_rate_constant_mass as drying_rate_constant_mass,
    drying_time as drying_time,
    drying_time_characteristic as drying_time_characteristic,
    drying_time_constant_rate as drying_time_constant_rate,
    drying_time_falling_rate as drying_time_falling_rate,
    drying_time_receding_front as drying_time_receding_front,
    evaporation_activation_energy as evaporation_activation_energy,
    heat_flux_combined as heat_flux_combined,
)
from granum.drying.formulas.vials import (
    History as History,
    Vial as Vial,
    cake_vapor_resistance as cake_vapor_resistance,
    frozen_height as frozen_height,
    vial_heat_transfer as vial_heat_transfer,
)
from granum.drying.formulas.vibration import (
    Throw as Throw,
    minimum_mixing_velocity_gupta_mujumdar as minimum_mixing_velocity_gupta_mujumdar,
    vibration_throw as vibration_throw,
)
from granum.drying.formulas.wood import (
    KilnAir as KilnAir,
    Schedule as Schedule,
    fiber_saturation as fiber_saturation,
    kiln_air as kiln_air,
    wood_diffusivity as wood_diffusivity,
)
from granum.drying.gas_solid.beds import (
    BedDryer as BedDryer,
)
from granum.drying.gas_solid.cells import (
    CellRow as CellRow,
    Contact as Contact,
    Entering as Entering,
    Inlet as Inlet,
    Network as Network,
    Profile as Profile,
)
from granum.drying.gas_solid.column import (
    Passage as Passage,
    Zone as Zone,
)
from granum.drying.gas_solid.conveyed import (
    Flight as Flight,
    Path as Path,
)
from granum.drying.gas_solid.dryer import (
    CellDryer as CellDryer,
    Dried as Dried,
    Dryer as Dryer,
    DryerFigures as DryerFigures,
    Through as Through,
)
from granum.drying.gas_solid.kinetics import (
    AbstractKinetics as AbstractKinetics,
    DiffusionKinetics as DiffusionKinetics,
    EquilibriumKinetics as EquilibriumKinetics,
    Meeting as Meeting,
    ReactionKinetics as ReactionKinetics,
    SurfaceKinetics as SurfaceKinetics,
    ThinLayerKinetics as ThinLayerKinetics,
    VanMeelKinetics as VanMeelKinetics,
)
from granum.drying.gas_solid.layer import (
    LayerDryer as LayerDryer,
)
from granum.drying.gas_solid.liquor import (
    Deposit as Deposit,
)
from granum.drying.gas_solid.matter import (
    Matter as Matter,
)
from granum.drying.gas_solid.mixed import (
    Bed as Bed,
    Found as Found,
    Gas as Gas,
    Life as Life,
    Lived as Lived,
    Solid as Solid,
    Spread as Spread,
)
from granum.drying.isotherm_charts import (
    isotherms_chart as isotherms_chart,
    stability_chart as stability_chart,
)
from granum.drying.isotherms.adsorption import (
    Bet as Bet,
    BetLayers as BetLayers,
    Gab as Gab,
    HailwoodHorrobin as HailwoodHorrobin,
)
from granum.drying.isotherms.base import (
    AbstractIsotherm as AbstractIsotherm,
)
from granum.drying.isotherms.empirical import (
    Bradley as Bradley,
    Caurie as Caurie,
    Chen as Chen,
    DoubleLog as DoubleLog,
    FerroFontan as FerroFontan,
    Halsey as Halsey,
    Henderson as Henderson,
    IglesiasChirife as IglesiasChirife,
    Kuhn as Kuhn,
    LewickiThree as LewickiThree,
    LewickiTwo as LewickiTwo,
    Oswin as Oswin,
    Peleg as Peleg,
    Smith as Smith,
)
from granum.drying.isotherms.grains import (
    ChungPfost as ChungPfost,
    HalseyModified as HalseyModified,
    HendersonModified as HendersonModified,
    OswinModified as OswinModified,
)
from granum.drying.isotherms.paper import (
    Heikkila as Heikkila,
)
from granum.drying.lab_tests.curve import (
    DryingCurve as DryingCurve,
    RateCurve as RateCurve,
)
from granum.drying.lab_tests.diffusivity import (
    EffectiveDiffusivity as EffectiveDiffusivity,
)
from granum.drying.lab_tests.freeze_drying import (
    ProductResistanceTest as ProductResistanceTest,
    VialHeatTest as VialHeatTest,
)
from granum.drying.lab_tests.isotherm import (
    IsothermTest as IsothermTest,
)
from granum.drying.lab_tests.isotherm_temperatures import (
    IsothermTemperatures as IsothermTemperatures,
)
from granum.drying.lab_tests.ranking import (
    Ranked as Ranked,
)
from granum.drying.lab_tests.thin_layer import (
    ThinLayerTest as ThinLayerTest,
)
from granum.drying.product_tables import (
    Applications as Applications,
    FoodMoistures as FoodMoistures,
    Foods as Foods,
    applications as applications,
    food_moistures as food_moistures,
    foods as foods,
)
from granum.drying.profile_charts import (
    drying_profile_chart as drying_profile_chart,
)
from granum.drying.radiant_heat import (
    AbstractRadiantHeat as AbstractRadiantHeat,
    DielectricField as DielectricField,
    InfraredEmitter as InfraredEmitter,
)
from granum.drying.selection import (
    Dryers as Dryers,
    WaterRemoval as WaterRemoval,
    choose as choose,
    water_removal_choice as water_removal_choice,
)
from granum.drying.thin_layers.base import (
    AbstractThinLayer as AbstractThinLayer,
)
from granum.drying.thin_layers.exponential import (
    DiffusionApproach as DiffusionApproach,
    HendersonPabis as HendersonPabis,
    HendersonPabisModified as HendersonPabisModified,
    Lewis as Lewis,
    Logarithmic as Logarithmic,
    Page as Page,
    PageModified as PageModified,
    TwoTerm as TwoTerm,
    TwoTermExponential as TwoTermExponential,
    Verma as Verma,
    Weibull as Weibull,
)
from granum.drying.thin_layers.other import (
    Aghbashlo as Aghbashlo,
    Demir as Demir,
    FickSimplified as FickSimplified,
    Geometric as Geometric,
    Hii as Hii,
    Midilli as Midilli,
    Parabolic as Parabolic,
    PelegRatio as PelegRatio,
    Silva as Silva,
    Thompson as Thompson,
    WangSingh as WangSingh,
    WeibullFour as WeibullFour,
)
from granum.drying.vial_spread import (
    VialSpread as VialSpread,
)
from granum.drying.web_path import (
    Air as Air,
    Phase as Phase,
    Web as Web,
)
