"""What kinsym derives for the lecture's systems: products of rows, elementary transforms, random screws."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from kinsym.kinematics.elementary import FACTORS, SCREWS
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import parse
from kinsym.lecture.posture import Posture, random_values
from kinsym.lecture.quantities import Matrix, matmul, rigid_inverse
from kinsym.lecture.screw import random_axis
from kinsym.lecture.system import System, system

ARMS = ("planar_rrr_craig", "scara", "scorbot_5r", "fanuc_s900w", "elbow_6r_screw", "stanford_screw", "pieper_craig")


def at(arm: System) -> Posture:
    """A random posture."""
    return Posture(arm, random_values(arm, random.Random(arm.robot.name)))


def product(posture: Posture, first: int, last: int) -> Matrix:
    """The product of the links first + 1 to last, link by link."""
    total = posture.matrix(posture.system.base)
    for number in range(first + 1, last + 1):
        total = matmul(total, posture.matrix(posture.system.link(number)))
    return total


@pytest.mark.parametrize("name", ARMS)
def test_parts_are_products_of_links(name: str) -> None:
    """What is derived for some rows as an arm of their own is the product of their links, and its inverse is one."""
    posture = at(system(name))
    rows = len(posture.system.robot.joints)
    for first, last in ((0, 2), (1, 3), (0, rows if posture.system.robot.joints[-1].variable else rows - 1)):
        whole = product(posture, first, last)
        assert posture.matrix(posture.system.part(first, last)) == whole
        assert posture.matrix(posture.system.inverse(first, last)) == rigid_inverse(whole)


@pytest.mark.parametrize("name", ["craig_link", "paul_link", "pieper_craig"])
def test_elementary_transforms_make_a_row(name: str) -> None:
    """The named factors of a row, in their order, make its link; so do the two screws."""
    arm = system(name)
    posture = at(arm)
    convention = arm.robot.convention
    evaluate = Evaluator(posture.values.__getitem__)
    for number, joint in enumerate(arm.robot.joints, start=1):
        cells = {"alpha": joint.alpha, "a": joint.a, "d": joint.d, "theta": joint.theta}
        four = "*".join(f"{transform}({cells[cell]})" for transform, cell in FACTORS[convention])
        two = "*".join(f"{transform}({cells[a]}, {cells[b]})" for transform, a, b in SCREWS[convention])
        link = posture.matrix(arm.link(number))
        assert evaluate(parse(four)) == link
        assert evaluate(parse(two)) == link


def test_random_axes_are_unit_vectors() -> None:
    """Exactly, with no component zero."""
    generator = random.Random(1)
    for _ in range(50):
        axis = random_axis(generator)
        assert sum((part * part for part in axis), Fraction(0)) == 1
        assert all(axis)
