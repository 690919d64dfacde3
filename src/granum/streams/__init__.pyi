"""Streams that carry solids, liquid and gas; abstract equipment; audits."""

from granum.streams.audit import (
    Closure as Closure,
)
from granum.streams.cake_course import (
    Stage as Stage,
)
from granum.streams.cake_maker import (
    CakeMaker as CakeMaker,
)
from granum.streams.cakes import (
    Filtered as Filtered,
)
from granum.streams.dissolution import (
    SaturatingWash as SaturatingWash,
)
from granum.streams.dusts import (
    DustData as DustData,
)
from granum.streams.equilibrium import (
    HumidMixture as HumidMixture,
)
from granum.streams.equipment.agglomerator import (
    Agglomerator as Agglomerator,
    AgglomeratorFigures as AgglomeratorFigures,
    Grid as Grid,
    Meetings as Meetings,
)
from granum.streams.equipment.basics import (
    Contents as Contents,
    Heated as Heated,
    Heater as Heater,
    HeaterFigures as HeaterFigures,
    Mixed as Mixed,
    Mixer as Mixer,
    Single as Single,
    SplitFigures as SplitFigures,
    Splitter as Splitter,
    StirredTank as StirredTank,
    TankFigures as TankFigures,
    TwoWays as TwoWays,
)
from granum.streams.equipment.humid_gas import (
    AdiabaticHumidifier as AdiabaticHumidifier,
    CondenserCooler as CondenserCooler,
    Cooled as Cooled,
    CoolerFigures as CoolerFigures,
    DehumidifyingCoil as DehumidifyingCoil,
    HumidFigures as HumidFigures,
    HumidMixer as HumidMixer,
    Humidified as Humidified,
    HumidifierFigures as HumidifierFigures,
    MixedGas as MixedGas,
)
from granum.streams.equipment.movers import (
    Fan as Fan,
    Moved as Moved,
    MoverFigures as MoverFigures,
    Pump as Pump,
)
from granum.streams.exchange import (
    Exchange as Exchange,
)
from granum.streams.feeding import (
    feed as feed,
)
from granum.streams.formulas.drives import (
    mass_flow_leakage_hei as mass_flow_leakage_hei,
    rotation_speed_zwietering as rotation_speed_zwietering,
    shaft_power_adiabatic as shaft_power_adiabatic,
    shaft_power_agitator as shaft_power_agitator,
    shaft_power_incompressible as shaft_power_incompressible,
    shaft_power_isothermal as shaft_power_isothermal,
)
from granum.streams.formulas.stirring import (
    Blades as Blades,
    Scaled as Scaled,
    Stirring as Stirring,
    heat_transfer_coefficient_stirred as heat_transfer_coefficient_stirred,
    scale_up_stirrer as scale_up_stirrer,
    stirring as stirring,
)
from granum.streams.from_materials import (
    GasProperty as GasProperty,
    Mixing as Mixing,
    SolutionViscosity as SolutionViscosity,
    mixture_of as mixture_of,
)
from granum.streams.holdup import (
    Held as Held,
)
from granum.streams.inside_charts import (
    Axis as Axis,
    Curve as Curve,
    Mark as Mark,
)
from granum.streams.mixture import (
    Mixture as Mixture,
    Species as Species,
)
from granum.streams.stirrers import (
    Agitation as Agitation,
)
from granum.streams.stream import (
    Stream as Stream,
    Summary as Summary,
)
from granum.streams.turnover import (
    Turnover as Turnover,
)
from granum.streams.units import (
    Check as Check,
    Dynamic as Dynamic,
    Operated as Operated,
    Sheet as Sheet,
    Unit as Unit,
)
