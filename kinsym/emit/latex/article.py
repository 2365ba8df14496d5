"""A body of LaTeX as a document of its own, or as a fragment of somebody else's.

Both need standard packages only. The same body gives the same bytes: no date, no path.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

from kinsym.emit.environment import Delimiters, environment

_DELIMITERS = Delimiters(block=("<%", "%>"), variable=("<<", ">>"), comment=("<#", "#>"))

Frame = Literal["article", "fragment", "chapter"]


@dataclass(frozen=True, kw_only=True)
class Levels:
    """The sectioning commands of a derivation, without their backslash."""

    section: str
    subsection: str


LEVELS: dict[Frame, Levels] = {
    "article": Levels(section="section", subsection="subsection*"),
    "fragment": Levels(section="subsection", subsection="subsubsection*"),
    "chapter": Levels(section="section", subsection="subsection*"),
}
"""A fragment is a section of the document it is put into, so that its own sections stand one level lower."""


def rendered(template: str, context: dict[str, Any]) -> str:
    """A template of ``templates/latex/``, filled in."""
    return environment(_DELIMITERS).get_template(f"latex/{template}.tex.j2").render(context)


def framed(frame: Frame, body: str, *, title: str, about: str, referring: bool = False) -> str:
    """A body between the preamble and the end of a document, or under a comment that names the packages it needs.

    ``title`` is LaTeX, ``about`` a sentence for the comment at the top; ``referring`` says that equations are referred
    to by their numbers, which TeX knows at its second run.
    """
    text = rendered(frame, {"body": body, "title": title, "about": about, "referring": referring})
    return re.sub(r"\n{3,}", "\n\n", re.sub(r" +\n", "\n", text))
