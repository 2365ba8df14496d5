"""The pool of equations: every cut of the loop closure, row by row.

Each pair of cuts gives nine rotation and three position equations, the three position equations of its inverse (p.u,
p.v, p.w), and p.p (Raghavan and Roth 1993, equations 6 to 8).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from kinsym.algebra.ring import Kind, Poly
from kinsym.inverse.cut import Cut
from kinsym.inverse.products import Products
from kinsym.inverse.state import State
from kinsym.kinematics.angles import Angle

ROWS = "xyz"


@dataclass(frozen=True)
class PoolEquation:
    """``lhs = rhs``; ``unit`` is the exponent of length it is measured in; unknowns are angles and lengths."""

    lhs: Poly
    rhs: Poly
    unit: int
    source: str
    angles: tuple[Angle, ...]
    lengths: tuple[str, ...]

    @cached_property
    def poly(self) -> Poly:
        """The equation as a polynomial that is zero."""
        return self.lhs - self.rhs

    @property
    def terms(self) -> int:
        """The number of terms."""
        return len(self.lhs) + len(self.rhs)

    @property
    def unknowns(self) -> int:
        """The number of unknown angles and lengths."""
        return len(self.angles) + len(self.lengths)


class Pool:
    """The equations of one state, built cut by cut."""

    def __init__(self, state: State) -> None:
        self.state = state
        self.ring = state.chain.ring
        self._angle_of = {name: angle for angle in state.chain.angles.values() for name in (angle.cosine, angle.sine)}
        self._known = {angle.label: state.known.knows(angle) for angle in state.chain.angles.values()}
        self._given = {f"{column}_{row}" for column in state.columns for row in ROWS}

    def cuts(self) -> list[Cut]:
        """All pairs of cuts, those that move the fewest groups first; the last moves the whole arm."""
        count = len(self.state.groups)
        pairs = [(first, stop) for first in range(count) for stop in range(first + 1, count + 1)]
        if not self.state.oriented:
            pairs = [(first, stop) for first, stop in pairs if stop == count]
        pairs.sort(key=lambda pair: (pair[0] - pair[1], pair))
        products = Products(self.state)
        return [Cut(products, first, stop) for first, stop in [*pairs, (count, count)]]

    def equations(self, cut: Cut) -> Iterator[PoolEquation]:
        """The equations of one pair of cuts that the given part of the pose can state."""
        for lhs, rhs, unit, place in self._scalars(cut):
            equation = self._equation(lhs, rhs, unit, f"{place} of {cut}")
            if equation is not None:
                yield equation

    def _scalars(self, cut: Cut) -> Iterator[tuple[Poly, Poly, int, str]]:
        columns = self.state.columns
        if "p" in columns:
            for row, left, right in zip(ROWS, cut.left_point(), cut.right_point(), strict=True):
                yield left, right, 1, f"row {row}, column p"
        for column in "uvw":
            if column in columns:
                sides = zip(ROWS, cut.left_column(column), cut.right_column(column), strict=True)
                for row, left, right in sides:
                    yield left, right, 0, f"row {row}, column {column}"
        if cut.first == cut.stop:
            return
        if "uvw" in columns and cut.skew:
            for row, left, right in zip(ROWS, cut.left_axis(), cut.right_axis(), strict=True):
                yield left, right, 0, f"row {row}, direction of the last axis"
        if columns == "uvwp":
            for row, left, right in zip(ROWS, cut.left_origin(), cut.right_origin(), strict=True):
                yield left, right, 1, f"row {row}, column p of the inverse"
        if "p" in columns:
            yield cut.left_squared(), cut.right_squared(), 2, "square of column p"

    def _equation(self, lhs: Poly, rhs: Poly, unit: int, source: str) -> PoolEquation | None:
        ring = self.ring
        angles: dict[str, Angle] = {}
        lengths: dict[str, None] = {}
        for name in (*ring.used(lhs), *ring.used(rhs)):
            kind = ring.generators[ring.index[name]].kind
            if kind is Kind.POSE and name not in self._given:
                return None
            if kind is Kind.LENGTH and name not in self.state.known.lengths:
                lengths[name] = None
            if kind in (Kind.COSINE, Kind.SINE) and not self._known[self._angle_of[name].label]:
                angles[self._angle_of[name].label] = self._angle_of[name]
        if not angles and not lengths:
            return None
        return PoolEquation(lhs, rhs, unit, source, tuple(angles.values()), tuple(lengths))
