"""A method of the lecture as LaTeX: sentences, aligned equations, matrices side by side.

Equations are labelled ``ROBOT:METHOD:NAME``, and sentences refer to them by that label. Matrices that nobody refers to
share a line and its number, which has the label of the first of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby, takewhile
from types import MappingProxyType
from typing import Literal

from kinsym.algebra.tree import Num, Sym, Tree, symbols
from kinsym.emit.latex.formula import relation_sign
from kinsym.emit.latex.layout import PAGE, RELATION, Relation, aligned, bracketed_width
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.method_names import MethodNames, MethodPrinter, is_of_a_method
from kinsym.emit.latex.sentences import escape, wrapped
from kinsym.emit.prose.methods import pieces
from kinsym.methods.document import (
    INVERSE,
    TRANSPOSE,
    Equation,
    Factor,
    Matrix,
    MethodDerivation,
    Passage,
    Product,
    Sentence,
)

_SUPERSCRIPT = {"": "", INVERSE: "^{-1}", TRANSPOSE: "^{T}"}
#: What a line of matrices leaves for its number, and what stands between two of them.
_TAG, _BETWEEN = 34.0, 20.0
_MOST_BESIDE = 4
#: As many names for entries of a matrix as this list all of it.
_MANY_ENTRIES = 9
_NOTHING: Mapping[str, str] = MappingProxyType({})


#: What is to be said of an equation, given its label.
Remark = Callable[[str], str]


@dataclass(frozen=True)
class _Laid:
    """An equation with matrices: its text and how wide that is."""

    equation: Equation
    text: str
    width: float


class MethodPage:
    """What a derivation by a method says, in LaTeX.

    ``lecture`` has the lecture's own number of some equations, which is then printed beside ours; ``remarks`` what is
    to be said of some of them, before the next sentence; ``elsewhere`` labels of equations that this derivation refers
    to and does not hold.
    """

    def __init__(
        self,
        derivation: MethodDerivation,
        *,
        lecture: Mapping[str, str] = _NOTHING,
        remarks: Mapping[str, Remark] = MappingProxyType({}),
        elsewhere: Mapping[str, str] = _NOTHING,
    ) -> None:
        self.derivation = derivation
        used = (name for equation in derivation.equations for tree in _trees(equation) for name in symbols(tree))
        self.names = MethodNames(name for name in used if not is_of_a_method(name))
        self.formula = MethodPrinter(self.names)
        self._lecture, self._remarks, self._elsewhere = lecture, remarks, elsewhere
        self._first: dict[str, str] = {}
        self._conditions = {equation.name for equation in derivation.conditions}
        self._named = {
            equation.right: equation.left for equation in reversed(derivation.equations) if _names_an_entry(equation)
        }
        sentences = [passage for passage in derivation.passages if isinstance(passage, Sentence)]
        referred = {name for sentence in sentences for name in sentence.references}
        for solution in derivation.solutions:
            referred |= {equation.name for equation in (*solution.equations, *solution.conditions)}
        self._alone = referred | {*lecture}

    def label(self, name: str) -> str:
        """The label of an equation; in a line of matrices, once it is laid out, that of the first of them."""
        name = self._first.get(name, name)
        return self._elsewhere.get(name) or f"{self.derivation.robot}:{self.derivation.method}:{name}"

    def lines(self) -> list[str]:
        """The passages in order, without a heading."""
        parts: list[str] = []
        remarks: list[str] = []
        for kind, passages in groupby(self._passages(), key=_kind):
            found = list(passages)
            equations = [passage for passage in found if isinstance(passage, Equation)]
            if kind == "sentence":
                parts += remarks
                remarks = []
                parts += [self.sentence(passage) for passage in found if isinstance(passage, Sentence)]
            parts += self._matrices(equations) if kind == "matrix" else self._aligned(equations)
            remarks += [
                self._remarks[equation.name](self.label(equation.name))
                for equation in equations
                if equation.name in self._remarks
            ]
        return parts + remarks

    def _passages(self) -> Iterator[Passage]:
        """The passages without entries, one by one, of a matrix that has just been printed whole."""
        passages = self.derivation.passages
        at = 0
        while at < len(passages):
            passage = passages[at]
            yield passage
            at += 1
            if isinstance(passage, Equation) and isinstance(passage.right, Matrix):
                entries = list(takewhile(partial(_is_entry, passage.right), passages[at + 1 :]))
                names = {entry.name for entry in entries if isinstance(entry, Equation)}
                if len(names) >= _MANY_ENTRIES and self._fits(passage) and not self._alone & names:
                    self._first |= dict.fromkeys(names, passage.name)
                    at += 1 + len(entries)

    def _fits(self, equation: Equation) -> bool:
        return self._written(equation).width <= PAGE - _TAG

    def sentence(self, sentence: Sentence) -> str:
        """A sentence with its formulas and references, in lines of the source."""
        text = ""
        for piece in pieces(sentence.text):
            if piece.kind == "reference":
                text += self.reference(piece.text)
            elif piece.kind == "math":
                text += f"${self.names.mathematics(piece.text)}$"
            else:
                lead, tail = piece.text[:1].isspace(), piece.text[-1:].isspace()
                text += (" " if lead else "") + self.words(piece.text) + (" " if tail and piece.text.strip() else "")
        return wrapped(text)

    def words(self, text: str) -> str:
        """Words between formulas."""
        return escape(text)

    def reference(self, name: str) -> str:
        """An equation, in a sentence."""
        return f"\\eqref{{{self.label(name)}}}"

    def numbered(self, name: str) -> str:
        """The end of an equation: the lecture's number and the label."""
        number = f" \\lecture{{{self._lecture[name]}}}" if name in self._lecture else ""
        return f"{number} \\label{{{self.label(name)}}}"

    def _aligned(self, equations: Sequence[Equation]) -> Iterator[str]:
        """Formulas aligned at their relation, each with its number."""
        relations = []
        for equation in equations:
            condition = "\\text{for } " if equation.name in self._conditions else ""
            left, right = self._side(equation.left), self._side(equation.right)
            relations.append(Relation(left=condition + left, right=right, sign=relation_sign(equation.sign)))
        rest = iter(equations)
        for block in aligned(relations):
            lines = []
            for row in block:
                lines += [f"  {line} \\notag \\\\" for line in row[:-1]]
                lines.append(f"  {row[-1]}{self.numbered(next(rest).name)} \\\\")
            lines[-1] = lines[-1].removesuffix(" \\\\")
            yield "\n".join(["\\begin{align}", *lines, "\\end{align}"])

    def _matrices(self, equations: Sequence[Equation]) -> Iterator[str]:
        """Equations of matrices, side by side as far as they fit; a matrix that is too wide entry by entry."""
        line: list[_Laid] = []
        used = 0.0
        for equation in equations:
            laid = self._laid(equation)
            alone = equation.name in self._alone
            full = len(line) == _MOST_BESIDE or used + _BETWEEN + laid.width > PAGE - _TAG
            if line and (alone or full or line[-1].equation.name in self._alone):
                yield self._beside(line)
                line, used = [], 0.0
            if laid.width > PAGE - _TAG and isinstance(equation.right, Matrix):
                yield self._entries(equation, equation.right)
                continue
            used += laid.width + (_BETWEEN if line else 0.0)
            line.append(laid)
        if line:
            yield self._beside(line)

    def _beside(self, line: Sequence[_Laid]) -> str:
        self._first |= {laid.equation.name: line[0].equation.name for laid in line}
        text = " \\qquad\n  ".join(laid.text for laid in line)
        return f"\\begin{{equation}}\n  {text}{self.numbered(line[0].equation.name)}\n\\end{{equation}}"

    def _laid(self, equation: Equation) -> _Laid:
        laid = self._written(equation)
        if self._fits(equation) or not isinstance(equation.right, Matrix):
            return laid
        named = Matrix(tuple(tuple(self._entry(cell) for cell in row) for row in equation.right.rows))
        complete = all(isinstance(cell, (Sym, Num)) for row in named.rows for cell in row)
        shorter = Equation(
            number=equation.number, name=equation.name, left=equation.left, right=named, sign=equation.sign
        )
        return self._written(shorter) if complete else laid

    def _entry(self, cell: Tree) -> Tree:
        """An entry by the name under which it is stated."""
        named = self._named.get(cell, cell)
        return named if isinstance(named, Sym) else cell

    def _written(self, equation: Equation) -> _Laid:
        left, right = self._side(equation.left), self._side(equation.right)
        wide = RELATION + sum(self._width(side) for side in (equation.left, equation.right))
        return _Laid(equation, f"{left} {relation_sign(equation.sign)} {right}", wide)

    def _side(self, side: Tree | Matrix | Product) -> str:
        if isinstance(side, Product):
            return " \\, ".join(self._factor(factor) for factor in side.factors)
        return self._array(side) if isinstance(side, Matrix) else self.formula(side)

    def _factor(self, factor: Factor | Matrix) -> str:
        if isinstance(factor, Matrix):
            return self._array(factor)
        name = self.names[factor.name]
        mark = _SUPERSCRIPT[factor.mark]
        return f"\\bigl({name}\\bigr){mark}" if mark and name.startswith("{}^") else f"{name}{mark}"

    def _cells(self, matrix: Matrix) -> tuple[tuple[str, ...], ...]:
        return tuple(tuple(self.formula(cell) for cell in row) for row in matrix.rows)

    def _array(self, matrix: Matrix) -> str:
        rows = " \\\\ ".join(" & ".join(row) for row in self._cells(matrix))
        return f"\\begin{{bmatrix}} {rows} \\end{{bmatrix}}"

    def _width(self, side: Tree | Matrix | Product) -> float:
        if isinstance(side, Product):
            return sum(self._width(f) if isinstance(f, Matrix) else 2 + width(self._factor(f)) for f in side.factors)
        return bracketed_width(self._cells(side)) if isinstance(side, Matrix) else width(self.formula(side))

    def _entries(self, equation: Equation, right: Matrix) -> str:
        """A matrix that is too wide, entry by entry; rows and entries that are numbers are left out."""
        relations = []
        for i, row in enumerate(right.rows):
            for j, cell in enumerate(row):
                if isinstance(cell, Num):
                    continue
                if isinstance(equation.left, Matrix):
                    left = self.formula(equation.left.rows[i][j])
                else:
                    whole = self._side(equation.left)
                    left = f"{whole if whole.isalpha() else f'({whole})'}_{{{i + 1},{j + 1}}}"
                relations.append(Relation(left=left, right=self.formula(cell)))
        lines = [line for block in aligned(relations) for row in block for line in row]
        body = [f"  {line} \\notag \\\\" for line in lines[:-1]]
        return "\n".join(["\\begin{align}", *body, f"  {lines[-1]}{self.numbered(equation.name)}", "\\end{align}"])


def _trees(equation: Equation) -> Iterator[Tree]:
    for side in (equation.left, equation.right):
        for part in side.factors if isinstance(side, Product) else (side,):
            if isinstance(part, Matrix):
                yield from (cell for row in part.rows for cell in row)
            elif not isinstance(part, Factor):
                yield part


def _names_an_entry(equation: Equation) -> bool:
    """Whether an equation is ``name = formula``."""
    return equation.sign == "=" and isinstance(equation.left, Sym) and not isinstance(equation.right, (Matrix, Product))


def _kind(passage: Passage) -> Literal["sentence", "matrix", "formula"]:
    if isinstance(passage, Sentence):
        return "sentence"
    return "matrix" if _has_matrix(passage) else "formula"


def _is_entry(matrix: Matrix, passage: Passage) -> bool:
    """Whether a passage gives a name to an entry of a matrix."""
    return (
        isinstance(passage, Equation) and _names_an_entry(passage) and any(passage.right in row for row in matrix.rows)
    )


def _has_matrix(equation: Equation) -> bool:
    """Whether a matrix is written out in an equation."""
    return any(
        isinstance(part, Matrix)
        for side in (equation.left, equation.right)
        for part in (side.factors if isinstance(side, Product) else (side,))
    )
