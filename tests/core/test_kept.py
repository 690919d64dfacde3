"""Programs kept for the next process give what fresh ones give, and what is stale, damaged, forbidden or not
to be named is not used.
"""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Iterator
from copy import copy
from hashlib import sha256
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core import kept, registry
from granum.core.compiling import begun, once
from granum.core.i18n import language
from granum.core.uncompiled import Program
from granum.particles import terminal_velocity

ROOT = Path(__file__).parents[2]


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    """Programs are kept here during a test."""
    place = tmp_path / "traced"
    kept.keep_in(place)
    yield place
    kept.keep_in(None)


class Counted:
    """A function that knows how often it was traced."""

    def __init__(self, factor: float = 3.0):
        self.traced = 0
        self.factor = factor

    def __call__(self, x: Any, y: Any) -> Any:
        self.traced += 1
        return {"product": jnp.sin(x) * y * self.factor, "kind": (x > y,)}


def ask(function: Any, x: Any = 2.0, y: Any = 0.5, named: Any = "test") -> Any:
    """As the first call of a new process would."""
    return begun(function, named)(x, y)


def leave(folder: Path) -> list[Path]:
    """The end of a process."""
    kept.store()
    return sorted(folder.glob(f"*{kept.ENDING}"))


def test_the_next_process_traces_nothing_and_gets_the_same(folder: Path) -> None:
    first, second = Counted(), Counted()
    expected = ask(first)
    assert len(leave(folder)) == 1
    found = ask(second)
    assert (first.traced, second.traced) == (1, 0)
    assert found == expected == {"product": np.sin(2.0) * 1.5, "kind": (True,)}
    assert ask(second, 1.0, 4.0)["product"] == np.sin(1.0) * 12.0


@pytest.mark.parametrize(
    ("x", "named"), [(jnp.ones(3), "test"), (np.float32(2.0), "test"), (2.0, "other"), (2.0, ("test", 1.0))]
)
def test_what_tracing_looks_at_is_in_the_name(folder: Path, x: Any, named: Any) -> None:
    ask(Counted())
    leave(folder)
    other = Counted()
    ask(other, x, named=named)
    assert other.traced == 1
    assert len(leave(folder)) == 2


def test_whether_equal_things_are_one_is_not_in_the_name(folder: Path) -> None:
    one, other = (2.0, "water"), ("".join(["wa", "ter"]), 2.0)[::-1]
    assert one == other
    assert one[1] is not other[1]
    ask(Counted(), named=[one, one])
    leave(folder)
    second = Counted()
    ask(second, named=[one, other])
    assert second.traced == 0


