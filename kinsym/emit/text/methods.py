"""A method of the lecture for a terminal: sentences, and equations under their numbers."""

from __future__ import annotations

from kinsym.emit.prose.breaking import TEXT, broken
from kinsym.emit.prose.methods import pieces
from kinsym.emit.text.page import Page
from kinsym.methods.document import Equation, Factor, Matrix, MethodDerivation, Product, Sentence, Side

_INDENT = 8
_CONTINUED = 4
"""How far the further lines of a long left side are moved in."""


def method_text(derivation: MethodDerivation, *, width: int = 80, ascii: bool = False) -> str:
    """The whole derivation; ``ascii`` writes ``+-`` for ``±``."""
    page = Page(width=width, ascii=ascii)
    title = f"{derivation.title}: {derivation.robot}"
    parts = [f"{title}\n{'=' * len(title)}"]
    numbers = {equation.name: equation.number for equation in derivation.equations}
    lines: list[str] = []
    for passage in derivation.passages:
        if isinstance(passage, Sentence):
            lines += ["", page.prose(_sentence(passage, numbers)), ""]
        else:
            lines.append(equation_text(passage, page))
    parts.append("\n".join(lines).strip("\n"))
    if derivation.solutions:
        parts.append(_solutions(derivation, page))
    return "\n\n".join(parts) + "\n"


def equation_text(equation: Equation, page: Page) -> str:
    """One equation, its number before it."""
    text = _matrices(equation, page) if _has_matrix(equation) else _plain(equation, page)
    number = f"  ({equation.number})"
    return number.ljust(_INDENT) + text[_INDENT:]


def _plain(equation: Equation, page: Page) -> str:
    left, right = _side(equation.left, page), _side(equation.right, page)
    rest = f" {equation.sign} {right}"
    if _INDENT + len(left) + len(rest) <= page.width:
        return f"{' ' * _INDENT}{left}{rest}"
    if len(left) <= page.width // 2:
        return page.equation(left, right, indent=_INDENT, relation=equation.sign)
    lines = broken(left, page.width - _INDENT - _CONTINUED, syntax=TEXT)
    shown = [
        f"{' ' * (_INDENT + (_CONTINUED + 2 * line.depth if k else 0))}{line.text}" for k, line in enumerate(lines)
    ]
    if len(shown[-1]) + len(rest) <= page.width:
        shown[-1] += rest
        return "\n".join(shown)
    return "\n".join([*shown, page.equation("", right, indent=_INDENT, relation=equation.sign)])


def _side(side: Side, page: Page) -> str:
    if isinstance(side, Product):
        return " ".join(_factor(factor) for factor in side.factors if isinstance(factor, Factor))
    if isinstance(side, Matrix):
        raise TypeError("a matrix is no line of text")
    return page.formula(side)


def _factor(factor: Factor) -> str:
    return f"{factor.name}^{factor.mark}" if factor.mark else factor.name


def _has_matrix(equation: Equation) -> bool:
    return any(
        isinstance(side, Matrix) or (isinstance(side, Product) and any(isinstance(f, Matrix) for f in side.factors))
        for side in (equation.left, equation.right)
    )


def _matrices(equation: Equation, page: Page) -> str:
    """Sides that hold matrices, set beside each other; entry by entry where they are too wide."""
    blocks: list[list[str]] = []
    for side in (equation.left, equation.right):
        factors = side.factors if isinstance(side, Product) else (side,)
        for factor in factors:
            if isinstance(factor, Matrix):
                rows = [[page.formula(cell) for cell in row] for row in factor.rows]
                blocks.append([f"[ {line} ]" for line in _columns(rows)])
            else:
                blocks.append([_factor(factor) if isinstance(factor, Factor) else page.formula(factor)])
        if side is equation.left:
            blocks.append([equation.sign])
    height = max(map(len, blocks))
    lines = []
    for k in range(height):
        cells = [block[k] if k < len(block) else "" for block in blocks]
        widths = [max(map(len, block)) for block in blocks]
        lines.append(" ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip())
    if max(map(len, lines)) + _INDENT > page.width and isinstance(equation.right, Matrix):
        return _entries(equation, page)
    return "\n".join(" " * _INDENT + line for line in lines)


def _columns(rows: list[list[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]


def _entries(equation: Equation, page: Page) -> str:
    """A matrix that is too wide, entry by entry."""
    if not isinstance(equation.right, Matrix):
        raise TypeError("only a matrix has entries")
    lines = []
    for i, row in enumerate(equation.right.rows, start=1):
        for j, cell in enumerate(row, start=1):
            if isinstance(equation.left, Matrix):
                name = page.formula(equation.left.rows[i - 1][j - 1])
            else:
                name = f"({_side(equation.left, page)})[{i},{j}]"
            lines.append(page.equation(name, cell, indent=_INDENT, relation=equation.sign))
    return "\n".join(lines)


def _sentence(sentence: Sentence, numbers: dict[str, int]) -> str:
    return "".join(
        f"({numbers[piece.text]})" if piece.kind == "reference" else piece.text for piece in pieces(sentence.text)
    )


def _solutions(derivation: MethodDerivation, page: Page) -> str:
    rows = [("unknown", "equation", "values at most", "if")]
    for solution in derivation.solutions:
        conditions = ", ".join(f"({condition.number})" for condition in solution.conditions)
        equations = ", ".join(f"({equation.number})" for equation in solution.equations)
        rows.append((solution.unknown, equations, str(solution.branches), conditions))
    return f"Solutions\n---------\n{page.columns(rows)}"
