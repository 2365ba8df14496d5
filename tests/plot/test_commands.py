"""``kinsym plot`` and ``kinsym workspace`` as a user meets them."""

from __future__ import annotations

import io
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from kinsym.cli import main
from kinsym.command.bar import Bar
from kinsym.command.screen import Screen
from kinsym.command.workspace import KINDS, ORIENTATIONS
from kinsym.plot.export import PICTURES
from kinsym.workspace import evaluate, sweeping

ROOT = Path(__file__).resolve().parent.parent.parent
BIND = ["--bind", "l1=0.4", "--bind", "l2=0.25"]


class Run:
    """One call of ``kinsym`` in this process, in a folder of its own."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys
        self.out = self.err = ""

    def __call__(self, *arguments: str) -> int:
        status = main(arguments)
        self.out, self.err = self._capsys.readouterr()
        assert "Traceback" not in self.err
        return status


@pytest.fixture
def kinsym(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.chdir(tmp_path)
    return Run(capsys)


def test_the_parser_repeats_what_it_does_not_load() -> None:
    from kinsym.command import output

    assert KINDS == sweeping.KINDS
    assert ORIENTATIONS == evaluate.ORIENTATIONS
    assert output.PICTURES == PICTURES


def test_a_picture_and_the_posture_it_shows(kinsym: Run) -> None:
    assert kinsym("plot", "planar_rr", *BIND, "--joints", "0.1, deg(20)") == 0
    assert os.listdir() == ["planar_rr.svg"]
    assert "theta1 = 5.73 deg, theta2 = 20.00 deg" in kinsym.out
    first = Path("planar_rr.svg").read_bytes()
    assert first.startswith(b"<?xml")
    assert kinsym("plot", "planar_rr", *BIND) == 2
    assert "planar_rr.svg is there already. Name a file with --output" in kinsym.err
    assert kinsym("plot", "planar_rr", *BIND, "--joints", "0.1, deg(20)", "-o", "planar_rr.svg") == 0
    assert Path("planar_rr.svg").read_bytes() == first
    assert kinsym("plot", "planar_rr", *BIND, "-o", "new/arm.PNG", "--quiet") == 0
    assert Path("new/arm.PNG").read_bytes().startswith(b"\x89PNG")
    assert kinsym.out == kinsym.err == ""


def test_urdf_lengths_are_metres(kinsym: Run) -> None:
    limit = '<limit lower="-2" upper="2" effort="1" velocity="1"/>'
    links = "".join(f'<link name="{name}"/>' for name in "abc")
    joints = "".join(
        f'<joint name="j{below}" type="revolute"><parent link="{above}"/><child link="{below}"/>'
        f'<origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>{limit}</joint>'
        for above, below in ("ab", "bc")
    )
    Path("arm.urdf").write_text(f'<robot name="arm">{links}{joints}</robot>')
    for options, label in (([], "x [m]"), (["--unit", "mm"], "x [mm]")):
        assert kinsym("plot", "arm.urdf", *options, "-o", "arm.svg") == 0
        assert f"<!-- {label} -->" in Path("arm.svg").read_text()


def test_branches(kinsym: Run) -> None:
    """Every solution is listed; a branch is drawn by its number; the pose may be given as it is."""
    assert kinsym("plot", "planar_rr", *BIND, "--branches", "--pose", "0.3, 0.4, 0", "-o", "a.svg") == 0
    assert re.findall(r"^\d  elbow \w+", kinsym.out, re.MULTILINE) == ["0  elbow right", "1  elbow left"]
    assert "0:  elbow right" in Path("a.svg").read_text()
    assert kinsym("plot", "planar_rr", *BIND, "--branch", "1", "--pose", "0.3, 0.4, 0", "-o", "b.svg") == 0
    assert "elbow right" not in kinsym.out
    assert kinsym("plot", "kuka_iiwa", "--lock", "theta3=pi/6", "--branches", "-o", "c.svg") == 0
    assert kinsym.out.count("theta3 = 30.00 deg") == 8


def test_a_workspace_and_its_files(kinsym: Run) -> None:
    assert kinsym("workspace", "planar_rr", *BIND, "--points", "15", "--unit", "m") == 0
    assert sorted(os.listdir()) == ["planar_rr_workspace.npz", "planar_rr_workspace.svg"]
    assert "of 225 points are inside: an area of about" in kinsym.out
    assert "circles of radius 0.15 and 0.65" in kinsym.out
    assert "evaluating 15 x 15 points" in kinsym.err
    assert kinsym("workspace", "planar_rr", *BIND, "--points", "15") == 2
    assert "planar_rr_workspace.svg is there already" in kinsym.err
    assert (
        kinsym("workspace", "puma560", "--orientation", "pi, 0, 0", "--points", "9", "-o", "w.csv", "-o", "w.png") == 0
    )
    lines = Path("w.csv").read_text().splitlines()
    assert {line.split(",")[1] for line in lines[1:]} == {"0.0"}
    assert {line.split(",")[4] for line in lines[1:]} == {"1"}
    assert kinsym("workspace", "scara", *(f"--bind={n}=0.3" for n in ("a1", "a2", "d1", "d4")),
                  "--volume", "--points", "7", "--count", "4", "--kind", "dexterous", "-o", "v.npz") == 0  # fmt: skip
    assert "d3 has no limits" in kinsym.out
    assert "a volume of about" in kinsym.out
    assert min(np.load("v.npz")["hits"].shape) > 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["plot", "planar_rr"], "the parameters l1, l2 have no value"),
        (["plot", "puma560", "-o", "x.pdf"], "x.pdf is no name of a file that is written here. Its ending tells what"),
        (["plot", "puma560", "-o", "file/x.svg"], "file is a file"),
        (["plot", "puma560", "--joints", "0.1,0.2"], "--joints has 2 values, puma560 has 6 joints"),
        (["plot", "puma560", "--joints", "0,0,0,0,0,nan"], "--joints theta6: NaN and infinity"),
        (["plot", "puma560", "--joints", "0,0,0,0,0,q"], "--joints theta6: the value of a joint depends on q"),
        (["plot", "puma560", "--joints", "0,30,0,0,0,0"], "--joints theta2: 30 radians are more than a turn"),
        (["plot", "kuka_iiwa", "--joints", "0,2.5,0,0,0,0,0"], "--joints theta2: 2.5 is outside the limits"),
        (["plot", "kuka_iiwa", "--lock", "theta3=0.5", "--joints", "0,0,0,0,0,0,0"], "the robot holds it at 0.5"),
        (["plot", "puma560", "--pose", "1,2,3"], "Add --branches, or --branch N"),
        (["plot", "puma560", "--branches", "--pose", "1,2"], "'1,2' has 2 cells"),
        (["plot", "puma560", "--branches", "--pose", "9,0,0"], "the pose is out of reach"),
        (["plot", "puma560", "--branch", "8"], "there is no branch 8. Give one from 0 to 7"),
        (["plot", "planar_rr", *BIND, "--branch", "1", "--pose", "9,0,0"], "the pose is out of reach"),
        (["plot", "ur5", "--branch", "3"], "no solution in branch 3. It has some in 0, 1, 6, 7"),
        (["plot", "puma560", "--deadline", "1"], "--deadline belongs to kinsym derive"),
        (["workspace", "fanuc_s900w"], "the parameters a1, a2, a3, d4, d6 have no value"),
        (["workspace", "kuka_iiwa"], "--lock theta3=VALUE"),
        (["workspace", "spherical_wrist", "--bind", "d6=0.1"], "has no workspace of positions"),
        (["workspace", "puma560", "--slice", "q=1"], "'q=1' is no plane"),
        (["workspace", "puma560", "--slice", "x=nan"], "--slice: NaN and infinity"),
        (["workspace", "planar_rr", *BIND, "--slice", "x=0"], "the arm moves in the plane of x and y"),
        (["workspace", "puma560", "--points", "1"], "a grid of 1 points"),
        (["workspace", "puma560", "--points", "9999"], "points are too many"),
        (["workspace", "puma560", "--count", "0"], "--count 0 orientations are none"),
        (["workspace", "puma560", "--jobs", "0"], "--jobs 0 processes are none"),
        (["workspace", "puma560", "--jobs", "2", "--scheduler", "x"], "Give one of both"),
        (["workspace", "puma560", "--kind", "dexterous", "--orientation", "0,0,0"], "--orientation is for"),
        (["workspace", "puma560", "-o", "a.svg", "-o", "./a.svg"], "a file is named twice"),
        (["workspace", "puma560", "-o", "a.svg", "-o", "a.partial.npz"], "the name under which an unfinished sweep"),
    ],
)  # fmt: skip
def test_wrong_input(kinsym: Run, arguments: list[str], message: str) -> None:
    """One message that names the place, status 2, nothing written."""
    Path("file").write_text("mine")
    assert kinsym(*arguments) == 2
    assert message in kinsym.err
    assert os.listdir() == ["file"]


def test_without_matplotlib(kinsym: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """One line that names the command; data can be written without it."""
    monkeypatch.setattr("kinsym.command.output.importlib.util.find_spec", lambda _: None)
    for command in ("plot", "workspace"):
        assert kinsym(command, "planar_rr", *BIND) == 2
        assert kinsym.err == "kinsym: pictures need matplotlib. Install it with: pip install 'kinsym[plot]'\n"
    assert kinsym("workspace", "planar_rr", *BIND, "--points", "5", "-o", "w.csv") == 0


def test_a_workspace_that_is_killed_goes_on(tmp_path: Path) -> None:
    """Killed outright in the middle; the second run starts from what the first has found, and ends with the same."""
    asked = "workspace planar_rrr_craig --points 120 -o w.npz --quiet --bind l1=0.4 --bind l2=0.3 --bind l3=0.1"
    command = [sys.executable, "-m", "kinsym", *asked.split()]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(command, cwd=tmp_path, env=environment)
    kept = tmp_path / "w.partial.npz"
    deadline = time.monotonic() + 60.0
    while not kept.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.wait()
    known = int((np.load(io.BytesIO(kept.read_bytes()))["hits"] >= 0).sum())
    assert 0 < known < 120 * 120
    done = subprocess.run(command, cwd=tmp_path, env=environment, check=False)
    assert done.returncode == 0
    assert os.listdir(tmp_path) == ["w.npz"]


def test_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """A quarter of what was left took ten seconds, so that thirty remain; nothing is promised before."""
    now = [100.0]
    monkeypatch.setattr("kinsym.command.bar.time.monotonic", lambda: now[0])
    shown: list[str] = []
    bar = Bar(shown.append)
    bar(20, 100)
    now[0] += 10.0
    bar(40, 100)
    bar(100, 100)
    assert shown == ["[###.............]  20 %", "[######..........]  40 %, 30 s left", "[################] 100 %"]


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_the_bar_is_for_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    for err, seen in ((Terminal(), True), (io.StringIO(), False)):
        screen = Screen(err=err)
        screen.stage("evaluating")
        screen.part("[####]")
        time.sleep(0.3)
        screen.stage("writing")
        screen.end()
        assert ("evaluating [####]" in err.getvalue()) is seen
        assert "writing [####]" not in err.getvalue()
