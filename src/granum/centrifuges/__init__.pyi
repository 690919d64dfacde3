"""Centrifugal settling and filtration."""

from granum.centrifuges.charts import (
    bowl_chart as bowl_chart,
    grade_efficiency_chart as grade_efficiency_chart,
)
from granum.centrifuges.equipment.bowls import (
    Bowl as Bowl,
)
from granum.centrifuges.equipment.decanters import (
    Conveyed as Conveyed,
    DecanterFigures as DecanterFigures,
    ScrollDecanter as ScrollDecanter,
    Scrolled as Scrolled,
    ThreePhaseDecanter as ThreePhaseDecanter,
    ThreePhaseFigures as ThreePhaseFigures,
)
from granum.centrifuges.equipment.filtering import (
    FilteringCentrifuge as FilteringCentrifuge,
    Peeler as Peeler,
    Pusher as Pusher,
    SetCake as SetCake,
    Spin as Spin,
    SpinFigures as SpinFigures,
    Spun as Spun,
)
from granum.centrifuges.equipment.liquids import (
    DiscSeparating as DiscSeparating,
    DiscSeparator as DiscSeparator,
    NozzleFigures as NozzleFigures,
    NozzleSeparator as NozzleSeparator,
    Parted as Parted,
    PartedFigures as PartedFigures,
    Separator as Separator,
    TubularSeparator as TubularSeparator,
)
from granum.centrifuges.equipment.purifiers import (
    DiscPurifier as DiscPurifier,
    PurifierFigures as PurifierFigures,
)
from granum.centrifuges.equipment.screens import (
    ConicalScreen as ConicalScreen,
    ScrollScreen as ScrollScreen,
    SlidingCakeScreen as SlidingCakeScreen,
    SlidingScreen as SlidingScreen,
    TumblingScreen as TumblingScreen,
    VibratingScreen as VibratingScreen,
)
from granum.centrifuges.equipment.settling import (
    Clarified as Clarified,
    ClarifierFigures as ClarifierFigures,
    DiscStack as DiscStack,
    Discs as Discs,
    EmptiedFigures as EmptiedFigures,
    SettlingCentrifuge as SettlingCentrifuge,
    SolidBasket as SolidBasket,
    Tube as Tube,
    TubularBowl as TubularBowl,
    TubularFigures as TubularFigures,
)
from granum.centrifuges.formulas.clarifying import (
    cut_size_centrifuge as cut_size_centrifuge,
    grade_efficiency_thin_layer as grade_efficiency_thin_layer,
    grade_efficiency_tubular as grade_efficiency_tubular,
    grade_efficiency_tubular_rising as grade_efficiency_tubular_rising,
    radius_heavy_dam as radius_heavy_dam,
    radius_interface as radius_interface,
    sigma_factor_bottle as sigma_factor_bottle,
    sigma_factor_disc as sigma_factor_disc,
    sigma_factor_scroll as sigma_factor_scroll,
    sigma_factor_tubular as sigma_factor_tubular,
    sigma_factor_tubular_half_area as sigma_factor_tubular_half_area,
    sigma_factor_tubular_half_thickness as sigma_factor_tubular_half_thickness,
    volume_flow_centrifuge as volume_flow_centrifuge,
    volume_flow_g_volume as volume_flow_g_volume,
    volume_flow_other_centrifuge as volume_flow_other_centrifuge,
)
from granum.centrifuges.formulas.conveying import (
    conveying_torque as conveying_torque,
    conveying_velocity as conveying_velocity,
    power_pushing as power_pushing,
    slide_length_cycle as slide_length_cycle,
    sliding_ratio as sliding_ratio,
    stay_time_scroll as stay_time_scroll,
    stay_time_sliding as stay_time_sliding,
    tumbling_angle_least as tumbling_angle_least,
    vibration_acceleration_least as vibration_acceleration_least,
)
from granum.centrifuges.formulas.field import (
    centrifugal_effect as centrifugal_effect,
    centrifugal_force as centrifugal_force,
    liquid_pressure_bowl as liquid_pressure_bowl,
    rotation_speed_for_effect as rotation_speed_for_effect,
    settling_velocity_centrifugal as settling_velocity_centrifugal,
    settling_velocity_centrifugal_allen as settling_velocity_centrifugal_allen,
    settling_velocity_centrifugal_newton as settling_velocity_centrifugal_newton,
    settling_velocity_centrifugal_stokes as settling_velocity_centrifugal_stokes,
    surface_height_rotating as surface_height_rotating,
)
from granum.centrifuges.formulas.laboratory import (
    clearing_factor as clearing_factor,
    molar_mass_svedberg as molar_mass_svedberg,
    pelleted_fraction as pelleted_fraction,
    pelleting_time as pelleting_time,
    pelleting_time_other_rotor as pelleting_time_other_rotor,
    sedimentation_coefficient as sedimentation_coefficient,
    sedimentation_coefficient_standard as sedimentation_coefficient_standard,
    sedimentation_coefficient_stokes as sedimentation_coefficient_stokes,
)
from granum.centrifuges.formulas.mechanics import (
    critical_speed_bowl as critical_speed_bowl,
    discharge_interval as discharge_interval,
    hoop_stress_bowl as hoop_stress_bowl,
    nozzle_flow_bowl as nozzle_flow_bowl,
    power_acceleration as power_acceleration,
    power_windage as power_windage,
)
from granum.centrifuges.formulas.spinning import (
    cake_saturation_spinning as cake_saturation_spinning,
    filtrate_flow_basket as filtrate_flow_basket,
    filtrate_flow_critical as filtrate_flow_critical,
    irreducible_saturation_leung as irreducible_saturation_leung,
    irreducible_saturation_spinning as irreducible_saturation_spinning,
    loading_time_basket as loading_time_basket,
    spin_off_time as spin_off_time,
)
from granum.centrifuges.pelleting import (
    Pellets as Pellets,
    differential_centrifugation as differential_centrifugation,
)
