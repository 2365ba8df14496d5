"""The laws: functions of a table, a language and a generator of random numbers, which raise where the law is broken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
from hypothesis import assume

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import determinant, kernel
from kinsym.algebra.residues import residue_of
from kinsym.errors import RobotError
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.singular.zeros import postures, somewhere
from kinsym.robot import lock
from kinsym.robot.model import Convention, Task
from tests.kinematics.determinants import square
from tests.laws.oracle import Oracle
from tests.laws.solved import Arm
from tests.laws.tables import ZERO, Cell, Frame, Table

Law = Callable[[Table, str, np.random.Generator], None]

POSES = 4
#: Angles and lengths of regular postures; Newton's method would give all digits, closed forms lose some of them.
SAME = 1e-6
CLOSURE = 1e-9
EXACT = 1e-12
#: Why an arm cannot be written in another convention.
INEXACT = ("no exact form", "not rational numbers")


def same(arm: Arm, one: np.ndarray, two: np.ndarray, scale: float = 1.0) -> None:
    """Two sets of joint vectors are one."""
    assert len(one) == len(two), (one, two)
    for q in one:
        assert arm.oracle.apart(two, q).min() < SAME * scale, (one, two)


def forward(table: Table, target: str, rng: np.random.Generator) -> None:
    """The generated forward kinematics is the product of the table, and R is in SO(3)."""
    arm = Arm(table, target=target)
    q = rng.uniform(-3.0, 3.0, (POSES, len(table.rows)))
    pose = arm.solver.forward(q)
    assert np.abs(pose - arm.oracle.fk(q)).max() < EXACT * max(1.0, np.abs(pose).max())
    R = pose[:, :3, :3]
    assert np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max() < EXACT
    assert np.abs(np.linalg.det(R) - 1.0).max() < EXACT
    chain, columns = arm.derivation.chain, arm.derivation.forward.columns
    for posture in somewhere(chain, 2):
        u, v, w = ([chain.ring.evaluate(entry, posture.values) for entry in column] for column in columns[:3])
        products = [sum(x * y for x, y in zip(one, two, strict=True)) % PRIME for one in (u, v, w) for two in (u, v, w)]
        assert products == [1, 0, 0, 0, 1, 0, 0, 0, 1]
        assert determinant([u, v, w]) == 1


def jacobian(table: Table, target: str, rng: np.random.Generator) -> None:
    """The generated Jacobian is the derivative of the table's product, by complex steps and by differences."""
    arm = Arm(table, target=target)
    q = rng.uniform(-3.0, 3.0, (POSES, len(table.rows)))
    J = arm.solver.jacobian(q)
    assert np.abs(J - arm.oracle.jacobian(q)).max() < EXACT * max(1.0, np.abs(J).max())
    for column, unit in enumerate(np.eye(len(table.rows))):
        difference = arm.solver.forward(q + 1e-5 * unit) - arm.solver.forward(q - 1e-5 * unit)
        assert np.abs(difference[:, :3, 3] / 2e-5 - J[:, :3, column]).max() < 1e-8 * max(1.0, np.abs(J).max())


def closure(table: Table, target: str, rng: np.random.Generator) -> None:
    """FK(IK(T)) = T in what the task asks for, at regular poses and with joints at quarter turns."""
    arm = Arm(table, target=target)
    special = rng.integers(-1, 3, (2 * POSES, len(table.rows))) * np.where(arm.oracle.revolute, np.pi / 2, 0.25)
    for regular, q in [(True, arm.postures(rng, POSES)), (False, special)]:
        for joints in q:
            pose = arm.oracle.fk(joints)
            found = arm.inverse(pose, joints)
            missing = np.abs(arm.oracle.away(found, pose, arm.task)).max(initial=0.0)
            assert missing < CLOSURE, (joints, found)
            assert len(found), joints
            if regular:
                assert arm.oracle.apart(found, joints).min() < SAME, (joints, found)


