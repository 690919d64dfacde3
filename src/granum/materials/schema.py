"""What a materials file may contain: TOML tables ``[fluid.NAME]``, ``[solid.NAME]``, ``[solute.NAME]``,
``[salt.NAME]``, checked with Pydantic.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from granum.core.conversion import convert
from granum.core.documents import wrong_sort
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.written import read_number


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


def _in_si(given: Any) -> Any:
    """A molar mass as a number, or as text with its unit."""
    return convert(given, Parameter("molar_mass", KINDS["MolarMass"])) if isinstance(given, str) else given


MolarMass = Annotated[float, BeforeValidator(_in_si), Field(gt=0, lt=10)]


class PropertyEntry(_Strict):
    """One property: a constant ``value``, or a ``form`` with ``coefficients``; ``range`` in K; ``unit`` of
    the printed value. A constant may stand alone, as text with its unit or as a number in SI.
    """

    value: float | None = None
    form: str | None = None
    coefficients: list[float] | None = None
    range: tuple[float, float] | None = None
    unit: str = ""
    source: str

    @model_validator(mode="before")
    @classmethod
    def _alone(cls, given: Any) -> Any:
        if isinstance(given, bool) or not isinstance(given, (str, int, float)):
            return given
        number, unit = (given, "") if not isinstance(given, str) else read_number(given) or (None, "")
        if number is None:
            raise ValueError(_("write a constant as a number with its unit, such as '1400 kg/m3'"))
        return {"value": number, "unit": unit, "source": "stated"}

    @model_validator(mode="after")
    def _one_way(self) -> PropertyEntry:
        if (self.value is None) == (self.form is None):
            raise ValueError("give either 'value' or 'form'")
        if self.form is not None and self.range is None:
            raise ValueError("a 'form' needs the 'range' of temperature, in K, that it was fitted over")
        if self.range is not None and not 0.0 < self.range[0] < self.range[1]:
            raise ValueError("'range' is two increasing temperatures in K")
        return self


class _Named(_Strict):
    fr: str = ""
    aliases: list[str] = []
    formula: str = ""


class CombustionEntry(_Strict):
    """What a kilogram of a fuel takes and gives when it burns: dry air needed and water formed, kg; lower
    heating value at 25 °C, J/kg.
    """

    air: float = Field(gt=0)
    water: float = Field(ge=0)
    lower_heating_value: float = Field(gt=0)
    source: str


class FlammabilityEntry(_Strict):
    """Of a vapor in ambient air, mole fractions: lower explosive limit, and the oxygen below which no mixture
    with nitrogen burns.
    """

    lower_limit: float = Field(gt=0, lt=1)
    limiting_oxygen: float | None = Field(default=None, gt=0, lt=0.21)
    source: str


class FluidEntry(_Named):
    """A pure fluid. Every property is optional: what is missing says so when it is asked for."""

    molar_mass: MolarMass
    critical_temperature: float | None = Field(default=None, gt=0)
    critical_pressure: float | None = Field(default=None, gt=0)
    diffusion_volume: float | None = Field(default=None, gt=0)
    liquid_density: PropertyEntry | None = None
    liquid_viscosity: PropertyEntry | None = None
    liquid_heat_capacity: PropertyEntry | None = None
    liquid_conductivity: PropertyEntry | None = None
    surface_tension: PropertyEntry | None = None
    vapor_pressure: PropertyEntry | None = None
    heat_of_vaporization: PropertyEntry | None = None
    vapor_heat_capacity: PropertyEntry | None = None
    vapor_viscosity: PropertyEntry | None = None
    vapor_conductivity: PropertyEntry | None = None
    combustion: CombustionEntry | None = None
    flammability: FlammabilityEntry | None = None


class SolidEntry(_Named):
    """A solid."""

    molar_mass: MolarMass | None = None
    sphericity: float | None = Field(default=None, gt=0, le=1)
    mohs_hardness: float | None = Field(default=None, ge=0, le=10)
    dust: str = ""
    """Which tested dust it burns like, of the table of dusts."""
    density: PropertyEntry | None = None
    heat_capacity: PropertyEntry | None = None
    conductivity: PropertyEntry | None = None
    sublimation_pressure: PropertyEntry | None = None


class BranchEntry(_Strict):
    """One crystal: which solid, how many moles of solvent it binds, where it is stable (K), its solubility
    and in what basis.
    """

    crystal: str
    bound_solvent: float = Field(default=0.0, ge=0)
    stable: tuple[float, float]
    basis: str
    factor: float = 1.0
    form: str
    coefficients: list[float] | None = None
    range: tuple[float, float]
    source: str
    heat_of_solution: float | None = None
    """J per mol of anhydrous solute dissolved at 25 °C, negative when heat is released on dissolving."""
    heat_at_saturation: float | None = None
    """J per mol of anhydrous solute dissolved in the saturated solution at 25 °C, where it is better known
    than by the slope of the solubility.
    """
    heat_source: str = ""
    table: list[tuple[float, float]] = []
    """Printed values: temperature in °C, rising, and percent by mass of anhydrous solute. The form ``table``
    goes through them.
    """

    @model_validator(mode="after")
    def _curve(self) -> BranchEntry:
        rising = all(a[0] < b[0] for a, b in pairwise(self.table))
        if not rising or any(not 0.0 < percent < 100.0 for _t, percent in self.table):
            raise ValueError("'table' has rising temperatures in °C and percents by mass between 0 and 100")
        if self.form == "table" and (
            len(self.table) < 3
            or self.coefficients is not None
            or self.basis != "kg anhydrous per kg solvent"
        ):
            raise ValueError(
                "the form 'table' needs a 'table' of three points or more, the basis 'kg anhydrous per "
                "kg solvent' and no 'coefficients'"
            )
        return self


class ActivityEntry(_Strict):
    """Water activity of the solutions: ``form`` is "pitzer", "starzak_peacock", "olsson" or
    "raoult". Each Pitzer
    parameter is one number at all temperatures, eight coefficients of Møller's function of temperature, or
    ten: then those of 1/T² and ln(T - 225) follow. Raoult's law takes the ``ions`` of a molecule.
    """

    form: Literal["pitzer", "starzak_peacock", "olsson", "raoult"]
    ions: int = Field(default=1, ge=1, le=8)
    counts: tuple[int, int] = (1, 1)
    charges: tuple[int, int] = (1, 1)
    beta_zero: list[float] = []
    beta_one: list[float] = []
    beta_two: list[float] = [0.0]
    c_phi: list[float] = []
    exponents: tuple[float, float] | None = None
    """With which beta one and two fade: 2 and 12, or 1.4 and 12 of ions that pair, where none are given."""
    beside: ActivityEntry | None = None
    """Another set of Pitzer parameters, taken beside the ions of other salts."""
    range: tuple[float, float] = (273.15, 423.15)
    molality: float = Field(default=0.0, ge=0, description="largest, mol per kg of water")
    source: str

    @model_validator(mode="after")
    def _whole(self) -> ActivityEntry:
        sets = (self.beta_zero, self.beta_one, self.beta_two, self.c_phi)
        if self.form == "pitzer" and (self.molality <= 0.0 or any(len(a) not in (1, 8, 10) for a in sets)):
            raise ValueError(
                "the form 'pitzer' needs 'beta_zero', 'beta_one' and 'c_phi' of one, eight or ten numbers, "
                "and the largest 'molality'"
            )
        return self


class SoluteEntry(_Named):
    """A solute in a solvent."""

    molar_mass: MolarMass
    solvent: str = "water"
    form_of: str = Field(
        default="",
        description="the solute, in the same solvent, of which this is another crystal form: its crystals "
        "then dissolve to that one",
    )
    branches: list[BranchEntry] = Field(min_length=1)
    density: list[float] | None = Field(default=None, min_length=5, max_length=5)
    viscosity: list[float] | None = Field(default=None, min_length=6, max_length=6)
    heat_capacity: list[float] | None = Field(default=None, min_length=6, max_length=6)
    density_limits: list[float] | None = Field(
        default=None, min_length=3, max_length=3, description="K, K, largest mass fraction of solute"
    )
    viscosity_limits: list[float] | None = Field(default=None, min_length=3, max_length=3)
    thick_viscosity: Literal["genotelle"] | None = Field(
        default=None, description="law of solutions too thick for the coefficients of 'viscosity'"
    )
    viscosity_b: float | None = Field(default=None, description="Jones and Dole's coefficient, L/mol")
    heat_capacity_limits: list[float] | None = Field(default=None, min_length=3, max_length=3)
    water_activity: ActivityEntry | None = None
    mixing: Literal["olsson", "activity"] | None = Field(
        default=None,
        description="law of the enthalpy of the solutions, which holds their heat of dilution; "
        "'activity': by the change of 'water_activity' with temperature",
    )
    mixing_from: float = Field(default=0.0, ge=0, description="coldest of 'mixing', K")

    @model_validator(mode="after")
    def _olsson_for_lye(self) -> SoluteEntry:
        activity = self.water_activity is not None and self.water_activity.form == "olsson"
        if (activity or self.mixing == "olsson") and (self.formula, self.solvent) != ("NaOH", "water"):
            raise ValueError("'olsson' is a law of NaOH in water: leave it out")
        return self

    @model_validator(mode="after")
    def _mixing_by_activity(self) -> SoluteEntry:
        if self.mixing == "activity" and (
            self.water_activity is None or self.water_activity.form != "pitzer" or self.solvent != "water"
        ):
            raise ValueError("'mixing' by 'activity' needs a 'water_activity' of the form 'pitzer' in water")
        return self

    @model_validator(mode="after")
    def _one_after_another(self) -> SoluteEntry:
        ends = [t for b in self.branches for t in b.stable]
        if any(a >= b for a, b in zip(ends[::2], ends[1::2], strict=True)) or ends[1:-1:2] != ends[2::2]:
            raise ValueError("the 'stable' ranges of the branches must follow one another without gap, in K")
        return self


class IonEntry(_Strict):
    """One ion of a salt: name, how many in the formula, signed charge number."""

    name: str
    count: int = Field(gt=0)
    charge: int


class SaltEntry(_Named):
    """A sparingly soluble salt."""

    cation: IonEntry
    anion: IonEntry
    solubility_product: float = Field(gt=0)
    enthalpy_of_dissolution: float | None = None
    source: str

    @model_validator(mode="after")
    def _neutral(self) -> SaltEntry:
        if self.cation.count * self.cation.charge + self.anion.count * self.anion.charge != 0:
            raise ValueError("the charges of the ions must add up to zero")
        return self


class MaterialsFile(_Strict):
    """A whole file."""

    fluid: dict[str, FluidEntry] = {}
    solid: dict[str, SolidEntry] = {}
    solute: dict[str, SoluteEntry] = {}
    salt: dict[str, SaltEntry] = {}


def _fields_of(table: list[str]) -> list[str]:
    """The keys that a table of materials may have."""
    sorts = MaterialsFile.model_fields
    if not table:
        return list(sorts)
    if len(table) == 2:
        return list(get_args(sorts[table[0]].annotation)[1].model_fields)
    return list((BranchEntry if "branches" in table else PropertyEntry).model_fields)


def read_materials(content: dict[str, Any], where: str) -> MaterialsFile:
    """The checked tables of materials, or one clear error that says where they stand."""
    try:
        return MaterialsFile.model_validate(content)
    except ValidationError as problem:
        first = problem.errors()[0]
        *table, key = map(str, first["loc"])
        place = ".".join((*table, key))
        if first["type"] == "extra_forbidden":
            told = _("in [{place}]").format(place=".".join(table))
            raise unknown_name(_("Key"), key, _fields_of(table), f"{told} ({where})") from problem
        if first["type"] == "missing":
            raise InputError(
                _("{name}: '{place}' is missing.").format(name=where, place=place), place=place
            ) from problem
        if first["type"] != "value_error":
            raise InputError(f"{where}: {wrong_sort(first)}", place=place) from problem
        raise InputError(
            _("{name}: '{place}': {reason}.").format(
                name=where, place=place, reason=first["msg"].removeprefix("Value error, ")
            ),
            place=place,
        ) from problem
