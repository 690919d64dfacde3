"""Porous media: permeability and packed beds."""

from granum.porous.charts import (
    pressure_drop_chart as pressure_drop_chart,
)
from granum.porous.formulas.darcy import (
    forchheimer_number as forchheimer_number,
    hydraulic_conductivity as hydraulic_conductivity,
    noncircularity_rectangle as noncircularity_rectangle,
    permeability_darcy as permeability_darcy,
    permeability_from_conductivity as permeability_from_conductivity,
    permeability_klinkenberg as permeability_klinkenberg,
    pressure_drop_darcy as pressure_drop_darcy,
    pressure_drop_forchheimer as pressure_drop_forchheimer,
    pressure_drop_poiseuille as pressure_drop_poiseuille,
    superficial_velocity_darcy as superficial_velocity_darcy,
    superficial_velocity_forchheimer as superficial_velocity_forchheimer,
)
from granum.porous.formulas.gas import (
    mass_flux_gas_bed as mass_flux_gas_bed,
    permeability_gas as permeability_gas,
    pressure_outlet_gas_bed as pressure_outlet_gas_bed,
)
from granum.porous.formulas.inverse import (
    particle_diameter_packed_bed as particle_diameter_packed_bed,
    pressure_drop_packed_bed as pressure_drop_packed_bed,
    superficial_velocity_packed_bed as superficial_velocity_packed_bed,
    void_fraction_packed_bed as void_fraction_packed_bed,
)
from granum.porous.formulas.kozeny import (
    KozenyBundle as KozenyBundle,
    kozeny_bundle as kozeny_bundle,
    particle_diameter_kozeny_carman as particle_diameter_kozeny_carman,
    permeability_blake_kozeny as permeability_blake_kozeny,
    permeability_carman as permeability_carman,
    permeability_davies as permeability_davies,
    permeability_happel as permeability_happel,
    permeability_kozeny_carman as permeability_kozeny_carman,
    permeability_obstacles as permeability_obstacles,
    permeability_rumpf_gupte as permeability_rumpf_gupte,
    specific_surface_kozeny_carman as specific_surface_kozeny_carman,
    specific_surface_mixture as specific_surface_mixture,
    void_fraction_kozeny_carman as void_fraction_kozeny_carman,
    wall_correction_coulson as wall_correction_coulson,
)
from granum.porous.formulas.non_newtonian import (
    dynamic_viscosity_bed_christopher_middleman as dynamic_viscosity_bed_christopher_middleman,
    dynamic_viscosity_permeable_christopher_middleman as dynamic_viscosity_permeable_christopher_middleman,
    pressure_gradient_yield_bed as pressure_gradient_yield_bed,
    superficial_velocity_bed_bingham as superficial_velocity_bed_bingham,
)
from granum.porous.formulas.packed_beds import (
    BedNumbers as BedNumbers,
    packed_bed_numbers as packed_bed_numbers,
    pressure_gradient_blake_kozeny as pressure_gradient_blake_kozeny,
    pressure_gradient_burke_plummer as pressure_gradient_burke_plummer,
    pressure_gradient_carman as pressure_gradient_carman,
    pressure_gradient_ergun as pressure_gradient_ergun,
    pressure_gradient_kozeny_carman as pressure_gradient_kozeny_carman,
    pressure_gradient_leva as pressure_gradient_leva,
    pressure_gradient_macdonald as pressure_gradient_macdonald,
    pressure_gradient_obstacles as pressure_gradient_obstacles,
)
from granum.porous.formulas.packed_beds_modern import (
    EisfeldSchnitzlein as EisfeldSchnitzlein,
    pressure_gradient_brauer as pressure_gradient_brauer,
    pressure_gradient_eisfeld_schnitzlein_spheres as pressure_gradient_eisfeld_schnitzlein_spheres,
    pressure_gradient_erdim as pressure_gradient_erdim,
    pressure_gradient_gibilaro as pressure_gradient_gibilaro,
    pressure_gradient_kta as pressure_gradient_kta,
    pressure_gradient_nemec_levec as pressure_gradient_nemec_levec,
    pressure_gradient_tallmadge as pressure_gradient_tallmadge,
)
from granum.porous.formulas.porosimetry import (
    pore_diameter_washburn as pore_diameter_washburn,
)
from granum.porous.formulas.porosity import (
    void_fraction_benyahia_oneill as void_fraction_benyahia_oneill,
    void_fraction_dixon as void_fraction_dixon,
    void_fraction_from_mass as void_fraction_from_mass,
)
from granum.porous.lab_tests.permeametry import (
    Permeametry as Permeametry,
)
from granum.porous.lab_tests.porosimetry import (
    MercuryPorosimetry as MercuryPorosimetry,
)