def test_another_language_and_other_code_have_other_names(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ask(Counted())
    leave(folder)
    french, later = Counted(), Counted(4.0)
    with language("fr"):
        ask(french)
    monkeypatch.setattr(kept, "_surroundings", lambda: b"a later version")
    assert ask(later)["product"] == np.sin(2.0) * 2.0
    assert (french.traced, later.traced) == (1, 1)


def test_every_file_and_setting_changes_the_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("a.py", "b.csv", "c.toml", "page.js"):
        (tmp_path / "package" / "core").mkdir(parents=True, exist_ok=True)
        (tmp_path / "package" / name).write_text("1")
    monkeypatch.setattr(kept, "__file__", str(tmp_path / "package" / "core" / "kept.py"))

    def now() -> bytes:
        kept._surroundings.cache_clear()
        return kept._surroundings()

    seen = [now()]
    for name in ("a.py", "b.csv", "c.toml"):
        stamp = (tmp_path / "package" / name).stat().st_mtime
        (tmp_path / "package" / name).write_text("2")  # as long and as old as before
        os.utime(tmp_path / "package" / name, (stamp, stamp))
        seen.append(now())
    monkeypatch.setenv("JAX_NUMPY_RANK_PROMOTION", "raise")
    seen.append(now())
    monkeypatch.setattr("importlib.metadata.version", lambda name: "99" if name == "equinox" else "1")
    seen.append(now())
    assert len(set(seen)) == len(seen)
    (tmp_path / "package" / "page.js").write_text("2")
    assert now() == seen[-1]
    kept._surroundings.cache_clear()


def _forbidden() -> bytes:
    content = pickle.dumps(os.system)
    return sha256(content).digest() + content


@pytest.mark.parametrize(
    "spoil",
    [
        lambda whole: b"",
        lambda whole: whole[: len(whole) // 2],
        lambda whole: whole[:-1] + bytes([whole[-1] ^ 1]),
        lambda whole: b"\0" * len(whole),
        lambda whole: _forbidden(),
        lambda whole: sha256(b"").digest(),
    ],
    ids=["empty", "half", "a bit", "zeros", "a pickle that calls a shell", "nothing, with its sum"],
)
def test_what_is_damaged_is_traced_anew_and_mended(folder: Path, spoil: Any) -> None:
    expected = ask(Counted())
    (path,) = leave(folder)
    whole = path.read_bytes()
    path.write_bytes(spoil(whole))
    again = Counted()
    assert ask(again) == expected
    assert again.traced == 1
    assert leave(folder) == [path]
    assert path.read_bytes() == whole


def test_a_folder_where_others_write_is_not_believed(folder: Path) -> None:
    ask(Counted())
    (path,) = leave(folder)
    folder.chmod(0o777)
    again, another = Counted(), Counted()
    ask(again)
    ask(another, named="another")
    assert (again.traced, another.traced) == (1, 1)
    assert leave(folder) == [path]


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="owners are told apart where there are user numbers")
def test_a_folder_of_somebody_else_is_not_believed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ask(Counted())
    leave(folder)
    monkeypatch.setattr(os, "getuid", lambda: 12345)
    again = Counted()
    ask(again)
    assert again.traced == 1


def test_a_folder_that_cannot_be_written_does_no_harm(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_given: Any, **_options: Any) -> Any:
        raise PermissionError("read-only file system")

    monkeypatch.setattr(kept.tempfile, "mkstemp", refused)
    assert ask(Counted())["product"] == np.sin(2.0) * 1.5
    assert leave(folder) == []
    monkeypatch.undo()
    in_the_way = tmp_path / "file"
    in_the_way.write_text("")
    kept.keep_in(in_the_way / "traced")
    assert ask(Counted())["product"] == np.sin(2.0) * 1.5
    kept.store()
    assert in_the_way.read_text() == ""


def test_a_disk_that_fills_up_leaves_no_half_files(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_given: Any) -> None:
        raise OSError(28, "No space left on device")

    ask(Counted())
    monkeypatch.setattr(kept.os, "replace", full)
    kept.store()
    assert list(folder.iterdir()) == []


def test_many_writers_and_readers_at_once(folder: Path) -> None:
    expected = ask(Counted())
    (path,) = leave(folder)
    whole, wrong = path.read_bytes(), []

    def write() -> None:
        for _turn in range(40):
            kept._write(path, whole)

    def read() -> None:
        for _turn in range(40):
            again = Counted()
            if ask(again) != expected or again.traced:
                wrong.append(again.traced)

    threads = [threading.Thread(target=act) for act in (write, write, read, read)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []
    assert list(folder.iterdir()) == [path]


def test_the_oldest_make_room(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for i in range(4):
        ask(Counted(), named=i)
        for path in leave(folder):
            os.utime(path, (path.stat().st_mtime - 100.0,) * 2)
    before = sorted(folder.iterdir(), key=lambda p: p.stat().st_mtime)
    monkeypatch.setattr(kept, "MOST", sum(p.stat().st_size for p in before[-2:]) + 10)
    again = Counted()
    ask(again, named=0)  # the oldest, used again
    assert again.traced == 0
    ask(Counted(), named="new")
    after = leave(folder)
    assert len(after) == 2
    assert before[0] in after


def mine(x: Any) -> Any:
    """A function that Granum does not know."""
    return 2.0 * x


def test_what_somebody_wrote_is_not_kept(folder: Path) -> None:
    ask(Counted(), named=mine)
    ask(Counted(), named=lambda x: x)
    ask(Counted(), named=Counted)
    ask(Counted(), named=("inside", [{"deep": (mine,)}]))
    assert once(mine, 2.0) == 4.0
    assert leave(folder) == []


def test_formulas_are_named_by_their_card(folder: Path) -> None:
    ask(Counted(), named=(terminal_velocity, "bare"))
    assert len(leave(folder)) == 1
    assert kept._reference(terminal_velocity) == (kept._card, ("particles.terminal_velocity",))
    assert kept._reference(copy(terminal_velocity)) is None


def long(x: Any, n: Any) -> Any:
    """A loop that pays to be compiled after some turns."""
    return jax.lax.while_loop(lambda s: s[0] < n, lambda s: (s[0] + 1, jnp.cos(s[1]) + x), (0, x))[1]


def test_loops_that_were_compiled_are_compiled_at_once(folder: Path) -> None:
    fresh = begun(long, "loop")
    expected = [float(fresh(0.1, n)) for n in (100_000, 7)]
    (path,) = leave(folder)
    assert path.stat().st_size > 1000

    again = begun(lambda x, n: pytest.fail("traced"), "loop")
    assert [float(again(0.1, n)) for n in (100_000, 7)] == pytest.approx(expected, rel=1e-12)


def test_a_loop_that_grows_beyond_what_was_kept_is_traced_anew(folder: Path) -> None:
    begun(long, "loop")(0.1, 7)
    (path,) = leave(folder)
    small = path.stat().st_size
    expected = float(jax.jit(long)(0.1, 100_000))
    assert float(begun(long, "loop")(0.1, 100_000)) == pytest.approx(expected, rel=1e-12)
    assert leave(folder) == [path]
    assert path.stat().st_size > small  # now with what is compiled


def test_a_loop_is_compiled_earlier_where_the_next_process_has_it_too() -> None:
    turns = 10_000
    closed = jax.make_jaxpr(long)(0.1, turns)
    (alone,), taken_alone = Program(closed).run([0.1, turns])
    shared = Program(closed, kept=True)
    (same,), taken = shared.run([0.1, turns])
    assert same == pytest.approx(float(alone), rel=1e-12)
    assert taken < 0.7 * taken_alone  # the rest ran compiled
    assert shared.loops[0] is not None


def test_what_only_jax_does_is_not_kept(folder: Path) -> None:
    def inverse(x: Any) -> Any:
        return jax.lax.erf_inv(x)

    assert not Program(jax.make_jaxpr(inverse)(0.5)).lasts
    begun(inverse, "inverse")(0.5)
    assert leave(folder) == []


def test_a_line_is_the_same_the_second_time(tmp_path: Path) -> None:
    told = []
    for seed in ("1", "2"):
        environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path), "PYTHONHASHSEED": seed}
        words = [sys.executable, "-m", "granum", "run", "examples/potassium-nitrate/line.toml", "--json"]
        done = subprocess.run(words, cwd=ROOT, env=environment, capture_output=True, check=True)
        told.append(json.loads(done.stdout))
        files = {p.name: p.stat().st_ino for p in (tmp_path / "granum" / "traced").iterdir()}
        if seed == "1":
            first = files
    assert told[0] == told[1]
    assert files == first  # nothing had to be traced and written again


@pytest.mark.parametrize("key", ["filtration.rotary_vacuum_drum", "particles.terminal_velocity"])
def test_a_card_is_the_same_from_what_an_earlier_process_kept(folder: Path, key: str) -> None:
    assert kept.card(key) is registry.find(key).card
    assert len(leave(folder)) == 1
    again = kept.card(key)
    assert again is not registry.find(key).card
    assert again.as_json() == registry.find(key).card.as_json()


def test_a_kept_card_is_shown_without_jax(tmp_path: Path) -> None:
    shown, script = (
        [],
        "import sys; from granum.cli import app; app(standalone_mode=False); print('jax' in sys.modules)",
    )
    for spoken in ("en", "en", "fr", "fr"):
        environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path), "GRANUM_LANG": spoken}
        words = ["show", "filtration.rotary_vacuum_drum"]
        begun = "from granum.shell import keep_compiled_code as keep; from granum.core import kept; keep(); "
        done = subprocess.run(
            [sys.executable, "-c", f"{begun}{script}; kept.store()", *words],
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        )
        card, _newline, with_jax = done.stdout.strip().rpartition("\n")
        shown.append((card, with_jax))
    (english, first), (same, second), (french, _), (_, fourth) = shown
    assert english == same != french
    assert (first, second, fourth) == ("True", "False", "False")


def test_what_a_card_was_kept_for_is_not_read_when_files_have_changed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    key = "filtration.rotary_vacuum_drum"
    kept.card(key)
    leave(folder)
    monkeypatch.setattr(kept, "_surroundings", lambda: b"another version")
    assert kept.card(key) is registry.find(key).card
