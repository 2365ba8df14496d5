"""What is probably meant: cells that look like slips. Nothing is changed here; suspicions are notes only."""

from __future__ import annotations

import sympy

from kinsym.robot.model import Joint, Robot
from kinsym.robot.snapping import decimal_places, nearest_special
from kinsym.robot.text import cell_text

FEWEST_PLACES = 2


def advised(robot: Robot) -> tuple[str, ...]:
    """Notes on suspicious cells of a Denavit-Hartenberg table.

    >>> from kinsym.robot import from_inline
    >>> advised(from_inline("1.57 0 0 theta1", convention="paul"))
    ('row 1, alpha: 1.57 is near pi/2 but not equal; write pi/2 if that is meant.',)
    """
    return tuple(
        f"row {i}, {note}"
        for i, joint in enumerate(robot.joints, start=1)
        if joint.s is None
        for note in _suspicions(joint)
    )


def _suspicions(joint: Joint) -> list[str]:
    found = []
    for column, cell in (("alpha", joint.alpha), ("theta", joint.theta)):
        constant = cell.as_coeff_Add()[0] if cell is not None else sympy.Integer(0)
        places = decimal_places(constant)
        if places is not None and places >= FEWEST_PLACES:
            exact, error = nearest_special(constant)
            if exact != 0 and error * 10**places < 1:
                near = f"is near {exact} but not equal; write {exact} if that is meant."
                found.append(f"{column}: {cell_text(constant)} {near}")
        if abs(constant) > 2 * sympy.pi:
            number = cell_text(constant)
            found.append(f"{column}: {number} radians are more than a turn; write deg({number}) for degrees.")
    for column, cell in (("a", joint.a), ("d", joint.d)):
        if cell is not None and cell.is_number and cell.has(sympy.pi):
            found.append(f"{column}: {cell} is a length here; are the columns in the order alpha, a, d, theta?")
    return found
