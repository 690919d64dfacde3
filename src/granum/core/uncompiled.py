"""Traced programs run by NumPy, without compiling them: for what runs a few times, where the compiler would
take a thousand times as long as the numbers.

The program is JAX's own (``jax.make_jaxpr``); whatever stands in it that is not listed here is handed to JAX,
one operation at a time.
"""

from __future__ import annotations

import math
import string
import threading
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import jax
import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

Step = Callable[..., Any]
Body = Callable[..., list[Any]]

EMPTY_PASSES = 8
"""Passes taken for a loop of unknown length when the work of a program is guessed."""
ELEMENTS = 500
"""So many elements of an array take as long as one more step."""

_budget = threading.local()


class TooLong(Exception):
    """A program took more steps than it was allowed."""


class Program:
    """A traced program, ready to run on NumPy values.

    Parameters
    ----------
    closed: as ``jax.make_jaxpr`` gives it.

    ``size`` counts its operations, each once; ``work`` guesses how many steps a run takes.

    >>> import jax
    >>> program = Program(jax.make_jaxpr(lambda x: 3.0 * x + 1.0)(2.0))
    >>> program.size, program.run([2.0], steps=100)
    (2, ([np.float64(7.0)], 2.0))
    """

    def __init__(self, closed: ClosedJaxpr):
        self.size, self.work, self._body = _Maker().made(closed)
        self._takes = [v.aval.dtype for v in closed.jaxpr.invars]

    def run(self, values: Sequence[Any], steps: float = math.inf) -> tuple[list[Any], float]:
        """The results for a flat list of values, and the steps taken; ``TooLong`` beyond those allowed."""
        given = [np.asarray(v, dtype)[()] for v, dtype in zip(values, self._takes, strict=True)]
        outer = getattr(_budget, "left", math.inf)
        _budget.left = steps
        try:
            with np.errstate(all="ignore"):
                return self._body(*given), steps - _budget.left
        finally:
            _budget.left = outer


class Made(NamedTuple):
    """A program with what is known of it: operations, guessed work, and a function of its inputs."""

    size: float
    work: float
    run: Body


class _Maker:
    """Makes programs ready, each inner one once however often it is called."""

    def __init__(self) -> None:
        self._known: dict[int, Made] = {}

    def made(self, closed: ClosedJaxpr) -> Made:
        found = self._known.get(id(closed.jaxpr)) if not closed.consts else None
        if found is not None:
            return found._replace(size=1.0)
        found = self._make(closed)
        if not closed.consts:
            self._known[id(closed.jaxpr)] = found
        return found

    def _make(self, closed: ClosedJaxpr) -> Made:
        """Each value has a place in a list, each step knows its places."""
        jaxpr, places, known = closed.jaxpr, {}, []

        def place(atom: Any) -> int:
            if isinstance(atom, Literal):
                known.append(np.asarray(atom.val, atom.aval.dtype)[()])
                return len(known) - 1
            if atom not in places:
                places[atom] = len(known)
                known.append(None)
            return places[atom]

        for variable, constant in zip(jaxpr.constvars, closed.consts, strict=True):
            known[place(variable)] = np.asarray(constant)[()]
        inputs = [place(v) for v in jaxpr.invars]
        steps, size, work, own = [], 0.0, 0.0, 0.0
        for eqn in jaxpr.eqns:
            weight = 1.0 + sum(v.aval.size for v in eqn.outvars) / ELEMENTS
            nested = NESTED.get(eqn.primitive.name)
            inside = nested(eqn.params, self, len(eqn.outvars)) if nested else Made(1.0, 0.0, _step(eqn))
            size, work, own = size + inside.size, work + inside.work + weight, own + weight
            ins, outs = [place(v) for v in eqn.invars], [place(v) for v in eqn.outvars]
            steps.append((inside.run, ins, outs, len(outs) == 1))
        outputs = [place(v) for v in jaxpr.outvars]

        def run(*values: Any) -> list[Any]:
            _budget.left -= own
            if _budget.left < 0:
                raise TooLong
            at = known.copy()
            for i, value in zip(inputs, values, strict=True):
                at[i] = value
            for step, ins, outs, single in steps:
                found = step(*[at[i] for i in ins])
                if single:
                    at[outs[0]] = found
                else:
                    for i, value in zip(outs, found, strict=True):
                        at[i] = value
            return [at[i] for i in outputs]

        return Made(size, work, run)


