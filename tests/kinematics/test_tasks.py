"""What the joints of an arm can move, against the Jacobian by numbers, and the task that fits."""

from __future__ import annotations

import random

import pytest

from kinsym.algebra.field import PRIME
from kinsym.kinematics.chain import build_chain, chain_to_solve
from kinsym.kinematics.singular.posture import posture
from kinsym.kinematics.tasks import TOLD, _sample, fitting_task, mobility, rank, told
from kinsym.robot import from_inline, load, lock
from kinsym.robot.model import Task
from tests.arms import robot


@pytest.mark.parametrize(
    "name", ["puma560", "stanford_paul", "reversed_axes", "scorbot_5r", "sliding_rpr", "elbow_6r_screw"]
)
def test_the_rows_are_those_of_the_jacobian_that_a_task_tells(name: str) -> None:
    chain = build_chain(robot(name))
    here = posture(chain, _sample(chain))
    whole = here.jacobian(Task.POSE)
    for task, rows in TOLD.items():
        assert [[value % PRIME for value in row] for row in told(chain, task)] == [whole[row] for row in rows]
    axis = told(chain, Task.POSITION_AXIS)
    assert [[value % PRIME for value in row] for row in axis] == here.jacobian(Task.POSITION_AXIS)


@pytest.mark.parametrize(
    ("size", "shape"), [(0, (3, 4)), (1, (3, 4)), (2, (4, 4)), (3, (3, 5)), (3, (6, 4)), (4, (4, 4))]
)
def test_the_rank_of_a_product(size: int, shape: tuple[int, int]) -> None:
    generator = random.Random(size)

    def matrix(rows: int, columns: int) -> list[list[int]]:
        return [[generator.randrange(PRIME) for _ in range(columns)] for _ in range(rows)]

    left, right = matrix(shape[0], size), matrix(size, shape[1])
    found = [
        [sum(a * b for a, b in zip(row, column, strict=True)) % PRIME for column in zip(*right, strict=True)]
        for row in left
    ]
    found = found if size else [[0] * shape[1] for _ in range(shape[0])]
    assert rank(found) == size
    # columns and rows of zeros change nothing
    assert rank([[0] * shape[1], *found]) == rank([[0, *row] for row in found]) == size
    assert rank([]) == 0


#: Rows of a table, in how many ways its joints move the end effector, the task that fits.
ARMS = {
    "one turn": ("0 a1 0 theta1", 1, Task.POSE),
    "two in a plane": ("0 a1 0 theta1; 0 a2 0 theta2", 2, Task.POSITION),
    "pan and tilt": ("pi/2 0 0 theta1; 0 0 0 theta2", 2, Task.ORIENTATION),
    "one line": ("0 0 0 theta1; 0 0 0 theta2", 1, Task.POSE),
    "three in a plane": ("0 a1 0 theta1; 0 a2 0 theta2; 0 a3 0 theta3", 3, Task.PLANAR),
    "a slide in a plane": ("pi/2 a1 0 theta1; -pi/2 0 d2 0; 0 a3 0 theta3", 3, Task.PLANAR),
    "an elbow": ("pi/2 0 0 theta1; 0 a2 0 theta2; 0 a3 0 theta3", 3, Task.POSITION),
    "a wrist": ("pi/2 0 0 theta1; -pi/2 0 0 theta2; 0 0 0 theta3", 3, Task.ORIENTATION),
    "scara": ("0 a1 0 theta1; 0 a2 0 theta2; 0 0 d3 0; 0 0 0 theta4", 4, Task.SCARA),
    "no scara": ("pi/2 0 0 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4", 4, Task.POSE),
    "four parallel": ("0 a1 0 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4", 3, Task.POSE),
    "five": (
        "pi/2 a1 d1 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; -pi/2 0 d4 theta4; pi/2 0 0 theta5",
        5,
        Task.POSITION_AXIS,
    ),
    "five about the end": (
        "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; pi/2 0 0 theta4; 0 0 d5 theta5",
        5,
        Task.POSE,
    ),
}


@pytest.mark.parametrize("name", ARMS)
def test_the_task_that_fits_is_the_one_whose_rows_the_joints_can_change(name: str) -> None:
    table, ways, task = ARMS[name]
    chain = build_chain(from_inline(table, convention="paul", name="arm"))
    assert mobility(chain) == ways
    assert fitting_task(chain, chain) is task


def test_an_arm_that_can_make_any_pose_is_asked_for_one_also_while_a_joint_is_locked() -> None:
    puma = load("puma560")
    held = lock(puma, dict.fromkeys(("theta4", "theta5", "theta6"), "0.3"))
    assert fitting_task(build_chain(held), chain_to_solve(held)) is Task.POSE
    assert fitting_task(chain_to_solve(held), chain_to_solve(held)) is Task.POSITION
    scara = lock(load("scara"), {"theta4": "0.3"})
    assert fitting_task(build_chain(scara), chain_to_solve(scara)) is Task.POSITION
