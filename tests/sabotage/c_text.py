"""Mutants of generated C, by its tokens: enough of the language to know a sign from an increment."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from tests.sabotage.mutant import (
    BRANCH,
    CONSTANT,
    GUARD,
    PARAMETER,
    SIGN,
    TRIG,
    Change,
    Mutant,
    nudged,
    other,
    text_mutants,
    turned,
)

LANGUAGE = "c"

_TOKEN = re.compile(
    r"(?P<skip>/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|\s+)"
    r"|(?P<directive>\#[^\n]*)"
    r"|(?P<number>(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][+-]?\d+)?|\d+[uUlL]*)"
    r"|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>->|\+\+|--|<<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/&|^%]=|.)",
    re.DOTALL,
)
_FUNCTION = re.compile(r"^(?:KINSYM_FN )?[a-z][^;{}=()]*?(\w+)\([^;{}]*\)\s*\{", re.MULTILINE)
#: Macros that nobody defines here; what is for them alone is not compiled.
_UNDEFINED = re.compile(r"#ifdef\s+(__cplusplus|\w+_LIBM_ATAN2)|#if .*__cplusplus.*")
_SWAPS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
_WAVES = {"sin": "cos", "cos": "sin", "lane_sin": "lane_cos", "lane_cos": "lane_sin"}
_OPEN, _CLOSE = "([{", ")]}"


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)


def mutants(text: str, parameters: tuple[str, ...]) -> list[Mutant]:
    """Every mutant of one C file."""
    return text_mutants(LANGUAGE, text, _changes(list(_tokens(text)), parameters), _FUNCTION)


def _tokens(text: str) -> Iterator[_Token]:
    """What is compiled, without comments, text in quotes and directives but for the values of macros."""
    hidden = 0
    for match in _TOKEN.finditer(text):
        kind = str(match.lastgroup)
        if kind == "directive":
            line = match.group()
            if hidden:
                hidden += line.startswith("#if")
                hidden -= line.startswith("#endif")
                hidden = 0 if line.startswith("#else") and hidden == 1 else hidden
            elif _UNDEFINED.match(line):
                hidden = 1
            elif re.match(r"#define \w+ [\d.]", line):
                number = line.split()[2]
                yield _Token("number", number, match.start() + line.index(number))
        elif kind != "skip" and not hidden:
            yield _Token(kind, match.group(), match.start())


def _changes(tokens: list[_Token], parameters: tuple[str, ...]) -> Iterator[Change]:
    names = {token.text for token in tokens if token.kind == "name"}
    for place, token in enumerate(tokens):
        before = tokens[place - 1] if place else _Token("sign", "", 0)
        after = tokens[place + 1] if place + 1 < len(tokens) else before
        one = (token.start, token.end)
        if token.kind == "number":
            if not token.text.rstrip("uUlL").isdigit():
                yield CONSTANT, *one, repr(nudged(float(token.text)))
        elif token.kind == "name":
            yield from _names(token, before, after, names, parameters)
        elif token.text in _SWAPS:
            binary = (before.kind in ("number", "name") and before.text != "return") or before.text in (")", "]")
            if binary:
                yield SIGN, *one, _SWAPS[token.text]
            elif token.text == "-":
                yield SIGN, *one, " "
        elif token.text == "?":
            yield BRANCH, *one, "&& 0 ?"
            yield BRANCH, *one, "|| 1 ?"
        elif token.text in ("&&", "||"):
            yield GUARD, token.start, tokens[_end_of_operand(tokens, place + 1) - 1].end, ""
        if token.text == "if":
            close = _closing(tokens, place + 1)
            leaves = close + 2 < len(tokens) and tokens[close + 2].text in ("return", "continue", "break")
            yield GUARD if leaves else BRANCH, tokens[place + 2].start, tokens[close].start, "0"
        elif token.text == "for" and (ends := _limit(tokens, place)) is not None:
            yield BRANCH, ends.start, ends.end, f"{ends.text} - 1"
        elif token.text == "return" and after.text == "2":
            yield BRANCH, after.start, after.end, "1"


def _names(
    token: _Token, before: _Token, after: _Token, names: set[str], parameters: tuple[str, ...]
) -> Iterator[Change]:
    declared = before.text in ("double", "int", "unsigned", "struct") or after.text == "="
    wave = _WAVES.get(token.text) or turned(token.text)
    if wave in names and not declared:
        yield TRIG, token.start, token.end, str(wave)
    swapped = other(token.text, parameters)
    if swapped is not None and not declared:
        yield PARAMETER, token.start, token.end, swapped


def _closing(tokens: list[_Token], place: int) -> int:
    """Where the bracket at a place is closed."""
    depth = 0
    for here in range(place, len(tokens)):
        depth += (tokens[here].text in _OPEN) - (tokens[here].text in _CLOSE)
        if depth == 0:
            return here
    return len(tokens) - 1


def _end_of_operand(tokens: list[_Token], place: int) -> int:
    """Where what follows && or || ends: at a bracket that was open before, or at an operator that binds less."""
    depth = 0
    for here in range(place, len(tokens)):
        text = tokens[here].text
        if depth == 0 and text in (")", "]", "}", ";", ",", "?", ":", "&&", "||"):
            return here
        depth += (text in _OPEN) - (text in _CLOSE)
    return len(tokens)


def _limit(tokens: list[_Token], place: int) -> _Token | None:
    """The name before which a loop ends (i < n1;), if it is a plain one."""
    close = _closing(tokens, place + 1)
    for here in range(place + 2, close - 2):
        if tokens[here].text == "<" and tokens[here + 1].kind == "name" and tokens[here + 2].text == ";":
            return tokens[here + 1]
    return None
