"""Arms off a special geometry by real millimetres: the nominal closed form, then Newton's steps with the true arm.

Oracles are the general solver without a nominal arm, its elimination with 50 digits, and the axes of the table in 40
digits (:mod:`kinsym.robot.geometry`), which share nothing with generated code.
"""

from __future__ import annotations

import ctypes
import json
import re
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from kinsym.check import compare
from kinsym.check.c_solver import CSolver
from kinsym.check.compiler import compile_shared, find_compiler
from kinsym.check.exact_solver import ExactSolver
from kinsym.check.poses import Counts
from kinsym.cli import main
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.latex import document
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.c_source import c_source
from kinsym.emit.text import equations
from kinsym.errors import RobotError
from kinsym.robot import from_inline, load
from kinsym.robot.files import from_draft, toml_draft
from kinsym.robot.geometry.arm import arm_of
from kinsym.robot.locking import lock
from kinsym.robot.model import Robot, Task
from kinsym.robot.snapping import EXACT
from kinsym.robot.stand_in import stand_in
from kinsym.robot.summary import to_toml
from tests.general.arms import random_robot, run
from tests.robot.test_nearby import calibrated, matrix

#: A Puma 560 with twists off by up to 1.2e-3 rad, lengths by up to 0.5 mm and joint zeros by up to 1e-2 rad.
PUMA = (
    "pi/2+0.0007 0.0004 0.4 theta1+0.002; 0.0011 0.5 0.0003 theta2+0.01; pi/2+0.0004 0.02 0.0002 theta3+0.3; "
    "-pi/2-0.0012 0.0003 0.6 theta4-0.004; pi/2 -0.0002 0.0005 theta5+0.001; 0 0 0.1 theta6+0.003"
)
#: Five joints of such an arm, which place a point and an axis.
FIVE = (
    "pi/2+0.0007 0.0003 0.3 theta1; 0.0011 0.5 0 theta2; -0.0008 0.4 0.0002 theta3; "
    "pi/2+0.0005 0.0004 0.1 theta4; pi/2 0 0.2 theta5"
)
#: The first of these arms on a rail, a joint that slides; locked, it leaves that arm.
ON_A_RAIL = "0 0 d1 0; " + re.sub(r"theta(\d)", lambda found: f"theta{int(found[1]) + 1}", PUMA)


@dataclass(frozen=True)
class Solved:
    """An arm solved both ways."""

    derivation: Derivation
    schedule: Schedule
    module: ModuleType
    general: ModuleType


def table(name: str) -> Robot:
    if name in ("puma", "five"):
        rows = PUMA if name == "puma" else FIVE
        robot = from_inline(rows, convention="paul", name=name, snapping=EXACT)
        return replace(robot, task=Task.POSITION_AXIS if name == "five" else Task.POSE)
    return calibrated(name)


@cache
def solved(name: str) -> Solved:
    derivation = derive(replace(table(name), nominal=True))
    schedule = build_schedule(derivation)
    return Solved(derivation, schedule, run(schedule), run(replace(schedule, nominal=None)))


ARMS = ("puma", "ur10e", "five")


