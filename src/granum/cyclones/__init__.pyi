"""Gas cyclones and hydrocyclones."""

from granum.cyclones.charts import (
    cyclone_distributions_chart as cyclone_distributions_chart,
    gas_cyclone_chart as gas_cyclone_chart,
)
from granum.cyclones.drawing import (
    cyclone_drawing as cyclone_drawing,
)
from granum.cyclones.equipment.gas import (
    CycloneFigures as CycloneFigures,
    CycloneOutlets as CycloneOutlets,
    GasCyclone as GasCyclone,
    Swirl as Swirl,
)
from granum.cyclones.equipment.liquid import (
    Hydrocyclone as Hydrocyclone,
    Split as Split,
    SplitFigures as SplitFigures,
)
from granum.cyclones.formulas.efficiency import (
    configuration_number_leith_licht as configuration_number_leith_licht,
    cut_size_barth as cut_size_barth,
    cut_size_lapple as cut_size_lapple,
    cut_size_muschelknautz as cut_size_muschelknautz,
    cut_size_turns as cut_size_turns,
    cyclone_efficiency_barth as cyclone_efficiency_barth,
    cyclone_efficiency_lapple as cyclone_efficiency_lapple,
    cyclone_efficiency_leith_licht as cyclone_efficiency_leith_licht,
    cyclone_efficiency_muschelknautz as cyclone_efficiency_muschelknautz,
    limit_loading_muschelknautz as limit_loading_muschelknautz,
    turn_number_lapple as turn_number_lapple,
    vortex_exponent_alexander as vortex_exponent_alexander,
)
from granum.cyclones.formulas.erosion import (
    indentation_hardness_mohs as indentation_hardness_mohs,
    wear_velocity_cyclone_inlet as wear_velocity_cyclone_inlet,
    wear_velocity_finnie as wear_velocity_finnie,
)
from granum.cyclones.formulas.hydrocyclones import (
    HydrocycloneFigures as HydrocycloneFigures,
    cut_size_rietema as cut_size_rietema,
    hydrocyclone_castilho_medronho as hydrocyclone_castilho_medronho,
    hydrocyclone_efficiency as hydrocyclone_efficiency,
    hydrocyclone_plitt as hydrocyclone_plitt,
)
from granum.cyclones.formulas.mothes import (
    cyclone_efficiency_mothes_loffler as cyclone_efficiency_mothes_loffler,
)
from granum.cyclones.formulas.overall import (
    cut_size_stairmand as cut_size_stairmand,
    removal_efficiency_grades as removal_efficiency_grades,
    terminal_velocity_retained_stairmand as terminal_velocity_retained_stairmand,
)
from granum.cyclones.formulas.pressure import (
    inlet_heads_casal_martinez as inlet_heads_casal_martinez,
    inlet_heads_ramachandran as inlet_heads_ramachandran,
    inlet_heads_shepherd_lapple as inlet_heads_shepherd_lapple,
    inlet_heads_stairmand as inlet_heads_stairmand,
    loading_factor_briggs as loading_factor_briggs,
    pressure_drop_barth as pressure_drop_barth,
    pressure_drop_muschelknautz as pressure_drop_muschelknautz,
    saltation_velocity_kalen_zenz as saltation_velocity_kalen_zenz,
)
from granum.cyclones.formulas.similar import (
    cut_size_similar as cut_size_similar,
    diameter_similar as diameter_similar,
    pressure_drop_similar as pressure_drop_similar,
)
from granum.cyclones.geometry import (
    Dimensions as Dimensions,
    FreeCyclone as FreeCyclone,
    StandardCyclone as StandardCyclone,
)
from granum.cyclones.sizing import (
    CycloneSize as CycloneSize,
    HydrocycloneSize as HydrocycloneSize,
    cyclone_sizing as cyclone_sizing,
    hydrocyclone_sizing as hydrocyclone_sizing,
)
from granum.cyclones.total import (
    CyclonePlant as CyclonePlant,
    cyclone_for_efficiency as cyclone_for_efficiency,
)
