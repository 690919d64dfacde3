"""Dust in gas: bag filters, scrubbers, electrostatic precipitators, settling chambers, emissions."""

from granum.dust.dusts import (
    Explosibility as Explosibility,
    dust_explosibility as dust_explosibility,
)
from granum.dust.equipment.air_filter import (
    AirFilter as AirFilter,
    AirFilterFigures as AirFilterFigures,
    Fibered as Fibered,
)
from granum.dust.equipment.bag_filter import (
    BagFigures as BagFigures,
    BagFilter as BagFilter,
    Bagged as Bagged,
)
from granum.dust.equipment.collector import (
    Cleaned as Cleaned,
    Collector as Collector,
    Seen as Seen,
)
from granum.dust.equipment.hood import (
    Drawn as Drawn,
    Extracted as Extracted,
    ExtractionHood as ExtractionHood,
    HoodFigures as HoodFigures,
)
from granum.dust.equipment.mesh_pad import (
    Demisted as Demisted,
    MeshFigures as MeshFigures,
    MeshPad as MeshPad,
    Meshed as Meshed,
)
from granum.dust.equipment.precipitator import (
    Charged as Charged,
    ElectrostaticPrecipitator as ElectrostaticPrecipitator,
    PrecipitatorFigures as PrecipitatorFigures,
)
from granum.dust.equipment.settling_chamber import (
    ChamberFigures as ChamberFigures,
    Fallen as Fallen,
    SettlingChamber as SettlingChamber,
)
from granum.dust.equipment.towers import (
    PackedScrubber as PackedScrubber,
    ScrubbingTower as ScrubbingTower,
    SprayTower as SprayTower,
    TowerFigures as TowerFigures,
)
from granum.dust.equipment.venturi import (
    VenturiFigures as VenturiFigures,
    VenturiScrubber as VenturiScrubber,
)
from granum.dust.equipment.washer import (
    Scrubbed as Scrubbed,
    Washed as Washed,
    Washer as Washer,
)
from granum.dust.formulas.bags import (
    residual_drag_pulse_jet as residual_drag_pulse_jet,
)
from granum.dust.formulas.chambers import (
    grade_efficiency_chamber_laminar as grade_efficiency_chamber_laminar,
    grade_efficiency_chamber_turbulent as grade_efficiency_chamber_turbulent,
)
from granum.dust.formulas.emission import (
    emission_concentration as emission_concentration,
)
from granum.dust.formulas.explosion import (
    inert_gas_flow_steady as inert_gas_flow_steady,
    oxygen_permitted_nfpa69 as oxygen_permitted_nfpa69,
    vent_area_en14491 as vent_area_en14491,
    vent_area_nfpa68 as vent_area_nfpa68,
)
from granum.dust.formulas.precipitation import (
    elementary_charges_diffusion as elementary_charges_diffusion,
    elementary_charges_field as elementary_charges_field,
    grade_efficiency_deutsch as grade_efficiency_deutsch,
    migration_velocity as migration_velocity,
    removal_efficiency_matts_ohnfeldt as removal_efficiency_matts_ohnfeldt,
)
from granum.dust.formulas.scrubbers import (
    contacting_power as contacting_power,
    droplet_diameter_venturi as droplet_diameter_venturi,
    grade_efficiency_johnstone as grade_efficiency_johnstone,
    grade_efficiency_mesh as grade_efficiency_mesh,
    grade_efficiency_packed_scrubber as grade_efficiency_packed_scrubber,
    grade_efficiency_spray_tower as grade_efficiency_spray_tower,
    impaction_number as impaction_number,
    pressure_drop_venturi as pressure_drop_venturi,
    removal_efficiency_semrau as removal_efficiency_semrau,
    target_efficiency_drop as target_efficiency_drop,
    target_efficiency_wire as target_efficiency_wire,
)
from granum.dust.vents import (
    ExplosionVent as ExplosionVent,
)
