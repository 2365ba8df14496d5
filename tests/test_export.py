"""What ``kinsym export`` writes is the same arm: URDF read back, the Robotics Toolbox by a stand-in of its rows."""

from __future__ import annotations

import math
import sys
import types
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kinsym.cli import main
from kinsym.command import exporting
from kinsym.errors import RobotError
from kinsym.export import FORMATS, rtb, urdf
from kinsym.export.urdf import rpy
from kinsym.robot import load
from kinsym.robot.files import from_draft
from kinsym.robot.geometry.arm import Arm, arm_of, difference, mpf
from kinsym.robot.geometry.frames import Frame, slide, turn
from kinsym.robot.model import Robot

WILD = {
    "name": "wild",
    "title": '"""wild""" --> <arm> \\',
    "convention": "paul",
    "joints": [
        {"type": "R", "alpha": "pi/3", "a": "0.1", "d": "0.3", "theta": "-theta1+pi/4", "limits": ["-1", "2"]},
        {"type": "P", "alpha": "-pi/2", "a": "0", "d": "0.2-d2", "theta": "pi/2", "limits": ["0", "0.5"]},
        {"type": "P", "alpha": "0.3", "a": "-0.2", "d": "d3", "theta": "0.4"},
        {"type": "R", "alpha": "pi/2", "a": "0", "d": "0.1", "theta": "theta4"},
    ],
    "base": {"xyz": ["0.1", "0.2", "0.3"], "rpy": ["0.1", "pi/2", "0.7"]},
    "tool": {"xyz": ["0", "0.05", "0.12"], "rpy": ["0.3", "0.2", "0.1"]},
}


def craig() -> Robot:
    """Craig's rows with one behind the last joint, and one in between."""
    cells = ("0 0 0.4 theta1", "pi/2 0.1 0 theta2+pi/2", "0 0.3 0 0", "pi 0.2 0 -theta3", "pi/2 0.1 0.2 0")
    rows = [dict(zip(("alpha", "a", "d", "theta"), row.split(), strict=True)) for row in cells]
    for constant in (rows[2], rows[4]):
        constant["type"] = "fixed"
    return from_draft({"name": "rows", "convention": "craig", "joints": rows}, where="tests")


def numbers(name: str) -> dict[str, Fraction]:
    """Different lengths for all parameters."""
    return {parameter: Fraction(3 + k, 10) for k, parameter in enumerate(load(name).parameters)}


ARMS = {
    "puma560": lambda: load("puma560"),
    "kuka_iiwa": lambda: load("kuka_iiwa"),
    "stanford_arm": lambda: load("stanford_arm"),
    "screws": lambda: load("elbow_6r_screw", bindings=numbers("elbow_6r_screw")),
    "craig": lambda: load("planar_rrr_craig", bindings=numbers("planar_rrr_craig")),
    "constant rows": craig,
    "wild": lambda: from_draft(WILD, where="tests"),
}


@pytest.fixture(params=ARMS)
def robot(request: pytest.FixtureRequest) -> Robot:
    """An arm with numbers."""
    return ARMS[request.param]()


def test_urdf_read_back_is_the_same_arm(robot: Robot, tmp_path: Path) -> None:
    """Forward kinematics to the digits of a double, kinds and limits."""
    (tmp_path / "arm.urdf").write_text(urdf(robot), encoding="utf-8")
    again = load(str(tmp_path / "arm.urdf"))
    position, rotation = difference(arm_of(robot), arm_of(again))
    assert position < 1e-15
    assert rotation < 1e-15
    assert [joint.kind for joint in again.joints] == [joint.kind for joint in robot.moving]
    for old, new in zip(robot.moving, again.joints, strict=True):
        assert (old.limits is None) == (new.limits is None)
        if old.limits and new.limits:
            assert np.allclose([float(x) for x in old.limits], [float(x) for x in new.limits], rtol=0, atol=1e-15)


class Link:
    """A row of the Robotics Toolbox, as its documentation defines it."""

    def __init__(self, standard: bool, slides: bool, **given: Any) -> None:
        self.standard, self.slides, self.given = standard, slides, given

    def frame(self, q: float) -> Frame:
        """The link transform."""
        values = {key: given for key, given in self.given.items() if key in ("d", "a", "alpha", "theta")}
        value = (-q if self.given.get("flip") else q) + self.given["offset"]
        assert ("d" if self.slides else "theta") not in values
        values["d" if self.slides else "theta"] = value
        along_z = turn("z", mpf_of(values["theta"])).then(moved(0.0, 0.0, values["d"]))
        along_x = moved(values["a"], 0.0, 0.0).then(turn("x", mpf_of(values["alpha"])))
        return along_z.then(along_x) if self.standard else along_x.then(along_z)


