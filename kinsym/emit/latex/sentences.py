"""Text of the user and of the plan inside a LaTeX document.

A title is hostile until it is escaped: it may hold any character, and none of them may reach TeX as a command. The
sentences of a plan hold names of the program; those become mathematics.
"""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Callable

from kinsym.emit.latex.names import Names, link, pose

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedbl{}",
    "'": "'",
    "`": r"\textasciigrave{}",
    "–": "--",
    "—": "---",
    "’": "'",
    "‘": "`",
    "“": "``",
    "”": "''",
    "°": r"\textdegree{}",
    "±": r"$\pm$",
    "×": r"$\times$",
    "ß": r"\ss{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "œ": r"\oe{}",
    "Œ": r"\OE{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "…": r"\dots{}",
}
_ACCENTS = {
    "\u0300": r"\`",
    "\u0301": r"\'",
    "\u0302": r"\^",
    "\u0303": r"\~",
    "\u0304": r"\=",
    "\u0306": r"\u",
    "\u0307": r"\.",
    "\u0308": r"\"",
    "\u030a": r"\r",
    "\u030b": r"\H",
    "\u030c": r"\v",
    "\u0327": r"\c",
    "\u0328": r"\k",
}
_LONGEST_WORD = 30
_SOURCE_LINE = 120


def _character(character: str) -> str:
    if character in _SPECIAL:
        return _SPECIAL[character]
    if " " <= character <= "~":
        return character
    base, *marks = list(unicodedata.normalize("NFD", character))
    if len(marks) == 1 and marks[0] in _ACCENTS and base.isascii() and base.isalpha():
        return f"{_ACCENTS[marks[0]]}{{{base}}}"
    return f"[U+{ord(character):04X}]"


def escape(text: str) -> str:
    r"""Any text as one line of plain LaTeX text in ASCII.

    >>> escape("50% of $x_1$\n\\input{secret} Müller")
    '50\\% of \\$x\\_1\\$ \\textbackslash{}input\\{secret\\} M\\"{u}ller'
    """
    words = []
    for word in unicodedata.normalize("NFC", text).split():
        letters = [_character(letter) for letter in word if unicodedata.category(letter) not in ("Cc", "Cf")]
        chunks = [letters[k : k + _LONGEST_WORD] for k in range(0, len(letters), _LONGEST_WORD)]
        words.append(r"\hspace{0pt}".join("".join(chunk).replace("--", "-{}-") for chunk in chunks))
    return " ".join(word for word in words if word)


Words = Callable[[str], str]
"""Escapes words for the document that they stand in."""

_TOKEN = re.compile(
    r"(?P<pose>T_(?P<left>\d+)_(?P<right>\d+))"
    r"|(?P<link>[AL]\d+)(?P<inverse>\^-1)?"
    r"|(?P<name>[A-Za-z][A-Za-z0-9_]*)(?P<power>\^\d)?"
    r"|(?P<other>.)",
    re.DOTALL,
)


def _is_symbol(name: str, names: Names) -> bool:
    """Whether a word of a sentence means a quantity; other words are taken for English.

    The letters of rows (x, y, z) and columns (u, v, w, p) always mean a quantity.
    """
    if len(name) == 1:
        return name in "uvwpxyz"
    return name in names and (bool(re.search(r"[0-9_]", name)) or name in ("alpha", "beta", "gamma", "phi", "psi"))


def prose(text: str, names: Names, words: Words = escape) -> str:
    r"""A sentence of the plan, its names set as mathematics and the rest escaped by ``words``.

    >>> prose("row z of A1^-1 T_0_6, for theta1", Names(["theta1"]))
    'row $z$ of $A_{1}^{-1} \\, {}^{0}T_{6}$, for $\\theta_{1}$'
    """
    parts: list[str] = []
    plain = ""

    def flush() -> None:
        nonlocal plain
        lead, tail = plain[: len(plain) - len(plain.lstrip())], plain[len(plain.rstrip()) :]
        if plain.strip():
            parts.append((" " if lead else "") + words(plain) + (" " if tail else ""))
        elif plain:
            parts.append(" ")
        plain = ""

    for token in _TOKEN.finditer(text):
        math = ""
        if token["pose"]:
            math = pose(int(token["left"]), int(token["right"]))
        elif token["link"]:
            math = link(token["link"]) + ("^{-1}" if token["inverse"] else "")
        elif token["name"] and _is_symbol(token["name"], names):
            math = names[token["name"]] + (f"^{{{token['power'][1:]}}}" if token["power"] else "")
        if math:
            if parts and parts[-1].endswith("$") and plain == " ":
                parts[-1] = f"{parts[-1][:-1]} \\, {math}$"
                plain = ""
            else:
                flush()
                parts.append(f"${math}$")
        else:
            plain += token[0]
    flush()
    return "".join(parts).strip()


def wrapped(text: str) -> str:
    """A paragraph in lines of the source; nothing but blanks is touched."""
    return textwrap.fill(text, _SOURCE_LINE, break_long_words=False, break_on_hyphens=False)


def capital(sentence: str) -> str:
    """A sentence with a capital at its beginning, unless it begins with mathematics."""
    return sentence[:1].upper() + sentence[1:]