def _step(eqn: Any) -> Step:
    name = eqn.primitive.name
    if name in PLAIN:
        return PLAIN[name]
    made = SHAPED[name](eqn.params, eqn) if name in SHAPED else None
    return made or _by_jax(eqn)


def _by_jax(eqn: Any) -> Step:
    """One operation as JAX does it."""
    fixed, several = eqn.params, eqn.primitive.multiple_results

    def step(*values: Any) -> Any:
        with jax.ensure_compile_time_eval():  # a program may run while another is being traced
            found = eqn.primitive.bind(*values, **fixed)
        out = [np.asarray(x)[()] for x in found] if several else np.asarray(found)[()]
        return out[0] if several and len(out) == 1 else out

    return step


def _quotient(x: Any, y: Any) -> Any:
    return x / y if x.dtype.kind == "f" else np.trunc(x / y).astype(x.dtype)


def _before(x: Any, y: Any) -> Any:
    """Total order of floating-point numbers: -0 before 0, all before NaN."""
    signs = (x == y) & np.signbit(x) & ~np.signbit(y) if np.asarray(x).dtype.kind == "f" else False
    return (x < y) | ((y != y) & (x == x)) | signs


PLAIN: dict[str, Step] = {
    "add": lambda x, y: x + y,
    "add_any": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": _quotient,
    "neg": lambda x: -x,
    "rem": np.fmod,
    "pow": np.power,
    "max": np.maximum,
    "min": np.minimum,
    "abs": abs,
    "sign": np.sign,
    "floor": np.floor,
    "ceil": np.ceil,
    "sqrt": np.sqrt,
    "rsqrt": lambda x: 1.0 / np.sqrt(x),
    "cbrt": np.cbrt,
    "square": lambda x: x * x,
    "exp": np.exp,
    "exp2": np.exp2,
    "expm1": np.expm1,
    "log": np.log,
    "log1p": np.log1p,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "eq": lambda x, y: x == y,
    "ne": lambda x, y: x != y,
    "lt": lambda x, y: x < y,
    "le": lambda x, y: x <= y,
    "gt": lambda x, y: x > y,
    "ge": lambda x, y: x >= y,
    "and": lambda x, y: x & y,
    "or": lambda x, y: x | y,
    "xor": lambda x, y: x ^ y,
    "not": lambda x: ~x,
    "is_finite": np.isfinite,
    "shift_left": np.left_shift,
    "shift_right_arithmetic": np.right_shift,
    "nextafter": np.nextafter,
    "lt_to": _before,
    "le_to": lambda x, y: ~_before(y, x),
    "clamp": lambda low, x, high: np.minimum(np.maximum(x, low), high),
    "copy": lambda x: x,
    "copy_p": lambda x: x,
    "stop_gradient": lambda x: x,
}


def _integer_pow(params: Any, _eqn: Any) -> Step:
    y = params["y"]

    def power(x: Any) -> Any:
        found, square, n = None, x, abs(y)
        while n:
            if n & 1:
                found = square if found is None else found * square
            n >>= 1
            square = square * square if n else square
        found = np.ones_like(x)[()] if found is None else found
        return found if y >= 0 else 1.0 / found

    return power


def _select(_params: Any, eqn: Any) -> Step | None:
    if len(eqn.invars) != 3 or eqn.invars[0].aval.dtype != bool:
        return None
    if eqn.invars[0].aval.shape:
        return lambda which, off, on: np.where(which, on, off)
    return lambda which, off, on: on if which else off


def _broadcast(params: Any, eqn: Any) -> Step | None:
    shape, along = params["shape"], params["broadcast_dimensions"]
    if len(eqn.invars) > 1:
        return None
    size = eqn.invars[0].aval.shape
    between = [1] * len(shape)
    for i, axis in enumerate(along):
        between[axis] = size[i]
    if not shape:
        return lambda x: x
    return lambda x: np.broadcast_to(np.reshape(x, between), shape)


def _reduction(function: Step) -> Callable[[Any, Any], Step | None]:
    def made(params: Any, eqn: Any) -> Step | None:
        nothing = not eqn.invars[0].aval.size and function in (np.max, np.min)
        if params.get("out_sharding") is not None or nothing:
            return None
        return lambda x: function(x, axis=params["axes"])

    return made


def _extreme_place(function: Step) -> Callable[[Any, Any], Step]:
    return lambda params, _eqn: lambda x: function(x, axis=params["axes"][0]).astype(params["index_dtype"])