def completeness(table: Table, target: str, rng: np.random.Generator) -> None:
    """A blind search finds no solution that is not listed, and no solution is listed twice."""
    arm = Arm(table, target=target)
    (joints,) = arm.postures(rng, 1)
    pose = arm.oracle.fk(joints)
    found = arm.inverse(pose, joints)
    assert len(found) <= arm.maximum
    apart = arm.oracle.apart(found[:, None], found[None]) + np.eye(len(found))
    assert apart.min() > SAME, found
    for q in arm.oracle.search(pose, arm.task, rng):
        assert arm.oracle.apart(found, q).min() < 1e-4, (joints, found, q)


def conventions(table: Table, target: str, rng: np.random.Generator) -> None:
    """Craig's, Paul's and the screws' table of one arm have the same forward kinematics and the same solutions."""
    arm = Arm(table, target=target)
    twins = [Arm(table.as_craig(), target=target)]
    for convention in Convention:
        try:
            robot = convert(arm.robot, convention)
            build_chain(robot)
        except RobotError as refused:
            if not any(reason in str(refused) for reason in INEXACT):
                raise
            continue
        twins.append(Arm(table, target=target, robot=robot))
    for joints in arm.postures(rng, POSES):
        pose = arm.solver.forward(joints[None])[0]
        found = arm.inverse(pose, joints)
        for twin in twins:
            assert np.abs(twin.solver.forward(joints[None])[0] - pose).max() < EXACT * max(1.0, np.abs(pose).max())
            same(arm, twin.inverse(pose, joints), found)


def singular(table: Table, target: str, rng: np.random.Generator) -> None:
    """det J is the product of the conditions' factors; J loses a motion where one of them holds, nowhere by chance."""
    arm = Arm(table, target=target)
    chain, found, task = arm.derivation.solved, arm.derivation.singular, Task(arm.task)
    for condition in found.conditions:
        for zero in condition.zeros:
            for posture in postures(chain, zero, 2):
                assert kernel(posture.jacobian(task)), condition
    for posture in somewhere(chain, 2):
        assert not kernel(posture.jacobian(task))
        if found.square:
            assert determinant(square(task, posture)) == residue_of(found.determinant, posture.values)


def frames(table: Table, target: str, rng: np.random.Generator) -> None:
    """A base moves every pose, a tool is carried along: the solutions of B T W are those of T without them."""
    arm = Arm(table, target=target)
    quarters = [Cell(Fraction(int(k), 2), "pi") for k in rng.integers(-1, 3, 6)]
    lengths = [Cell(Fraction(int(k), 8)) for k in rng.integers(-4, 5, 6)]
    base = Frame((lengths[0], lengths[1], lengths[2]), (quarters[0], Cell(Fraction("0.3")), quarters[2]))
    tool = Frame((lengths[3], lengths[4], lengths[5]), (quarters[3], quarters[4], Cell(Fraction("-0.4"))))
    if arm.task == "position":
        tool = replace(tool, xyz=(ZERO, ZERO, ZERO))
    if arm.task == "position_axis":
        tool = Frame((ZERO, ZERO, lengths[5]), (ZERO, ZERO, quarters[5]))
    task = "" if arm.task in ("planar", "scara") else arm.task
    moved = Arm(replace(table, base=base, tool=tool, task=task), target=target)
    for joints in arm.postures(rng, POSES):
        pose = arm.oracle.fk(joints)
        framed = moved.oracle.frame(base) @ pose @ moved.oracle.frame(tool)
        assert np.abs(moved.solver.forward(joints[None])[0] - framed).max() < EXACT * 10.0
        same(arm, moved.inverse(framed, joints), arm.inverse(pose, joints))


def scaling(table: Table, target: str, rng: np.random.Generator) -> None:
    """An arm whose lengths are all multiplied reaches the pose with its position multiplied, at the same angles."""
    arm = Arm(table, target=target)
    factor = (Fraction(2), Fraction(1000), Fraction(1, 1000), Fraction(7, 3))[rng.integers(4)]
    rows = [replace(row, a=_scaled(row.a, factor), d=_scaled(row.d, factor)) for row in table.rows]
    large = Arm(replace(table, rows=tuple(rows), task=arm.task), target=target, lengths=factor)
    stretch = np.where(arm.oracle.revolute, 1.0, float(factor))
    for joints in arm.postures(rng, POSES):
        pose = arm.oracle.fk(joints)
        scaled = pose.copy()
        scaled[:3, 3] *= float(factor)
        same(arm, large.inverse(scaled, joints * stretch) / stretch, arm.inverse(pose, joints))


