"""Names of the lecture's methods as a lecturer writes them, beside those of the program."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import ClassVar

from kinsym.emit.latex.formula import LatexPrinter, relation_sign
from kinsym.emit.latex.names import Names, pose

_ELEMENTARY = re.compile(r"([RD])_([XZ])_of_(\w+)")
_FRAME = re.compile(r"([TRAP])_(\d+|[A-Z])_(\d+|[A-Z]\d*)")
_NEIGHBOURS = re.compile(r"([TA])_(im1|i)_(i|ip1)")
_SUBSCRIPT = re.compile(r"([A-Za-z]+)_(i|im1|ip1)")
_STEPS = {"i": "i", "im1": "i-1", "ip1": "i+1"}
_INSIDE = re.compile(r"([a-z]+)_in(\d+)(?:_([xyz]))?")
_VECTOR = re.compile(r"([A-Za-z]+)(\d*)_vec")
_HOME = re.compile(r"(so|s0)_([xyz]|\d+)")
_WORD = re.compile(
    r"(?P<function>sin|cos|tan|abs|pi)\b|(?P<name>[A-Za-z][A-Za-z0-9_]*)|(?P<sign>!=|<=|>=)|(?P<other>.)"
)
_FUNCTIONS = {"sin": r"\sin ", "cos": r"\cos ", "tan": r"\tan ", "pi": r"\pi ", "abs": r"\operatorname{abs} "}


class MethodNames(Names):
    r"""Names of a method beside those of the program: matrices by their frames, vectors under an arrow.

    >>> names = MethodNames([])
    >>> names["T_0_1"], names["w_in3_x"], names["l1_vec"], names["P_0_O4"], names["alpha_im1"]
    ('{}^{0}T_{1}', '{}^{3}w_{x}', '\\vec{l}_{1}', '{}^{0}P_{O4}', '\\alpha_{i-1}')
    """

    def __getitem__(self, name: str) -> str:
        if match := _SUBSCRIPT.fullmatch(name):
            word, index = match.groups()
            return f"{super().__getitem__(word)}_{{{_STEPS[index]}}}"
        if name in self:
            return super().__getitem__(name)
        return self._of_a_method(name) or super().__getitem__(name)

    def _of_a_method(self, name: str) -> str:
        """A name that only methods have; empty for any other."""
        if match := _ELEMENTARY.fullmatch(name):
            return f"{match[1]}_{{{match[2]}}}({self[match[3]]})"
        if match := _FRAME.fullmatch(name):
            letter, left, right = match.groups()
            if letter == "T" and left.isdigit() and right.isdigit():
                return pose(int(left), int(right))
            return f"{{}}^{{{left}}}{letter}_{{{right}}}"
        if match := _NEIGHBOURS.fullmatch(name):
            letter, left, right = match.groups()
            return f"{{}}^{{{_STEPS[left]}}}{letter}_{{{_STEPS[right]}}}"
        if match := _VECTOR.fullmatch(name):
            word, index = match.groups()
            return f"\\vec{{{super().__getitem__(word)}}}" + (f"_{{{index}}}" if index else "")
        if match := _HOME.fullmatch(name):
            return f"s_{{0{match[2] if match[2].isdigit() else f',{match[2]}'}}}"
        if match := _INSIDE.fullmatch(name):
            word, frame, row = match.groups()
            return f"{{}}^{{{frame}}}{word}" + (f"_{{{row}}}" if row else "")
        return ""

    def mathematics(self, text: str) -> str:
        r"""A formula of a sentence.

        >>> MethodNames([]).mathematics("sin alpha1 != 0")
        '\\sin \\alpha_{1} \\ne 0'
        """
        parts = []
        for token in _WORD.finditer(text):
            if token["function"]:
                parts.append(_FUNCTIONS[token["function"]])
            elif token["name"]:
                parts.append(self[token["name"]] + " ")
            else:
                parts.append(relation_sign(token["sign"]) + " " if token["sign"] else token["other"])
        return re.sub(r" (?=[]()^,]|$)", "", re.sub(r" {2,}", " ", "".join(parts)))


def is_of_a_method(name: str) -> bool:
    """Whether a name has a meaning of its own, so that the table of plain names must not hold it."""
    return any(pattern.fullmatch(name) for pattern in (_INSIDE, _VECTOR, _HOME))


class MethodPrinter(LatexPrinter):
    """Formulas of a method: inverse functions under their usual names."""

    functions: ClassVar[Mapping[str, str]] = {
        **LatexPrinter.functions,
        "atan": "arctan",
        "acos": "arccos",
        "asin": "arcsin",
        "v": "v",
    }
