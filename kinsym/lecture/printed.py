"""What kinsym prints for a name of the lecture, as shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

from kinsym.kinematics.chain import Chain
from kinsym.kinematics.elementary import FACTORS, SCREWS, elementary
from kinsym.lecture.chapter import Chapter
from kinsym.lecture.frames import Frames
from kinsym.lecture.notation import Apply, Binary, Grid, Name, Negative, Node, Part
from kinsym.lecture.shape import (
    NameOf,
    NoShape,
    Shape,
    circular,
    lecture_names,
    minus,
    name,
    number,
    shape_of_node,
    shape_of_tree,
    total,
)
from kinsym.lecture.system import Derived, System

Shapes = tuple[tuple[Shape, ...], ...]


def chain_names(chain: Chain) -> NameOf:
    """The names of a chain's ring: cosines and sines of sums of joint angles and of twists, everything else itself."""
    known: dict[str, Shape] = {}
    for angle in chain.angles.values():
        known[angle.cosine], known[angle.sine] = circular("cos", angle.terms), circular("sin", angle.terms)
    for cell, label in chain.constants.angles.items():
        known["c" + label], known["s" + label] = (circular(f, [(str(cell), 1)]) for f in ("cos", "sin"))
    return lambda text: known.get(text, name(text))


@dataclass(frozen=True)
class Printed:
    """The shapes of kinsym's output for a chapter."""

    chapter: Chapter
    system: System

    def find(self, node: Node) -> Shapes | None:
        """What kinsym prints for a formula that names a quantity it derives, else None; a number is one cell."""
        match node:
            case Name(text) if text in self.chapter.names:
                return self.find(self.chapter.names[text])
            case Name(text):
                return self._named(text)
            case Part(base, row, column):
                return self._part(self.find(base), row, column)
            case Negative(body):
                found = self.find(body)
                return None if found is None else tuple(tuple(map(minus, row)) for row in found)
            case Apply("rot", (matrix,)):
                found = self.find(matrix)
                return None if found is None else tuple(row[:3] for row in found[:3])
            case Apply("hom", (vector,)):
                found = self.find(vector)
                return None if found is None else (*found, (number(1),))
            case Apply("inv", (matrix,)):
                return self._inverse(matrix)
            case Apply("x_angle", (matrix,)):
                return _angle(self.find(matrix))
            case Binary("*", _, _):
                return self._product(node)
            case _:
                return None

    def written(self, node: Node, aliases: Mapping[str, str] = MappingProxyType({})) -> Shapes | None:
        """The shapes of a formula or matrix that the lecture writes out; None where it only names matrices.

        ``aliases`` says what kinsym calls some of its symbols.
        """
        names = lecture_names(self.chapter.shorthand, aliases)
        node = self._spelled(node)
        try:
            if isinstance(node, Grid):
                return tuple(tuple(shape_of_node(cell, names) for cell in row) for row in node.rows)
            return ((shape_of_node(node, names),),)
        except NoShape:
            return None

    def _spelled(self, node: Node) -> Node:
        """A formula with the name of the end frame's angle replaced by the sum of joint angles that it stands for."""
        match node:
            case Apply("cos" | "sin" as function, (Name(text),)) if text in self.chapter.names:
                found = self.find(Name(text))
                return node if found is None else Apply(function, (_sum_of(found[0][0]),))
            case Negative(body):
                return Negative(self._spelled(body))
            case Grid(rows):
                return Grid(tuple(tuple(map(self._spelled, row)) for row in rows))
            case _:
                return node

    def links_of(self, node: Node) -> tuple[int, ...] | None:
        """The rows of the table whose links a product of names stands for."""
        match node:
            case Name(text) if text in self.chapter.names:
                return self.links_of(self.chapter.names[text])
            case Name(text):
                named = Frames.of(self.chapter, self.system).find(text)
                return None if named is None or named.part not in (None, "R") else named.derived.links
            case Binary("*", left, right):
                before, after = self.links_of(left), self.links_of(right)
                return None if before is None or after is None else before + after
            case _:
                return None

    def _named(self, text: str) -> Shapes | None:
        named = Frames.of(self.chapter, self.system).find(text)
        if named is None:
            return None
        cells = shapes(named.derived)
        if named.part == "R":
            return tuple(row[:3] for row in cells[:3])
        return cells if named.part is None else tuple((row[int(named.part)],) for row in cells[:3])

    def _part(self, found: Shapes | None, row: int | str, column: int) -> Shapes | None:
        if found is None:
            return None
        if isinstance(row, int):
            return ((found[row][column],),)
        rows = found if row == ":" else found[:3]
        return tuple((line[column],) for line in rows)

    def _inverse(self, matrix: Node) -> Shapes | None:
        links = self.links_of(matrix)
        if links is None or not _consecutive(links):
            return None
        return shapes(self.system.inverse(links[0] - 1, links[-1]))

    def _product(self, node: Node) -> Shapes | None:
        """A product of neighbouring links; of rotations the rotation."""
        links = self.links_of(node)
        if links is None or not _consecutive(links):
            return None
        cells = shapes(self.system.part(links[0] - 1, links[-1]))
        return tuple(row[:3] for row in cells[:3]) if _first(node).startswith("R") else cells


