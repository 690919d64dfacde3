"""The routines of LAPACK, without what else stands in SciPy's package of linear algebra: JAX asks for them
before it compiles anything, and the whole package takes as long to import as a line takes to solve.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec, module_from_spec

PACKAGE = "scipy.linalg"


def at_hand() -> None:
    """Import the two modules in which JAX looks for LAPACK, alone. For processes in which one thread works.

    >>> at_hand()
    """
    if PACKAGE in sys.modules:
        return
    spec = find_spec(PACKAGE)
    assert spec is not None  # SciPy is required
    sys.modules[PACKAGE] = module_from_spec(spec)  # a package that has not been run
    try:
        from scipy.linalg import cython_blas, cython_lapack  # noqa: F401
    finally:
        del sys.modules[PACKAGE]
