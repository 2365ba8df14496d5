"""Files of any size and kind: a gigabyte costs no memory, a pipe no time, and a variable of the shell no traceback."""

from __future__ import annotations

import os
import resource
import time
from pathlib import Path

import pytest

from kinsym.check.compiler import find_compiler
from kinsym.cli import main
from kinsym.errors import KinsymError
from kinsym.robot import from_inline, load
from kinsym.robot.names import nearest
from tests.urdf.trees import J, urdf, write

GIGABYTE = 1 << 30
KIBIBYTES = 64 << 10


def memory() -> int:
    """The most memory this process has had, in KiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


@pytest.mark.parametrize("name", ["arm.toml", "arm.csv", "arm.urdf", "arm.report.json"])
def test_a_file_of_a_gigabyte(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Refused by its size, of which no more is read than is allowed."""
    (tmp_path / name).touch()
    os.truncate(tmp_path / name, GIGABYTE)
    before, start = memory(), time.process_time()
    arguments = ["check", str(tmp_path)] if "report" in name else ["show", str(tmp_path / name), "--convention", "paul"]
    if name.endswith(".urdf"):
        arguments = arguments[:2]
    assert main(arguments) == 2
    assert "is larger than" in capsys.readouterr().err
    assert memory() - before < KIBIBYTES
    assert time.process_time() - start < 3


def test_a_gigabyte_in_the_way_of_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whether kinsym wrote a file is told from what kinsym could have written."""
    (tmp_path / "planar_rr.c").touch()
    os.truncate(tmp_path / "planar_rr.c", GIGABYTE)
    before = memory()
    assert main(["derive", "planar_rr", "--no-check", "-o", str(tmp_path)]) == 2
    assert "was not written by kinsym" in capsys.readouterr().err
    assert memory() - before < KIBIBYTES


def test_what_is_no_plain_file_is_not_waited_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A pipe in the place of a generated file."""
    assert main(["derive", "planar_rr", "--no-check", "--quiet", "-o", str(tmp_path)]) == 0
    (tmp_path / "planar_rr.c").unlink()
    os.mkfifo(tmp_path / "planar_rr.c")
    assert main(["check", str(tmp_path)]) == 2
    assert "is no plain file" in capsys.readouterr().err


def test_a_cell_of_many_megabytes() -> None:
    """Its length is all that is looked at."""
    start = time.process_time()
    for cell in ("9" * 30_000_000, "(" * 30_000_000, "a+" * 15_000_000):
        with pytest.raises(KinsymError, match="longer than 1000 characters"):
            from_inline(f"0 {cell} 0 theta1", convention="paul")
    assert time.process_time() - start < 3


def test_dots_without_end(tmp_path: Path) -> None:
    """A dotted key in a line of its own, in a header and in an inline table; tomllib alone would take hours."""
    for line in ("{0}a = 1", "[{0}a]", "x = {{{0}a = 1}}"):
        path = tmp_path / "arm.toml"
        path.write_text(f'name = "arm"\n{line.format("a." * 300_000)}\n')
        with pytest.raises(KinsymError, match="line 2: the line has more than 1000 dots"):
            load(str(path))
    start = time.process_time()
    path.write_text("".join(f"{'a.' * 999}a{i} = 1\n" for i in range(100)))
    with pytest.raises(KinsymError, match="unknown key"):
        load(str(path))
    assert time.process_time() - start < 10


def test_a_hint_among_thousands_of_long_names(tmp_path: Path) -> None:
    """Looking for the nearest name is given up where it would take long."""
    names = ["a" * 190 + f"{i:05d}" for i in range(4900)]
    joints = [J(f"j{i}", "revolute", "a", name) for i, name in enumerate(names)]
    text = urdf(*joints).replace('<parent link="a"/>', f'<parent link="{"a" * 190}"/>', 1)
    start = time.process_time()
    with pytest.raises(KinsymError, match="there is no link"):
        load(str(write(tmp_path, text)))
    assert time.process_time() - start < 3
    assert nearest("thet1", ["theta1", *names]) == "Did you mean theta1? "


def test_a_compiler_that_is_no_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """CC holds a quotation mark without its partner: the usual compilers are looked for."""
    usual = find_compiler()
    monkeypatch.setenv("CC", "gcc 'x")
    assert find_compiler() == usual
