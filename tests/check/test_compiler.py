"""Compilers that are not there, that say nothing, that do not end."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from kinsym.check import compiler
from kinsym.check.compiler import compile_shared, compiler_version, find_compiler
from kinsym.errors import CheckFailed


def script(folder: Path, text: str) -> str:
    """A program by the name of a compiler."""
    path = folder / "cc"
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return str(path)


def test_the_variable_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its first word, if that is a program; otherwise the usual names, whatever stands there."""
    own, other = script(tmp_path, "exit 0"), tmp_path / "bin"
    other.mkdir()
    usual = script(other, "exit 0")
    monkeypatch.setenv("PATH", f"{other}")
    for named, found in ((f"{own} -m64", own), ("nothing-of-the-kind", usual), ("'unpaired", usual), ("", usual)):
        monkeypatch.setenv("CC", named)
        assert find_compiler() == found
    monkeypatch.setenv("PATH", str(tmp_path / "none"))
    assert find_compiler() is None
    with pytest.raises(CheckFailed, match=r"no C compiler was found\. Install gcc or clang, or name one"):
        compile_shared(tmp_path, "arm", tmp_path)


def test_one_that_cannot_be_run(tmp_path: Path) -> None:
    with pytest.raises(CheckFailed, match=r"the compiler gone could not be run: .*No such file"):
        compile_shared(tmp_path, "arm", tmp_path, compiler=str(tmp_path / "gone"))


def test_one_that_says_nothing(tmp_path: Path) -> None:
    """Neither its version, nor why it does not compile."""
    silent = script(tmp_path, "exit 3")
    assert compiler_version(silent) == ""
    with pytest.raises(CheckFailed, match=r"arm\.c does not compile with cc:\n$"):
        compile_shared(tmp_path, "arm", tmp_path, compiler=silent)


def test_one_that_does_not_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is ended together with what it has started."""
    endless = script(tmp_path, f"sleep 60 &\necho $! > {tmp_path}/child\nwait")
    monkeypatch.setattr(compiler, "_SECONDS", 0.5)
    with pytest.raises(CheckFailed, match=r"the compiler cc could not be run: .* timed out after"):
        compile_shared(tmp_path, "arm", tmp_path, compiler=endless)
    child = int((tmp_path / "child").read_text())
    end = time.monotonic() + 10
    while Path(f"/proc/{child}/stat").exists() and time.monotonic() < end:
        if Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
            break
        time.sleep(0.02)
    assert time.monotonic() < end
