"""What may stand as a law besides the declared ones: a formula with options of its own, a plain function."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import equinox as eqx
import jax

from granum.core import registry
from granum.core.errors import GranumError, InputError
from granum.core.given import shown
from granum.core.i18n import _


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class FormulaWith:
    """A formula some of whose inputs are fixed, as a law: ``{law = "macdonald", inertial_constant =
    4.0}``.
    """

    formula: Any = field(metadata={"static": True})
    words: tuple[tuple[str, Any], ...] = field(metadata={"static": True})
    names: tuple[str, ...] = field(metadata={"static": True})
    values: tuple[Any, ...]

    @property
    def card(self) -> Any:
        """The card of the formula."""
        return self.formula.card

    @property
    def key(self) -> str:
        """The key of the formula."""
        return self.formula.key

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        options = dict(self.words) | dict(zip(self.names, self.values, strict=True))
        given = {p.name for p in self.card.parameters[: len(args)]} | set(kwargs)
        for name in options:
            if name in given:
                raise InputError(
                    _("'{name}' cannot be an option of the law {law} here: it is computed.").format(
                        name=name, law=self.key
                    ),
                    name=name,
                )
        return self.formula(*args, **kwargs, **options)


@jax.tree_util.register_static
class GivenLaw:
    """A user's own function or object as a law; what goes wrong inside it is told as one message that names
    it.
    """

    def __init__(self, function: Any, name: str):
        self.function, self.name = function, name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, GivenLaw) and self.name == other.name and self.function is other.function

    def __hash__(self) -> int:
        return hash(self.name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "function":
            raise AttributeError(name)
        return getattr(self.function, name)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        try:
            found = self.function(*args, **kwargs)
        except GranumError:
            raise
        except jax.errors.JAXTypeError as problem:  # NumPy, float(…) or 'if' on a traced number
            raise InputError(
                _(
                    "The function given as '{name}' must be written with jax.numpy, without 'if' on its "
                    "numbers."
                ).format(name=self.name),
                name=self.name,
            ) from problem
        except Exception as problem:
            raise InputError(
                _("The function given as '{name}' failed: {problem}.").format(
                    name=self.name, problem=f"{type(problem).__name__}: {shown(str(problem))}"
                ),
                name=self.name,
            ) from problem
        if not all(
            isinstance(leaf, (int, float))
            or getattr(getattr(leaf, "dtype", None), "kind", "") in ("i", "u", "f")
            for leaf in jax.tree.leaves(found)
        ):
            raise InputError(
                _("The function given as '{name}' gave {value}, which is not a number.").format(
                    name=self.name, value=shown(found)
                ),
                name=self.name,
            )
        return found


def as_law(value: Any, family: str, name: str, where: str) -> Any:
    """An object given as a law: one of the family as it is, a function wrapped; anything else is refused."""
    try:
        return _as_law(value, family, name, where)
    except GranumError:
        raise
    except Exception:  # an object of another program whose attributes raise
        raise _no_law(value, name, where) from None


def _as_law(value: Any, family: str, name: str, where: str) -> Any:
    declared = getattr(getattr(value, "card", None), "family", None)
    if declared is not None:
        if declared != family:
            raise InputError(
                _(
                    "'{name}' takes a law of the family '{family}'{where}, and {law} is one of '{other}'."
                ).format(
                    name=name,
                    family=family,
                    where=where,
                    law=value.card.key,
                    other=declared or value.card.sort,
                ),
                name=name,
            )
        return value() if isinstance(value, type) else value
    if isinstance(value, eqx.Module) and not callable(value):
        return value  # a module written for the purpose, such as an equilibrium that hangs on nothing
    if isinstance(value, type) or not callable(value):
        raise _no_law(value, name, where)
    missing = [
        ability for ability in registry.abilities(family) if not callable(getattr(value, ability, None))
    ]
    if missing:
        raise InputError(
            _(
                "The law given as '{name}'{where} is called only: one that also knows {missing} is "
                "needed. 'granum list {family}' shows such laws."
            ).format(
                name=name,
                where=where,
                missing=", ".join(f".{ability}(…)" for ability in missing),
                family=family,
            ),
            name=name,
        )
    return GivenLaw(value, name) if jax.tree_util.all_leaves([value]) else value


def _no_law(value: Any, name: str, where: str) -> InputError:
    message = _(
        "'{name}' = {value} is not a law{where}: give the name of one, a function, or a table such as "
        '{{law = "…", option = 1}}.'
    )
    return InputError(message.format(name=name, value=shown(value), where=where), name=name)