class DHRobot:
    """base, links and tool."""

    def __init__(self, links: list[Link], *, name: str, base: Any = None, tool: Any = None) -> None:
        self.links, self.name, self.base, self.tool = links, name, base, tool

    def pose(self, q: Any) -> np.ndarray:
        """T (4, 4)."""
        here = np.eye(4) if self.base is None else self.base
        for link, value in zip(self.links, q, strict=True):
            here = here @ matrix(link.frame(float(value)))
        return here if self.tool is None else here @ self.tool


@pytest.fixture
def toolbox(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stand-ins of roboticstoolbox and spatialmath, with the names that the file may ask for."""
    links = {
        f"{word}{ending}": lambda standard=ending == "DH", slides=word == "Prismatic", **given: Link(
            standard, slides, **given
        )
        for word in ("Revolute", "Prismatic")
        for ending in ("DH", "MDH")
    }
    monkeypatch.setitem(sys.modules, "roboticstoolbox", types.SimpleNamespace(DHRobot=DHRobot, **links))
    monkeypatch.setitem(sys.modules, "spatialmath", types.SimpleNamespace(SE3=lambda given: given))


@pytest.mark.usefixtures("toolbox")
def test_the_dhrobot_is_the_same_arm(robot: Robot) -> None:
    names: dict[str, Any] = {}
    exec(compile(rtb(robot), "robot_rtb.py", "exec"), names)
    own, arm = names["robot"], arm_of(robot)
    assert own.name == robot.name
    random = np.random.default_rng(4)
    for q in random.uniform(-2.0, 2.0, (5, len(robot.variables))):
        np.testing.assert_allclose(own.pose(q), pose_of(arm, q), rtol=0, atol=1e-14)
    for joint, link in zip(robot.moving, own.links, strict=True):
        assert (joint.limits is None) == ("qlim" not in link.given)


def test_modified_rows_stay_modified() -> None:
    text = rtb(ARMS["craig"]())
    assert "RevoluteMDH" in text
    assert "Modified rows of Craig's convention" in text


@pytest.mark.parametrize(
    "angles", [(0.1, 0.2, 0.3), (0.0, math.pi / 2, 0.4), (2.0, -1.2, -3.0), (0.3, -math.pi / 2, 0.2)]
)
def test_rpy_of_a_frame(angles: tuple[float, float, float]) -> None:
    """Also where the pitch is a right angle and roll and yaw turn about one axis."""
    roll, pitch, yaw = map(mpf_of, angles)
    frame = turn("z", yaw).then(turn("y", pitch)).then(turn("x", roll))
    again = rpy(frame)
    np.testing.assert_allclose(
        matrix(turn("z", again[2]).then(turn("y", again[1])).then(turn("x", again[0]))), matrix(frame), atol=1e-15
    )


@pytest.mark.parametrize("to", FORMATS)
def test_numbers_are_needed(to: str) -> None:
    with pytest.raises(RobotError, match=r"planar_rr: the parameters l1, l2 have no value\. .*--bind l1="):
        FORMATS[to].text(load("planar_rr"))


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Its own name for the file, which it does not write over; another one it does."""
    monkeypatch.chdir(tmp_path)
    assert tuple(FORMATS) == exporting.FORMATS
    assert main(["export", "ur5", "--to", "urdf"]) == 0
    assert "ur5.urdf" in capsys.readouterr().out
    assert main(["export", "ur5", "--to", "urdf"]) == 2
    assert "ur5.urdf is there already" in capsys.readouterr().err
    assert main(["export", "ur5", "--to", "urdf", "-o", "ur5.urdf", "--quiet"]) == 0
    assert main(["import", "ur5.urdf", "--name", "again"]) == 0
    assert main(["export", "ur5", "--to", "rtb"]) == 0
    assert Path("ur5_rtb.py").read_text(encoding="utf-8") == rtb(load("ur5"))
    assert main(["export", "scara", "--to", "rtb"]) == 2
    assert "a1, d1, a2, d4 have no value" in capsys.readouterr().err
    assert main(["export", "ur5", "--to", "sdf"]) == 2


def mpf_of(value: float) -> Any:
    return mpf(Fraction(value))


def moved(x: float, y: float, z: float) -> Frame:
    return slide(x, y, z)


def matrix(frame: Frame) -> np.ndarray:
    result = np.eye(4)
    for column, vector in enumerate((frame.x, frame.y, frame.z, frame.origin)):
        result[:3, column] = [float(value) for value in vector]
    return result


def pose_of(arm: Arm, q: np.ndarray) -> np.ndarray:
    return matrix(arm.pose([mpf_of(float(value)) for value in q]))
