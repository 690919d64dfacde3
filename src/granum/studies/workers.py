"""Chunks computed by Dask workers, local or behind a scheduler; a worker that dies loses nothing, its chunks
go to others.
"""

from __future__ import annotations

import logging
from collections.abc import Generator
from contextlib import ExitStack
from functools import lru_cache
from typing import Any
from uuid import uuid4

import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.studies.chunks import evaluator
from granum.studies.store import Part

RETRIES = 5


@lru_cache(maxsize=4)
def _built(recipe: Any) -> Any:
    return recipe.build()


def chunk(recipe: Any, inputs: tuple[str, ...], outputs: tuple[str, ...], size: int, x: np.ndarray) -> Part:
    """One chunk, computed in the process of a worker; the model is built there once."""
    return evaluator(_built(recipe), inputs, outputs, size)(x)


def computed(
    recipe: Any,
    inputs: tuple[str, ...],
    outputs: tuple[str, ...],
    chunks: list[tuple[int, np.ndarray]],
    workers: Any,
) -> Generator[tuple[int, Part], None, None]:
    """Finished chunks with their first case, in the order in which they finish.

    ``workers``: a number of local processes, the address of a scheduler, or a ``distributed.Client``.
    """
    try:
        import distributed
    except ImportError:
        raise InputError(_("Workers need Dask: pip install 'granum[distributed]'.")) from None
    size, own = max(len(x) for _start, x in chunks), uuid4().hex
    with ExitStack() as stack:
        client = (
            workers
            if isinstance(workers, distributed.Client)
            else stack.enter_context(_connect(distributed, workers, stack))
        )
        futures = {
            client.submit(
                chunk,
                recipe,
                inputs,
                outputs,
                size,
                x,
                key=f"granum-{start}-{own}",
                retries=RETRIES,
                pure=False,
            ): start
            for start, x in chunks
        }
        try:
            for done, result in distributed.as_completed(futures, with_results=True, raise_errors=True):
                yield futures[done], result
        except distributed.KilledWorker as problem:
            raise InputError(
                _("A chunk killed its worker again and again ({problem}): too little memory?").format(
                    problem=problem
                )
            ) from None
        finally:
            client.cancel(list(futures), force=True)


def _connect(distributed: Any, workers: Any, stack: ExitStack) -> Any:
    text = str(workers).strip()
    if text.isdigit():
        if int(text) < 1:
            raise InputError(_("'workers' must be at least 1."))
        try:
            cluster = distributed.LocalCluster(
                n_workers=int(text),
                threads_per_worker=1,
                processes=True,
                dashboard_address=None,
                silence_logs=logging.ERROR,
            )
        except RuntimeError as problem:
            raise InputError(
                _(
                    "Local workers did not start ({problem}). In a script of your own, call the study "
                    'under: if __name__ == "__main__":'
                ).format(problem=problem)
            ) from None
        stack.enter_context(cluster)
        return distributed.Client(cluster)
    try:
        return distributed.Client(text, timeout=10)
    except (OSError, ValueError) as problem:
        reason = str(problem).splitlines()[0] if str(problem) else type(problem).__name__
        raise InputError(
            _("No Dask scheduler answers at '{address}': {reason}").format(address=text, reason=reason)
        ) from None
