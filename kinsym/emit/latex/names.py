"""Names of the program as a lecturer writes them: theta23, c12m4, p16_x, kappa1, offset_x.

The lecture puts the frame as a left superscript (its ^3w_x); a name of several letters is set upright. Two names of
one robot never look alike: where they would (a1 and a_1), the second is written out as it stands in the table.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

_GREEK = frozenset(
    """alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi
    omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega""".split()
)
_WINDOW = re.compile(r"([uvwp])(\d)(\d+)_([xyz])")
_AXIS = re.compile(r"([zo])(E|\d+)_([xyz])")
_NUMBERED = re.compile(r"([A-Za-z]+?)_?(\d+(?:[m_]\d+)*)")
_INDEXED = re.compile(r"([A-Za-z]+)_([A-Za-z0-9]+)")
_TURN = re.compile(r"([cs])(alpha|theta|beta|gamma|delta|phi|psi)(\d*)")


def _word(word: str) -> str:
    """One part of a name: a Greek letter, a letter, or a word set upright."""
    if word in _GREEK:
        return f"\\{word}"
    if len(word) == 1:
        return word
    return f"\\mathrm{{{word}}}"


def _plain(name: str) -> str:
    r"""The usual LaTeX of a name.

    >>> [_plain(name) for name in ("theta23", "c12m4", "p16_x", "u_x", "L_arm", "calpha1")]
    ['\\theta_{23}', 'c_{12-4}', '{}^{1}p_{6,x}', 'u_{x}', 'L_{\\mathrm{arm}}', 'c\\alpha_{1}']
    """
    if match := _WINDOW.fullmatch(name):
        letter, left, right, axis = match.groups()
        return f"{{}}^{{{left}}}{letter}_{{{right},{axis}}}"
    if match := _AXIS.fullmatch(name):
        letter, joint, axis = match.groups()
        return f"{letter}_{{{joint},{axis}}}"
    if match := _TURN.fullmatch(name):
        letter, greek, digits = match.groups()
        return f"{letter}\\{greek}" + (f"_{{{digits}}}" if digits else "")
    if match := _NUMBERED.fullmatch(name):
        word, label = match.groups()
        return f"{_word(word)}_{{{label.replace('m', '-').replace('_', ',')}}}"
    if match := _INDEXED.fullmatch(name):
        word, index = match.groups()
        return f"{_word(word)}_{{{index if index.isdigit() else _word(index)}}}"
    if re.fullmatch(r"[A-Za-z]+", name):
        return _word(name)
    return _literal(name)


def _literal(name: str) -> str:
    """A name as it stands in the table."""
    safe = re.sub(r"[^A-Za-z0-9_]", "?", name)
    return "\\mathrm{" + safe.replace("_", "\\_") + "}"


class Names:
    r"""The LaTeX of every name of one document.

    >>> names = Names(["a1", "a_1"])
    >>> names["a1"], names["a_1"]
    ('a_{1}', '\\mathrm{a\\_1}')
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._latex: dict[str, str] = {}
        taken: set[str] = set()
        for name in names:
            if name not in self._latex:
                latex = _plain(name)
                self._latex[name] = _literal(name) if latex in taken else latex
                taken.add(latex)

    def __contains__(self, name: str) -> bool:
        return name in self._latex

    def __getitem__(self, name: str) -> str:
        return self._latex[name] if name in self._latex else _plain(name)


def pose(left: int, right: int) -> str:
    """The pose of frame ``right`` in frame ``left``."""
    return f"{{}}^{{{left}}}T_{{{right}}}"


def link(name: str) -> str:
    """A link transform: A1 is A_{1}."""
    return _plain(name)
