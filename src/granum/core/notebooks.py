"""What results look like in a notebook: as the command line prints them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def shown(printer: str, thing: Any) -> str:
    """HTML of what a function of the command line prints; ``printer`` is its ``module:name``, which the core
    itself does not know.
    """
    module, _colon, name = printer.partition(":")
    html: str = import_module("granum.reports.terminal").as_html(getattr(import_module(module), name), thing)
    return html