def gaps(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    return np.abs((left - right + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)


def lacking(q: np.ndarray, valid: np.ndarray, others: np.ndarray, there: np.ndarray) -> int:
    """How many solutions q (N, S, n) are not among the others."""
    apart = np.where(there[:, None], gaps(q[:, :, None], others[:, None]), np.inf)
    return int((valid & (apart.min(axis=2) > 1e-6)).sum())


def joint_vectors(name: str, count: int, seed: int) -> np.ndarray:
    joints = len(solved(name).schedule.joints)
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (count, joints))


@pytest.mark.parametrize("name", ARMS)
def test_no_solution_is_lost_at_random_poses(name: str) -> None:
    """Against the general solver: some 2000 solutions an arm; they reach the pose to 1e-12 by the table itself."""
    arm = solved(name)
    q = joint_vectors(name, 250, 1)
    poses = arm.module.fk(q)
    found, valid = arm.module.ik_batch(poses)
    wanted, there = arm.general.ik_batch(poses)
    assert lacking(q[:, None], np.ones((250, 1), bool), found, valid) == 0
    assert lacking(wanted, there, found, valid) == 0
    assert there.sum() > 250
    true = arm_of(arm.derivation.robot)
    entries = (slice(0, 3), [2, 3]) if name == "five" else slice(0, 3)
    for pose, row in zip(*np.nonzero(valid[:5]), strict=True):
        assert np.abs((matrix(true, found[pose, row].tolist()) - poses[pose])[entries]).max() < 2e-12


@pytest.mark.parametrize("distance", [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2])
@pytest.mark.parametrize(
    ("name", "joint", "values"), [("puma", 4, (0, np.pi)), ("ur10e", 4, (0, np.pi)), ("ur10e", 2, (0,))]
)
def test_next_to_singular_poses_of_the_nominal_arm(
    name: str, joint: int, values: tuple[float, ...], distance: float
) -> None:
    """Wrist and elbow: there the true arm has up to twelve solutions; of the known ones 1 in 100 may be missed."""
    arm = solved(name)
    q = joint_vectors(name, 200, 7)
    q[:, joint] = np.random.default_rng(8).choice(values, len(q)) + distance
    poses = arm.module.fk(q)
    found, valid = arm.module.ik_batch(poses)
    assert lacking(q[:, None], np.ones((200, 1), bool), found, valid) <= 1
    assert np.abs(np.where(valid[..., None, None], arm.module.fk(found) - poses[:, None], 0.0)).max() < 1e-9


@pytest.mark.parametrize("name", ARMS)
def test_most_random_poses_need_no_general_solver(name: str) -> None:
    """A band that is too wide, or starts that do not converge, would send every pose there."""
    arm = solved(name)
    poses = arm.module.fk(joint_vectors(name, 500, 3))
    (pose, _, _), doubt = arm.module._corrected(poses[:, :3].transpose(1, 2, 0), poses, {})
    assert doubt.mean() < 0.35
    sure = np.flatnonzero(~doubt)
    _, valid = arm.general.ik_batch(poses[sure])
    assert np.array_equal(np.bincount(pose, minlength=500)[sure], valid.sum(axis=1))


@pytest.mark.parametrize("name", ARMS)
def test_the_languages_and_the_elimination_agree(name: str, tmp_path: Path) -> None:
    arm = solved(name)
    q = joint_vectors(name, 2, 2)
    q[1:, 4 if name != "five" else 3] = 1e-9
    exact = ExactSolver(arm.schedule, {})
    poses = exact.forward(q)
    oracle, count = exact.inverse(poses, q)
    answers = [[arm.module.ik(pose) for pose in poses]]
    compiler = find_compiler()
    if compiler is not None:
        for file, text in c_source(arm.schedule).items():
            (tmp_path / file).write_text(text)
        library = ctypes.CDLL(str(compile_shared(tmp_path, name, tmp_path, compiler=compiler)))
        found, number = CSolver(library, arm.schedule, {}).inverse(poses, q)
        answers.append([rows[:n] for rows, n in zip(found, number, strict=True)])
    for answer in answers:
        for row, found in enumerate(answer):
            assert len(found) == count[row]
            assert np.all(gaps(found, oracle[row, : count[row]]) < 1e-6)


def test_a_locked_joint_keeps_its_value() -> None:
    robot = from_inline(ON_A_RAIL, convention="paul", name="on_a_rail", snapping=EXACT)
    module = run(build_schedule(derive(replace(lock(robot, {"d1": None}), nominal=True))))
    known = np.array([0.2, 0.4, -0.8, 1.1, 0.7, 0.9, -0.5])
    found = module.ik(module.fk(known), d1=0.2)
    assert len(found) >= 2
    assert np.all(found[:, 0] == 0.2)
    assert gaps(found[:, 1:], known[1:]).min() < 1e-9


def test_the_reader_is_told() -> None:
    arm = solved("puma")
    text, tex = equations(arm.derivation), document(arm.derivation)
    (module,) = (arm.module.__doc__,)
    sources = c_source(arm.schedule)
    for part in (text, tex, module, sources["puma.h"], sources["puma.c"]):
        flat = " ".join(part.replace("\n *", " ").split())
        assert "losed form of the nominal arm, then Newton's steps with the true arm" in flat
        assert "That none is missed is measured, not proved." in flat
    assert "row 4, a      0.0003        0            3.0e-04" in text
    assert "row 4, a & 0.0003 & 0 & 3.0e-04" in tex
    assert "row 4, a: 0.0003 read as 0 (off by 3.0e-04)" in sources["puma.h"]
    assert "theta4 by -0.004" in text
    assert "Singular poses of the nominal arm" in text
    assert "Wrist singularity: axes 4 and 6 coincide" in text


def test_long_entries_are_not_written_out() -> None:
    """Twists and offsets of a whole table make entries of two thousand terms."""
    arm = solved("ur10e")
    assert arm.derivation.long
    assert len(equations(arm.derivation, full=True)) < 30_000
    assert len(document(arm.derivation)) < 60_000
    q = joint_vectors("ur10e", 3, 9)
    exact = ExactSolver(arm.schedule, {}).jacobian(q)
    assert np.abs(arm.module.jacobian(q) - exact).max() < 1e-12


def test_an_arm_that_does_not_ask_is_solved_as_before() -> None:
    derivation = derive(load("ur5"))
    assert derivation.nominal is None
    assert build_schedule(derivation).nominal is None
    assert not derivation.long


def test_the_band_follows_the_deviation() -> None:
    """Four deviations, rounded up to a power of two: 2.0e-3 in an arm of 1.5 m, and 3.1e-3 rad."""
    assert stand_in(table("puma")).band == Fraction(1, 32)


def test_a_robot_file_asks_for_it_and_comes_back() -> None:
    robot = replace(table("puma"), nominal=True)
    text = to_toml(robot)
    assert "nominal = true" in text.splitlines()
    assert from_draft(toml_draft(text, "test"), where="test", snapping=EXACT).nominal
    assert "nominal" not in to_toml(table("puma"))
    for value in ('"yes"', "1"):
        with pytest.raises(RobotError, match="neither true nor false"):
            from_draft(toml_draft(text.replace("nominal = true", f"nominal = {value}"), "test"), where="test")


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (lambda: load("puma560"), "special as it stands"),
        (lambda: load("planar_rr"), "l1 has no value"),
        (lambda: random_robot(3), "no closed form either"),
        (
            lambda: from_inline(PUMA.rsplit(";", 1)[0], convention="paul", name="cut", snapping=EXACT),
            "Lock a joint|closed form",
        ),
        (lambda: replace(table("five"), task=Task.POSE), "five for a position and an axis"),
        (
            lambda: from_inline(
                "pi/2 0 0.4 theta1; 0.0007 0.5 0 theta2; pi/2 0.02 0 theta3; -pi/2 0 0.6 theta4; pi/2 0 0 theta5; "
                "0 0 0.1 theta6",
                convention="paul",
                name="wrist",
                snapping=EXACT,
            ),
            "has a closed form as it stands",
        ),
    ],
)
def test_what_has_no_use_for_it_is_refused(robot: object, message: str) -> None:
    with pytest.raises(RobotError, match=message) as caught:
        derive(replace(robot(), nominal=True))  # type: ignore[operator]
    assert "nominal arm of" in str(caught.value)


def test_the_command_writes_and_repeats_its_checks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compare, "SLOWLY", 2)
    monkeypatch.setattr(compare, "FULL", Counts(uniform=24, quarter=12, singular=18, pair=4))
    command = ["derive", "--dh", PUMA, "--convention", "paul", "--name", "puma", "--exact", "--nominal"]
    assert main([*command, "--target", "numpy", "-o", str(tmp_path)]) == 0
    shown = capsys.readouterr().out
    assert "singular for the nominal arm" in shown
    assert "the same at and next to singular poses of the nominal arm" in shown
    report = json.loads((tmp_path / "puma.report.json").read_text())
    assert report["checked"] == "passed"
    assert {"row 1, alpha", "row 4, a"} <= {change["where"] for change in report["nominal_arm"]["changes"]}
    assert any("measured, not proved" in sentence for sentence in report["nominal_arm"]["says"])
    assert "nominal = true" in report["table"]
    assert main(["check", str(tmp_path)]) == 0
    assert "not what kinsym would write" not in capsys.readouterr().err
