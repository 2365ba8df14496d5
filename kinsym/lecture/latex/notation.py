"""The lecture's notation as LaTeX, with the brackets and fractions of kinsym's own formulas."""

from __future__ import annotations

import re
from fractions import Fraction

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.emit.latex.formula import relation_sign
from kinsym.emit.latex.layout import bracketed_width
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.method_names import MethodNames, MethodPrinter
from kinsym.emit.latex.sentences import escape
from kinsym.lecture.notation import (
    Apply,
    Binary,
    Grid,
    Name,
    Negative,
    Node,
    NotationError,
    Number,
    Part,
    Power,
    parse,
)
from kinsym.lecture.told import parts_of

_FRAMED = re.compile(r"([TARPd])_(\d+|[A-Z]|i|im1)_([A-Za-z0-9]+)")
_SCREW = re.compile(r"([a-z])0_i")
_AT = re.compile(r"(\w+)_at_([a-z]+)(\d)_(\d)")
_VECTOR = re.compile(r"(\w+)_vec")
_STEPS = {"im1": "i-1", "ip1": "i+1"}
_LIST = re.compile(r"\[[^]]*\]")
_RELATION = re.compile(r" (=|!=|<=|>=|<|>) ")
_ONE = Number(Fraction(1))
_SCALAR = {"sin": "sin", "cos": "cos", "tan": "tan", "asin": "asin", "acos": "acos", "atan": "atan", "atan2": "atan2"}
_SCALAR |= {"sqrt": "sqrt", "abs": "abs", "v": "v"}
_TRANSFORMS = {
    name: f"{letter}_{{{axis}}}"
    for name, letter, axis in (("R_X", "R", "X"), ("R_Y", "R", "Y"), ("R_Z", "R", "Z"), ("D_X", "D", "X"))
} | {"D_Z": "D_{Z}", "Screw_X": r"\operatorname{Screw}_{X}", "Screw_Z": r"\operatorname{Screw}_{Z}"}


class LectureNames(MethodNames):
    r"""The lecture's names, and pieces of LaTeX that the printer of formulas takes for names.

    >>> names = LectureNames([])
    >>> names["T_im1_R"], names["x_E_vec"], names["Theta_E"], names["R_phi_theta_psi"]
    ('{}^{i-1}T_{R}', '\\vec{x}_{E}', '\\Theta_{E}', 'R_{\\phi, \\theta, \\psi}')
    """

    def atom(self, latex: str) -> Sym:
        """A piece of LaTeX as a symbol."""
        self._latex[latex] = latex
        return Sym(latex)

    def __getitem__(self, name: str) -> str:
        if name in self:
            return self._latex[name]
        if match := _AT.fullmatch(name):
            inner, word, digit, value = match.groups()
            return f"{self[inner]}\\big|_{{{self[word + digit]}={value}}}"
        if match := _VECTOR.fullmatch(name):
            head, _, tail = match[1].partition("_")
            letter, digits = re.fullmatch(r"([A-Za-z]+)(\d*)", head).groups()  # type: ignore[union-attr]
            index = tail or digits
            return f"\\vec{{{self[letter]}}}" + (f"_{{{index}}}" if index else "")
        if match := _FRAMED.fullmatch(name):
            letter, left, right = match.groups()
            return f"{{}}^{{{self._index(left)}}}{letter}_{{{self._index(right)}}}"
        if match := _SCREW.fullmatch(name):
            return f"{match[1]}_{{0i}}"
        head, *indices = name.split("_")
        if len(indices) > 1 and not re.search(r"in\d", name):
            return f"{self[head]}_{{{', '.join(map(self._index, indices))}}}"
        return super().__getitem__(name)

    def _index(self, text: str) -> str:
        if match := re.fullmatch(r"([A-Z])(\d)", text):
            return f"{match[1]}_{{{match[2]}}}"
        return _STEPS.get(text, text if len(text) == 1 or text.isdigit() else self[text])


