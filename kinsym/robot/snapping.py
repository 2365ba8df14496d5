"""Which decimals are read as the special values that were meant: the one policy for tables, axes and URDF.

A twist of 1.5708 is not pi/2 and an arm with it has no closed form, yet published tables, URDF files and exports of
CAD print it so. Unless the user forbids it (``--exact``) an angle is read as a multiple of 15 degrees where it

* has four or more decimal places and agrees with the multiple to all of them, or
* is off by at most 1e-6 rad;

a cosine of such an angle in a unit vector likewise (0.7071 is sqrt(2)/2, 0.9999 is 1), and a length is read as zero
where it is at most 1e-6 of the arm's size. ``--snap TOL`` puts its own tolerance in the
place of both rules. Whatever is read otherwise than written is a :class:`~kinsym.robot.model.Change`.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from fractions import Fraction

import sympy
from sympy import Expr, Rational

from kinsym.errors import RobotError
from kinsym.robot.expressions import number
from kinsym.robot.model import Change, Vector
from kinsym.robot.text import cell_text

PARTS_OF_PI = 12
LARGEST_MULTIPLE = 2 * PARTS_OF_PI
MOST_PLACES = 40
LARGEST_TOLERANCE = Fraction(1, 10)
"""Below half of 15 degrees, so that no angle is near two multiples."""


@dataclass(frozen=True, kw_only=True)
class Snapping:
    """How far a number may be off: ``within`` in radians, or as a share of the arm's size for a length.

    ``places`` is the least number of decimal places at which agreement with all places is enough, None for never.
    """

    within: Fraction
    places: int | None = None

    def angle(self, cell: Expr, *, where: str) -> tuple[Expr, Change | None]:
        """An angle cell with its constant part made special, and the change if there is one.

        >>> from kinsym.robot import parse
        >>> ROUNDING.angle(parse("theta2 - 1.5708"), where="row 2, theta")[0]
        theta2 - pi/2
        >>> EXACT.angle(parse("1.5708"), where="")
        (3927/2500, None)
        """
        constant = cell.as_coeff_Add()[0]
        if not constant.is_Rational or constant == 0:
            return cell, None
        exact, error = nearest_special(constant)
        places = decimal_places(constant)
        agrees = exact != 0 and self.places is not None and places is not None and self.places <= places
        if error > self.within and not (agrees and error < Fraction(1, 10 ** (places or 0))):
            return cell, None
        change = Change(where=where, written=cell_text(constant), read_as=cell_text(exact), difference=float(error))
        return cell - constant + exact, change

    def direction(self, cells: Vector, *, where: str) -> tuple[Vector, Change | None]:
        """A vector of rounded cosines of multiples of 15 degrees made a unit vector, and the change if there is one.

        Nothing is changed unless the length becomes one exactly.

        >>> from kinsym.robot import parse
        >>> ROUNDING.direction((parse("0.7071"), parse("0"), parse("-0.7071")), where="")[0]
        (sqrt(2)/2, 0, -sqrt(2)/2)
        """
        x, y, z = (self._cosine(cell) for cell in cells)
        exact = x, y, z
        if exact == cells or sympy.expand(x**2 + y**2 + z**2) != 1:
            return cells, None
        difference = max(abs(float(a - b)) for a, b in zip(exact, cells, strict=True))
        written, read_as = (", ".join(cell_text(cell) for cell in vector) for vector in (cells, exact))
        return exact, Change(where=where, written=written, read_as=read_as, difference=difference)

    def _cosine(self, cell: Expr) -> Expr:
        if not cell.is_Rational:
            return cell
        size, places = abs(cell), decimal_places(cell)
        agrees = self.places is not None and places is not None and self.places <= places
        allowed = max(self.within, Fraction(1, 10**places) if agrees and places is not None else Fraction(0))
        exact = min(_cosines(), key=lambda cosine: abs(float(cosine - size)))
        if abs(float(exact - size)) > float(allowed):
            return cell
        return exact if cell >= 0 else -exact

    def negligible(self, length: Fraction, size: Fraction) -> bool:
        """Whether a length that is not zero is read as zero in an arm of this size."""
        return 0 < abs(length) <= self.within * size


@functools.cache
def _cosines() -> tuple[Expr, ...]:
    """The cosines of the special angles up to a right one."""
    return tuple(sympy.cos(multiple * sympy.pi / PARTS_OF_PI) for multiple in range(PARTS_OF_PI // 2 + 1))


ROUNDING = Snapping(within=Fraction(1, 10**6), places=4)
EXACT = Snapping(within=Fraction(0))


def snapping_of(text: str) -> Snapping:
    """The policy of ``--snap TOL``.

    >>> snapping_of("1e-4").within
    Fraction(1, 10000)
    """
    within = number(text, where="--snap")
    if not 0 < within <= LARGEST_TOLERANCE:
        raise RobotError(
            "the tolerance is not above 0 and at most 0.1",
            where="--snap",
            remedy="Write radians, for example --snap 1e-4; --exact takes every number as it is.",
        )
    return Snapping(within=within)


def nearest_special(angle: Expr) -> tuple[Expr, Fraction]:
    """The nearest multiple of 15 degrees up to two turns, else 0, and by how much a rational angle misses it."""
    multiple = int(sympy.floor(angle * PARTS_OF_PI / sympy.pi + Rational(1, 2)))
    if abs(multiple) > LARGEST_MULTIPLE:
        multiple = 0
    exact = multiple * sympy.pi / PARTS_OF_PI
    return exact, abs(Fraction(str(sympy.N(exact - angle, 2 * MOST_PLACES))))


def decimal_places(value: Expr) -> int | None:
    """How many decimal places a rational has, None for a whole number or if its decimal does not end."""
    if not value.is_Rational or value.is_Integer:
        return None
    denominator = int(value.q)
    return next((n for n in range(1, MOST_PLACES + 1) if 10**n % denominator == 0), None)
