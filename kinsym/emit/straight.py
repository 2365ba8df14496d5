"""Forward kinematics and Jacobian as straight lines of assignments.

The pose is built from the tip to the base, one group of parallel axes at a time: T_4_6, T_3_6, ..., each entry that is
more than a name gets one (u36_x), so that a product of sines and cosines is computed once.
"""

from __future__ import annotations

from collections.abc import Iterable

from kinsym.algebra.nested import nested, number
from kinsym.algebra.ring import Vector, apply
from kinsym.algebra.tree import Call, Definition, Num, Sym, Tree, add, mul, negated, symbols
from kinsym.emit.schedule import StraightLine
from kinsym.emit.sharing import shared
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.jacobian import Jacobian
from kinsym.kinematics.moves import Moves


def forward_line(chain: Chain) -> StraightLine:
    """The twelve entries of T, row by row."""
    ring = chain.ring
    zero, one = ring.zero, ring.one
    names: dict[str, Tree] = {}
    definitions: list[Definition] = []
    columns: dict[str, Vector] = {
        "u": (one, zero, zero),
        "v": (zero, one, zero),
        "w": (zero, zero, one),
        "p": (zero, zero, zero),
    }
    trees: dict[str, Tree] = {}
    for group in reversed(chain.groups):
        move = Moves(ring, group.whole(ring), chain.turn)
        columns = {n: move.point(v) if n == "p" else move.direction(v) for n, v in columns.items()}
        if group.index == 0:
            columns = {
                n: chain.base.apply(ring, v) if n == "p" else apply(ring, chain.base.rotation, v)
                for n, v in columns.items()
            }
        trees = {f"{n}_{r}": nested(ring, e, names) for n, v in columns.items() for r, e in zip("xyz", v, strict=True)}
        if group.index == 0:
            break
        names = {}
        numbers = f"{group.joints[0]}{len(chain.joints)}"
        for name, vector in columns.items():
            entries = []
            for row, entry in zip("xyz", vector, strict=True):
                key = f"{name}_{row}"
                tree = trees[key]
                if not _plain(tree):
                    called = f"{name}{numbers}_{row}"
                    definitions.append(Definition(name=called, value=tree))
                    tree = Sym(called)
                names[key] = tree
                entries.append(entry if entry.is_ground else ring[key])
            columns[name] = (entries[0], entries[1], entries[2])
    outputs = tuple(trees[f"{n}_{r}"] for r in "xyz" for n in "uvwp")
    return with_angles(chain, definitions, outputs)


def jacobian_line(chain: Chain, jacobian: Jacobian) -> StraightLine:
    """The 6 n entries of the Jacobian, row by row."""
    outputs = tuple(entry for row in jacobian.entries for entry in row)
    return with_angles(chain, list(jacobian.definitions), outputs)


def _plain(tree: Tree) -> bool:
    return isinstance(tree, (Num, Sym)) or isinstance(negated(tree), Sym)


def with_angles(chain: Chain, definitions: list[Definition], outputs: tuple[Tree, ...]) -> StraightLine:
    """Put the cosines and sines that are used in front, and leave out what is not."""
    wanted = {name for tree in outputs for name in symbols(tree)}
    kept: list[Definition] = []
    for definition in reversed(definitions):
        if definition.name in wanted:
            wanted.update(symbols(definition.value))
            kept.append(definition)
    head = [d for d in angle_functions(chain) if d.name in wanted]
    return shared(StraightLine(definitions=(*head, *reversed(kept)), outputs=outputs))


def angle_functions(chain: Chain) -> Iterable[Definition]:
    """Cosine and sine of every named angle from the joint variables."""
    for angle in chain.angles.values():
        total = add(*(mul(number(sign), Sym(variable)) for variable, sign in angle.terms))
        yield Definition(name=angle.cosine, value=Call("cos", (total,)))
        yield Definition(name=angle.sine, value=Call("sin", (total,)))
