"""One matrix equation of the loop closure, cut twice.

What lies before the first cut and after the second is moved to the left:
``(G_1..G_i)^-1 T (G_k..G_m)^-1 = G_i+1..G_k-1``. This module gives the columns of both sides, the origin of the
inverse equation and the squared distance of the cuts; all are linear in the cosines and sines of each group.
"""

from __future__ import annotations

from functools import cached_property

from kinsym.algebra.ring import Poly, Vector, plus
from kinsym.inverse.products import Products
from kinsym.robot.model import Convention, Robot


def link_letter(robot: Robot) -> str:
    """A for the link transforms of Paul's table; L for the links of the chain where they are cut differently."""
    return "A" if robot.convention is Convention.PAUL else "L"


class Cut:
    """The groups ``first`` to ``stop`` (exclusive) of a state stay on the right."""

    def __init__(self, products: Products, first: int, stop: int) -> None:
        self.state, self.ring, self.products = products.state, products.ring, products
        self.first, self.stop = first, stop

    def __str__(self) -> str:
        return self._words

    @cached_property
    def _words(self) -> str:
        """The equation in words: A1^-1 T_0_6 = A2 A3 A4 A5 A6."""
        state = self.state
        link = link_letter(state.chain.robot)
        groups = state.chain.groups[state.first : state.end]

        def numbers(part: slice) -> list[int]:
            return [number for group in groups[part] for number in state.links(group)]

        left = [f"{link}{i}^-1" for i in reversed(numbers(slice(0, self.first)))]
        right = [f"{link}{i}^-1" for i in reversed(numbers(slice(self.stop, None)))]
        product = " ".join(f"{link}{i}" for i in numbers(slice(self.first, self.stop)))
        return f"{' '.join([*left, state.label, *right])} = {product or '1'}"

    def left_column(self, column: str) -> Vector:
        """Column u, v or w of the left side."""
        return self.products.left_column(self.first, self.stop, column)

    def right_column(self, column: str) -> Vector:
        """Column u, v or w of the right side."""
        return self.products.right_column(self.first, self.stop, column)

    @property
    def skew(self) -> bool:
        """Whether slides after the last revolute axis have turned the last frame away from it."""
        x, y, _ = self._axis()
        return bool(x or y)

    def left_axis(self) -> Vector:
        """The direction of the last revolute axis on the right, from the columns of the left side."""
        columns = [self.left_column(column) for column in "uvw"]
        x, y, z = (self.ring.dot(self._axis(), row) for row in zip(*columns, strict=True))
        return x, y, z

    def right_axis(self) -> Vector:
        """The same from the joints before it; it does not turn about itself."""
        vector = self.products.unit("w")
        for move in reversed(self.products.inside(self.first, self.stop)[:-1]):
            vector = move.direction(vector)
        return vector

    def _axis(self) -> Vector:
        """The axis of the last group of the right side in the last frame."""
        return self.products.inside(self.first, self.stop)[-1].group.turned[2]

    def left_point(self) -> Vector:
        """Column p of the left side."""
        return self.products.left_point(self.first, self.stop)

    def right_point(self) -> Vector:
        """Column p of the right side."""
        return self.products.right_point(self.first, self.stop)

    def left_origin(self) -> Vector:
        """Column p of the inverse of the left side."""
        products = self.products
        return products.trail(self.stop).apply(self.ring, products.left_origin(self.first, self.stop))

    def right_origin(self) -> Vector:
        """Column p of the inverse of the right side."""
        *_, last = self.products.inside(self.first, self.stop)
        return last.point_back(self.products.right_origin(self.first, self.stop - 1))

    def left_squared(self) -> Poly:
        """The squared length of column p of the left side."""
        ring, p = self.ring, self.state.pose["p"]
        turned, tip_squared = self.products.turned_tip(self.stop), self.products.tip(self.stop)[1]
        root, root_squared = self.products.root(self.first)
        total = tip_squared + root_squared + ring.dot(p, p) + 2 * ring.dot(p, turned)
        return ring.reduce(total - 2 * ring.dot(root, plus(turned, p)))

    def right_squared(self) -> Poly:
        """The squared length of column p of the right side."""
        return self.products.right_squared(self.first, self.stop)
