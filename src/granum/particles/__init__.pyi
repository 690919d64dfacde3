"""Particles: sizes, shapes, distributions, sieving; drag and the motion of single particles."""

from granum.particles.charts_motion import (
    drag_chart as drag_chart,
    drag_deviation_chart as drag_deviation_chart,
    trajectory_chart as trajectory_chart,
)
from granum.particles.charts_sizes import (
    log_probability_chart as log_probability_chart,
    partition_chart as partition_chart,
    rosin_rammler_chart as rosin_rammler_chart,
    size_distribution_chart as size_distribution_chart,
)
from granum.particles.class_means import (
    SizeSummary as SizeSummary,
    class_fractions_converted as class_fractions_converted,
    cumulative_fraction_classes as cumulative_fraction_classes,
    mean_diameter_classes as mean_diameter_classes,
    percentile_diameter as percentile_diameter,
    size_summary as size_summary,
)
from granum.particles.distributions import (
    SizeDistribution as SizeDistribution,
)
from granum.particles.formulas.bubbles import (
    GraceVelocity as GraceVelocity,
    eotvos_number as eotvos_number,
    hadamard_factor as hadamard_factor,
    morton_number as morton_number,
    spherical_diameter_limit as spherical_diameter_limit,
    stable_diameter_limit as stable_diameter_limit,
    terminal_velocity_davies_taylor as terminal_velocity_davies_taylor,
    terminal_velocity_grace as terminal_velocity_grace,
    terminal_velocity_hadamard_rybczynski as terminal_velocity_hadamard_rybczynski,
    terminal_velocity_mendelson as terminal_velocity_mendelson,
    weber_number as weber_number,
)
from granum.particles.formulas.classifying import (
    fluid_density_equal_settling as fluid_density_equal_settling,
    settling_ratio as settling_ratio,
)
from granum.particles.formulas.criteria import (
    FallByRegime as FallByRegime,
    SizeByRegime as SizeByRegime,
    archimedes_number as archimedes_number,
    diameter_criterion as diameter_criterion,
    reynolds_number_from_diameter_criterion as reynolds_number_from_diameter_criterion,
    reynolds_number_from_velocity_criterion as reynolds_number_from_velocity_criterion,
    terminal_diameter_by_regime as terminal_diameter_by_regime,
    terminal_velocity_by_regime as terminal_velocity_by_regime,
    velocity_criterion as velocity_criterion,
)
from granum.particles.formulas.cumulative import (
    LawSummary as LawSummary,
    cumulative_fraction_gates_gaudin_schuhmann as cumulative_fraction_gates_gaudin_schuhmann,
    cumulative_fraction_gaudin_meloy as cumulative_fraction_gaudin_meloy,
    cumulative_fraction_log_normal as cumulative_fraction_log_normal,
    cumulative_fraction_normal as cumulative_fraction_normal,
    cumulative_fraction_rosin_rammler as cumulative_fraction_rosin_rammler,
    partition_number_logistic as partition_number_logistic,
    partition_number_molerus_hoffmann as partition_number_molerus_hoffmann,
    partition_number_rosin_rammler as partition_number_rosin_rammler,
    partition_number_whiten as partition_number_whiten,
    size_law_summary as size_law_summary,
)
from granum.particles.formulas.drag import (
    drag_coefficient_abraham as drag_coefficient_abraham,
    drag_coefficient_allen as drag_coefficient_allen,
    drag_coefficient_dalla_valle as drag_coefficient_dalla_valle,
    drag_coefficient_fair_geyer as drag_coefficient_fair_geyer,
    drag_coefficient_five_ranges as drag_coefficient_five_ranges,
    drag_coefficient_kaskas as drag_coefficient_kaskas,
    drag_coefficient_newton as drag_coefficient_newton,
    drag_coefficient_oseen as drag_coefficient_oseen,
    drag_coefficient_proudman_pearson as drag_coefficient_proudman_pearson,
    drag_coefficient_stokes as drag_coefficient_stokes,
)
from granum.particles.formulas.drag_modern import (
    drag_coefficient_almedeij as drag_coefficient_almedeij,
    drag_coefficient_barati as drag_coefficient_barati,
    drag_coefficient_brown_lawler as drag_coefficient_brown_lawler,
    drag_coefficient_cheng as drag_coefficient_cheng,
    drag_coefficient_clift_gauvin as drag_coefficient_clift_gauvin,
    drag_coefficient_clift_grace_weber as drag_coefficient_clift_grace_weber,
    drag_coefficient_concha_almendra as drag_coefficient_concha_almendra,
    drag_coefficient_flemmer_banks as drag_coefficient_flemmer_banks,
    drag_coefficient_khan_richardson as drag_coefficient_khan_richardson,
    drag_coefficient_mikhailov_freire as drag_coefficient_mikhailov_freire,
    drag_coefficient_morrison as drag_coefficient_morrison,
    drag_coefficient_morsi_alexander as drag_coefficient_morsi_alexander,
    drag_coefficient_schiller_naumann as drag_coefficient_schiller_naumann,
    drag_coefficient_swamee_ojha as drag_coefficient_swamee_ojha,
    drag_coefficient_turton_levenspiel as drag_coefficient_turton_levenspiel,
)
from granum.particles.formulas.drag_nonspherical import (
    BagheriBonadonna as BagheriBonadonna,
    GanserShape as GanserShape,
    drag_coefficient_chien as drag_coefficient_chien,
    drag_coefficient_ganser as drag_coefficient_ganser,
    drag_coefficient_haider_levenspiel as drag_coefficient_haider_levenspiel,
    drag_coefficient_holzer_sommerfeld as drag_coefficient_holzer_sommerfeld,
)
from granum.particles.formulas.forces import (
    drag_force as drag_force,
    measured_drag_coefficient as measured_drag_coefficient,
)
from granum.particles.formulas.gas_adsorption import (
    adsorbed_volume_bet as adsorbed_volume_bet,
    specific_surface_mass_bet as specific_surface_mass_bet,
)
from granum.particles.formulas.hindered import (
    RichardsonZaki as RichardsonZaki,
    hindered_velocity as hindered_velocity,
    hindrance_barnea_mizrahi as hindrance_barnea_mizrahi,
    hindrance_batchelor as hindrance_batchelor,
    hindrance_garside_al_dibouni as hindrance_garside_al_dibouni,
    hindrance_happel as hindrance_happel,
    hindrance_khan_richardson as hindrance_khan_richardson,
    hindrance_maude_whitmore as hindrance_maude_whitmore,
    hindrance_richardson_zaki as hindrance_richardson_zaki,
    hindrance_steinour as hindrance_steinour,
    settling_exponent_garside_al_dibouni as settling_exponent_garside_al_dibouni,
    settling_exponent_khan_richardson as settling_exponent_khan_richardson,
    settling_exponent_maude_whitmore as settling_exponent_maude_whitmore,
    settling_exponent_richardson_zaki as settling_exponent_richardson_zaki,
    settling_exponent_rowe as settling_exponent_rowe,
)
from granum.particles.formulas.means import (
    curvature_coefficient as curvature_coefficient,
    fineness_modulus as fineness_modulus,
    geometric_standard_deviation as geometric_standard_deviation,
    mean_diameter_harmonic as mean_diameter_harmonic,
    mean_diameter_hatch_choate as mean_diameter_hatch_choate,
    mean_diameter_length_surface as mean_diameter_length_surface,
    mean_diameter_length_volume as mean_diameter_length_volume,
    mean_diameter_mass as mean_diameter_mass,
    mean_diameter_moment_ratio as mean_diameter_moment_ratio,
    mean_diameter_number_length as mean_diameter_number_length,
    mean_diameter_number_surface as mean_diameter_number_surface,
    mean_diameter_number_volume as mean_diameter_number_volume,
    mean_diameter_surface_volume as mean_diameter_surface_volume,
    median_diameter_hatch_choate as median_diameter_hatch_choate,
    number_per_mass as number_per_mass,
    size_span as size_span,
    uniformity_coefficient as uniformity_coefficient,
)
from granum.particles.formulas.non_newtonian import (
    drag_coefficient_renaud as drag_coefficient_renaud,
    reynolds_number_power_law as reynolds_number_power_law,
    terminal_velocity_ansley_smith as terminal_velocity_ansley_smith,
    terminal_velocity_renaud as terminal_velocity_renaud,
    yield_stress_beris as yield_stress_beris,
)
from granum.particles.formulas.numbers import (
    reynolds_number as reynolds_number,
)
from granum.particles.formulas.sampling import (
    composition_deviation_random as composition_deviation_random,
    mineral_factor_gy as mineral_factor_gy,
    mixing_index_lacey as mixing_index_lacey,
    sample_mass_gy as sample_mass_gy,
    sampling_error_gy as sampling_error_gy,
)
from granum.particles.formulas.sedimentation import (
    SedimentationSizes as SedimentationSizes,
    size_distribution_balance as size_distribution_balance,
    size_distribution_pipette as size_distribution_pipette,
)
from granum.particles.formulas.shapes import (
    circularity as circularity,
    shape_factor_corey as shape_factor_corey,
    shape_factor_surface as shape_factor_surface,
    shape_factor_volume as shape_factor_volume,
    sphericity_box as sphericity_box,
    sphericity_cylinder as sphericity_cylinder,
    sphericity_diameters as sphericity_diameters,
    sphericity_krumbein as sphericity_krumbein,
    sphericity_regular as sphericity_regular,
    sphericity_spheroid as sphericity_spheroid,
    sphericity_volume_surface as sphericity_volume_surface,
)
from granum.particles.formulas.sizes import (
    equivalent_diameter_aerodynamic as equivalent_diameter_aerodynamic,
    equivalent_diameter_perimeter as equivalent_diameter_perimeter,
    equivalent_diameter_projected_area as equivalent_diameter_projected_area,
    equivalent_diameter_specific_surface as equivalent_diameter_specific_surface,
    equivalent_diameter_stokes as equivalent_diameter_stokes,
    equivalent_diameter_surface as equivalent_diameter_surface,
    equivalent_diameter_surface_volume as equivalent_diameter_surface_volume,
    equivalent_diameter_volume as equivalent_diameter_volume,
    specific_surface_diameter as specific_surface_diameter,
    specific_surface_mass_diameter as specific_surface_mass_diameter,
)
from granum.particles.formulas.slip import (
    brownian_diameter as brownian_diameter,
    brownian_diffusivity as brownian_diffusivity,
    brownian_displacement as brownian_displacement,
    knudsen_number as knudsen_number,
    mean_free_path as mean_free_path,
    slip_factor_allen_raabe as slip_factor_allen_raabe,
    slip_factor_davies as slip_factor_davies,
    slip_factor_kim as slip_factor_kim,
    terminal_velocity_slip as terminal_velocity_slip,
)
from granum.particles.formulas.suspension import (
    DilutedSuspension as DilutedSuspension,
    diluted_suspension as diluted_suspension,
    hindrance_apparent_medium as hindrance_apparent_medium,
    relative_viscosity_batchelor as relative_viscosity_batchelor,
    relative_viscosity_einstein as relative_viscosity_einstein,
    relative_viscosity_krieger_dougherty as relative_viscosity_krieger_dougherty,
    relative_viscosity_mooney as relative_viscosity_mooney,
    relative_viscosity_thomas as relative_viscosity_thomas,
    relative_viscosity_vand as relative_viscosity_vand,
    suspension_density as suspension_density,
    suspension_viscosity as suspension_viscosity,
    terminal_velocity_collective as terminal_velocity_collective,
)
from granum.particles.formulas.terminal import (
    terminal_diameter as terminal_diameter,
    terminal_velocity as terminal_velocity,
)
from granum.particles.formulas.terminal_explicit import (
    terminal_velocity_allen as terminal_velocity_allen,
    terminal_velocity_brown_lawler as terminal_velocity_brown_lawler,
    terminal_velocity_ferguson_church as terminal_velocity_ferguson_church,
    terminal_velocity_haider_levenspiel as terminal_velocity_haider_levenspiel,
    terminal_velocity_khan_richardson as terminal_velocity_khan_richardson,
    terminal_velocity_newton as terminal_velocity_newton,
    terminal_velocity_power_law as terminal_velocity_power_law,
    terminal_velocity_stokes as terminal_velocity_stokes,
    terminal_velocity_turton_clark as terminal_velocity_turton_clark,
    terminal_velocity_zigrang_sylvester as terminal_velocity_zigrang_sylvester,
)
from granum.particles.formulas.trajectories import (
    Path as Path,
    Settled as Settled,
    settling_distance as settling_distance,
    settling_distance_stokes as settling_distance_stokes,
    trajectory as trajectory,
    trajectory_stokes as trajectory_stokes,
)
from granum.particles.formulas.transfer import (
    nusselt_number_ranz_marshall as nusselt_number_ranz_marshall,
)
from granum.particles.formulas.unsteady import (
    Approach as Approach,
    FallState as FallState,
    approach_to_terminal as approach_to_terminal,
    fall_newton as fall_newton,
    fall_stokes as fall_stokes,
    relaxation_time as relaxation_time,
    stopping_distance as stopping_distance,
)
from granum.particles.formulas.wall import (
    terminal_velocity_bounded as terminal_velocity_bounded,
    wall_factor_di_felice as wall_factor_di_felice,
    wall_factor_faxen as wall_factor_faxen,
    wall_factor_francis as wall_factor_francis,
    wall_factor_francis_power as wall_factor_francis_power,
    wall_factor_haberman_sayre as wall_factor_haberman_sayre,
    wall_factor_kehlenbeck_di_felice as wall_factor_kehlenbeck_di_felice,
    wall_factor_ladenburg as wall_factor_ladenburg,
    wall_factor_munroe as wall_factor_munroe,
)
from granum.particles.in_class import (
    ArithmeticMidpoint as ArithmeticMidpoint,
    GeometricMidpoint as GeometricMidpoint,
    InClassRule as InClassRule,
    LogUniformDensity as LogUniformDensity,
    PowerDensity as PowerDensity,
    ShiftedDensity as ShiftedDensity,
    UniformDensity as UniformDensity,
)
from granum.particles.lab_tests.gas_adsorption import (
    GasAdsorption as GasAdsorption,
)
from granum.particles.lab_tests.instruments import (
    ImageAnalysis as ImageAnalysis,
    LaserDiffraction as LaserDiffraction,
    ParticleCounter as ParticleCounter,
)
from granum.particles.lab_tests.sieve_analysis import (
    SieveAnalysis as SieveAnalysis,
)
from granum.particles.lab_tests.size_test import (
    Recipe as Recipe,
    SizeTest as SizeTest,
)
from granum.particles.partition import (
    BypassedPartition as BypassedPartition,
    IdealPartition as IdealPartition,
    LogisticPartition as LogisticPartition,
    MolerusHoffmannPartition as MolerusHoffmannPartition,
    PartitionCurve as PartitionCurve,
    RosinRammlerPartition as RosinRammlerPartition,
    WhitenPartition as WhitenPartition,
    imperfection as imperfection,
    partition_number_reduced as partition_number_reduced,
    probable_error as probable_error,
    sharpness_index as sharpness_index,
)
from granum.particles.paths import (
    Motion as Motion,
)
from granum.particles.ranking import (
    DragRanking as DragRanking,
    drag_ranking as drag_ranking,
)
from granum.particles.sieves import (
    SieveStack as SieveStack,
    aperture as aperture,
    sieve_series_apertures as sieve_series_apertures,
)
from granum.particles.size_laws import (
    GatesGaudinSchuhmann as GatesGaudinSchuhmann,
    GaudinMeloy as GaudinMeloy,
    LogNormal as LogNormal,
    Mixture as Mixture,
    Normal as Normal,
    RosinRammler as RosinRammler,
    SizeLaw as SizeLaw,
)
