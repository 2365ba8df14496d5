"""The pages of the documentation, and the blocks of code in them.

A block says in its first line what it is: a language, and behind it the name of a file if it is one
(```` ```toml two_links.toml ````). A block that a machine without ROS or CUDA cannot run, or that another test runs,
has a comment above it that says so, ``<!-- not run: why -->``, which no reader of the page sees. Indented lines are the
commands that wrote a page, ``python -m tests...``, which run for hours.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

ROOT = Path(__file__).resolve().parents[2]
PAGES = (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md")))
_MARK = re.compile(r"<!-- not run: (?P<reason>\S.*) -->\s*")


@dataclass(frozen=True, kw_only=True)
class Block:
    """A block of code, from ``line`` on; ``reason`` is why it is not run, empty where it is."""

    language: str
    name: str
    text: str
    line: int
    reason: str


def tokens(text: str) -> list[Token]:
    """What a page consists of."""
    return MarkdownIt("commonmark").enable("table").parse(text)


def blocks(text: str) -> list[Block]:
    """The blocks of code, in order; AssertionError for one that has no language."""
    found, mark = [], ""
    for token in tokens(text):
        line = token.map[0] + 1 if token.map else 0
        if token.type == "code_block":
            own = all(command.startswith("python -m tests.") for command in token.content.splitlines())
            assert own, f"line {line}: code without a language; write it between ``` and ```"
        if token.type == "fence":
            language, _, name = token.info.partition(" ")
            assert language, f"line {line}: code without a language"
            found.append(Block(language=language, name=name, text=token.content, line=line + 1, reason=mark))
        match = _MARK.fullmatch(token.content) if token.type == "html_block" else None
        mark = match["reason"] if match else ""
    return found


def inline_code(text: str) -> Iterator[str]:
    """What stands between backticks in the sentences and tables of a page."""
    for token in tokens(text):
        yield from (child.content for child in token.children or () if child.type == "code_inline")