def _running(function: Step) -> Callable[[Any, Any], Step]:
    def made(params: Any, _eqn: Any) -> Step:
        axis = params["axis"]
        if params["reverse"]:
            return lambda x: np.flip(function(np.flip(x, axis), axis=axis), axis)
        return lambda x: function(x, axis=axis)

    return made


def _slice(params: Any, _eqn: Any) -> Step:
    strides = params["strides"] or (1,) * len(params["start_indices"])
    place = tuple(map(slice, params["start_indices"], params["limit_indices"], strides))
    return lambda x: x[place]


def _window(start: Sequence[Any], sizes: Sequence[int], shape: Sequence[int]) -> tuple[slice, ...]:
    firsts = [min(max(int(s), 0), n - size) for s, size, n in zip(start, sizes, shape, strict=True)]
    return tuple(slice(first, first + size) for first, size in zip(firsts, sizes, strict=True))


def _dynamic_slice(params: Any, _eqn: Any) -> Step:
    return lambda x, *start: x[_window(start, params["slice_sizes"], x.shape)]


def _dynamic_update(_params: Any, _eqn: Any) -> Step:
    def step(x: Any, piece: Any, *start: Any) -> Any:
        out = np.array(x)
        out[_window(start, piece.shape, out.shape)] = piece
        return out

    return step


def _product(params: Any, eqn: Any) -> Step | None:
    (left, right), (left_batch, right_batch) = params["dimension_numbers"]
    if params["preferred_element_type"] not in (None, eqn.invars[0].aval.dtype):
        return None
    if left_batch:
        letters = iter(string.ascii_letters)
        first = [next(letters) for _axis in eqn.invars[0].aval.shape]
        second = [next(letters) for _axis in eqn.invars[1].aval.shape]
        for i, j in zip((*left_batch, *left), (*right_batch, *right), strict=True):
            second[j] = first[i]
        kept = [first[i] for i in left_batch]
        kept += [c for i, c in enumerate(first) if i not in (*left_batch, *left)]
        kept += [c for j, c in enumerate(second) if j not in (*right_batch, *right)]
        pattern = f"{''.join(first)},{''.join(second)}->{''.join(kept)}"
        return lambda x, y: np.einsum(pattern, x, y)
    return lambda x, y: np.tensordot(x, y, axes=(left, right))[()]


def _each(function: Callable[[float], float]) -> Callable[[Any, Any], Step]:
    each = np.frompyfunc(function, 1, 1)
    return lambda _params, _eqn: lambda x: np.asarray(each(x), x.dtype)[()]


def _lgamma(x: float) -> float:
    return math.inf if x <= 0.0 and (math.isinf(x) or x == math.floor(x)) else math.lgamma(x)


def _convert(params: Any, eqn: Any) -> Step:
    target = np.dtype(params["new_dtype"])
    if eqn.invars[0].aval.dtype.kind != "f" or target.kind not in "iu":
        return lambda x: x.astype(target)
    low, high = float(np.iinfo(target).min), np.nextafter(float(np.iinfo(target).max), 0.0)
    # beyond the ends and without a number as XLA does it
    return lambda x: np.clip(np.where(np.isnan(x), 0.0, x), low, high).astype(target)[()]


def _places(indices: Any, mode: Any, sizes: Sequence[int]) -> tuple[tuple[Any, ...], Any]:
    """Index arrays, one an axis, brought inside it, and which of them were."""
    columns = [indices[..., k] for k in range(indices.shape[-1])]
    inside = np.all([(c >= 0) & (c < n) for c, n in zip(columns, sizes, strict=True)], axis=0)
    if str(mode).endswith("FILL_OR_DROP") or str(mode).endswith("None"):
        return tuple(columns), inside
    clipped = tuple(np.clip(c, 0, n - 1) for c, n in zip(columns, sizes, strict=True))
    return clipped, np.ones_like(inside)


def _gather(params: Any, eqn: Any) -> Step | None:
    """Whole rows picked by index, along some axes; other patterns are left to JAX."""
    numbers, shape, mode = params["dimension_numbers"], eqn.invars[0].aval.shape, params["mode"]
    indexed = tuple(numbers.start_index_map)
    others = tuple(axis for axis in range(len(shape)) if axis not in indexed)
    full = all(params["slice_sizes"][axis] == shape[axis] for axis in others)
    if numbers.operand_batching_dims or set(numbers.collapsed_slice_dims) != set(indexed) or not full:
        return None
    sizes, fill = [shape[axis] for axis in indexed], params["fill_value"]
    if fill is None:
        if eqn.outvars[0].aval.dtype.kind != "f":
            return None
        fill = np.nan

    def step(x: Any, indices: Any) -> Any:
        places, inside = _places(indices, mode, sizes)
        safe = tuple(np.where(inside, place, 0) for place in places)
        found = np.transpose(x, indexed + others)[safe]
        lost = ~np.reshape(inside, inside.shape + (1,) * len(others))
        if lost.any():
            found = np.where(lost, fill, found)
        count = inside.ndim
        return np.moveaxis(found, range(count, count + len(others)), numbers.offset_dims)

    return step


