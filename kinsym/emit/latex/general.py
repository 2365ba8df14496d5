"""The inverse kinematics of an arm without a closed form, as passages of the LaTeX document."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.emit.latex.layout import Block, Relation, aligned
from kinsym.emit.latex.names import Names
from kinsym.emit.latex.sentences import capital, prose
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


def general_passages(derivation: Derivation, plan: GeneralPlan, names: Names) -> tuple[Passage, ...]:
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
                pieces.append(Piece(text=capital(prose(piece, names))))
        unknowns = ", ".join(names[name] for name in stage.unknowns)
        title = stage.title if unknowns else capital(stage.title)
        result.append(Passage(number=number, unknowns=unknowns, title=title, pieces=tuple(pieces)))
    return tuple(result)
