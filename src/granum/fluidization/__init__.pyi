"""Fluidized beds."""

from granum.fluidization.curve import (
    PressureVelocity as PressureVelocity,
    geldart_chart as geldart_chart,
    grace_chart as grace_chart,
    pressure_velocity as pressure_velocity,
    pressure_velocity_chart as pressure_velocity_chart,
)
from granum.fluidization.equipment.bed import (
    BedFigures as BedFigures,
    BedOutlets as BedOutlets,
    Blown as Blown,
    FluidizedBed as FluidizedBed,
)
from granum.fluidization.equipment.liquid import (
    LiquidBedFigures as LiquidBedFigures,
    LiquidFluidizedBed as LiquidFluidizedBed,
    LiquidOutlets as LiquidOutlets,
)
from granum.fluidization.formulas.bubbles import (
    bubble_diameter_darton as bubble_diameter_darton,
    bubble_diameter_maximum_stable as bubble_diameter_maximum_stable,
    bubble_diameter_mori_wen as bubble_diameter_mori_wen,
    bubble_diameter_werther as bubble_diameter_werther,
    bubble_exchange_rate as bubble_exchange_rate,
    bubble_exchange_rate_cloud as bubble_exchange_rate_cloud,
    bubble_exchange_rate_emulsion as bubble_exchange_rate_emulsion,
    bubble_fraction_davidson_harrison as bubble_fraction_davidson_harrison,
    bubble_rise_velocity_davidson_harrison as bubble_rise_velocity_davidson_harrison,
    bubble_rise_velocity_single as bubble_rise_velocity_single,
)
from granum.fluidization.formulas.expansion import (
    GradedBed as GradedBed,
    bed_void_fraction_from_pressure_drop as bed_void_fraction_from_pressure_drop,
    bed_void_fraction_riba as bed_void_fraction_riba,
    bed_void_fraction_richardson_zaki as bed_void_fraction_richardson_zaki,
    bed_void_fraction_wen_yu as bed_void_fraction_wen_yu,
    expansion_exponent as expansion_exponent,
    graded_bed_expansion as graded_bed_expansion,
    height_expanded as height_expanded,
    pressure_drop_fluidized_bed as pressure_drop_fluidized_bed,
)
from granum.fluidization.formulas.freeboard import (
    disengaging_height_amitin as disengaging_height_amitin,
    disengaging_height_fournol as disengaging_height_fournol,
    disengaging_height_fung as disengaging_height_fung,
    disengaging_height_horio as disengaging_height_horio,
    disengaging_height_pemberton as disengaging_height_pemberton,
    disengaging_height_smolders as disengaging_height_smolders,
    elutriation_flux_colakyan_levenspiel as elutriation_flux_colakyan_levenspiel,
    elutriation_flux_geldart as elutriation_flux_geldart,
    elutriation_flux_lin as elutriation_flux_lin,
    elutriation_flux_tasirin_geldart as elutriation_flux_tasirin_geldart,
    elutriation_flux_wen_hashinger as elutriation_flux_wen_hashinger,
    elutriation_flux_zenz_weil as elutriation_flux_zenz_weil,
    entrainment_flux_freeboard as entrainment_flux_freeboard,
)
from granum.fluidization.formulas.heat import (
    Distributor as Distributor,
    distributor_design as distributor_design,
    heat_transfer_coefficient_packet as heat_transfer_coefficient_packet,
    heat_transfer_coefficient_zabrodsky as heat_transfer_coefficient_zabrodsky,
    nusselt_number_gunn as nusselt_number_gunn,
    nusselt_number_kothari as nusselt_number_kothari,
    superficial_velocity_best_heat_transfer as superficial_velocity_best_heat_transfer,
)
from granum.fluidization.formulas.minimum import (
    minimum_fluidization_velocity_babu as minimum_fluidization_velocity_babu,
    minimum_fluidization_velocity_bourgeois_grenier as minimum_fluidization_velocity_bourgeois_grenier,
    minimum_fluidization_velocity_chitester as minimum_fluidization_velocity_chitester,
    minimum_fluidization_velocity_grace as minimum_fluidization_velocity_grace,
    minimum_fluidization_velocity_richardson as minimum_fluidization_velocity_richardson,
    minimum_fluidization_velocity_saxena_vogel as minimum_fluidization_velocity_saxena_vogel,
    minimum_fluidization_velocity_thonglimp as minimum_fluidization_velocity_thonglimp,
    minimum_fluidization_velocity_thonglimp_fine as minimum_fluidization_velocity_thonglimp_fine,
    minimum_fluidization_velocity_wen_yu as minimum_fluidization_velocity_wen_yu,
)
from granum.fluidization.formulas.minimum_beds import (
    minimum_fluidization_velocity_ergun as minimum_fluidization_velocity_ergun,
    minimum_fluidization_velocity_kozeny_carman as minimum_fluidization_velocity_kozeny_carman,
    minimum_fluidization_velocity_leva as minimum_fluidization_velocity_leva,
)
from granum.fluidization.formulas.minimum_powers import (
    minimum_bubbling_velocity_abrahamsen_geldart as minimum_bubbling_velocity_abrahamsen_geldart,
    minimum_fluidization_velocity_baeyens_geldart as minimum_fluidization_velocity_baeyens_geldart,
    minimum_fluidization_velocity_leva_power as minimum_fluidization_velocity_leva_power,
    minimum_fluidization_velocity_riba as minimum_fluidization_velocity_riba,
)
from granum.fluidization.formulas.regimes import (
    GraceCoordinates as GraceCoordinates,
    bubbling_number as bubbling_number,
    entrainment_onset_velocity_bi_grace as entrainment_onset_velocity_bi_grace,
    grace_coordinates as grace_coordinates,
    minimum_slugging_velocity as minimum_slugging_velocity,
    slug_rise_velocity as slug_rise_velocity,
    slugging_height as slugging_height,
    turbulent_onset_velocity_bi_grace as turbulent_onset_velocity_bi_grace,
)
from granum.fluidization.formulas.spouting import (
    bed_depth_cone_cylinder as bed_depth_cone_cylinder,
    minimum_spouting_velocity_mathur_gishler as minimum_spouting_velocity_mathur_gishler,
    spoutable_depth_mcnab_bridgwater as spoutable_depth_mcnab_bridgwater,
    spouting_pressure_drop_lefroy_davidson as spouting_pressure_drop_lefroy_davidson,
    starting_pressure_drop_asenjo as starting_pressure_drop_asenjo,
)
from granum.fluidization.formulas.two_phase import (
    TwoPhaseBed as TwoPhaseBed,
    two_phase_bed as two_phase_bed,
    unconverted_fraction_davidson_harrison as unconverted_fraction_davidson_harrison,
)
from granum.fluidization.lab_tests.pressure_curve import (
    PressureCurve as PressureCurve,
)
from granum.fluidization.ranking import (
    ElutriationSpread as ElutriationSpread,
    FluidizationSpread as FluidizationSpread,
    GeldartGroup as GeldartGroup,
    Regime as Regime,
    Spread as Spread,
    disengaging_height_spread as disengaging_height_spread,
    elutriation_spread as elutriation_spread,
    fluidization_regime as fluidization_regime,
    geldart_group as geldart_group,
    minimum_fluidization_spread as minimum_fluidization_spread,
)
