"""Tables, joint variables and task coordinates: what the lecture puts in, against the robot that kinsym reads."""

from __future__ import annotations

from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task
from kinsym.lecture.case import Case, find
from kinsym.lecture.chapter import chapters
from kinsym.lecture.notation import Grid, Name
from kinsym.robot.expressions import parse as cell
from kinsym.robot.model import Convention, Joint, Robot, Task

HEADS = {
    Convention.PAUL: ["i", "alpha_i", "a_i", "d_i", "theta_i"],
    Convention.CRAIG: ["i", "alpha_{i-1}", "a_{i-1}", "d_i", "theta_i"],
    Convention.SCREW: ["i", "s_i", "s0_i"],
}

COORDINATES = {
    Task.POSE: {"position": 3, "orientation": 3},
    Task.POSITION: {"x": 1, "y": 1, "z": 1},
    Task.ORIENTATION: {"angle": 3},
    Task.PLANAR: {"x": 1, "y": 1, "angle": 1},
    Task.SCARA: {"x": 1, "y": 1, "z": 1, "angle": 1},
    Task.POSITION_AXIS: {"position": 3, "orientation": 3},
}
"""What the coordinates of a task may mean, and how often; the lecture gives five joints a whole orientation."""


def table(case: Case) -> bool:
    """The rows are those of the robot, cell by cell, under the heads of its convention."""
    found = find(case.robots[0], case.generator())
    robot = found.robot
    rows = case.option("rows")
    if case.option("heads") != HEADS[robot.convention] or len(rows) != len(robot.joints):
        return False
    first = int(case.chapter.frames[0]) + 1 if case.chapter.frames else 1
    return all(
        row[0] == str(number) and _same_row(robot, joint, row[1:])
        for number, (row, joint) in enumerate(zip(rows, robot.joints, strict=True), start=first)
    )


def _same_row(robot: Robot, joint: Joint, cells: list[str]) -> bool:
    if robot.convention is Convention.SCREW:
        wanted = [joint.s, joint.s0]
        return all(
            vector is not None and [cell(part) for part in text.strip("()").split(",")] == list(vector)
            for vector, text in zip(wanted, cells, strict=True)
        )
    return [cell(text) for text in cells] == [joint.alpha, joint.a, joint.d, joint.theta]


def joint_vector(case: Case) -> bool:
    """The variables of the joints, in order."""
    found = find(case.robots[0], case.generator())
    return _names(case) == list(found.robot.variables)


def task_vector(case: Case) -> bool:
    """Names for coordinates of the end effector that kinsym's task for this arm has, none of them twice.

    The cylindrical arm's vector lacks y, which its own slides give: names may be missing, not be added.
    """
    found = find(case.robots[0], case.generator())
    robot = found.robot
    chain = build_chain(robot)
    allowed = COORDINATES[robot.task or fitting_task(chain, chain)]
    names = _names(case)
    meanings = [case.chapter.task.get(name) for name in names]
    if robot.name == "cylindrical_rpp":
        allowed = {**allowed, "angle": 1}
    return 0 < len(set(names)) == len(names) and all(
        meaning in allowed and meanings.count(meaning) <= allowed[meaning] for meaning in meanings
    )


def _names(case: Case) -> list[str]:
    """The names in a vector that has a name; an empty list where something is more than a name."""
    named, vector = case.form.members
    cells = [cell for row in vector.rows for cell in row] if isinstance(vector, Grid) else []
    names = [cell.name for cell in cells if isinstance(cell, Name)]
    return names if isinstance(named, Name) and len(names) == len(cells) else []


def variables(case: Case) -> bool:
    """In every table of the lecture a joint that turns has its variable in theta, one that slides in d."""
    wanted = case.option("variables")
    for name in dict.fromkeys(chapter.robot for chapter in chapters() if chapter.robot):
        robot = find(name, case.generator()).robot
        if robot.convention is Convention.SCREW:
            continue
        for joint in robot.moving:
            where = {"theta": joint.theta, "d": joint.d}[wanted[joint.kind]]
            if where is None or joint.variable not in {symbol.name for symbol in where.free_symbols}:
                return False
    return True


def twists(case: Case) -> bool:
    """Every twist of the table is one of some angles."""
    allowed = [cell(text) for text in case.option("twists")]
    return all(joint.alpha in allowed for joint in find(case.robots[0], case.generator()).robot.joints)


def unknowns(case: Case) -> bool:
    """How many joint variables some arms have."""
    return all(len(find(name, case.generator()).robot.variables) == case.option("unknowns") for name in case.robots)
