"""``granum`` as a user types it."""

from __future__ import annotations

import contextvars

from typer.testing import CliRunner

from granum.cli import app


def granum(*words: object) -> tuple[int, str, str]:
    """Exit status, what it prints and what it complains of; the language ends with the command."""
    outcome = contextvars.copy_context().run(CliRunner().invoke, app, [str(word) for word in words])
    return outcome.exit_code, outcome.stdout, outcome.stderr
