"""Kinds, cards, registry, flags, errors, units at the edge, glossary and languages. Knows no engineering."""

from granum.core.cards import (
    Card as Card,
)
from granum.core.declarations import (
    equipment as equipment,
    lab_test as lab_test,
    law as law,
)
from granum.core.flags import (
    impossible as impossible,
    limit_active as limit_active,
    unconverged as unconverged,
    watch as watch,
)
from granum.core.formulas import (
    Formula as Formula,
    formula as formula,
)
from granum.core.parameters import (
    Parameter as Parameter,
)
from granum.core.procedures import (
    chart as chart,
    procedure as procedure,
)
from granum.core.results import (
    Result as Result,
)
from granum.core.steps import (
    record_steps as record_steps,
)
