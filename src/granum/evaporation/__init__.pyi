"""Evaporators: one effect or many, with vapor recompression, crystallizing or not."""

from granum.evaporation.boiling import (
    Effect as Effect,
    Forming as Forming,
    Liquor as Liquor,
)
from granum.evaporation.equipment.evaporator import (
    Evaporated as Evaporated,
    Evaporator as Evaporator,
    EvaporatorFigures as EvaporatorFigures,
    Heating as Heating,
    Recompressed as Recompressed,
    RecompressionEvaporator as RecompressionEvaporator,
)
from granum.evaporation.equipment.multiple_effect import (
    FromTrain as FromTrain,
    JetFigures as JetFigures,
    MultipleEffectEvaporator as MultipleEffectEvaporator,
    SteamJetEvaporator as SteamJetEvaporator,
    Suction as Suction,
    Train as Train,
    TrainFigures as TrainFigures,
)
from granum.evaporation.formulas.steam_jet import (
    motive_steam_ratio_el_dessouky as motive_steam_ratio_el_dessouky,
)
