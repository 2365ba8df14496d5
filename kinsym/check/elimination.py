"""The loop of a six-joint arm reduced to one angle, with 50 digits: the oracle of the general solver.

Written apart from the generated code: states of lines are moved entry by entry, the determinant is taken of the whole
12 x 12 matrix and read as a polynomial in z = e^(i theta), all its complex roots are found at once (Aberth 1973), and
null vectors come from the whole matrix, so that no half angle is special.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from kinsym.check.linear import Matrix, Value, Vector, circle_roots, determinant, null_vectors
from kinsym.general.plan import Cut

Motion = tuple[Matrix, Vector]

DEGREE = 8
#: Where x = HALF_TURN + pi the half angle is infinite: nowhere in particular.
HALF_TURN = 0.7391


@dataclass(frozen=True)
class Joint:
    """One joint of the loop: kind ``"R"`` or ``"P"`` and the sign with which its variable moves it."""

    kind: str
    sign: int


class Elimination:
    """One loop cut open: ``candidates`` are joint values in the order N0 .. N5 for the ``angles`` of N2.

    A determinant below ``vanished`` at every angle is zero but for the rounding of the pose.
    """

    vanished = 1e-25

    def __init__(self, ctx: Any, cut: Cut, joints: Sequence[Joint], links: Sequence[Motion]) -> None:
        """``joints`` and ``links`` are the robot's, six each; the last link closes the loop."""
        self.ctx = ctx
        direction = -1 if cut.backward else 1
        self.joints = [Joint(joints[number - 1].kind, direction * joints[number - 1].sign) for number in cut.order]
        used = [links[number - 1] for number in cut.links]
        self.links = [inverted(ctx, link) for link in used] if cut.backward else used
        self.x, self.y = (4, 3) if cut.shift else (3, 4)
        self.upper, self.lower = self._equations()
        self.parts = self._half_angles()

    def candidates(self, angles: list[Value]) -> Iterator[Vector]:
        """Joint values N0 .. N5 near every solution, and near some that are none."""
        for theta in angles:
            found = null_vectors(self.ctx, self._matrix(self.ctx.sin(theta), self.ctx.cos(theta)))
            for x, y in self._pairs(*found):
                values = self._completed(theta, x, y)
                if values is not None:
                    yield values

    def _split(self, joint: Joint, psi: Vector, sign: int) -> list[Vector]:
        """A state moved by a joint, as the factors of its three monomials."""
        zero = self.ctx.zero
        first, second, rest = [zero] * 15, [zero] * 15, list(psi)
        if joint.kind == "R":
            for start in (1, 5, 9, 12):
                x, y = psi[start], psi[start + 1]
                first[start], first[start + 1] = -sign * y, sign * x
                second[start], second[start + 1] = x, y
                rest[start] = rest[start + 1] = zero
            return [first, second, rest]
        first[3], first[4], first[8] = sign * psi[0], 2 * sign * psi[3], sign * psi[7]
        first[9], first[10] = -sign * psi[6], sign * psi[5]
        first[12], first[13], first[14] = 2 * sign * psi[10], -2 * sign * psi[9], -2 * sign * psi[8]
        second[4], second[12], second[13], second[14] = psi[0], psi[5], psi[6], -psi[7]
        return [first, second, rest]

    def _spread(self, k: int, states: list[Vector], sign: int) -> list[Vector]:
        joint = self.joints[k]
        parts = [self._split(joint, psi, sign * joint.sign) for psi in states]
        return [part[n] for n in range(3) for part in parts]

    def _equations(self) -> tuple[Matrix, Matrix]:
        """[Q P] with the first eight columns eliminated: the upper eight rows and the lower six, without Q."""
        ctx = self.ctx
        one, zero = ctx.one, ctx.zero
        axis = [one, *[zero] * 6, one, *[zero] * 7]
        left: list[Vector] = [axis]
        for k in (4, 3, 2):
            left = self._spread(k, [moved(ctx, self.links[k], psi) for psi in left], 1)
        right = [moved(ctx, inverted(ctx, self.links[5]), axis)]
        for k in (0, 1):
            back = inverted(ctx, self.links[k])
            right = [moved(ctx, back, psi) for psi in self._spread(k, right, -1)]
        left[-1] = [a - b for a, b in zip(left[-1], right[-1], strict=True)]
        rows = [list(row) for row in zip(*right[:-1], *left, strict=True)][1:]
        for done in range(8):
            pivot = max(range(done, 14), key=lambda i: abs(rows[i][done]))
            rows[done], rows[pivot] = rows[pivot], rows[done]
            if not rows[done][done]:
                continue
            for i in range(done + 1, 14):
                factor = rows[i][done] / rows[done][done]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[done], strict=True)]
        return rows[:8], [_unit(ctx, row[8:]) for row in rows[8:]]

    def _half_angles(self) -> list[list[Matrix]]:
        """By monomial of N2 and power X^2, X, 1 the 6 x 3 factors of (sin y, cos y, 1)."""
        ctx = self.ctx
        c, s = ctx.cos(HALF_TURN), ctx.sin(HALF_TURN)
        result = []
        for m in range(3):
            blocks = [
                [[row[9 * m + (3 * n + k if self.x == 4 else 3 * k + n)] for n in range(3)] for row in self.lower]
                for k in range(3)
            ]
            if self.joints[self.x].kind == "P":
                result.append([blocks[1], blocks[0], blocks[2]])
                continue
            weights = ((-s, -c, 1), (2 * c, -2 * s, 0), (s, c, 1))
            result.append(
                [
                    [
                        [
                            sum(w * value for w, value in zip(weight, values, strict=True))
                            for values in zip(*rows, strict=True)
                        ]
                        for rows in zip(*blocks, strict=True)
                    ]
                    for weight in weights
                ]
            )
        return result

    def _matrix(self, sine: Value, cosine: Value) -> Matrix:
        blocks = [
            [
                [sine * a + cosine * b + e for a, b, e in zip(*rows, strict=True)]
                for rows in zip(*(part[k] for part in self.parts), strict=True)
            ]
            for k in range(3)
        ]
        zero = [self.ctx.zero] * 3
        rows = list(zip(*blocks, strict=True))
        return [[*a, *b, *c, *zero] for a, b, c in rows] + [[*zero, *a, *b, *c] for a, b, c in rows]

    def angles(self) -> list[Value]:
        """The suppressed angles at which the determinant vanishes, or nearly does."""
        return circle_roots(self.ctx, self.closing, DEGREE)

    def closing(self, c: Value, s: Value) -> Value:
        """The determinant at a suppressed angle with this cosine and sine."""
        return determinant(self.ctx, self._matrix(s, c))

    def _pairs(self, first: Vector, second: Vector, alone: bool) -> Iterator[tuple[Value, Value]]:
        """Values of x and y from the null vectors (X^3 W, X^2 W, X W, W) of one root."""
        ctx = self.ctx
        vectors = [first] if alone else [first, *_separated(ctx, first, second)]
        for vector in vectors:
            blocks = [vector[3 * k : 3 * k + 3] for k in range(4)]
            norms = [ctx.fdot(block, block) for block in blocks]
            k = max(range(3), key=lambda n: norms[n] + norms[n + 1])
            mixed = ctx.fdot(blocks[k], blocks[k + 1])
            W = blocks[k] if norms[k] > norms[k + 1] else blocks[k + 1]
            if norms[k] > norms[k + 1]:
                above, below = norms[k], mixed
            else:
                above, below = mixed, norms[k + 1]
            if self.joints[self.x].kind == "P":
                if not below:
                    continue
                x = above / below
            else:
                x = HALF_TURN + 2 * ctx.atan2(above, below)
            if self.joints[self.y].kind == "P":
                if not W[2]:
                    continue
                y = W[0] / W[2]
            else:
                y = ctx.atan2(W[0] * ctx.sign(W[2]), W[1] * ctx.sign(W[2]))
            yield x, y

    def _monomials(self, k: int, value: Value) -> Vector:
        if self.joints[k].kind == "P":
            return [value, value * value, self.ctx.one]
        return [self.ctx.sin(value), self.ctx.cos(value), self.ctx.one]

    def _completed(self, theta: Value, x: Value, y: Value) -> Vector | None:
        """The other joints: N1 and N0 from the upper equations, N5 from the orientation."""
        ctx = self.ctx
        values = [ctx.zero] * 6
        values[2], values[self.x], values[self.y] = theta, x, y
        m2, m3, m4 = (self._monomials(k, values[k]) for k in (2, 3, 4))
        mu = [a * b * c for a in m2 for b in m3 for c in m4]
        nu = [ctx.zero] * 8
        for k in range(7, -1, -1):
            row = self.upper[k]
            rest = ctx.fdot(row[8:], mu) - ctx.fdot(row[k + 1 : 8], nu[k + 1 :])
            nu[k] = rest / row[k] if row[k] else ctx.zero
        values[1] = nu[2] if self.joints[1].kind == "P" else ctx.atan2(nu[2], nu[5])
        values[0] = nu[6] if self.joints[0].kind == "P" else ctx.atan2(nu[6], nu[7])
        whole: Motion = (_identity(ctx), [ctx.zero] * 3)
        for k in range(5):
            whole = product(ctx, product(ctx, whole, self._motion(k, values[k])), self.links[k])
        rotation = inverted(ctx, product(ctx, self.links[5], whole))[0]
        values[5] = self.joints[5].sign * ctx.atan2(rotation[1][0] - rotation[0][1], rotation[0][0] + rotation[1][1])
        return values if all(ctx.isfinite(value) for value in values) else None

    def _motion(self, k: int, value: Value) -> Motion:
        ctx, joint = self.ctx, self.joints[k]
        if joint.kind == "P":
            return _identity(ctx), [ctx.zero, ctx.zero, joint.sign * value]
        c, s = ctx.cos(value), joint.sign * ctx.sin(value)
        return [[c, -s, ctx.zero], [s, c, ctx.zero], [ctx.zero, ctx.zero, ctx.one]], [ctx.zero] * 3


