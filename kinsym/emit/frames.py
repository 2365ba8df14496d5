"""The Jacobian from frame to frame, for an arm whose entries multiplied out would fill a book.

Where no two axes are parallel or meet a closed formula of an entry has hundreds of terms. Here the frame of each joint
is computed from the one before, and the columns [z_i x (p - o_i); z_i] from these.
"""

from __future__ import annotations

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly, Vector, apply, plus
from kinsym.algebra.tree import ZERO, Definition, Num, Sym, Tree, negated, sub
from kinsym.emit.schedule import StraightLine
from kinsym.emit.straight import with_angles
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.jacobian import cross
from kinsym.kinematics.links import Motion, turn_z

Frame = dict[str, Vector]
Column = tuple[Tree, Tree, Tree]


def jacobian_by_frames(chain: Chain) -> StraightLine:
    """The 6 n entries of the Jacobian, row by row, with the joints' frames (u03_x, ...) as definitions."""
    writer = _Frames(chain)
    axes: list[Column] = []
    points: list[Column] = []
    for number, joint in enumerate(chain.joints):
        axes.append(writer.column("w", joint.sign))
        points.append(writer.column("p"))
        writer.move(joint, f"0{number + 1}")
    end = writer.column("p")
    columns = []
    for joint, axis, point in zip(chain.joints, axes, points, strict=True):
        if joint.kind == "R":
            lever = (sub(end[0], point[0]), sub(end[1], point[1]), sub(end[2], point[2]))
            columns.append((*cross(axis, lever), *axis))
        else:
            columns.append((*axis, ZERO, ZERO, ZERO))
    outputs = tuple(entry for row in zip(*columns, strict=True) for entry in row)
    return with_angles(chain, writer.definitions, outputs)


class _Frames:
    """The frame reached so far; the entries that have names stand in the ring as those of a pose."""

    def __init__(self, chain: Chain) -> None:
        self._chain, self._ring = chain, chain.ring
        self.definitions: list[Definition] = []
        self._names: dict[str, Tree] = {}
        r, t = chain.base.rotation, chain.base.translation
        u, v, w = ((r[0][i], r[1][i], r[2][i]) for i in range(3))
        self._frame: Frame = {"u": u, "v": v, "w": w, "p": t}

    def column(self, letter: str, sign: int = 1) -> Column:
        """A column as it is printed."""
        x, y, z = (nested(self._ring, entry * sign, self._names) for entry in self._frame[letter])
        return x, y, z

    def move(self, joint: Motion, number: str) -> None:
        """Go on through a joint and the constant behind it; entries that are more than a name get one."""
        ring = self._ring
        turned, slid = turn_z(ring, *self._turn(joint)), (ring.zero, ring.zero, ring.zero)
        if joint.kind == "P":
            slid = (ring.zero, ring.zero, ring[joint.variable] * joint.sign)
        columns = {name: tuple(row[i] for row in joint.after.rotation) for i, name in enumerate("uvw")}
        frame = {name: self._seen(apply(ring, turned, (v[0], v[1], v[2]))) for name, v in columns.items()}
        reach = self._seen(plus(slid, apply(ring, turned, joint.after.translation)))
        frame["p"] = plus(self._frame["p"], reach)
        names: dict[str, Tree] = {}
        for letter, vector in frame.items():
            entries = []
            for row, entry in zip("xyz", vector, strict=True):
                tree = nested(ring, entry, self._names)
                if not (isinstance(tree, (Num, Sym)) or isinstance(negated(tree), Sym)):
                    self.definitions.append(Definition(name=f"{letter}{number}_{row}", value=tree))
                    tree = Sym(f"{letter}{number}_{row}")
                names[f"{letter}_{row}"] = tree
                entries.append(entry if entry.is_ground else ring[f"{letter}_{row}"])
            frame[letter] = (entries[0], entries[1], entries[2])
        self._frame, self._names = frame, names

    def _seen(self, vector: Vector) -> Vector:
        """A vector of the frame, in the base frame."""
        ring, frame = self._ring, self._frame
        x, y, z = (ring.dot((frame["u"][i], frame["v"][i], frame["w"][i]), vector) for i in range(3))
        return x, y, z

    def _turn(self, joint: Motion) -> tuple[Poly, Poly]:
        """Cosine and sine by which a joint turns about the z axis of its frame."""
        ring = self._ring
        for angle in self._chain.angles.values():
            if len(angle.terms) == 1 and angle.terms[0][0] == joint.variable:
                return ring[angle.cosine], ring[angle.sine] * (angle.terms[0][1] * joint.sign)
        return ring.one, ring.zero