def shapes(derived: Derived) -> Shapes:
    """A printed matrix as shapes."""
    if derived.general is not None:
        return tuple(tuple(shape_of_tree(cell, name) for cell in row) for row in derived.general)
    names = chain_names(derived.chain)
    return tuple(tuple(shape_of_tree(cell, names) for cell in row) for row in derived.matrix)


def row_names(system: System, number: int) -> tuple[tuple[tuple[str, ...], ...], ...]:
    """A row's link as a product of four and of two elementary transforms, by their names and cells."""
    convention, joint = system.robot.convention, system.robot.joints[number - 1]
    if system.screws:
        return ()
    cells = {"alpha": str(joint.alpha), "a": str(joint.a), "d": str(joint.d), "theta": str(joint.theta)}
    four = tuple((transform, cells[cell]) for transform, cell in FACTORS[convention])
    two = tuple((transform, cells[length], cells[angle]) for transform, length, angle in SCREWS[convention])
    return four, two


def row_factors(system: System, number: int) -> tuple[tuple[Shapes, ...], ...]:
    """The same as matrices."""
    return tuple(tuple(_matrix(*factor) for factor in way) for way in row_names(system, number))


def _matrix(transform: str, *cells: str) -> Shapes:
    if len(cells) == 2:
        found = elementary(transform, length=cells[0], angle=cells[1])
    else:
        found = elementary(transform, **{"angle" if transform[0] == "R" else "length": cells[0]})
    return tuple(tuple(shape_of_tree(cell, name) for cell in row) for row in found)


def _consecutive(links: Sequence[int]) -> bool:
    return bool(links) and all(after == before + 1 for before, after in pairwise(links))


def _first(node: Node) -> str:
    while isinstance(node, Binary):
        node = node.left
    return node.name if isinstance(node, Name) else ""


def _sum_of(shape: Shape) -> Node:
    """A sum of angles as a formula."""
    sign, key = shape
    terms = key[1] if key[0] == "sum" else ((1, key),)
    assert isinstance(terms, tuple)
    node: Node | None = None
    for inner, (_, text) in terms:
        term: Node = Name(text) if sign * inner > 0 else Negative(Name(text))
        node = term if node is None else Binary("+", node, term)
    assert node is not None
    return node


def _angle(found: Shapes | None) -> Shapes | None:
    """The sum of angles whose cosine and sine head the first column."""
    if found is None:
        return None
    (_, cosine), (_, sine) = found[0][0], found[1][0]
    if cosine[0] != "cos" or sine[0] != "sin" or cosine[1] != sine[1]:
        return None
    terms = cosine[1]
    assert isinstance(terms, tuple)
    parts = [name(text) if count > 0 else minus(name(text)) for text, count in terms]
    return ((total(parts),),)
