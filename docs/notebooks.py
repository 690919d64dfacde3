"""A guide as a notebook: its code becomes cells, all else stands between them."""

from __future__ import annotations

import re
from typing import Any

PAGES = ("guides/in-the-notebook", "fr/dans-un-carnet")
_CODE = re.compile(r"^```python\n(.*?)^```\n(?:```text\n.*?^```\n)?", re.MULTILINE | re.DOTALL)


def notebook(page: str) -> dict[str, Any]:
    """The notebook of a page, without what its cells print: they are there to be run."""
    cells = []
    for i, text in enumerate(_CODE.split(page)):
        source = text.strip().splitlines(keepends=True)
        if source:
            code = {"outputs": [], "execution_count": None} if i % 2 else {}
            kind = "code" if code else "markdown"
            cells.append({"cell_type": kind, "id": f"cell-{i}", "metadata": {}, "source": source} | code)
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}
