"""The inverse kinematics of an arm without a closed form, as passages of the LaTeX document."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.emit.latex.layout import Block, Relation, aligned
from kinsym.emit.latex.names import Names
from kinsym.emit.latex.sentences import Words, capital, escape
from kinsym.emit.prose.general import Formula, stages
from kinsym.general.plan import GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


@dataclass(frozen=True, kw_only=True)
class Piece:
    """A sentence, or formulas set apart."""

    text: str = ""
    blocks: tuple[Block, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Passage:
    """One step: what it is about as mathematics, its title and its pieces."""

    number: int
    unknowns: str
    title: str
    pieces: tuple[Piece, ...]


def general_passages(
    derivation: Derivation, plan: GeneralPlan, names: Names, words: Words = escape
) -> tuple[Passage, ...]:
    """The steps in order; formulas that follow each other stand together."""
    result = []
    for number, stage in enumerate(stages(derivation, plan, names.__getitem__), start=1):
        pieces: list[Piece] = []
        pending: list[Relation] = []
        for piece in (*stage.body, ""):
            if isinstance(piece, Formula):
                left, right = piece.tex
                pending.append(Relation(left=left, right=right))
                continue
            if pending:
                pieces.append(Piece(blocks=aligned(pending)))
                pending = []
            if piece:
                pieces.append(Piece(text=capital(_sentence(piece, names, words))))
        unknowns = ", ".join(names[name] for name in stage.unknowns)
        result.append(Passage(number=number, unknowns=unknowns, title=stage.title, pieces=tuple(pieces)))
    return tuple(result)


_WORDS = {
    "psi0": r"\psi_{0}",
    "psi": r"\psi",
    "phi": r"\phi",
    "mu": r"\mu",
    "nu": r"\nu",
    "x": r"\times",
    "Mi": "M_{i}",
    "Li": "L_{i}",
    "L5": "L_{5}",
    "L6": "L_{6}",
    "Rk": "R_{k}",
    "Ak": "A_{k}",
    "rho": r"\rho",
    **{f"{letter}{k}": f"{letter}_{{{k}}}" for letter in "ARk" for k in range(1, 5)},
    "1e-10": "10^{-10}",
    "1e-9": "10^{-9}",
}


def _sentence(text: str, names: Names, words: Words = escape) -> str:
    r"""A sentence with the mathematics in its braces.

    >>> _sentence("{R nu = P_1 mu} gives {nu} at 100 %", Names([]))
    '$R \\nu = P_{1} \\mu$ gives $\\nu$ at 100 \\%'
    """
    parts = re.split(r"\{(.*?)\}", text)
    return "".join(f"${_formula(part, names)}$" if k % 2 else _spaced(part, words) for k, part in enumerate(parts))


def _formula(text: str, names: Names) -> str:
    def token(match: re.Match[str]) -> str:
        word = match[0]
        return _WORDS.get(word) or _named(word, names)

    return re.sub(r"[A-Za-z0-9_-]+", token, text)


def _named(word: str, names: Names) -> str:
    """A name as mathematics, any other word as it stands."""
    try:
        return names[word]
    except KeyError:
        return word


def _spaced(text: str, words: Words) -> str:
    """Escaped text that keeps the blanks at its ends."""
    lead, tail = text[: len(text) - len(text.lstrip())], text[len(text.rstrip()) :]
    return f"{lead}{words(text)}{tail if text.strip() else ''}"