class LecturePrinter:
    r"""Prints formulas of the lecture.

    >>> from kinsym.lecture.notation import parse
    >>> LecturePrinter()(parse("inv(T_0_1)*T_0_6"))
    '\\bigl({}^{0}T_{1}\\bigr)^{-1} \\, {}^{0}T_{6}'
    """

    def __init__(self) -> None:
        self.names = LectureNames([])
        self.printer = MethodPrinter(self.names)

    def __call__(self, node: Node) -> str:
        if isinstance(node, Grid) and len(node.rows) > 1 and len(node.rows[0]) == 1 and node.rows[-1] != (_ONE,):
            return f"\\bigl({', '.join(self(row[0]) for row in node.rows)}\\bigr)^{{T}}"
        if isinstance(node, Grid):
            rows = " \\\\ ".join(" & ".join(map(self, row)) for row in node.rows)
            return f"\\begin{{bmatrix}} {rows} \\end{{bmatrix}}"
        return self.printer(self._tree(node))

    def factors(self, node: Node) -> list[tuple[str, float]]:
        """The factors of a product of matrices, each with its width in points; anything else is one factor."""
        if isinstance(node, Binary) and node.operator == "*":
            return [*self.factors(node.left), *self.factors(node.right)]
        text = self(node)
        if isinstance(node, Grid) and "bmatrix" in text:
            return [(text, bracketed_width([[self(cell) for cell in row] for row in node.rows]))]
        return [(text, width(text))]

    def told(self, text: str) -> str:
        r"""A sentence with its formulas.

        >>> LecturePrinter().told("50 % of `s1 != 0`")
        '50 \\% of $s_{1} \\ne 0$'
        """
        result = ""
        for is_formula, part in parts_of(text):
            if is_formula:
                result += f"${self._formula(part)}$"
            else:
                lead, tail = part[:1].isspace(), part[-1:].isspace()
                result += (" " if lead else "") + escape(part) + (" " if tail and part.strip() else "")
        return result

    def _formula(self, text: str) -> str:
        """A formula of a sentence: members and relations, or letters that are no formula of the notation."""
        pieces = _RELATION.split(text)
        try:
            members = [self(parse(piece)) for piece in pieces[::2]]
        except NotationError:
            text = self.names.mathematics(text).replace("...", r"\cdots")
            return _LIST.sub(lambda row: row[0].replace(" ", r" \; "), text)
        signs = [relation_sign(sign) for sign in pieces[1::2]]
        return " ".join(part for pair in zip(members, [*signs, ""], strict=True) for part in pair if part)

    def _tree(self, node: Node) -> Tree:
        match node:
            case Number(value):
                return Num(value)
            case Name("pm"):
                return self.names.atom(r"\pm")
            case Name("pi"):
                return Pi()
            case Name(name):
                return Sym(name)
            case Negative(body):
                return _minus(self._tree(body))
            case Power(base, exponent):
                return Pow(self._tree(base), exponent)
            case Binary("+", left, Binary("*", Name("pm"), right)):
                return PlusMinus(self._tree(left), self._tree(right))
            case Binary(operator, left, right):
                return _joined(operator, self._tree(left), self._tree(right))
            case Apply(function, arguments) if function in _SCALAR:
                return Call(_SCALAR[function], tuple(map(self._tree, arguments)))
            case _:
                return self.names.atom(self._written(node))

    def _written(self, node: Node) -> str:
        """What has no tree: matrices, their parts, and functions of them."""
        match node:
            case Grid():
                return self(node)
            case Part(base, row, column):
                index = f"{row + 1}," if isinstance(row, int) else ""
                return f"\\bigl({self(base)}\\bigr)_{{{index}{column + 1}}}"
            case Apply("inv" | "transpose" as function, (matrix,)):
                mark = "{-1}" if function == "inv" else "{T}"
                name = self(matrix)
                return f"{name}^{mark}" if re.fullmatch(r"[A-Z](_\{\w+\})?", name) else f"\\bigl({name}\\bigr)^{mark}"
            case Apply("hom", (vector,)):
                return f"\\begin{{bmatrix}} {self(vector)} \\\\ 1 \\end{{bmatrix}}"
            case Apply("block", (rotation, moved)):
                return f"\\begin{{bmatrix}} {self(rotation)} & {self(moved)} \\\\ 0 & 1 \\end{{bmatrix}}"
            case Apply("deg", (Number(value),)):
                return f"{value}^{{\\circ}}"
            case Apply("dot", (left, right)):
                one, other = (f"({self(part)})" if isinstance(part, Binary) else self(part) for part in (left, right))
                return f"{one} \\cdot {other}"
            case Apply("frame_angle", (first, second, about)):
                return f"\\angle({self(first)}, {self(second)}) \\text{{ about }} {self(about)}"
            case Apply("vec", parts):
                rows = " \\\\ ".join(map(self, parts))
                return f"\\begin{{bmatrix}} {rows} \\end{{bmatrix}}"
            case Apply(function, arguments) if function in _TRANSFORMS:
                return f"{_TRANSFORMS[function]}({', '.join(map(self, arguments))})"
        raise NotationError(f"{node!r} has no printed form.")


def _minus(tree: Tree) -> Tree:
    return Num(-tree.value) if isinstance(tree, Num) else Prod((Num(Fraction(-1)), *_factors(tree)))


def _factors(tree: Tree) -> tuple[Tree, ...]:
    return tree.factors if isinstance(tree, Prod) else (tree,)


def _terms(tree: Tree) -> tuple[Tree, ...]:
    return tree.terms if isinstance(tree, Sum) else (tree,)


def _joined(operator: str, left: Tree, right: Tree) -> Tree:
    """Both sides as they are written, no number moved and nothing multiplied out."""
    match operator:
        case "+":
            return Sum((*_terms(left), *_terms(right)))
        case "-":
            return Sum((*_terms(left), _minus(right)))
        case "*":
            return Prod((*_factors(left), *_factors(right)))
        case _:
            return Quot(left, right)
