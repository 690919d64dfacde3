"""Comminution and screening."""

from granum.comminution.batch import (
    GroundTable as GroundTable,
    ground_fractions as ground_fractions,
)
from granum.comminution.breakage import (
    AustinBreakage as AustinBreakage,
    AustinSelection as AustinSelection,
    BreakageFunction as BreakageFunction,
    BroadbentCallcottBreakage as BroadbentCallcottBreakage,
    SelectionFunction as SelectionFunction,
    WhitenClassification as WhitenClassification,
    selection_rate_herbst_fuerstenau as selection_rate_herbst_fuerstenau,
)
from granum.comminution.equipment.mills import (
    BallMill as BallMill,
    BondMill as BondMill,
    ConeCrusher as ConeCrusher,
    CrusherFigures as CrusherFigures,
    Ground as Ground,
    MillFigures as MillFigures,
)
from granum.comminution.equipment.screens import (
    DoubleDeckScreen as DoubleDeckScreen,
    Screen as Screen,
    ScreenFigures as ScreenFigures,
    Screened as Screened,
    ThreeDeckFigures as ThreeDeckFigures,
    ThreeDecks as ThreeDecks,
    TripleDeckScreen as TripleDeckScreen,
    TwoDeckFigures as TwoDeckFigures,
    TwoDecks as TwoDecks,
)
from granum.comminution.equipment.vibrating_screen import (
    VibratingScreen as VibratingScreen,
    VibratingScreenFigures as VibratingScreenFigures,
)
from granum.comminution.formulas.energy import (
    LawAdvice as LawAdvice,
    energy_law as energy_law,
    product_size_bond as product_size_bond,
    reduction_ratio as reduction_ratio,
    shaft_power_comminution as shaft_power_comminution,
    specific_energy_bond as specific_energy_bond,
    specific_energy_hukki as specific_energy_hukki,
    specific_energy_kick as specific_energy_kick,
    specific_energy_morrell as specific_energy_morrell,
    specific_energy_rittinger as specific_energy_rittinger,
    specific_energy_rittinger_surface as specific_energy_rittinger_surface,
    specific_energy_walker as specific_energy_walker,
    work_index_ball_mill_test as work_index_ball_mill_test,
    work_index_operating as work_index_operating,
)
from granum.comminution.formulas.machines import (
    ball_diameter_bond as ball_diameter_bond,
    feed_size_rolls as feed_size_rolls,
    mill_filling as mill_filling,
    nip_angle_rolls as nip_angle_rolls,
    roll_diameter_rolls as roll_diameter_rolls,
    rotation_speed_critical as rotation_speed_critical,
    volume_flow_rolls as volume_flow_rolls,
)
from granum.comminution.formulas.rowland import (
    MillDesign as MillDesign,
    efficiency_factor_diameter as efficiency_factor_diameter,
    efficiency_factor_fineness as efficiency_factor_fineness,
    efficiency_factor_low_ratio as efficiency_factor_low_ratio,
    efficiency_factor_open_circuit as efficiency_factor_open_circuit,
    efficiency_factor_oversize as efficiency_factor_oversize,
    efficiency_factor_rod_ratio as efficiency_factor_rod_ratio,
    mill_power_bond as mill_power_bond,
)
from granum.comminution.formulas.screen_capacity import (
    cut_size_karra as cut_size_karra,
    screen_area_karra as screen_area_karra,
    screening_capacity_karra as screening_capacity_karra,
    throughfall_aperture as throughfall_aperture,
)
from granum.comminution.formulas.screening import (
    circulating_load as circulating_load,
    product_yield as product_yield,
    screening_effectiveness as screening_effectiveness,
    screening_recovery as screening_recovery,
    screening_rejection as screening_rejection,
)
from granum.comminution.lab_tests.batch_grinding import (
    BatchGrinding as BatchGrinding,
)
from granum.comminution.lab_tests.grinding_kinetics import (
    GrindingKinetics as GrindingKinetics,
)
from granum.comminution.lab_tests.partition_test import (
    PartitionTest as PartitionTest,
)
from granum.comminution.population import (
    LargeAndTwoSmall as LargeAndTwoSmall,
    PlugFlow as PlugFlow,
    ResidenceTimeLaw as ResidenceTimeLaw,
    TanksInSeries as TanksInSeries,
)
from granum.comminution.selection import (
    Mills as Mills,
    mill_choice as mill_choice,
)
from granum.comminution.transients import (
    MillResponse as MillResponse,
    mill_response as mill_response,
)
from granum.comminution.work_indices import (
    work_index as work_index,
)
