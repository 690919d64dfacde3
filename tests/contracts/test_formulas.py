"""What every declared formula must hold, drawn over the registry: a new card is tested here unasked."""

from __future__ import annotations

import doctest
import importlib
import inspect
from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.drawing import ELEMENTWISE, FORMULAS, draw, loops
from tests.sharing.samples import EVERYTHING

from granum.core import glossary as glossary_module
from granum.core import sources as sources_module
from granum.core.compiling import once
from granum.core.formulas import Formula
from granum.core.glossary import quantity_in
from granum.core.i18n import catalog
from granum.core.sources import bibliography, keys_of, reference
from granum.reports.mathml import mathml

quickly_compiled = partial(jax.jit, compiler_options={"xla_backend_optimization_level": 0})


def leaves(out: object) -> list[np.ndarray]:
    return [np.asarray(x, dtype=float) for x in jax.tree.leaves(out)]


@pytest.mark.parametrize("key", EVERYTHING)
def test_declaration_is_complete(key: str) -> None:
    card = EVERYTHING[key].card
    assert card.source, "every card has a source"
    missing = [k for k in keys_of(card.source) if k not in bibliography()]
    assert not missing, f"not in the bibliography: {missing}"
    for p in (*card.parameters, *card.outputs):
        assert quantity_in(p.name), f"'{p.name}' is not in the glossary"
        assert (
            p.kind or p.law or p.choices or p.sort or p.optional or p.default is not inspect.Parameter.empty
        ), f"'{p.name}' has no kind"
        if p.kind and isinstance(p.default, int | float):
            assert p.kind.contains(float(p.default)), f"the default of '{p.name}' lies outside its own bounds"
    assert card.entry.english_summary.endswith("."), "the docstring starts with one sentence"
    assert "<math" in mathml(card.equation or "x")
    for text in (card.given_title, card.entry.english_summary):
        assert not text or text in catalog("fr"), f"no French for: {text}"
    known = {*card.inputs, *(p.name for p in card.outputs)}
    body = inspect.getsource(
        EVERYTHING[key].function if isinstance(EVERYTHING[key], Formula) else EVERYTHING[key]
    )
    for name in card.fitted:
        assert name in known or f"{name}=" in body, f"fitted range of '{name}' is never checked"


def test_one_word_one_source() -> None:
    glossary_module.glossary()
    assert not glossary_module.duplicates
    assert all(reference(key) for key in bibliography())
    assert not sources_module.duplicates


@pytest.mark.parametrize("key", FORMULAS)
def test_docstring_has_an_example(key: str) -> None:
    assert ">>>" in FORMULAS[key].card.doc


@pytest.mark.parametrize("module", sorted({thing.card.module for thing in EVERYTHING.values()}))
def test_docstring_examples_run(module: str) -> None:
    found = importlib.import_module(module)
    finder, runner = (
        doctest.DocTestFinder(),
        doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE),
    )
    for name, item in vars(found).items():
        target = item.function if isinstance(item, Formula) else item
        if getattr(target, "__module__", None) == module and (
            inspect.isfunction(target) or inspect.isclass(target)
        ):
            for test in finder.find(target, name, globs={**vars(found)}):
                runner.run(test)
    assert runner.failures == 0


@pytest.mark.parametrize("key", ELEMENTWISE)
def test_scalar_array_vmap_and_gradient_agree_in_float64(key: str) -> None:
    f = ELEMENTWISE[key]
    inputs = draw(f, 3)
    if not inputs:
        return
    agree(f, inputs)


def agree(f: Formula, inputs: dict[str, np.ndarray]) -> None:
    def total(kw):
        out = [jnp.asarray(x) for x in jax.tree.leaves(f(**kw))]
        return sum(map(jnp.sum, out)), out

    batched = leaves(f(**inputs))
    single = [leaves(f(**{n: float(v[i]) for n, v in inputs.items()})) for i in range(3)]
    # where there is a loop the compiler's word is asked for too
    repeats = loops(f, inputs)
    run = quickly_compiled if repeats else partial(partial, once)
    (_, out), gradient = run(jax.vmap(jax.value_and_grad(total, has_aux=True)))(
        jax.tree.map(jnp.asarray, inputs)
    )
    for k, (whole, mapped) in enumerate(zip(batched, leaves(out), strict=True)):
        assert whole.dtype == np.float64
        assert np.all(np.isfinite(whole)), f"not finite at ordinary values: {inputs}"
        # a difference of larger numbers is as good as their rounding, which another way to run it changes
        least = 1e-13 * float(np.max(np.abs(whole)))
        np.testing.assert_allclose(whole, [s[k] for s in single], rtol=1e-12, atol=least)
        # the roundings of hundreds of steps add up
        np.testing.assert_allclose(whole, mapped, rtol=1e-11 if repeats else 1e-12, atol=least)

    point = {n: float(v[0]) for n, v in inputs.items()}
    steps = {n: 1e-5 * (abs(x) or 1e-12) for n, x in point.items()}
    around = {
        n: np.array([x, *(x + s * steps[n] * (m == n) for m in point for s in (1, -1))])
        for n, x in point.items()
    }
    value, *beside = np.sum(leaves(f(**around)), axis=0)
    for i, (name, x) in enumerate(point.items()):
        difference = (beside[2 * i] - beside[2 * i + 1]) / (2 * steps[name])
        scale = max(abs(difference), abs(value) / max(abs(x), 1e-12) * 1e-3, 1e-300)
        assert abs(float(gradient[name][0]) - difference) <= 2e-5 * scale, (
            f"d/d{name}: {gradient[name]} against {difference}"
        )


@pytest.mark.parametrize("key", [k for k, f in ELEMENTWISE.items() if f.fitted])
def test_fitted_range_is_flagged_at_its_edges(key: str) -> None:
    f = ELEMENTWISE[key]
    edges(f, {n: float(v[0]) for n, v in draw(f, 1).items()})


def edges(f: Formula, inputs: dict[str, float]) -> None:
    for name, (low, high) in f.fitted.items():
        if name not in inputs:
            continue
        p = f.card.parameter(name)
        assert p.kind is not None
        for edge, beyond in (
            (low, low - 0.01 * max(abs(low), 1e-9)),
            (high, high * 1.01 if high > 0 else high * 0.99),
        ):
            if not np.isfinite(edge) or not p.kind.contains(beyond):
                continue
            # as arrays, since a single value at which nothing exists (saturated gas above boiling) raises
            assert any(n["name"] == name for n in f.evaluate(**{**inputs, name: np.array([beyond])}).notices)
            if name in {o.name for o in f.card.outputs}:
                continue  # what comes out may lie beyond
            at_edge = f.evaluate(**{**inputs, name: np.array([edge])}).notices
            assert not any(
                n["name"] == name and n["card"] == f.key and n["flag"] == "extrapolated" for n in at_edge
            )
