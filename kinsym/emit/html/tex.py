r"""The little TeX of kinsym's own names and of the general solver's formulas, read into MathML.

Names are set as in the LaTeX document (:mod:`kinsym.emit.latex.names`), so that both show the same letters. What is
read here was written by kinsym: letters, digits, signs, ``_``, ``^``, groups, Greek letters, functions, ``bmatrix``.
"""

from __future__ import annotations

import re
from html import escape

from kinsym.emit.html.mathml import Row, fence, grouped, identifier, matrix, number, operator

_TOKEN = re.compile(r"\\[A-Za-z]+\*?|\\.|[0-9]+(?:\.[0-9]+)?|\s+|.")
_GREEK = dict(
    zip(
        """alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi
        omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega""".split(),
        "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩ",
        strict=True,
    )
)
_FUNCTIONS = frozenset("sin cos tan arctan det".split())
_SIGNS = {"cdot": "·", "times": "×", "pm": "±", "le": "≤", "ge": "≥", "ne": "≠", "sum": "∑", "lbrace": "{"}
_SPACES = {",": "0.17em", ";": "0.28em", "quad": "1em", "qquad": "2em", " ": "0.25em"}
_IGNORED = frozenset("bigl bigr Bigl Bigr".split())
_BREAKS_AT = frozenset((r"\quad", r"\qquad"))


def mathml(tex: str) -> Row:
    r"""A formula; a line may end after ``\quad``.

    >>> mathml(r"\theta_{23}")
    ('<msub><mi>θ</mi><mn>23</mn></msub>',)
    """
    return tuple("".join(piece) for piece in _Reader(_TOKEN.findall(tex)).pieces())


class _Reader:
    """Reads tokens from left to right."""

    def __init__(self, tokens: list[str]) -> None:
        self._tokens, self._at, self._depth = tokens, 0, 0

    def pieces(self) -> list[list[str]]:
        """The whole formula."""
        result: list[list[str]] = [[]]
        while self._at < len(self._tokens):
            wide = self._tokens[self._at] in _BREAKS_AT
            result[-1].append(self._scripted())
            if wide:
                result.append([])
        return result

    def _until(self, *ends: str) -> list[str]:
        """The items up to one of the tokens ``ends``, which is taken as well."""
        items: list[str] = []
        while self._tokens[self._at] not in ends:
            items.append(self._scripted())
        self._at += 1
        return items

    def _scripted(self) -> str:
        """An item with its subscript and superscript; an empty group carries the left superscript of what follows."""
        base = self._item()
        scripts: dict[str, str] = {}
        while self._at < len(self._tokens) and self._tokens[self._at] in ("_", "^"):
            place = self._tokens[self._at]
            self._at += 1
            self._depth += 1
            scripts[place] = self._item()
            self._depth -= 1
        return _with_scripts(base, scripts.get("_"), scripts.get("^"))

    def _item(self) -> str:
        token = self._tokens[self._at]
        self._at += 1
        if token == "{":
            items = self._until("}")
            return "".join(items) if len(items) < 2 else grouped(tuple(items))
        if token[0] == "\\":
            return self._command(token[1:])
        if token[0].isdigit():
            return number(token)
        if token.isspace():
            return ""
        if token.isalpha():
            return identifier(token)
        if token in "()[]":
            return fence(token)
        if token == "'":
            return "<mo>′</mo>"
        sign = "−" if token == "-" else token
        if self._depth:  # signs of an index stand close together
            return f'<mo lspace="0" rspace="0">{escape(sign)}</mo>'
        return operator(sign, "postfix" if token in ",." else "infix")

    def _command(self, name: str) -> str:
        if name in _GREEK:
            return identifier(_GREEK[name])
        if name in _SPACES:
            return f'<mspace width="{_SPACES[name]}"></mspace>'
        if name in _SIGNS:
            return operator(_SIGNS[name])
        if name in _FUNCTIONS:
            return f'{identifier(name)}<mspace width="0.17em"></mspace>'
        if name in _IGNORED:
            return self._item()
        if name in ("mathrm", "operatorname"):
            return identifier(self._word(), upright=True)
        if name == "begin":
            self._word()
            return self._matrix()
        if name == "_":
            return identifier("_", upright=True)
        raise ValueError(f"\\{name} is not among the TeX that kinsym writes")

    def _word(self) -> str:
        """The letters of a group."""
        start = self._at + 1
        self._at = self._tokens.index("}", start) + 1
        return "".join(self._tokens[start : self._at - 1]).replace("\\_", "_")

    def _matrix(self) -> str:
        """Cells up to the end of the environment."""
        rows: list[list[str]] = [[]]
        cell: list[str] = []
        while True:
            token = self._tokens[self._at]
            if token not in ("&", "\\\\", "\\end"):
                cell.append(self._scripted())
                continue
            self._at += 1
            rows[-1].append("".join(cell))
            cell = []
            if token == "\\\\":
                rows.append([])
            elif token == "\\end":
                self._word()
                return matrix(rows)


def _with_scripts(base: str, below: str | None, above: str | None) -> str:
    if below is None and above is None:
        return base
    base = base or "<mrow></mrow>"
    if below is not None and above is not None:
        return f"<msubsup>{base}{below}{above}</msubsup>"
    if below is not None:
        return f"<msub>{base}{below}</msub>"
    return f"<msup>{base}{above}</msup>"