def _scatter(put: Callable[[Any, Any, Any], None]) -> Callable[[Any, Any], Step | None]:
    """Whole rows changed by index, or one window; other patterns are left to JAX."""

    def made(params: Any, eqn: Any) -> Step | None:
        numbers, mode = params["dimension_numbers"], params["mode"]
        if numbers.operand_batching_dims:
            return None
        shape, given = eqn.invars[0].aval.shape, eqn.invars[2].aval.shape
        indexed, inserted = tuple(numbers.scatter_dims_to_operand_dims), set(numbers.inserted_window_dims)
        others = tuple(axis for axis in range(len(shape)) if axis not in indexed)
        windows = iter(numbers.update_window_dims)
        sizes = [1 if axis in inserted else given[next(windows)] for axis in range(len(shape))]

        def window(x: Any, indices: Any, update: Any) -> Any:
            first = np.zeros(len(shape), int)
            first[list(indexed)] = indices
            if np.any(first < 0) or np.any(first + sizes > shape):
                return x
            out = np.array(x)
            region = tuple(map(slice, first, first + sizes))
            put(out, region, np.reshape(update, sizes))
            return out

        def rows(x: Any, indices: Any, update: Any) -> Any:
            places, inside = _places(indices, mode, [shape[axis] for axis in indexed])
            out = np.array(x)
            along = np.moveaxis(update, numbers.update_window_dims, range(inside.ndim, np.ndim(update)))
            put(np.transpose(out, indexed + others), tuple(p[inside] for p in places), along[inside])
            return out

        if eqn.invars[1].aval.ndim == 1:
            return window if "CLIP" not in str(mode) else None
        whole = all(sizes[axis] == shape[axis] for axis in others)
        return rows if inserted == set(indexed) and whole else None

    return made


def _put(out: Any, places: Any, values: Any) -> None:
    out[places] = values


def _split(params: Any, _eqn: Any) -> Step:
    ends = np.cumsum(params["sizes"])[:-1]
    if not ends.size:
        return lambda x: x
    return lambda x: np.split(x, ends, axis=params["axis"])


def _iota(params: Any, eqn: Any) -> Step | None:
    if eqn.invars:
        return None
    shape, along = params["shape"], params["dimension"]
    counts = np.arange(shape[along], dtype=params["dtype"])
    whole = np.broadcast_to(np.reshape(counts, [-1 if i == along else 1 for i in range(len(shape))]), shape)
    return lambda: whole


def _rounding(params: Any, _eqn: Any) -> Step | None:
    return np.rint if int(params["rounding_method"]) == 1 else None


SHAPED: dict[str, Callable[[Any, Any], Step | None]] = {
    "integer_pow": _integer_pow,
    "select_n": _select,
    "broadcast_in_dim": _broadcast,
    "convert_element_type": _convert,
    "bitcast_convert_type": lambda params, eqn: (
        (lambda x: x.view(params["new_dtype"]))
        if np.dtype(params["new_dtype"]).itemsize == eqn.invars[0].aval.dtype.itemsize
        else None
    ),
    "reshape": lambda params, _eqn: (
        (lambda x: np.reshape(x, params["new_sizes"])[()]) if params["dimensions"] is None else None
    ),
    "squeeze": lambda params, _eqn: lambda x: np.squeeze(x, params["dimensions"])[()],
    "expand_dims": lambda params, _eqn: lambda x: np.expand_dims(x, params["dimensions"]),
    "transpose": lambda params, _eqn: lambda x: np.transpose(x, params["permutation"]),
    "rev": lambda params, _eqn: lambda x: np.flip(x, params["dimensions"]),
    "concatenate": lambda params, _eqn: lambda *parts: np.concatenate(parts, axis=params["dimension"]),
    "slice": _slice,
    "dynamic_slice": _dynamic_slice,
    "dynamic_update_slice": _dynamic_update,
    "reduce_sum": _reduction(np.sum),
    "reduce_prod": _reduction(np.prod),
    "reduce_max": _reduction(np.max),
    "reduce_min": _reduction(np.min),
    "reduce_and": _reduction(np.all),
    "reduce_or": _reduction(np.any),
    "argmax": _extreme_place(np.argmax),
    "argmin": _extreme_place(np.argmin),
    "cumsum": _running(np.cumsum),
    "cumprod": _running(np.cumprod),
    "cummax": _running(np.maximum.accumulate),
    "cummin": _running(np.minimum.accumulate),
    "dot_general": _product,
    "gather": _gather,
    "scatter": _scatter(_put),
    "scatter-add": _scatter(np.add.at),
    "scatter-mul": _scatter(np.multiply.at),
    "stack": lambda params, _eqn: lambda *parts: np.stack(parts, axis=params["axis"]),
    "split": _split,
    "iota": _iota,
    "round": _rounding,
    "erf": _each(math.erf),
    "erfc": _each(math.erfc),
    "lgamma": _each(_lgamma),
}


