"""A solute beside others in its mother liquor: its solubility there, and what else would crystallize."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from granum.core import flags
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.crystallization.equipment.roles import Roles
from granum.crystallization.formulas.solubility_laws import AntisolventSolubility, LibrarySolubility
from granum.crystallization.population.compiled import compiled
from granum.materials.brines import SOLVENT, Brine, brine, find_brine
from granum.materials.correlation import Owner
from granum.materials.library import Library, session
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture

TOLD = 0.01  # kg of other solutes per kg of solvent, from which they are worth a word
SLACK = 1e-6
ALONE = (
    "What else is dissolved is left out of the solubility, as nothing is known here of how it acts beside "
    "this solute: measure the solubility in this liquor and give it as a law."
)
OVER = (
    "Another salt of the mother liquor is beyond its solubility and would crystallize too: purge more, "
    "evaporate or cool less, or take 'crystallization.two_salt_crystallizer'."
)
OTHER_FORM = (
    "Beside the other salts another crystal of this one is stable: give that one among the solids, and as "
    "'solid'."
)
EXCHANGED = (
    "The other salts alone hold more of the ions of the one that crystallizes than dissolve: state what is "
    "dissolved so that this one has as much of its ions as there is."
)


class Beside(NamedTuple):
    """A salt of the library beside others: the brine's names, itself the first, its crystal among the
    brine's, and mol of each ion of the others in so much liquor as came in.
    """

    names: tuple[str, ...]
    materials: Library
    crystal: int
    others: Any

    @property
    def brine(self) -> Brine:
        """The salt and the others."""
        return brine(self.names, self.materials)


class Fixed(eqx.Module):
    """Solubility at one temperature beside others that stay as concentrated as they are."""

    value: Any

    def __call__(self, temperature: Any) -> Any:
        return self.value


class Warmed(eqx.Module):
    """Solubility over temperature beside others that stay as concentrated as they are, from a table of its
    logarithm.
    """

    logs: Any

    def __call__(self, temperature: Any) -> Any:
        return jnp.exp(_between(self.logs, (jnp.asarray(temperature, dtype=float) - COLDEST) / STEP))


class Thinned(eqx.Module):
    """Solubility beside others over temperature and the free solvent (kg) that holds them, from a table of
    its logarithm, whose rows are temperatures (or one) and columns logarithms of the dilution over that with
    the ``solvent``.
    """

    logs: Any
    thickest: Any
    solvent: Any

    takes_solvent: ClassVar[bool] = True

    def __call__(self, temperature: Any, solvent: Any) -> Any:
        thinned = jnp.log(jnp.maximum(safe_divide(solvent, self.solvent, 1.0), 1e-12))
        place = (thinned - self.thickest) / (THINNEST - self.thickest) * (COLUMNS - 1.0)
        if self.logs.shape[0] == 1:
            return jnp.exp(_between(self.logs[0], place))
        here = (jnp.asarray(temperature, dtype=float) - COLDEST) / STEP
        return jnp.exp(_between(_between(self.logs, here), place))


COLDEST, STEP, ROWS = 258.15, 2.5, 53  # K: temperatures of a table
THINNEST, THICKEST, COLUMNS = 1.6, -2.5, 48  # logarithm of the dilution over that of the feed
ROOM = 2.0  # of the solubility of the other salts alone, up to which they are followed


def _between(values: Any, place: Any) -> Any:
    """Lagrange's cubic through the four rows around a place, counted from the first; that of an end beyond
    it.
    """
    place = jnp.clip(place, 0.0, values.shape[0] - 1.0)
    first = jnp.clip(jnp.floor(lax.stop_gradient(place)).astype(int) - 1, 0, values.shape[0] - 4)
    a, b, c, d = (place - first - k for k in range(4))
    weights = jnp.stack([-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0])
    return weights @ lax.dynamic_slice_in_dim(values, first, 4)


@compiled
def _logs(made: tuple[str, ...], materials: Library, crystal: int, T: Any, molalities: Any) -> Any:
    """Logarithms of the solubility at temperatures (rows) and beside molalities (columns)."""
    known = brine(made, materials)
    mass = known.molar_masses[known.crystals[crystal].salt]

    def one(T: Any, m: Any) -> Any:
        return jnp.log(mass * known.solubility(T, m, crystal))

    return jax.vmap(lambda T: jax.vmap(lambda m: one(T, m))(molalities))(T)


def refuse_other_system(law: Any, mixture: Mixture, found: Roles) -> None:
    """Refuse the library's solubility of another solute, in another solvent or over another crystal form than
    those of the mixture.
    """
    if isinstance(law, AntisolventSolubility):
        law = law.pure_solubility
    if not isinstance(law, LibrarySolubility):
        return
    known = law.materials or session()
    if law.solute not in known.names("solute"):
        return
    system, names = known.solute(law.solute), mixture.materials.names
    solute, solvent = (mixture.liquids[i].name for i in (found.solute, found.solvent))
    own = system.form_of or system.name
    other = solute in names("solute") and mixture.materials.solute(solute).name not in (system.name, own)
    elsewhere = solvent in names("fluid") and mixture.materials.fluid(solvent).name != system.solvent.name
    if other or elsewhere:
        raise CaseError(
            _(
                "The solubility of the library is that of {system}, not of '{solute}' in '{solvent}': give a "
                "law of your own, such as 'polynomial_solubility' or 'apelblat_solubility'."
            ).format(system=system.label, solute=solute, solvent=solvent)
        )
    solid = mixture.solids[found.solid].name
    form = system.form_of or is_other_form(mixture.materials, solid)
    if form and all(branch.crystal.name != solid for branch in system.branches):
        raise CaseError(
            _(
                "The solubility of the library is that of {system}, not of the crystal '{crystal}', which is "
                "another form: give its own, or another crystal."
            ).format(system=system.label, crystal=solid)
        )


def is_other_form(materials: Library, crystal: str) -> bool:
    """Whether a library has a crystal as another form of a solute."""
    entries = materials.entries("solute").values()
    return any(e.form_of and any(b.crystal == crystal for b in e.branches) for e in entries)


def solubility_beside(
    law: Any, mixture: Mixture, found: Roles, liquid: Any, temperature: Any = None, solvent: Any = None
) -> Any:
    """The solubility in a liquor with other solutes: of a salt of the library by what is known of its ions
    beside theirs; the law itself where nothing is, and where it is not the library's, which speaks of the
    pure solvent, but one of the user's own, which speaks of this liquor.

    ``temperature`` where the vessel has one; ``solvent`` (kg) where it holds the others whatever
    crystallizes, else the solubility asks for it.
    """
    refuse_other_system(law, mixture, found)
    made = _beside(law, mixture, found, liquid)
    if made is None:
        return law
    T = COLDEST + STEP * jnp.arange(ROWS) if temperature is None else jnp.reshape(temperature, 1)
    T, fed = jnp.asarray(T, dtype=float), liquid[found.solvent]
    given = made.names, made.materials, made.crystal, T
    if solvent is not None:
        logs = _logs(*given, safe_divide(made.others, solvent, 0.0)[None])[:, 0]
        return Warmed(logs) if temperature is None else Fixed(jnp.exp(logs[0]))
    held, known = safe_divide(made.others, fed, 0.0), made.brine
    # what there may be of each ion of the others, from the solubilities of the salts alone
    most = jnp.max(known.ions_per_salt * known.alone(jnp.max(T))[:, None], axis=0)
    there = jnp.max(held / most)
    thickest = jnp.clip(jnp.log(jnp.maximum(there, 1e-12) / ROOM), THICKEST, -0.05)
    thinned = jnp.linspace(thickest, THINNEST, COLUMNS)
    return Thinned(_logs(*given, held * jnp.exp(-thinned)[:, None]), thickest, fed)


def keeps_solvent(found: Roles) -> bool:
    """Whether the crystal takes none of the solvent that holds other solutes."""
    return found.solute_fraction > 1.0 - 1e-12


@compiled
def _saturations(names: tuple[str, ...], materials: Library, T: Any, molalities: Any) -> Any:
    """Logarithm of the saturation ratio of each crystal, per ion, of several liquors."""
    return jax.vmap(brine(names, materials).saturation)(T, molalities)


def _beside(law: Any, mixture: Mixture, found: Roles, liquid: Any) -> Beside | None:
    if not isinstance(law, LibrarySolubility) or mixture.liquids[found.solvent].name != SOLVENT:
        return None
    library, solute = law.materials or session(), mixture.liquids[found.solute].name
    if law.solute not in library.names("solute") or library.solute(law.solute).name != solute:
        return None
    names, places = _known_beside(mixture, found)
    made = find_brine(names, mixture.materials) if places else None
    if made is None:
        return None
    solid = mixture.solids[found.solid].name
    forms = [k for k, c in enumerate(made.crystals) if c.name == solid and c.salt == 0]
    if not forms:
        return None
    moles = liquid[jnp.array(places)] / made.molar_masses[1 : len(names)]
    return Beside(names, mixture.materials, forms[0], moles @ jnp.asarray(made.ions_per_salt[1 : len(names)]))


def _heard(made: Beside, temperature: Any, ratio: Any, solvent: Any, card: Any) -> None:
    """Record, of liquors with so much solute per solvent, where they leave what is known and which other
    crystals they are beyond the solubility of.
    """
    known, own = made.brine, made.brine.crystals[made.crystal]
    T, ratio, solvent = (jnp.ravel(jnp.asarray(x, dtype=float)) for x in (temperature, ratio, solvent))
    T = T + 0.0 * ratio
    rest = safe_divide(made.others, solvent[:, None], 0.0)
    part = jnp.asarray(known.ions_per_salt[own.salt])
    there = rest + ratio[:, None] / known.molar_masses[own.salt] * part
    logs, alone = (_saturations(made.names, made.materials, T, m) for m in (there, rest))
    for k in (0, -1):
        known.heard(T[k], there[k])
    for k, form in enumerate(known.crystals):
        if k != made.crystal:
            same, of = form.salt == own.salt, form.solid
            system = of if form.salt is None else known.salts[form.salt]
            owner = Owner.of_property(system.name, "solubility", system.french, of.name, of.french)
            less = logs[:, made.crystal] if same else 0.0
            over = jnp.max(jnp.where(logs[:, k] > 0.0, jnp.exp(logs[:, k] - less), 0.0))
            reason = OTHER_FORM if same else OVER
            about = over > 1.0 + SLACK, over, "saturation_ratio", owner, 0.0, 1.0
            flags.record(flags.EXTRAPOLATED, *about, reason=reason)
    full = jnp.any((alone[:, made.crystal] >= 0.0) & (solvent > 0.0))
    unsolved(~full, card, reason=EXCHANGED)


def _known_beside(mixture: Mixture, found: Roles) -> tuple[tuple[str, ...], list[int]]:
    """Names of the salts known beside the solute, itself the first, and the places of the others."""
    names, places = (mixture.liquids[found.solute].name,), []
    for place, liquid in enumerate(mixture.liquids):
        other = place not in (found.solute, found.solvent)
        if other and find_brine((*names, liquid.name), mixture.materials) is not None:
            names, places = (*names, liquid.name), [*places, place]
    return names, places


def water_activity_beside(mixture: Mixture, found: Roles, liquid: Any, temperature: Any) -> Any:
    """Activity of water over a liquor of salts; None where there is one alone, or what they do to each other
    is not known.
    """
    names, places = _known_beside(mixture, found)
    if not places or mixture.liquids[found.solvent].name != SOLVENT:
        return None
    known = brine(names, mixture.materials)
    salts = liquid[jnp.array([found.solute, *places])] / known.molar_masses[: len(names)]
    ions = salts @ jnp.asarray(known.ions_per_salt[: len(names)])
    return known.water_activity(temperature, safe_divide(ions, liquid[found.solvent], 0.0))


def others_per_solvent(found: Roles, liquid: Any) -> Any:
    """kg of other liquids per kg of solvent."""
    rest = jnp.sum(liquid) - liquid[found.solute] - liquid[found.solvent]
    return safe_divide(rest, liquid[found.solvent], 0.0)


def heard_beside(
    law: Any, mixture: Mixture, found: Roles, liquid: Any, states: tuple[Any, Any, Any], card: Any
) -> None:
    """Record what a reader must know of a liquor with other solutes: ``states`` are temperatures, solute per
    solvent and free solvent that it went through, ``liquid`` what came in.
    """
    made = _beside(law, mixture, found, liquid)
    rest = [i for i in range(len(mixture.liquids)) if i not in (found.solute, found.solvent)]
    if made is not None:
        _heard(made, *states, card)
        rest = [i for i in rest if mixture.liquids[i].name not in made.names]
    if rest and isinstance(law, LibrarySolubility):
        share = safe_divide(jnp.sum(liquid[jnp.array(rest)]), liquid[found.solvent], 0.0)
        flags.record(flags.EXTRAPOLATED, share > TOLD, share, "solubility", card.key, reason=ALONE)
