"""Axes in numbers: an arm of any table is that table, and the table of an arm is the arm."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from kinsym.check.table import TableKinematics
from kinsym.robot import gallery
from kinsym.robot.files import from_draft
from kinsym.robot.geometry.arm import Arm, Axis, arm_of, difference
from kinsym.robot.geometry.frames import CONTEXT, UNIT, along, from_rpy, unit
from kinsym.robot.geometry.table import Tolerance, table_of
from kinsym.robot.snapping import EXACT
from tests.arms import SHAPES, robot

NONE = Tolerance.of(Fraction(0))


@pytest.mark.parametrize("name", [*gallery(), *sorted(SHAPES)])
def test_an_arm_is_its_table(name: str) -> None:
    """Against the independent walk along the rows, all three conventions, reversed axes among them."""
    written = robot(name)
    values = {key: Fraction(1) if value is None else value for key, value in written.parameters.items()}
    table, given = TableKinematics(written, values), arm_of(written)
    generator = random.Random(name)
    for _ in range(3):
        q = [generator.uniform(-3, 3) for _ in written.variables]
        pose, frame = table.forward(q), given.pose(q)
        columns = (frame.x, frame.y, frame.z, frame.origin)
        assert max(abs(pose[i][j] - columns[j][i]) for i in range(3) for j in range(4)) < 1e-35


@pytest.mark.parametrize("name", [*gallery(), *sorted(SHAPES)])
def test_the_table_of_an_arm_is_the_arm(name: str) -> None:
    """For special arms exactly, for any twist and length to the last digit of a double."""
    given = arm_of(robot(name))
    table = table_of(given, NONE)
    assert table.changes == ()
    again = from_draft({"name": "again", **table.draft}, where="x", snapping=EXACT)
    assert max(difference(given, arm_of(again))) < 1e-15


def axis(name: str, x: float, y: float, z: float, at: tuple[float, float, float]) -> Axis:
    direction = unit((CONTEXT.mpf(x), CONTEXT.mpf(y), CONTEXT.mpf(z)))
    return Axis(name=name, kind="R", frame=along(direction, tuple(map(CONTEXT.mpf, at))))


def test_nearly_parallel_axes_have_no_far_foot() -> None:
    """Within the tolerance d = 0; without it the table is exact and its lengths run off."""
    arm = Arm(axes=(axis("q1", 0, 0, 1, (0, 0, 0)), axis("q2", 0, 1e-4, 1, (0.5, 0, 0))), tip=UNIT)
    rows = table_of(arm, Tolerance.of(Fraction(1, 1000))).draft["joints"]
    assert (rows[0]["a"], rows[0]["d"], rows[0]["alpha"]) == ("a1", "0", "0")
    exact = table_of(arm, NONE).draft
    assert exact["joints"][0]["a"] == "a1" or exact["joints"][0]["d"] != "0"
    assert exact["joints"][0]["alpha"] not in ("0", "pi")


def test_a_length_never_takes_the_name_of_a_joint() -> None:
    arm = Arm(
        axes=(axis("a2", 0, 0, 1, (0, 0, 0)), axis("d1", 0, 1, 0, (0.5, 0, 0.2))), tip=from_rpy((1, 2, 3), (0, 0, 0))
    )
    table = table_of(arm, NONE)
    assert {"a2", "d1"}.isdisjoint(table.draft["parameters"])
    from_draft({"name": "x", **table.draft}, where="x", snapping=EXACT)


def test_coordinates_of_the_tip_frame() -> None:
    """Turns about the fixed axes x, y, z in this order: URDF's roll, pitch, yaw."""
    half = CONTEXT.pi / 2
    frame = from_rpy((CONTEXT.mpf(1), CONTEXT.mpf(2), CONTEXT.mpf(3)), (half, CONTEXT.mpf(0), half))
    assert [round(float(v), 12) for v in (*frame.x, *frame.y, *frame.z)] == [0, 1, 0, 0, 0, 1, 1, 0, 0]
    assert [float(v) for v in frame.apply((CONTEXT.mpf(1), CONTEXT.mpf(0), CONTEXT.mpf(0)))] == [1, 3, 3]
