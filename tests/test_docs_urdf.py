"""The commands and lines of docs/urdf.md work as they stand there."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from pathlib import Path

import pytest

from kinsym.cli import main

PAGE = (Path(__file__).resolve().parent.parent / "docs" / "urdf.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


def test_the_commands_and_what_they_print(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each command runs on the file shown; what stands below it is all that it prints."""
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(blocks("xml")[0], encoding="utf-8")
    for block in blocks("console"):
        for command, shown in re.findall(r"^\$ kinsym (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE):
            status = main([*shlex.split(command), *(["--no-check"] if command.startswith("derive") else [])])
            out, err = capsys.readouterr()
            assert status == (2 if shown.startswith("kinsym:") else 0), err
            assert shown in ("", out, err)
    assert Path("hoist", "hoist.py").is_file()
    assert Path("lifting_arm", "lifting_arm.c").is_file()


def test_the_python_lines() -> None:
    """The twists are those in the comment."""
    (code,) = blocks("python")
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(code, {})
    twists, sentence = printed.getvalue().splitlines()
    assert f"# {twists}" in code
    assert sentence.startswith("3 numbers read as special values")


def test_rounding_is_what_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the angle made exact the arm keeps its twist of 1.5708."""
    from kinsym.robot import load
    from kinsym.robot.snapping import EXACT

    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(blocks("xml")[0], encoding="utf-8")
    assert str(load("arm.urdf", tip_link="hook").joints[0].alpha) == "pi/2"
    assert float(load("arm.urdf", tip_link="hook", snapping=EXACT).joints[0].alpha or 0) == 1.5708