def _scaled(cell: Cell, factor: Fraction) -> Cell:
    """A length; parameters are scaled by their values."""
    return cell if cell.unit else cell.scaled(factor)


def offsets(table: Table, target: str, rng: np.random.Generator) -> None:
    """What is added to a joint's cell is taken from its solutions."""
    arm = Arm(table, target=target)
    shift = [Cell(Fraction(int(k), 2), "pi") for k in rng.integers(-1, 3, len(table.rows))]
    shift[rng.integers(len(shift))] = Cell(Fraction("0.3"))
    rows = [
        replace(row, theta=_sum(row.theta, cell)) if row.kind == "R" else replace(row, d=Cell(Fraction("0.3")))
        for row, cell in zip(table.rows, shift, strict=True)
    ]
    added = Oracle(table, {})
    moved = Arm(replace(table, rows=tuple(rows), task=arm.task), target=target)
    turned = [
        moved.oracle.number(new.theta) - arm.oracle.number(old.theta) if old.kind == "R" else added.number(new.d)
        for old, new in zip(table.rows, rows, strict=True)
    ]
    for joints in arm.postures(rng, POSES):
        pose = arm.oracle.fk(joints)
        same(arm, moved.inverse(pose, joints - turned) + turned, arm.inverse(pose, joints))


def _sum(first: Cell, second: Cell) -> Cell:
    """The sum of two cells of one unit; of two units the second alone."""
    if first.number == 0 or first.unit != second.unit:
        return second
    return Cell(first.number + second.number, first.unit)


def reversal(table: Table, target: str, rng: np.random.Generator) -> None:
    """The arm read from its tool to its base solves the inverse pose, its joints in the opposite order."""
    arm = Arm(table, target=target)
    assume(arm.task not in ("position", "position_axis"))
    task = "" if arm.task in ("planar", "scara") else arm.task
    mirror = Arm(replace(table.backwards(), task=task), target=target)
    for joints in arm.postures(rng, POSES):
        pose = arm.oracle.fk(joints)
        inverse = np.linalg.inv(pose)
        assert np.abs(mirror.solver.forward(joints[None, ::-1])[0] - inverse).max() < EXACT * max(
            1.0, np.abs(inverse).max()
        )
        same(arm, mirror.inverse(inverse, joints[::-1])[:, ::-1], arm.inverse(pose, joints))


def locking(table: Table, target: str, rng: np.random.Generator) -> None:
    """With a joint locked those solutions are left in which it has its value."""
    arm = Arm(table, target=target)
    assume(len(table.rows) > 1)
    place = int(rng.integers(len(table.rows)))
    locked = lock(replace(arm.robot, task=Task(arm.task)), {table.names[place]: None})
    held = Arm(table, target=target, robot=locked)
    for joints in arm.postures(rng, POSES):
        pose = arm.oracle.fk(joints)
        found = arm.inverse(pose, joints)
        for value in found[:2]:
            same(arm, held.inverse(pose, value), found[_near(arm, found, value, place)])


def _near(arm: Arm, found: np.ndarray, value: np.ndarray, place: int) -> np.ndarray:
    """Which solutions have one joint where another has it."""
    difference = found[:, place] - value[place]
    if arm.oracle.revolute[place]:
        difference = (difference + np.pi) % (2.0 * np.pi) - np.pi
    return np.asarray(np.abs(difference) < SAME)


LAWS: dict[str, Law] = {
    law.__name__: law
    for law in (
        forward,
        jacobian,
        closure,
        completeness,
        conventions,
        singular,
        frames,
        scaling,
        offsets,
        reversal,
        locking,
    )
}
