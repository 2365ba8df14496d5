"""Position and orientation apart: the lecture's way for the Fanuc S-900w (slides 59 to 65).

The last three axes meet in P, which joints 4 to 6 leave alone. From ``A_0_1^-1 P = A_1_3 P`` theta1 follows, from
squares theta3 by u = tan(theta/2), and theta2 by Cramer's rule; then ``A_3_6 = A_0_3^-1 A_0_6`` has theta5, theta4 and
theta6.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sympy import Integer

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Vector, identity, plus
from kinsym.algebra.tree import ONE, ZERO, Call, PlusMinus, Quot, Sym, Tree, add, mul, opposite, sub
from kinsym.errors import DoesNotApply
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.convert import convert
from kinsym.kinematics.forward import link_transform, pose_direction, pose_point
from kinsym.kinematics.links import Rigid
from kinsym.kinematics.moves import Moves
from kinsym.methods.document import INVERSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.steps import AngleOf, Row, half_angle, one_row
from kinsym.methods.tables import needs_wrist, unlocked
from kinsym.robot.model import Convention, Robot

NAME, TITLE = "decoupled", "Position and orientation apart"
GROUPS = ((0,), (1, 2), (3,), (4,), (5,))
ROWS = "xyz"


def decoupled(robot: Robot) -> MethodDerivation:
    """The inverse kinematics of an arm with parallel axes 2 and 3 and a spherical wrist.

    Raises :class:`DoesNotApply` with what of the arm is otherwise.
    """
    robot = unlocked(robot)
    needs_wrist(robot, TITLE)
    if robot.convention is not Convention.PAUL:
        robot = convert(robot, Convention.PAUL)
    if robot.base is not None or robot.tool is not None:
        raise _refusal(
            robot, "a base or a tool moves its frames 0 or 6, which the lecture lays into the first and the last joint"
        )
    whole = build_chain(robot)
    if tuple(group.joints for group in whole.groups) != GROUPS or any(joint.kind == "P" for joint in whole.joints):
        raise _refusal(robot, "axes 2 and 3 are not parallel, or a joint slides")
    last = robot.joints[-1]
    ended = replace(robot, joints=(*robot.joints[:-1], replace(last, d=Integer(0), a=Integer(0))))
    work = _Decoupled(whole, build_chain(ended))
    work.state_wrist_point()
    work.find_first()
    work.find_third()
    work.find_second()
    work.find_wrist()
    return work.draft.done()


def _refusal(robot: Robot, why: str) -> DoesNotApply:
    return DoesNotApply(f"{TITLE} does not apply to {robot.name}: {why}.")


class _Decoupled:
    """One arm; ``chain`` ends in the wrist point, so that p is a generator of its ring."""

    def __init__(self, whole: Chain, chain: Chain) -> None:
        self.whole, self.chain, self.ring = whole, chain, chain.ring
        self.draft = Draft(chain, method=NAME, title=TITLE)
        self.shoulder, self.links = (Moves(self.ring, group.whole(self.ring), chain.turn) for group in chain.groups[:2])
        self.point: Vector = link_transform(chain, chain.robot.joints[3], 4).translation
        self.given: Vector = tuple(self.ring[f"p_{row}"] for row in ROWS)
        self.left = self.shoulder.point_back(self.given)
        self.right = self.links.point(self.point)

    def angle(self, position: int) -> AngleOf:
        """The angle of a joint."""
        variable = self.chain.joints[position].variable
        found = next(angle for angle in self.chain.angles.values() if angle.terms == ((variable, 1),))
        return AngleOf(found.name, found.cosine, found.sine)

    def state_wrist_point(self) -> None:
        """P seen from the end, from the base and from frame 3."""
        draft, whole = self.draft, self.whole
        away = whole.joints[-1].after.inverse(whole.ring).translation
        ends = [draft.fresh(f"q_{row}") for row in ROWS]
        for row, name in zip(ROWS, ends, strict=True):
            total: Tree = Sym(f"p_{row}")
            for column, part in zip("uvw", away, strict=True):
                total = sub(total, mul(nested(whole.ring, part), Sym(f"{column}_{row}")))
            draft.give_value(name, total)
        pose = tuple((*(Sym(f"{column}_{row}") for column in "uvw"), Sym(q)) for row, q in zip(ROWS, ends, strict=True))
        draft.name_matrix("A_0_6", Matrix((*pose, (ZERO, ZERO, ZERO, ONE))))
        for number, joint in enumerate(whole.robot.joints, start=1):
            draft.name_matrix(f"A_{number - 1}_{number}", self._matrix(link_transform(whole, joint, number)))
        for first, end in ((0, 3), (1, 3), (3, 6)):
            factors = tuple(Factor(f"A_{i}_{i + 1}") for i in range(first, end))
            draft.name_matrix(f"A_{first}_{end}", Product(factors))
        draft.name_matrix("p_in0", self._column(map(Sym, ("p_x", "p_y", "p_z"))))
        draft.name_matrix("p_in3", Product((Factor("A_0_3", INVERSE), Factor("p_in0"))))
        draft.name_matrix("p_in6", Product((Factor("A_0_6", INVERSE), Factor("p_in0"))))
        draft.say("The last three axes meet in `P`, with `q` the end effector. Seen from frames 6, 0 and 3 it is")
        draft.state("p_in6", _one("p_in6"), self._column(nested(whole.ring, part) for part in away))
        draft.state("p_in0.name", _one("p_in0"), self._column(map(Sym, ("p_x", "p_y", "p_z"))))
        seen = [
            add(
                Sym(q), *(mul(nested(whole.ring, part), Sym(f"{c}_{row}")) for c, part in zip("uvw", away, strict=True))
            )
            for row, q in zip(ROWS, ends, strict=True)
        ]
        draft.state("p_in0", _one("p_in0"), self._column(seen))
        draft.state("p_in3", _one("p_in3"), self._column(map(draft.tree, self.point)))
        draft.state("p_in0.from3", _one("p_in0"), Product((Factor("A_0_3"), Factor("p_in3"))))
        left = Product((Factor("A_0_1", INVERSE), Factor("p_in0")))
        draft.state("loop", left, Product((Factor("A_1_3"), Factor("p_in3"))))
        for row, x, y in zip(ROWS, self.left, self.right, strict=True):
            draft.state(f"loop.{row}", draft.tree(x), draft.tree(y))

    def _matrix(self, link: Rigid) -> Matrix:
        """A link transform of the whole arm."""
        ring = self.whole.ring
        rows = tuple(
            tuple(nested(ring, entry) for entry in (*line, moved))
            for line, moved in zip(link.rotation, link.translation, strict=True)
        )
        return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))

    def _column(self, entries: Iterable[Tree]) -> Matrix:
        """A point as a column with a 1 below it."""
        return Matrix((*((entry,) for entry in entries), (ONE,)))

    def find_first(self) -> None:
        """theta1 from the row in which theta2 and theta3 do not occur."""
        angle = self.angle(0)
        row = self.left[2] - self.right[2]
        parts = self.ring.collect(row, (angle.cosine, angle.sine))
        zero: Poly = self.ring.zero
        a, b, rest = (parts[key] if key in parts else zero for key in ((1, 0), (0, 1), (0, 0)))  # noqa: SIM401
        if not a and not b:
            raise _refusal(self.chain.robot, "axis 1 is parallel to axis 2")
        self.draft.say(f"The row {{loop.z}} holds `{angle.name}` alone:")
        one_row(self.draft, self.ring, angle, Row(a, b, self.draft.tree(-rest)))

    def find_third(self) -> None:
        """theta3 from the sum of squares, by u = tan(theta/2)."""
        draft, ring, angle = self.draft, self.ring, self.angle(2)
        known = self.shoulder.point_back_squared(self.given, ring.dot(self.given, self.given))
        parts = ring.collect(
            self.links.point_squared(self.point, ring.dot(self.point, self.point)), (angle.cosine, angle.sine)
        )
        a, b, rest = parts.get((1, 0), ring.zero), parts.get((0, 1), ring.zero), parts.get((0, 0), ring.zero)
        draft.say(f"Squares of the three rows are added. Then `{angle.name}` is left alone:")
        kappa1 = draft.define(draft.fresh("kappa1"), draft.tree(b)) if b else ZERO
        kappa2 = draft.define(draft.fresh("kappa2"), draft.tree(a)) if a else ZERO
        kappa3 = draft.define(draft.fresh("kappa3"), draft.tree(ring.reduce(known - rest)))
        half_angle(draft, angle, kappa2, kappa1, kappa3)

    def find_second(self) -> None:
        """theta2 by Cramer's rule from the two rows that are left."""
        draft, angle = self.draft, self.angle(1)
        x, y = self._behind_second()
        draft.say(f"With `{self.angle(2).name}` known, the other two rows hold `{angle.name}` alone:")
        names: list[list[Sym]] = []
        for number, (along, across, known) in enumerate(((x, -y, self.left[0]), (y, x, self.left[1])), start=1):
            words = zip(("mu", "nu", "gamma"), (along, across, known), strict=True)
            names.append([draft.define(draft.fresh(f"{stem}{number}"), draft.tree(part)) for stem, part in words])
        for mu, nu, gamma in names:
            draft.state(f"{gamma.name}.row", add(mul(mu, angle.c), mul(nu, angle.s)), gamma)
        (mu1, nu1, gamma1), (mu2, nu2, gamma2) = names
        below = sub(mul(mu1, nu2), mul(mu2, nu1))
        unique = draft.require(f"{angle.name}.unique", below, "!=", ZERO)
        draft.state(f"{angle.name}.c", angle.c, Quot(sub(mul(gamma1, nu2), mul(gamma2, nu1)), below))
        draft.state(f"{angle.name}.s", angle.s, Quot(sub(mul(mu1, gamma2), mul(mu2, gamma1)), below))
        draft.solve(angle.name, Call("atan2", (angle.s, angle.c)), branches=1, conditions=(unique,))

    def _behind_second(self) -> tuple[Poly, Poly]:
        """P in the plane that joint 2 turns, before it turns: the lengths of both links with theta3."""
        links = self.links
        total: Vector = (self.ring.zero,) * 3
        for node, arm in enumerate(links.group.arms[1:], start=1):
            total = plus(total, links.rotated(1, node, arm))
        turned = tuple(self.ring.dot(row, self.point) for row in links.group.turned)
        x, y, _ = plus(total, links.rotated(1, links.group.last, turned))
        return x, y

    def find_wrist(self) -> None:
        """theta5 from the third column and row of A_3_6, then theta4 and theta6 from quotients by its sine."""
        draft, ring = self.draft, self.ring
        draft.say("What is left to joints 4, 5 and 6 is")
        draft.state("wrist", _one("A_3_6"), Product((Factor("A_0_3", INVERSE), Factor("A_0_6"))))
        draft.state("A_0_3", _one("A_0_3"), self._part(0, 2))
        draft.state("A_3_6", _one("A_3_6"), self._part(2, 5))
        four, five, six = (self.angle(position) for position in (3, 4, 5))
        c4, s4, c5, s5, c6, s6 = (ring[name] for angle in (four, five, six) for name in (angle.cosine, angle.sine))
        seen = {column: self._taken_back(column) for column in "uvw"}
        moved = {column: self._turned(column) for column in "uvw"}
        cosine = self._read(moved["w"][2], seen["w"][2], c5)
        r33 = draft.define(draft.fresh("r33"), cosine)
        draft.state(f"{five.name}.c", five.c, cosine)
        real = draft.require(f"{five.name}.real", Call("abs", (r33,)), "<=", ONE)
        draft.solve(five.name, PlusMinus(None, Call("acos", (r33,))), branches=2, conditions=(real,))
        unique = draft.require(f"{five.name}.regular", five.s, "!=", ZERO)
        draft.say(f"Where {{{unique.name}}} holds,")
        outer = zip(moved["w"][:2], seen["w"][:2], strict=True)
        inner = [(moved[column][2], seen[column][2]) for column in "uv"]
        for angle, c, s, entries in ((four, c4, s4, list(outer)), (six, c6, s6, inner)):
            for name, part, word in (("c", c, angle.c), ("s", s, angle.s)):
                wanted = ring.mul(part, s5)
                known = next((value for value in (self._sign(m, k, wanted) for m, k in entries) if value), None)
                if known is None:
                    raise _refusal(self.chain.robot, "the axes of its wrist do not cross at right angles")
                draft.state(f"{angle.name}.{name}", word, Quot(known, five.s))
            draft.solve(angle.name, Call("atan2", (angle.s, angle.c)), branches=1, conditions=(unique,))

    def _taken_back(self, column: str) -> Vector:
        """A column of the pose seen from frame 3."""
        x, y, z = (self.ring[f"{column}_{row}"] for row in ROWS)
        return self.links.direction_back(self.shoulder.direction_back((x, y, z)))

    def _turned(self, column: str) -> Vector:
        """The same as the wrist turns it."""
        unit = identity(self.ring)["uvw".index(column)]
        return pose_direction(self.chain, self.chain.groups[2:], unit)

    def _part(self, first: int, stop: int) -> Matrix:
        """The product of the groups first to stop - 1, whole arm."""
        ring = self.whole.ring
        groups = self.whole.groups[first:stop]
        columns = [pose_direction(self.whole, groups, unit) for unit in identity(ring)]
        columns.append(pose_point(self.whole, groups, (ring.zero,) * 3))
        rows = tuple(tuple(nested(ring, column[i]) for column in columns) for i in range(3))
        return Matrix((*rows, (ZERO, ZERO, ZERO, ONE)))

    def _read(self, moved: Poly, known: Poly, wanted: Poly) -> Tree:
        """The known side of an entry that is a quantity up to its sign."""
        found = self._sign(moved, known, wanted)
        if found is None:
            raise _refusal(self.chain.robot, "the axes of its wrist do not cross at right angles")
        return found

    def _sign(self, moved: Poly, known: Poly, wanted: Poly) -> Tree | None:
        if moved not in (wanted, -wanted):
            return None
        tree = self.draft.tree(known)
        return tree if moved == wanted else opposite(tree)


def _one(name: str) -> Product:
    return Product((Factor(name),))
