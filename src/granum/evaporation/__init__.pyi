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
    MultipleEffectEvaporator as MultipleEffectEvaporator,
    Train as Train,
    TrainFigures as TrainFigures,
)