def _identity(ctx: Any) -> Matrix:
    return [[ctx.one if i == j else ctx.zero for j in range(3)] for i in range(3)]


def _unit(ctx: Any, row: Vector) -> Vector:
    size = ctx.sqrt(ctx.fdot(row, row))
    return [value / size for value in row] if size else row


def inverted(ctx: Any, motion: Motion) -> Motion:
    """The inverse motion."""
    turned = [list(column) for column in zip(*motion[0], strict=True)]
    return turned, [-ctx.fdot(row, motion[1]) for row in turned]


def product(ctx: Any, left: Motion, right: Motion) -> Motion:
    """One motion after another: left * right."""
    columns = list(zip(*right[0], strict=True))
    rotation = [[ctx.fdot(row, column) for column in columns] for row in left[0]]
    return rotation, [ctx.fdot(row, right[1]) + t for row, t in zip(left[0], left[1], strict=True)]


def moved(ctx: Any, motion: Motion, psi: Vector) -> Vector:
    """A motion applied to the state (1, p, q, l, s, m, w) of a line, or to a part of one."""
    rotation, t = motion
    p, direction, m, w = ([ctx.fdot(row, psi[k : k + 3]) for row in rotation] for k in (1, 5, 9, 12))
    one, square = psi[0], ctx.fdot(t, t)
    s = psi[8] + ctx.fdot(t, direction)
    tm, tl = _cross(t, m), _cross(t, direction)
    return [
        one,
        *(a + one * b for a, b in zip(p, t, strict=True)),
        psi[4] + 2 * ctx.fdot(t, p) + one * square,
        *direction,
        s,
        *(a + b for a, b in zip(m, tl, strict=True)),
        *(a - 2 * b + square * c - 2 * s * d for a, b, c, d in zip(w, tm, direction, t, strict=True)),
    ]


def _cross(left: Vector, right: Vector) -> Vector:
    (a, b, c), (x, y, z) = left, right
    return [b * z - c * y, c * x - a * z, a * y - b * x]


def _separated(ctx: Any, first: Vector, second: Vector) -> Iterator[Vector]:
    """The vectors (X^3 W, X^2 W, X W, W) in the plane of two null vectors, where there are such."""
    above = [first[:9], second[:9]]
    below = [first[3:], second[3:]]
    a, b, c, d = (ctx.fdot(below[i], above[j]) for i in (0, 1) for j in (0, 1))
    e, f, h = (ctx.fdot(below[i], below[j]) for i, j in ((0, 0), (0, 1), (1, 1)))
    square, half, last = e * h - f * f, (a * h + d * e - f * (b + c)) / 2, a * d - b * c
    root = ctx.sqrt(max(half * half - square * last, ctx.zero))
    for numerator in (half + root, half - root):
        p, q = a * square - numerator * e, b * square - numerator * f
        r, s = c * square - numerator * f, d * square - numerator * h
        g = (-q, p) if abs(p) + abs(q) > abs(r) + abs(s) else (-s, r)
        yield [g[0] * x + g[1] * y for x, y in zip(first, second, strict=True)]
