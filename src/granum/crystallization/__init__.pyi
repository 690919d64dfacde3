"""Crystallization: equilibrium, kinetics, population balances, vessels."""

from granum.crystallization.charts import (
    batch_chart as batch_chart,
    seed_chart_figure as seed_chart_figure,
    size_distribution_chart as size_distribution_chart,
    solubility_chart as solubility_chart,
)
from granum.crystallization.charts_enantiomers import (
    enantiomers_chart as enantiomers_chart,
    resolution_chart as resolution_chart,
)
from granum.crystallization.charts_ionizable import (
    ph_solubility_chart as ph_solubility_chart,
)
from granum.crystallization.charts_melt import (
    layer_purity_chart as layer_purity_chart,
    zone_refining_chart as zone_refining_chart,
)
from granum.crystallization.charts_salts import (
    reciprocal_chart as reciprocal_chart,
    two_salts_chart as two_salts_chart,
)
from granum.crystallization.charts_solutions import (
    antisolvent_chart as antisolvent_chart,
    polymorph_chart as polymorph_chart,
    solubilities_chart as solubilities_chart,
)
from granum.crystallization.equipment.adductive import (
    AdductFigures as AdductFigures,
    AdductiveCrystallizer as AdductiveCrystallizer,
    Bound as Bound,
)
from granum.crystallization.equipment.antisolvent import (
    AntisolventBatchCrystallizer as AntisolventBatchCrystallizer,
    AntisolventCrystallizer as AntisolventCrystallizer,
    AntisolventFigures as AntisolventFigures,
    AtShare as AtShare,
    Dosed as Dosed,
    Drowned as Drowned,
    DrownedBatchFigures as DrownedBatchFigures,
)
from granum.crystallization.equipment.batch import (
    BatchCrystallizer as BatchCrystallizer,
    BatchFigures as BatchFigures,
    BatchOutlets as BatchOutlets,
    BatchVessel as BatchVessel,
    ChargedVessel as ChargedVessel,
    CycledVessel as CycledVessel,
    Grown as Grown,
    JacketedBatchCrystallizer as JacketedBatchCrystallizer,
    JacketedBatchFigures as JacketedBatchFigures,
    VacuumBatchCrystallizer as VacuumBatchCrystallizer,
    VacuumBatchFigures as VacuumBatchFigures,
    VacuumBatchOutlets as VacuumBatchOutlets,
)
from granum.crystallization.equipment.beside import (
    Beside as Beside,
    Fixed as Fixed,
    Thinned as Thinned,
    Warmed as Warmed,
)
from granum.crystallization.equipment.boiling import (
    Boiling as Boiling,
)
from granum.crystallization.equipment.brines import (
    Crystallizing as Crystallizing,
    Salts as Salts,
)
from granum.crystallization.equipment.classified import (
    ClassifiedCrystallizer as ClassifiedCrystallizer,
    ClassifiedFigures as ClassifiedFigures,
)
from granum.crystallization.equipment.colliding import (
    Colliding as Colliding,
)
from granum.crystallization.equipment.controlled import (
    ControlledBatchCrystallizer as ControlledBatchCrystallizer,
    ControlledBatchFigures as ControlledBatchFigures,
    FollowedBatch as FollowedBatch,
    NucleationControlledCrystallizer as NucleationControlledCrystallizer,
    NucleationControlledFigures as NucleationControlledFigures,
)
from granum.crystallization.equipment.dissolver import (
    Dissolver as Dissolver,
    DissolverFigures as DissolverFigures,
)
from granum.crystallization.equipment.extractive import (
    ExtractiveCrystallizer as ExtractiveCrystallizer,
    ExtractiveFigures as ExtractiveFigures,
)
from granum.crystallization.equipment.heat import (
    StreamHeat as StreamHeat,
)
from granum.crystallization.equipment.hydroxides import (
    HydroxideFigures as HydroxideFigures,
    HydroxidePrecipitator as HydroxidePrecipitator,
)
from granum.crystallization.equipment.in_time import (
    Crystallized as Crystallized,
    InTime as InTime,
)
from granum.crystallization.equipment.layer_melt import (
    LayerFigures as LayerFigures,
    LayerMeltCrystallizer as LayerMeltCrystallizer,
    LayerOutlets as LayerOutlets,
    Staged as Staged,
)
from granum.crystallization.equipment.msmpr import (
    CrystallizerFigures as CrystallizerFigures,
    Evaporative as Evaporative,
    Msmpr as Msmpr,
    VacuumCrystallizer as VacuumCrystallizer,
    VacuumFigures as VacuumFigures,
)
from granum.crystallization.equipment.needles import (
    GrownNeedles as GrownNeedles,
    NeedleBatchCrystallizer as NeedleBatchCrystallizer,
    NeedleBatchFigures as NeedleBatchFigures,
    NeedleCrystallizer as NeedleCrystallizer,
    NeedleFigures as NeedleFigures,
)
from granum.crystallization.equipment.oslo import (
    OsloCrystallizer as OsloCrystallizer,
    OsloFigures as OsloFigures,
)
from granum.crystallization.equipment.polymorphs import (
    PolymorphCrystallizer as PolymorphCrystallizer,
    PolymorphFigures as PolymorphFigures,
)
from granum.crystallization.equipment.precipitator import (
    Precipitating as Precipitating,
    Precipitator as Precipitator,
    PrecipitatorFigures as PrecipitatorFigures,
    Reacted as Reacted,
)
from granum.crystallization.equipment.preferential import (
    PreferentialCrystallizer as PreferentialCrystallizer,
    ResolutionFigures as ResolutionFigures,
)
from granum.crystallization.equipment.rival_batch import (
    Contested as Contested,
    Cut as Cut,
    RivalBatch as RivalBatch,
)
from granum.crystallization.equipment.roles import (
    Roles as Roles,
)
from granum.crystallization.equipment.stirring import (
    Stirred as Stirred,
    Stirring as Stirring,
)
from granum.crystallization.equipment.sublimation import (
    Desublimer as Desublimer,
    DesublimerFigures as DesublimerFigures,
    DesublimerOutlets as DesublimerOutlets,
    Sublimed as Sublimed,
    Sublimer as Sublimer,
    SublimerFigures as SublimerFigures,
    SublimerOutlets as SublimerOutlets,
    Volatile as Volatile,
)
from granum.crystallization.equipment.suspension_melt import (
    SuspensionMeltCrystallizer as SuspensionMeltCrystallizer,
    SuspensionMeltFigures as SuspensionMeltFigures,
    SuspensionMeltOutlets as SuspensionMeltOutlets,
    Washed as Washed,
)
from granum.crystallization.equipment.tubes import (
    BaffledTubeCrystallizer as BaffledTubeCrystallizer,
    BaffledTubeFigures as BaffledTubeFigures,
    Passed as Passed,
    PlugFlowCrystallizer as PlugFlowCrystallizer,
    PlugFlowFigures as PlugFlowFigures,
    SlugFlowCrystallizer as SlugFlowCrystallizer,
    SlugTubeFigures as SlugTubeFigures,
    Spread as Spread,
    Tube as Tube,
)
from granum.crystallization.equipment.two_salts import (
    Parted as Parted,
    TwoSaltCrystallizer as TwoSaltCrystallizer,
    TwoSaltFigures as TwoSaltFigures,
)
from granum.crystallization.equipment.uptake import (
    ImpurityUptake as ImpurityUptake,
    Shared as Shared,
    TakenUp as TakenUp,
    UptakeFigures as UptakeFigures,
)
from granum.crystallization.formulas.agglomeration import (
    AgglomerationKernel as AgglomerationKernel,
    Attrition as Attrition,
    Breakage as Breakage,
    BrownianKernel as BrownianKernel,
    ConstantKernel as ConstantKernel,
    PowerBreakage as PowerBreakage,
    ProductKernel as ProductKernel,
    SumKernel as SumKernel,
    TurbulentKernel as TurbulentKernel,
    agglomeration_coefficient_brownian as agglomeration_coefficient_brownian,
    agglomeration_coefficient_turbulent as agglomeration_coefficient_turbulent,
    shear_rate_turbulent as shear_rate_turbulent,
)
from granum.crystallization.formulas.balances import (
    Balance as Balance,
    FlashBalance as FlashBalance,
    KnownSoluteBalance as KnownSoluteBalance,
    area_jacket as area_jacket,
    crystallizer_balance as crystallizer_balance,
    crystallizer_balance_library as crystallizer_balance_library,
    evaporation_for_yield as evaporation_for_yield,
    heat_duty_crystallizer as heat_duty_crystallizer,
    log_mean_temperature_difference as log_mean_temperature_difference,
    solute_fraction_of_crystal as solute_fraction_of_crystal,
    vacuum_crystallizer_balance as vacuum_crystallizer_balance,
    yield_fraction_anhydrous as yield_fraction_anhydrous,
)
from granum.crystallization.formulas.batch_balances import (
    BatchBalance as BatchBalance,
    KnownSoluteBatch as KnownSoluteBatch,
    crystallizer_batch_balance as crystallizer_batch_balance,
    crystallizer_batch_balance_library as crystallizer_batch_balance_library,
)
from granum.crystallization.formulas.classified import (
    ClassifyingProduction as ClassifyingProduction,
    population_density_classified as population_density_classified,
    population_density_second_stage as population_density_second_stage,
    production_classifying as production_classifying,
)
from granum.crystallization.formulas.critical_nucleus import (
    CriticalNucleus as CriticalNucleus,
    critical_nucleus as critical_nucleus,
    critical_nucleus_melt as critical_nucleus_melt,
    critical_radius as critical_radius,
)
from granum.crystallization.formulas.driving_forces import (
    AbsoluteSupersaturation as AbsoluteSupersaturation,
    DrivingForce as DrivingForce,
    LogarithmicSupersaturation as LogarithmicSupersaturation,
    MolarSupersaturation as MolarSupersaturation,
    RelativeSupersaturation as RelativeSupersaturation,
)
from granum.crystallization.formulas.drowning_out import (
    antisolvent_fraction_best as antisolvent_fraction_best,
    yield_fraction_antisolvent as yield_fraction_antisolvent,
)
from granum.crystallization.formulas.enantiomers import (
    AlternatingCrop as AlternatingCrop,
    EutecticPoint as EutecticPoint,
    crop_alternating_seeds as crop_alternating_seeds,
    eutectic_racemate as eutectic_racemate,
    freezing_temperature_racemate as freezing_temperature_racemate,
    gibbs_energy_racemate as gibbs_energy_racemate,
    solubility_per_solvent_enantiomer as solubility_per_solvent_enantiomer,
)
from granum.crystallization.formulas.encrustation import (
    temperature_difference_encrustation as temperature_difference_encrustation,
    wall_temperature_jacket as wall_temperature_jacket,
)
from granum.crystallization.formulas.film import (
    FilmGrowth as FilmGrowth,
    FilmGrowthLaw as FilmGrowthLaw,
    damkohler_growth as damkohler_growth,
    diffusion_coefficient_sherwood as diffusion_coefficient_sherwood,
    film_growth as film_growth,
    growth_rate_from_flux as growth_rate_from_flux,
    sherwood_number_levins_glastonbury as sherwood_number_levins_glastonbury,
    sherwood_number_ranz_marshall as sherwood_number_ranz_marshall,
)
from granum.crystallization.formulas.growth import (
    BirthAndSpreadGrowth as BirthAndSpreadGrowth,
    GrowthLaw as GrowthLaw,
    PowerLawDissolution as PowerLawDissolution,
    PowerLawGrowth as PowerLawGrowth,
    SpiralGrowth as SpiralGrowth,
    growth_rate_birth_and_spread as growth_rate_birth_and_spread,
    growth_rate_power as growth_rate_power,
    growth_rate_spiral as growth_rate_spiral,
)
from granum.crystallization.formulas.hydroxides import (
    HydroxideRange as HydroxideRange,
    SaturatedHydroxide as SaturatedHydroxide,
    ph_precipitation_hydroxide as ph_precipitation_hydroxide,
    ph_saturated_hydroxide as ph_saturated_hydroxide,
)
from granum.crystallization.formulas.impurities import (
    ImpededGrowth as ImpededGrowth,
    PinnedSteps as PinnedSteps,
    growth_ratio_kubota_mullin as growth_ratio_kubota_mullin,
    pinning_supersaturation as pinning_supersaturation,
    undercooling_growth_start as undercooling_growth_start,
)
from granum.crystallization.formulas.inclusions import (
    InclusionOnset as InclusionOnset,
    OnsetByGrowth as OnsetByGrowth,
    OnsetSize as OnsetSize,
    growth_rate_clear_carlson as growth_rate_clear_carlson,
    inclusion_fraction_mean as inclusion_fraction_mean,
    inclusion_onset_size_carlson as inclusion_onset_size_carlson,
)
from granum.crystallization.formulas.ionizable import (
    IonizedSolubility as IonizedSolubility,
    SolubilityAtPh as SolubilityAtPh,
    ph_limit_salt as ph_limit_salt,
    solubility_ampholyte as solubility_ampholyte,
    solubility_weak_acid as solubility_weak_acid,
    solubility_weak_base as solubility_weak_base,
)
from granum.crystallization.formulas.melt import (
    Segregation as Segregation,
    distribution_coefficient_effective as distribution_coefficient_effective,
    freezing_temperature_ideal as freezing_temperature_ideal,
    impurity_ratio_sweating as impurity_ratio_sweating,
    impurity_ratio_zone as impurity_ratio_zone,
    impurity_ratio_zone_ultimate as impurity_ratio_zone_ultimate,
    segregation_freezing as segregation_freezing,
)
from granum.crystallization.formulas.mixing_times import (
    induction_time_volume as induction_time_volume,
    mixing_time_engulfment as mixing_time_engulfment,
    mixing_time_nienow as mixing_time_nienow,
)
from granum.crystallization.formulas.msmpr import (
    coefficient_of_variation as coefficient_of_variation,
    crystal_size_at_undersize as crystal_size_at_undersize,
    dominant_size as dominant_size,
    dominant_size_changed as dominant_size_changed,
    magma_density as magma_density,
    mass_median_size as mass_median_size,
    nucleation_rate_msmpr as nucleation_rate_msmpr,
    nuclei_population_density as nuclei_population_density,
    population_density as population_density,
    population_density_size_dependent as population_density_size_dependent,
    relative_nucleation_order as relative_nucleation_order,
    size_factor as size_factor,
    undersize_mass_fraction as undersize_mass_fraction,
)
from granum.crystallization.formulas.needles import (
    magma_density_needles as magma_density_needles,
)
from granum.crystallization.formulas.nucleation import (
    ClassicalNucleation as ClassicalNucleation,
    NoNucleation as NoNucleation,
    NucleationLaw as NucleationLaw,
    PowerLawNucleation as PowerLawNucleation,
    SummedNucleation as SummedNucleation,
    heterogeneous_factor as heterogeneous_factor,
    interfacial_energy_mersmann as interfacial_energy_mersmann,
    nucleation_barrier as nucleation_barrier,
    nucleation_rate_classical as nucleation_rate_classical,
    nucleation_rate_secondary as nucleation_rate_secondary,
    supersaturation_ratio_nucleation as supersaturation_ratio_nucleation,
)
from granum.crystallization.formulas.polymorphs import (
    supersaturation_ratio_polymorphs as supersaturation_ratio_polymorphs,
    temperature_transition_polymorphs as temperature_transition_polymorphs,
)
from granum.crystallization.formulas.programs import (
    ConstantFlow as ConstantFlow,
    CoolingShares as CoolingShares,
    CycledCooling as CycledCooling,
    NaturalCooling as NaturalCooling,
    PowerCooling as PowerCooling,
    Program as Program,
    TemperaturePoints as TemperaturePoints,
    temperature_cooling_power as temperature_cooling_power,
)
from granum.crystallization.formulas.purity import (
    Purity as Purity,
    SharedOut as SharedOut,
    impurity_share_crystallized as impurity_share_crystallized,
    purity_of_crystals as purity_of_crystals,
)
from granum.crystallization.formulas.ripening import (
    crystal_size_ripened as crystal_size_ripened,
    supersaturation_ratio_gibbs_thomson as supersaturation_ratio_gibbs_thomson,
)
from granum.crystallization.formulas.seeding import (
    GrownSeed as GrownSeed,
    SeedChart as SeedChart,
    duration_for_growth as duration_for_growth,
    grown_seed as grown_seed,
    product_size_from_seed as product_size_from_seed,
    seed_chart as seed_chart,
    seed_loading_critical as seed_loading_critical,
    seed_mass_for_product as seed_mass_for_product,
)
from granum.crystallization.formulas.selective import (
    Adducted as Adducted,
    Extracted as Extracted,
    adductive_crystallization as adductive_crystallization,
    agent_ratio_urea as agent_ratio_urea,
    extractive_crystallization as extractive_crystallization,
)
from granum.crystallization.formulas.slugs import (
    SlugFlow as SlugFlow,
    slug_flow as slug_flow,
)
from granum.crystallization.formulas.solubility_laws import (
    AntisolventSolubility as AntisolventSolubility,
    ApelblatSolubility as ApelblatSolubility,
    LibrarySolubility as LibrarySolubility,
    PolynomialSolubility as PolynomialSolubility,
    SolubilityLaw as SolubilityLaw,
    VantHoffSolubility as VantHoffSolubility,
)
from granum.crystallization.formulas.sublimation import (
    EntrainerBalance as EntrainerBalance,
    entrainer_balance as entrainer_balance,
    sublimation_pressure_clapeyron as sublimation_pressure_clapeyron,
)
from granum.crystallization.formulas.supersaturation import (
    absolute_supersaturation as absolute_supersaturation,
    driving_force_thermodynamic as driving_force_thermodynamic,
    relative_supersaturation as relative_supersaturation,
    solute_mass_fraction as solute_mass_fraction,
    solute_per_solvent_fraction as solute_per_solvent_fraction,
    solute_per_solvent_from_hydrate as solute_per_solvent_from_hydrate,
    solute_per_solvent_hydrate as solute_per_solvent_hydrate,
    supersaturation_ratio as supersaturation_ratio,
    supersaturation_ratio_solution_basis as supersaturation_ratio_solution_basis,
    undercooling as undercooling,
)
from granum.crystallization.formulas.tubes import (
    OscillatoryFlow as OscillatoryFlow,
    OscillatoryLoss as OscillatoryLoss,
    oscillatory_flow as oscillatory_flow,
    oscillatory_loss as oscillatory_loss,
)
from granum.crystallization.formulas.upflow import (
    Upflow as Upflow,
    cut_size_upflow as cut_size_upflow,
)
from granum.crystallization.formulas.wash_columns import (
    WashFront as WashFront,
    impurity_ratio_wash_column as impurity_ratio_wash_column,
    wash_front as wash_front,
)
from granum.crystallization.lab_tests.batch_kinetics import (
    BatchKinetics as BatchKinetics,
)
from granum.crystallization.lab_tests.induction_time import (
    InductionTime as InductionTime,
)
from granum.crystallization.lab_tests.metastable_zone import (
    MetastableZone as MetastableZone,
    MetastableZoneSangwal as MetastableZoneSangwal,
    undercooling_metastable as undercooling_metastable,
)
from granum.crystallization.lab_tests.msmpr_analysis import (
    MsmprAnalysis as MsmprAnalysis,
    population_densities as population_densities,
)
from granum.crystallization.lab_tests.next_batch import (
    NextBatches as NextBatches,
    next_batch as next_batch,
)
from granum.crystallization.lab_tests.solubility import (
    SolubilityAntisolvent as SolubilityAntisolvent,
    SolubilityApelblat as SolubilityApelblat,
    SolubilityPolynomial as SolubilityPolynomial,
    SolubilityVantHoff as SolubilityVantHoff,
)
from granum.crystallization.population.composition import (
    Trial as Trial,
)
from granum.crystallization.population.grid import (
    Collisions as Collisions,
    Events as Events,
)
from granum.crystallization.population.lagrangian import (
    Course as Course,
    Equilibrium as Equilibrium,
    Model as Model,
    SolventVolume as SolventVolume,
    SuspensionVolume as SuspensionVolume,
)
from granum.crystallization.population.needles import (
    Aged as Aged,
    Lines as Lines,
    Segments as Segments,
)
from granum.crystallization.population.operations import (
    Addition as Addition,
    Contents as Contents,
    Counted as Counted,
    Flashing as Flashing,
    Heat as Heat,
    HeatData as HeatData,
    Jacketed as Jacketed,
    Operation as Operation,
    Programmed as Programmed,
    Sensor as Sensor,
)
from granum.crystallization.population.packets import (
    DispersedMoments as DispersedMoments,
    GrowthDispersion as GrowthDispersion,
    Packets as Packets,
    Population as Population,
    Seeds as Seeds,
    ShiftedMoments as ShiftedMoments,
    SizeMap as SizeMap,
)
from granum.crystallization.population.rivals import (
    Form as Form,
    Rivals as Rivals,
    Row as Row,
    State as State,
)
from granum.crystallization.population.standing import (
    Classes as Classes,
    Outflow as Outflow,
    Standing as Standing,
)
from granum.crystallization.recipes import (
    CoolingRecipe as CoolingRecipe,
    Processes as Processes,
    choose as choose,
    optimal_cooling as optimal_cooling,
)
from granum.crystallization.robust import (
    Scaled as Scaled,
)
from granum.crystallization.vessels.batch import (
    AgglomeratingCourse as AgglomeratingCourse,
    BatchCourse as BatchCourse,
    agglomerating_batch as agglomerating_batch,
    batch as batch,
)
from granum.crystallization.vessels.classified_bed import (
    Bed as Bed,
)
from granum.crystallization.vessels.common_ion import (
    Border as Border,
    BrineSaturation as BrineSaturation,
    Diagram as Diagram,
    InvariantPoint as InvariantPoint,
    Isotherm as Isotherm,
    Path as Path,
    ReciprocalSaturation as ReciprocalSaturation,
    SolubilityBeside as SolubilityBeside,
    brine_saturation as brine_saturation,
    invariant_point as invariant_point,
    reciprocal_saturation as reciprocal_saturation,
    solubility_beside_salt as solubility_beside_salt,
)
from granum.crystallization.vessels.crowded import (
    Crowded as Crowded,
)
from granum.crystallization.vessels.crystals import (
    Crystal as Crystal,
)
from granum.crystallization.vessels.driven import (
    Constant as Constant,
    JacketedCourse as JacketedCourse,
    VacuumCourse as VacuumCourse,
    jacketed_batch as jacketed_batch,
    vacuum_batch as vacuum_batch,
)
from granum.crystallization.vessels.dynamic import (
    ConstantProgram as ConstantProgram,
    ContinuousCourse as ContinuousCourse,
    Exchanged as Exchanged,
    Inflow as Inflow,
    StageCourse as StageCourse,
    SteadyFeed as SteadyFeed,
    Surviving as Surviving,
    msmpr_over_time as msmpr_over_time,
)
from granum.crystallization.vessels.enantiomers import (
    Resolution as Resolution,
    ResolutionCourse as ResolutionCourse,
    preferential_crystallization as preferential_crystallization,
)
from granum.crystallization.vessels.held import (
    controlled_batch as controlled_batch,
    nucleation_controlled_batch as nucleation_controlled_batch,
)
from granum.crystallization.vessels.moving import (
    Moving as Moving,
)
from granum.crystallization.vessels.msmpr import (
    AdditiveVolumes as AdditiveVolumes,
    Composition as Composition,
    Feed as Feed,
    Removal as Removal,
    SteadyState as SteadyState,
)
from granum.crystallization.vessels.needles import (
    Habit as Habit,
    NeedleCourse as NeedleCourse,
    NeedleMarch as NeedleMarch,
    Needles as Needles,
    SteadyNeedles as SteadyNeedles,
    needle_batch as needle_batch,
)
from granum.crystallization.vessels.polymorphs import (
    PolymorphCourse as PolymorphCourse,
    polymorph_batch as polymorph_batch,
)
from granum.crystallization.vessels.precipitation import (
    HydroxideEquilibrium as HydroxideEquilibrium,
    Ions as Ions,
    PrecipitationCourse as PrecipitationCourse,
    ReagentAddition as ReagentAddition,
    SaltEquilibrium as SaltEquilibrium,
    precipitation_batch as precipitation_batch,
)
from granum.crystallization.vessels.reacting import (
    ByActivity as ByActivity,
    Held as Held,
    ReactedVolume as ReactedVolume,
    Reacting as Reacting,
)
from granum.crystallization.vessels.salt_heats import (
    DilutionHeat as DilutionHeat,
    SolutionHeat as SolutionHeat,
    heat_of_dilution as heat_of_dilution,
    heat_of_solution as heat_of_solution,
)
from granum.crystallization.vessels.zone_melting import (
    ZoneRefined as ZoneRefined,
    zone_refining as zone_refining,
)
