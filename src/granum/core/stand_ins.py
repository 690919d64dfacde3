"""What people state in place of an input: a kinematic viscosity, a mass flux, the diameter of what a card
knows by its radius, a standard design for its lengths.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NoReturn

from granum.core import given, units
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS

_DENSITIES = ("fluid_density", "liquid_density", "gas_density")
_DYNAMIC, _KINEMATIC = KINDS["DynamicViscosity"], KINDS["KinematicViscosity"]


def _is_kinematic(viscosity: Any) -> bool:
    """Whether it has such a unit; ordinary dynamic ones are known without reading units at length."""
    return (
        isinstance(viscosity, str)
        and not units.in_unit_of(viscosity, _DYNAMIC.unit)
        and units.in_unit_of(viscosity, _KINEMATIC.unit)
    )


def _number(value: Any, kind: Any, name: str) -> Any:
    if isinstance(value, str):
        return units.read_values(value, kind, name)
    return units.quantity_to_si(value, kind, name) if given.is_quantity(value) else value


_BY_DENSITY = {  # name: the input it stands for, its kind, the power of the density
    "kinematic_viscosity": ("dynamic_viscosity", _KINEMATIC, 1),
    "mass_flux": ("superficial_velocity", KINDS["MassFlux"], -1),
}


_WALLS = {
    "diameter": ("bowl_radius",),
    "inner_diameter": ("bowl_radius",),
    "diameter_inner": ("bowl_radius",),
    "bowl_diameter": ("radius_outer",),
    "basket_diameter": ("radius_outer", "bowl_radius"),
}

_DESIGNS: dict[tuple[str, ...], Callable[[str, Any], Mapping[str, Any]]] = {}

_ROUND: set[tuple[str, ...]] = set()

_BY_DIAMETER = {"mass_flow": "mass_flux", "volume_flow": "superficial_velocity"}  # over the cross-section


def designs(lengths: tuple[str, ...], of: Callable[[str, Any], Mapping[str, Any]]) -> None:
    """Let ``standard``, the name of a design, stand for such lengths beside a ``diameter``; ``of`` makes all
    lengths from the name and the diameter. Whoever declares inputs with these lengths says so.
    """
    _DESIGNS[lengths] = of


def circle(*beside: str) -> None:
    """Let ``diameter`` stand for the ``area`` of what asks for these inputs beside it: it is round. Whoever
    declares such a piece of equipment says so.
    """
    _ROUND.add(beside)


def not_varied(name: str, known: Container[str], where: str = "") -> InputError | None:
    """Why a study cannot vary a name that stands for an input; None of other names."""
    wanted = stands_for(name, known)
    if wanted is None:
        return None
    return InputError(
        _(
            "'{name}' stands in place of '{wanted}'{where} and holds one value: a study varies "
            "'{wanted}' itself."
        ).format(name=name, wanted=wanted, where=where),
        name=name,
        did_you_mean=wanted,
    )


def _designed(known: Container[str]) -> tuple[str, ...] | None:
    return next((lengths for lengths in _DESIGNS if all(name in known for name in lengths)), None)


def stands_for(name: str, known: Container[str]) -> str | None:
    """The input that a name stands for; the first of several.

    >>> stands_for("bowl_diameter", ["bowl_radius", "bowl_length"])
    'bowl_radius'
    >>> stands_for("outer_diameter", ["radius_inner", "radius_outer"])
    'radius_outer'
    >>> stands_for("outlet_temperature", ["temperature_inlet", "temperature_outlet"])
    'temperature_outlet'
    >>> stands_for("temperature_wet_bulb", ["temperature", "wet_bulb_temperature"])
    'wet_bulb_temperature'
    """
    if name in known:
        return None
    if turned := [other for other in _turns(name) if other in known]:
        return turned[0]
    if name == "standard":
        lengths = _designed(known)
        return lengths[0] if lengths else None
    if name == "diameter" and "area" in known and any(all(b in known for b in own) for own in _ROUND):
        return "area"
    if name in _BY_DIAMETER and _BY_DIAMETER[name] in known and "diameter" in known:
        return _BY_DIAMETER[name]
    if name in (*_BY_DIAMETER, "diameter") and _in_a_vessel(known):
        return "superficial_velocity"
    if name in _BY_DIAMETER:
        return None
    if name in _BY_DENSITY:
        wanted = _BY_DENSITY[name][0]
        return wanted if wanted in known else None
    return next((wanted for wanted in _radii(name) if wanted in known), None)


def _radii(diameter: str) -> tuple[str, ...]:
    """The radii that a diameter may mean: the word turned, or the wall of a bowl or basket, in order."""
    if "diameter" not in diameter.split("_"):
        return ()
    same = diameter.replace("diameter", "radius")
    return (same, _turned(same), *_WALLS.get(diameter, ()))


def _turned(name: str) -> str:
    """A name of two words the other way round: the outlet temperature is the temperature of the outlet."""
    return "_".join(reversed(name.split("_"))) if name.count("_") == 1 else name


def _turns(name: str) -> tuple[str, ...]:
    """A name with its first word last, or its last word first."""
    words = name.split("_")
    if len(words) < 2:
        return ()
    return "_".join([*words[1:], words[0]]), "_".join([words[-1], *words[:-1]])


def given_by(names: Iterable[str], known: Container[str]) -> frozenset[str]:
    """The inputs that names give, themselves or in their place.

    >>> sorted(given_by(["bowl_diameter", "bowl_length"], ["bowl_radius", "bowl_length"]))
    ['bowl_length', 'bowl_radius']
    """
    found = {stands_for(name, known) or name for name in names}
    return frozenset((*found, *(_designed(known) or ()))) if "standard" in names else frozenset(found)


def _in_a_vessel(known: Container[str]) -> bool:
    """Whether a flow and a diameter stand for a velocity: nothing else there is called so."""
    return "superficial_velocity" in known and not any(n in known for n in ("radius", "area", "mass_flux"))


@dataclass
class StandIns:
    """The ``values`` of one call of ``owner``, whose inputs are the ``known``, while what stands for an input
    is put in its place. ``value_of`` reads an input, given or by default, or says that there is none.
    """

    owner: str
    known: Mapping[str, int]
    given_by_place: int
    values: dict[str, Any]
    value_of: Callable[[str], Any]
    origins: dict[str, str] = field(default_factory=dict)

    def settle(self) -> None:
        """Put all in place."""
        if _is_kinematic(self.values.get("dynamic_viscosity")) and "kinematic_viscosity" not in self.known:
            if "kinematic_viscosity" in self.values:
                self._twice("dynamic_viscosity", "kinematic_viscosity")
            self.values["kinematic_viscosity"] = self.values.pop("dynamic_viscosity")
        for name in list(self.values):
            wanted = stands_for(name, self.known)
            if wanted is None:
                continue
            if wanted in _turns(name):
                self._put(name, wanted, self.values[name])
            elif name == "standard":
                self._standard()
            elif name in _BY_DENSITY:
                self._by_density(name, wanted)
            elif wanted == "superficial_velocity" and name not in _BY_DENSITY:
                self._over_section(name)
            elif name in _BY_DIAMETER:
                kind = KINDS["MassFlow" if name == "mass_flow" else "VolumeFlow"]
                section = math.pi / 4.0 * self._needed(name, "diameter") ** 2
                flow = _number(self.values[name], kind, name)
                self._put(name, wanted, flow / section, _("flow over the cross-section of the diameter"))
            elif wanted == "area":
                across = _number(self.values[name], KINDS["Length"], name)
                self._put(name, wanted, math.pi / 4.0 * across**2, _("circle of the diameter"))
            else:
                across = _number(self.values[name], KINDS["Length"], name)
                self._put(name, wanted, across / 2.0, _("half the diameter"))

    def _over_section(self, name: str) -> None:
        """A flow over the cross-section of a vessel, whose diameter the card itself may not ask for."""
        if name not in self.values:
            return  # the diameter, taken with its flow
        flow = next((word for word in _BY_DIAMETER if word in self.values), None)
        if flow is None or "diameter" not in self.values:
            other = "diameter" if name in _BY_DIAMETER else "volume_flow"
            message = _("'{name}' needs '{other}' beside it.")
            raise InputError(message.format(name=name, other=other), name=other)
        across = _number(self.values["diameter"], KINDS["Length"], "diameter")
        if "diameter" not in self.known:
            self.values.pop("diameter")
        kind = KINDS["MassFlow" if flow == "mass_flow" else "VolumeFlow"]
        through = _number(self.values[flow], kind, flow) / (math.pi / 4.0 * across**2)
        if flow == "mass_flow":
            through = through / self._density(flow, "superficial_velocity")
        self._put(flow, "superficial_velocity", through, _("flow over the cross-section of the diameter"))

    def _put(self, name: str, wanted: str, value: Any, origin: str = "") -> None:
        if wanted in self.values or self.known[wanted] < self.given_by_place:
            self._twice(wanted, name)
        self.values.pop(name, None)
        self.values[wanted] = value
        if origin:
            self.origins[wanted] = origin

    def _twice(self, wanted: str, name: str) -> NoReturn:
        message = _("'{name}' was given twice for {owner}.")
        raise InputError(message.format(name=wanted, owner=self.owner), name=name)

    def _by_density(self, name: str, wanted: str) -> None:
        """``wanted`` as ``name`` times the density, or over it, by the density among the inputs."""
        kind, power = _BY_DENSITY[name][1:]
        origin = _("kinematic viscosity times density") if power > 0 else _("mass flux over density")
        by = self._density(name, wanted)
        self._put(name, wanted, _number(self.values[name], kind, name) * by**power, origin)

    def _density(self, name: str, wanted: str) -> Any:
        density = next((n for n in _DENSITIES if n in self.known), None)
        if density is None:
            message = _("{owner} asks for no density: give '{wanted}' in place of '{name}'.")
            raise InputError(message.format(owner=self.owner, wanted=wanted, name=name), name=name)
        return self._needed(name, density)

    def _needed(self, name: str, other: str) -> Any:
        value = self.value_of(other)
        if value is None:
            message = _("'{name}' needs '{other}' beside it.")
            raise InputError(message.format(name=name, other=other), name=other)
        return value

    def _standard(self) -> None:
        """The lengths of a standard design for the diameter; what is given besides wins."""
        lengths, named = _designed(self.known), self.values.pop("standard")
        assert lengths is not None  # ``stands_for`` has found them
        for name, length in _DESIGNS[lengths](named, self._needed("standard", "diameter")).items():
            if name in self.known and name not in self.values and self.known[name] >= self.given_by_place:
                self.values[name] = length
                self.origins[name] = _("standard design {name}").format(name=named.replace("_", " "))
