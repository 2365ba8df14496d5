"""A method of the lecture as LaTeX, for inclusion in a document that loads ``amsmath``.

Equations are labelled ``ROBOT:METHOD:NAME``, and sentences refer to them by that label.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import ClassVar

from kinsym.algebra.tree import Tree, symbols
from kinsym.emit.latex.formula import LatexPrinter, relation_sign
from kinsym.emit.latex.layout import PAGE, Relation, aligned
from kinsym.emit.latex.layout import Matrix as Laid
from kinsym.emit.latex.names import Names, pose
from kinsym.emit.latex.sentences import escape
from kinsym.emit.prose.methods import pieces
from kinsym.methods.document import INVERSE, TRANSPOSE, Equation, Factor, Matrix, MethodDerivation, Product, Sentence

_SUPERSCRIPT = {"": "", INVERSE: "^{-1}", TRANSPOSE: "^{T}"}
_FRAME = re.compile(r"([TRAP])_(\d+|[A-Z])_(\d+|[A-Z]\d*)")
_INSIDE = re.compile(r"([a-z]+)_in(\d+)(?:_([xyz]))?")
_VECTOR = re.compile(r"([A-Za-z]+)(\d*)_vec")
_WORD = re.compile(
    r"(?P<function>sin|cos|tan|abs|pi)\b|(?P<name>[A-Za-z][A-Za-z0-9_]*)|(?P<sign>!=|<=|>=)|(?P<other>.)"
)
_FUNCTIONS = {"sin": r"\sin ", "cos": r"\cos ", "tan": r"\tan ", "pi": r"\pi ", "abs": r"\operatorname{abs} "}


class MethodNames(Names):
    r"""Names of a method beside those of the program: matrices by their frames, vectors under an arrow.

    >>> names = MethodNames([])
    >>> names["T_0_1"], names["w_in3_x"], names["l1_vec"], names["P_0_O4"]
    ('{}^{0}T_{1}', '{}^{3}w_{x}', '\\vec{l}_{1}', '{}^{0}P_{O4}')
    """

    def __getitem__(self, name: str) -> str:
        if name in self:
            return super().__getitem__(name)
        if match := _FRAME.fullmatch(name):
            letter, left, right = match.groups()
            if letter == "T" and left.isdigit() and right.isdigit():
                return pose(int(left), int(right))
            return f"{{}}^{{{left}}}{letter}_{{{right}}}"
        if match := _VECTOR.fullmatch(name):
            word, index = match.groups()
            return f"\\vec{{{super().__getitem__(word)}}}" + (f"_{{{index}}}" if index else "")
        if match := _INSIDE.fullmatch(name):
            word, frame, row = match.groups()
            return f"{{}}^{{{frame}}}{word}" + (f"_{{{row}}}" if row else "")
        return super().__getitem__(name)


class MethodPrinter(LatexPrinter):
    """Formulas of a method: inverse functions under their usual names."""

    functions: ClassVar[Mapping[str, str]] = {
        **LatexPrinter.functions,
        "atan": "arctan",
        "acos": "arccos",
        "asin": "arcsin",
    }


def method_fragment(derivation: MethodDerivation) -> str:
    """The derivation under a heading, ready for ``\\input``."""
    return MethodFragment(derivation).text()


class MethodFragment:
    """A method as text with formulas; what LaTeX writes otherwise than Markdown are methods of their own."""

    def __init__(self, derivation: MethodDerivation) -> None:
        self._derivation = derivation
        used = (name for equation in derivation.equations for tree in _trees(equation) for name in symbols(tree))
        plain = [name for name in used if not (_INSIDE.fullmatch(name) or _VECTOR.fullmatch(name))]
        self._names = MethodNames(plain)
        self._formula = MethodPrinter(self._names)

    def text(self) -> str:
        """The page."""
        return "\n".join(self.parts()) + "\n"

    def parts(self) -> list[str]:
        """The heading, then sentences, blocks of equations and equations of matrices in order."""
        derivation = self._derivation
        parts = [self.heading(f"{self.words(derivation.title)}: {self.words(derivation.robot)}")]
        waiting: list[Equation] = []
        for passage in derivation.passages:
            if isinstance(passage, Equation) and not _is_matrix(passage):
                waiting.append(passage)
                continue
            parts += self._block(waiting)
            waiting = []
            parts.append(self._matrix(passage) if isinstance(passage, Equation) else self._sentence(passage))
        return [*parts, *self._block(waiting)]

    def heading(self, text: str) -> str:
        """The heading of the page."""
        return f"\\subsection*{{{text}}}"

    def words(self, text: str) -> str:
        """Words between formulas."""
        return escape(text)

    def reference(self, name: str) -> str:
        """An equation, in a sentence."""
        return f"\\eqref{{{self._label(name)}}}"

    def numbered(self, name: str) -> str:
        """What gives an equation its number, at its end."""
        return f" \\label{{{self._label(name)}}}"

    def _label(self, name: str) -> str:
        return f"{self._derivation.robot}:{self._derivation.method}:{name}"

    def _sentence(self, sentence: Sentence) -> str:
        text = ""
        for piece in pieces(sentence.text):
            if piece.kind == "reference":
                text += self.reference(piece.text)
            elif piece.kind == "math":
                text += f"${self._math(piece.text)}$"
            else:
                lead, tail = piece.text[:1].isspace(), piece.text[-1:].isspace()
                text += (" " if lead else "") + self.words(piece.text) + (" " if tail and piece.text.strip() else "")
        return text

    def _math(self, text: str) -> str:
        parts = []
        for token in _WORD.finditer(text):
            if token["function"]:
                parts.append(_FUNCTIONS[token["function"]])
            elif token["name"]:
                parts.append(self._names[token["name"]] + " ")
            else:
                parts.append(relation_sign(token["sign"]) + " " if token["sign"] else token["other"])
        return "".join(parts).strip()

    def _block(self, equations: list[Equation]) -> list[str]:
        """Equations of numbers, aligned; every one keeps its label."""
        result = []
        relations = [
            Relation(left=self._side(e.left), right=self._side(e.right), sign=relation_sign(e.sign)) for e in equations
        ]
        rest = iter(equations)
        for block in aligned(relations):
            lines = []
            for row in block:
                label = self.numbered(next(rest).name)
                lines += [f"  {line} \\notag \\\\" for line in row[:-1]]
                lines.append(f"  {row[-1]}{label} \\\\")
            lines[-1] = lines[-1].removesuffix(" \\\\")
            result.append("\n".join(["\\begin{align}", *lines, "\\end{align}"]))
        return result

    def _side(self, side: Tree | Matrix | Product) -> str:
        if isinstance(side, Product):
            return " \\, ".join(self._factor(factor) for factor in side.factors)
        return self._array(side) if isinstance(side, Matrix) else self._formula(side)

    def _factor(self, factor: Factor | Matrix) -> str:
        if isinstance(factor, Matrix):
            return self._array(factor)
        name = self._names[factor.name]
        mark = _SUPERSCRIPT[factor.mark]
        return f"\\bigl({name}\\bigr){mark}" if mark and name.startswith("{}^") else f"{name}{mark}"

    def _cells(self, matrix: Matrix) -> tuple[tuple[str, ...], ...]:
        return tuple(tuple(self._formula(cell) for cell in row) for row in matrix.rows)

    def _array(self, matrix: Matrix) -> str:
        rows = " \\\\ ".join(" & ".join(row) for row in self._cells(matrix))
        return f"\\begin{{bmatrix}} {rows} \\end{{bmatrix}}"

    def _matrix(self, equation: Equation) -> str:
        """An equation of matrices on a line of its own; entry by entry where it is too wide."""
        width = sum(self._width(side) for side in (equation.left, equation.right))
        label = self.numbered(equation.name)
        if width <= PAGE - 30.0 or not isinstance(equation.right, Matrix):
            text = f"{self._side(equation.left)} {relation_sign(equation.sign)} {self._side(equation.right)}"
            return f"\\begin{{equation}}\n  {text}{label}\n\\end{{equation}}"
        blocks = aligned(self._entries(equation, equation.right))
        lines = [line for block in blocks for row in block for line in row]
        body = [f"  {line} \\notag \\\\" for line in lines[:-1]]
        return "\n".join(["\\begin{align}", *body, f"  {lines[-1]}{label}", "\\end{align}"])

    def _entries(self, equation: Equation, right: Matrix) -> Iterator[Relation]:
        for i, row in enumerate(self._cells(right)):
            for j, cell in enumerate(row):
                if isinstance(equation.left, Matrix):
                    left = self._formula(equation.left.rows[i][j])
                else:
                    left = f"({self._side(equation.left)})_{{{i + 1},{j + 1}}}"
                yield Relation(left=left, right=cell)

    def _width(self, side: Tree | Matrix | Product) -> float:
        if isinstance(side, Product):
            return sum(self._width(f) if isinstance(f, Matrix) else 30.0 for f in side.factors)
        return Laid(name="", cells=self._cells(side)).width if isinstance(side, Matrix) else 20.0


def _trees(equation: Equation) -> Iterator[Tree]:
    for side in (equation.left, equation.right):
        for part in side.factors if isinstance(side, Product) else (side,):
            if isinstance(part, Matrix):
                yield from (cell for row in part.rows for cell in row)
            elif not isinstance(part, Factor):
                yield part


def _is_matrix(equation: Equation) -> bool:
    return any(isinstance(side, (Matrix, Product)) for side in (equation.left, equation.right))
