"""What is probably meant: angles typed as rounded decimals, and cells that look like slips.

A twist of 1.5708 is not pi/2 and an arm with it has no closed form, yet many published tables print it so. A
decimal of four or more places that agrees with a multiple of 15 degrees to all its places is read as that
multiple, and a note says so. Other suspicions change nothing and are notes only.
"""

from __future__ import annotations

from dataclasses import replace

import sympy
from sympy import Expr, Rational

from kinsym.robot.model import Joint, Robot
from kinsym.robot.text import cell_text

FEWEST_PLACES = 4
FEWEST_PLACES_NOTED = 2
MOST_PLACES = 40
PARTS_OF_PI = 12
LARGEST_MULTIPLE = 2 * PARTS_OF_PI


def exact_angle(cell: Expr) -> tuple[Expr, str]:
    """The cell with a rounded multiple of pi/12 made exact, and a note, empty if nothing was changed.

    >>> from kinsym.robot import parse
    >>> exact_angle(parse("theta2 - 1.5708"))
    (theta2 - pi/2, '-1.5708 is read as -pi/2')
    >>> exact_angle(parse("1.57"))
    (157/100, '1.57 is near pi/2 but not equal; write pi/2 if that is meant')
    """
    constant = cell.as_coeff_Add()[0]
    places = _places(constant)
    if places is None or places < FEWEST_PLACES_NOTED:
        return cell, ""
    multiple = int(sympy.floor(constant * PARTS_OF_PI / sympy.pi + Rational(1, 2)))
    exact = multiple * sympy.pi / PARTS_OF_PI
    error = abs(sympy.N(exact - constant, 2 * MOST_PLACES))
    if multiple == 0 or abs(multiple) > LARGEST_MULTIPLE or error >= sympy.Float(10, 50) ** -places:
        return cell, ""
    shown = cell_text(constant)
    if places < FEWEST_PLACES:
        return cell, f"{shown} is near {exact} but not equal; write {exact} if that is meant"
    return cell - constant + exact, f"{shown} is read as {exact}"


def exact_angles(robot: Robot) -> Robot:
    """The robot with the angles of its rows made exact (:func:`exact_angle`), and with notes on suspicious cells."""
    joints: list[Joint] = []
    notes: list[str] = []
    for i, joint in enumerate(robot.joints, start=1):
        if joint.alpha is None or joint.theta is None:
            joints.append(joint)
            continue
        alpha, note_alpha = exact_angle(joint.alpha)
        theta, note_theta = exact_angle(joint.theta)
        joints.append(replace(joint, alpha=alpha, theta=theta))
        notes += [f"row {i}, {column}: {note}." for column, note in _noted(alpha=note_alpha, theta=note_theta)]
        notes += [f"row {i}, {note}" for note in _suspicions(joints[-1])]
    return replace(robot, joints=tuple(joints), notes=(*robot.notes, *notes))


def _noted(**notes: str) -> list[tuple[str, str]]:
    return [(column, note) for column, note in notes.items() if note]


def _suspicions(joint: Joint) -> list[str]:
    found = []
    for column, cell in (("alpha", joint.alpha), ("theta", joint.theta)):
        constant = cell.as_coeff_Add()[0] if cell is not None else 0
        if abs(constant) > 2 * sympy.pi:
            number = cell_text(constant)
            found.append(f"{column}: {number} radians are more than a turn; write deg({number}) for degrees.")
    for column, cell in (("a", joint.a), ("d", joint.d)):
        if cell is not None and cell.is_number and cell.has(sympy.pi):
            found.append(f"{column}: {cell} is a length here; are the columns in the order alpha, a, d, theta?")
    return found


def _places(value: Expr) -> int | None:
    """How many decimal places a rational has, or None if its decimal does not end."""
    if not value.is_Rational or value.is_Integer:
        return None
    denominator = int(value.q)
    return next((n for n in range(1, MOST_PLACES + 1) if 10**n % denominator == 0), None)
