"""``docs/reliability.md``, a section for each command that writes it."""

from __future__ import annotations

from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "reliability.md"

HEAD = """# How far the generated code and its checks can be trusted

Written by the commands that are named below, from what they measured. What is drawn at random is drawn with a seed: the
same command finds the same again, but for what another compiler rounds differently.
"""
#: The sections in the order in which they stand on the page.
TITLES = (
    "The checks catch sabotage",
    "The tests see broken mathematics",
    "Arms that nobody has looked at",
    "Long runs",
    "Single precision",
)


def write_section(title: str, lines: list[str], page: Path = PAGE) -> None:
    """Put a section in its place on the page; the others stay as they are."""
    old = page.read_text(encoding="utf-8") if page.exists() else ""
    bodies = {name: _body(old, name) for name in TITLES} | {title: "\n".join(lines).strip("\n")}
    sections = [f"\n## {name}\n\n{body}\n" for name, body in bodies.items() if body]
    page.write_text(HEAD + "".join(sections), encoding="utf-8", newline="\n")


def _body(text: str, title: str) -> str:
    _, found, rest = text.partition(f"\n## {title}\n")
    return rest.partition("\n## ")[0].strip("\n") if found else ""
