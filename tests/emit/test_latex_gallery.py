"""Every robot of the gallery, an arm with four branches, and two that try to break the page, as text and as LaTeX."""

from __future__ import annotations

import re
import shutil
import subprocess
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.latex import document
from kinsym.emit.text import equations
from kinsym.robot import load
from tests.arms import KINDS, SHAPES, robot

# A twist of 30 degrees, offsets in every cell, names of 35 letters, joints without numbers, base and tool.
TILTED = r"""
name = "tilted"
title = "50% of \\input{x} & $y_1$"
convention = "craig"
task = "position"
joints = [
  { type = "R", variable = "shoulder_pan", alpha = "deg(30)", a = "0", d = "height", theta = "shoulder_pan" },
  { type = "R", variable = "elbow", alpha = "pi/2", a = "b", d = "0.1", theta = "elbow - pi/2" },
  { type = "R", variable = "phi", alpha = "0", a = "length_of_the_upper_arm_of_this_one", d = "0", theta = "pi - phi" },
  { type = "fixed", alpha = "0", a = "length_of_the_lower_arm_of_this_one", d = "0", theta = "0" },
]
[base]
xyz = [0.1, "sqrt(2)*b", 0.2]
rpy = ["0", "0", 0.3]
[tool]
xyz = [0.1, "0", 0.2]
rpy = ["pi/2", "0", "deg(45)"]
[parameters]
b = 0.1234567
"""

# The Puma 560 of the gallery with its published numbers folded in.
NUMBERS = {"d3": Fraction("0.15005"), "a2": Fraction("0.4318"), "a3": Fraction("0.0203"), "d4": Fraction("0.4318")}


@cache
def derived(name: str) -> Derivation:
    return derive(load(name))


@pytest.fixture(params=[*KINDS, "tilted", "puma560 in numbers", "symbolic_pieper"])
def derivation(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Derivation:
    if request.param == "tilted":
        path = tmp_path_factory.mktemp("robots") / "tilted.toml"
        path.write_text(TILTED, encoding="utf-8")
        return derive(load(str(path)))
    if request.param == "puma560 in numbers":
        return derive(load("puma560", bindings=NUMBERS))
    if request.param in SHAPES:
        return derive(robot(request.param))
    return derived(request.param)


def test_text_fits_and_tells_every_step(derivation: Derivation) -> None:
    text = equations(derivation, width=100, full=True)
    assert max(map(len, text.splitlines())) <= 100
    steps = re.findall(r"^  (\d+)\. (\w+): ", text, re.MULTILINE)
    assert steps == [(str(step.number), step.unknown) for step in derivation.plan.steps]
    assert f"{derivation.plan.maximum} solution" in text or derivation.plan.maximum == 1


def test_latex_tells_every_step_and_every_solution(derivation: Derivation) -> None:
    text = document(derivation)
    assert text.isascii()
    assert text.count(r"\subsection*{Step ") == len(derivation.plan.steps)
    solutions = text.partition(r"\subsection*{Solutions}")[2]
    rows = re.findall(r"^\$\d+\$ & \$[+1-4-]\$", solutions, re.MULTILINE)
    assert len(rows) == (derivation.plan.maximum if derivation.plan.maximum > 1 else 0)


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
def test_latex_compiles_within_its_margins(derivation: Derivation, tmp_path: Path) -> None:
    (tmp_path / "robot.tex").write_text(document(derivation), encoding="ascii")
    command = ["pdflatex", "-draftmode", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "robot.tex"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=120)
    log = (tmp_path / "robot.log").read_text(encoding="latin-1").replace("\n", "")
    assert result.returncode == 0, log[-2000:]
    assert "undefined" not in log
    overfull = [float(points) for points in re.findall(r"Overfull \\hbox \(([\d.]+)pt too wide", log)]
    assert max(overfull, default=0.0) <= 10.0
