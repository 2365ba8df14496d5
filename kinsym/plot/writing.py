"""Names and values as a picture writes them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.live import Floats

_GREEK = frozenset("alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi phi psi rho sigma tau".split())


def name_text(name: str) -> str:
    """A joint variable as mathtext: theta12 with its number below the line.

    >>> name_text("theta2"), name_text("d3"), name_text("lift_left")
    ('$\\\\theta_{2}$', '$d_{3}$', 'lift_left')
    """
    match = re.fullmatch(r"([A-Za-z]+)_?(\d*)", name)
    if match is None or (match[1] not in _GREEK and len(match[1]) > 1):
        return name
    letter = f"\\{match[1]}" if match[1] in _GREEK else match[1]
    return f"${letter}_{{{match[2]}}}$" if match[2] else f"${letter}$"


def posture_text(variables: Sequence[str], kinds: Sequence[str], q: Floats) -> str:
    """Joint values with their names, angles in degrees.

    >>> import numpy as np
    >>> posture_text(["theta1", "d2"], "RP", np.array([np.pi / 2, 0.25]))
    '$\\\\theta_{1}$ = 90°,  $d_{2}$ = 0.25'
    """
    return ",  ".join(value_text(*each) for each in zip(variables, kinds, q, strict=True))


def value_text(name: str, kind: str, value: float) -> str:
    """A name with its value, an angle in degrees if its ``kind`` is "R".

    >>> value_text("theta3", "R", 0.5)
    '$\\\\theta_{3}$ = 28.6°'
    """
    shown = f"{number_text(math.degrees(value), 1)}°" if kind == "R" else number_text(value, 4)
    return f"{name_text(name)} = {shown}"


def number_text(value: float, places: int) -> str:
    """A number with so many places at most.

    >>> number_text(0.25, 4), number_text(-0.00001, 4)
    ('0.25', '0')
    """
    rounded = round(float(value), places) + 0.0
    return f"{rounded:.{places}f}".rstrip("0").rstrip(".")