def _alone(found: list[Any], count: int) -> Any:
    return found[0] if count == 1 else found


def _called(name: str) -> Callable[..., Made]:
    def made(params: Any, maker: _Maker, count: int) -> Made:
        inner = params[name]
        body = maker.made(inner if isinstance(inner, ClosedJaxpr) else ClosedJaxpr(inner, ()))
        run = body.run
        return body._replace(run=lambda *values: _alone(run(*values), count))

    return made


def _while(params: Any, maker: _Maker, count: int) -> Made:
    judge, body = maker.made(params["cond_jaxpr"]), maker.made(params["body_jaxpr"])
    first, second = params["cond_nconsts"], params["cond_nconsts"] + params["body_nconsts"]

    several = bool(params["cond_jaxpr"].jaxpr.outvars[0].aval.shape)

    def step(*values: Any) -> Any:
        judged_by, made_of, carry = values[:first], values[first:second], list(values[second:])
        while np.any(goes_on := judge.run(*judged_by, *carry)[0]):
            found = body.run(*made_of, *carry)
            # of loops that a batch runs together, those that have ended stay
            carry = list(map(_stay(goes_on), found, carry)) if several else found
        return _alone(carry, count)

    return Made(judge.size + body.size, EMPTY_PASSES * (judge.work + body.work), step)


def _stay(goes_on: Any) -> Step:
    shape = goes_on.shape
    return lambda new, old: np.where(np.reshape(goes_on, shape + (1,) * (new.ndim - len(shape))), new, old)


def _cond(params: Any, maker: _Maker, count: int) -> Made:
    branches = [maker.made(branch) for branch in params["branches"]]

    def step(which: Any, *values: Any) -> Any:
        return _alone(branches[min(max(int(which), 0), len(branches) - 1)].run(*values), count)

    return Made(sum(b.size for b in branches), max(b.work for b in branches), step)


def _scan(params: Any, maker: _Maker, count: int) -> Made:
    body, length, carried = maker.made(params["jaxpr"]), params["length"], params["num_carry"]
    first, second = params["num_consts"], params["num_consts"] + carried
    shapes = [(v.aval.shape, v.aval.dtype) for v in params["jaxpr"].jaxpr.outvars[carried:]]

    def step(*values: Any) -> Any:
        fixed, carry, rows = values[:first], list(values[first:second]), values[second:]
        made = [np.empty((length, *shape), dtype) for shape, dtype in shapes]
        for i in range(length)[:: -1 if params["reverse"] else 1]:
            found = body.run(*fixed, *carry, *(row[i] for row in rows))
            carry = found[:carried]
            for whole, part in zip(made, found[carried:], strict=True):
                whole[i] = part
        return _alone([*carry, *made], count)

    return Made(body.size, length * body.work, step)


def _linear_solve(params: Any, maker: _Maker, count: int) -> Made:
    body, counts = maker.made(params["jaxprs"].solve), params["const_lengths"]
    before = counts.matvec + counts.vecmat
    after = before + counts.solve + counts.transpose_solve

    def step(*values: Any) -> Any:
        return _alone(body.run(*values[before : before + counts.solve], *values[after:]), count)

    return body._replace(run=step)


NESTED: dict[str, Callable[..., Made]] = {
    "jit": _called("jaxpr"),
    "pjit": _called("jaxpr"),
    "closed_call": _called("call_jaxpr"),
    "custom_jvp_call": _called("call_jaxpr"),
    "custom_vjp_call": _called("call_jaxpr"),
    "while": _while,
    "cond": _cond,
    "scan": _scan,
    "custom_linear_solve": _linear_solve,
}
