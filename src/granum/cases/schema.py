"""The shape of a case file. JSON Schema for editors comes from here: ``Case.model_json_schema()``."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field, StrictFloat, StrictInt

Quantity = str | StrictFloat | StrictInt  # yes and no are no numbers


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Sizes(_Strict):
    """Particle size classes shared by all streams: geometric between two sizes, or given boundaries."""

    smallest: Quantity | None = None
    largest: Quantity | None = None
    classes: int = Field(default=40, ge=1, le=2000)
    boundaries: str | list[Quantity] | None = None


class Axis(_Strict):
    """A further attribute of the particles: its class boundaries (plain numbers, SI)."""

    boundaries: list[float]


class MixtureTable(_Strict):
    """What the streams are made of, by material name."""

    liquids: list[str] = []
    solids: list[str] = []
    gases: list[str] = []
    sizes: Sizes = Sizes(smallest="1 um", largest="10 mm")
    axes: dict[str, Axis] = {}
    materials: list[str] = Field(
        default=[], description="TOML files of own materials, relative to the case file"
    )


class SizeTable(BaseModel):
    """Size distribution of a feed: a law with its parameters, or mass fractions per class."""

    model_config = ConfigDict(extra="allow")
    law: str | None = None
    fractions: list[float] | None = None


class FeedTable(_Strict):
    """A stream entering from outside. Shares are mass fractions within the phase; flows are of the whole
    phase.
    """

    to: str
    temperature: Quantity = "25 degC"
    pressure: Quantity = "1 atm"
    mass_flow: Quantity | None = Field(
        default=None, description="solid and liquid together, divided by 'solids_mass_fraction'"
    )
    solids_mass_fraction: Quantity | None = None
    moisture_dry_basis: Quantity | None = Field(
        default=None, description="liquid per mass of dry solid, in place of 'liquid_flow'"
    )
    moisture_wet_basis: Quantity | None = Field(
        default=None, description="liquid per mass of wet solid, in place of 'liquid_flow'"
    )
    liquid_flow: Quantity | None = None
    liquid: dict[str, Quantity] = {}
    solid_flow: Quantity | None = None
    solid: dict[str, Quantity] = {}
    gas_flow: Quantity | None = None
    gas: dict[str, Quantity] = {}
    relative_humidity: Quantity | None = Field(
        default=None, description="of a gas feed: sets its vapor; 'gas_flow' is then dry gas"
    )
    humidity_ratio: Quantity | None = Field(
        default=None, description="vapor per dry gas, in place of 'relative_humidity'"
    )
    wet_bulb_temperature: Quantity | None = Field(
        default=None, description="of a gas feed, in place of 'relative_humidity'"
    )
    dew_point_temperature: Quantity | None = Field(
        default=None, description="of a gas feed, in place of 'relative_humidity'"
    )
    sizes: SizeTable | None = None


class StreamTable(_Strict):
    """A connection: ``from`` and ``to`` as unit.port; a port may be left out when there is only one."""

    origin: str = Field(alias="from")
    target: str = Field(alias="to", default="")


class Specification(_Strict):
    """A design specification: vary one parameter so that one result takes a value."""

    vary: str = Field(description="unit.parameter, or a figure of a feed such as feed.gas_flow")
    so_that: str = Field(
        description="unit.result, or a figure of a stream by its name or its outlet, such as "
        "dryer.product.moisture_dry_basis or filtrate.liquid.NAME"
    )
    equals: Quantity
    lower: Quantity
    upper: Quantity


class Project(_Strict):
    """Title block of the report."""

    project: str = ""
    author: str = ""
    date: str = ""


class FitTable(_Strict):
    """A lab test read from a data file beside the case, or from the case itself; what it estimates goes into
    the line with its uncertainty.
    """

    test: str = Field(description="a lab test, as domain.name")
    data: str = Field(
        description="CSV or XLSX, relative to the case file; or the table itself, as text of several lines"
    )
    conditions: dict[str, Any] = {}
    gives: dict[str, str] = Field(description="input of the line → estimate of the test")

    @property
    def holds_data(self) -> bool:
        """Whether the data stand in the case itself."""
        return "\n" in self.data


class Disturbance(_Strict):
    """A parameter or a feed flow over time: straight between points, constant outside."""

    vary: str = Field(description="unit.parameter, or feed.mass_flow")
    times: list[Quantity] | str
    values: list[Quantity] | str


class DynamicTable(_Strict):
    """A run in time: start-up from empty vessels or from the steady state, with disturbances."""

    duration: Quantity
    step: Quantity
    start: str | dict[str, str] = Field(
        default="steady", description="steady or empty, or either by unit, the others being empty"
    )
    disturbances: dict[str, Disturbance] = {}


class Studied(_Strict):
    """What a file with studies may hold besides its model."""

    uncertain: dict[str, dict[str, Any]] = Field(
        default={}, description="distributions of inputs, shared by the studies"
    )
    quantities: dict[str, Any] = Field(
        default={}, description="figures made from figures: expressions, or formulas with their inputs"
    )
    fits: dict[str, FitTable] = {}
    study: dict[str, dict[str, Any]] = Field(default={}, description="studies by name, see 'granum study'")


class StudyFile(Studied):
    """A file of studies of a case that stands elsewhere, or of a formula."""

    title: str = ""
    description: str = ""
    language: str | None = None
    case: str | None = Field(default=None, description="case file of the line, relative to this file")
    card: str | None = Field(default=None, description="formula or procedure, as domain.name")
    inputs: dict[str, Any] = Field(default={}, description="inputs of the card that stay fixed")


OWN = ("solid", "fluid", "solute")  # tables of materials of one's own, as in a materials file


class Case(Studied):
    """A whole case file."""

    title: str
    description: str = ""
    language: str | None = None
    report: Project = Project()
    mixture: MixtureTable
    solid: dict[str, dict[str, Any]] = Field(
        default={}, description="solids of one's own by name: density and heat_capacity at least"
    )
    fluid: dict[str, dict[str, Any]] = Field(
        default={}, description="liquids and gases of one's own by name, as in a materials file"
    )
    solute: dict[str, dict[str, Any]] = Field(
        default={}, description="solutes of one's own by name, as in a materials file"
    )
    feeds: dict[str, FeedTable]
    units: dict[str, dict[str, Any]]
    streams: dict[str, StreamTable | list[str]] = {}
    specifications: dict[str, Specification] = {}
    prices: dict[str, Quantity] = Field(
        default={}, description="of what the line takes: electricity, carriers of heat and cold, materials"
    )
    dynamic: DynamicTable | None = Field(
        default=None, description="how the line runs in time: start-up and disturbances"
    )
