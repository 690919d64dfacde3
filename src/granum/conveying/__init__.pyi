"""Pneumatic and hydraulic conveying, hoppers and silos."""

from granum.conveying.equipment.hopper import (
    Flow as Flow,
    Hopper as Hopper,
    HopperFigures as HopperFigures,
)
from granum.conveying.equipment.pneumatic import (
    Blown as Blown,
    Conveyed as Conveyed,
    PneumaticConveyor as PneumaticConveyor,
    PneumaticFigures as PneumaticFigures,
)
from granum.conveying.equipment.slurry import (
    Delivered as Delivered,
    Pumped as Pumped,
    SlurryFigures as SlurryFigures,
    SlurryPipeline as SlurryPipeline,
)
from granum.conveying.equipment.thick_slurry import (
    ThickSlurryFigures as ThickSlurryFigures,
    ThickSlurryPipeline as ThickSlurryPipeline,
)
from granum.conveying.formulas.flowability import (
    TappedPowder as TappedPowder,
    hausner_ratio as hausner_ratio,
)
from granum.conveying.formulas.hoppers import (
    WallStresses as WallStresses,
    critical_strength as critical_strength,
    flow_factor_hopper as flow_factor_hopper,
    half_angle_mass_flow_cone as half_angle_mass_flow_cone,
    mass_flow_beverloo as mass_flow_beverloo,
    outlet_width_jenike as outlet_width_jenike,
    silo_stresses_janssen as silo_stresses_janssen,
    unconfined_strength as unconfined_strength,
)
from granum.conveying.formulas.non_newtonian import (
    friction_factor_darby_melson as friction_factor_darby_melson,
    friction_factor_dodge_metzner as friction_factor_dodge_metzner,
    hedstrom_number as hedstrom_number,
    pressure_gradient_bingham as pressure_gradient_bingham,
    pressure_gradient_herschel_bulkley as pressure_gradient_herschel_bulkley,
    pressure_gradient_power_law as pressure_gradient_power_law,
    reynolds_critical_ryan_johnson as reynolds_critical_ryan_johnson,
    reynolds_metzner_reed as reynolds_metzner_reed,
)
from granum.conveying.formulas.outlets import (
    mass_flow_johanson as mass_flow_johanson,
    outlet_velocity_carleton as outlet_velocity_carleton,
    rathole_diameter_jenike as rathole_diameter_jenike,
)
from granum.conveying.formulas.pipes import (
    friction_factor_churchill as friction_factor_churchill,
    pressure_gradient_pipe as pressure_gradient_pipe,
)
from granum.conveying.formulas.pneumatic import (
    particle_friction_factor_hinkle as particle_friction_factor_hinkle,
    particle_velocity_hinkle as particle_velocity_hinkle,
    pressure_drop_bend as pressure_drop_bend,
    pressure_gradient_solid_hinkle as pressure_gradient_solid_hinkle,
    pressure_gradient_solid_konno_saito as pressure_gradient_solid_konno_saito,
)
from granum.conveying.formulas.slurry import (
    deposition_velocity_durand as deposition_velocity_durand,
    deposition_velocity_wasp as deposition_velocity_wasp,
    deposition_velocity_wilson as deposition_velocity_wilson,
    pressure_gradient_slurry_durand as pressure_gradient_slurry_durand,
    pressure_gradient_slurry_wilson as pressure_gradient_slurry_wilson,
)
from granum.conveying.formulas.thresholds import (
    Choked as Choked,
    choking_punwani as choking_punwani,
    choking_yang as choking_yang,
    diameter_pneumatic as diameter_pneumatic,
    pickup_velocity_kalman as pickup_velocity_kalman,
    saltation_velocity_matsumoto as saltation_velocity_matsumoto,
    saltation_velocity_rizk as saltation_velocity_rizk,
    saltation_velocity_schade as saltation_velocity_schade,
    saltation_velocity_weber as saltation_velocity_weber,
)
from granum.conveying.lab_tests.flow_curve import (
    FlowCurveTest as FlowCurveTest,
)
from granum.conveying.lab_tests.shear_cell import (
    FlowFunction as FlowFunction,
    YieldLocus as YieldLocus,
)
