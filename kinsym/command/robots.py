"""``kinsym robots``: the gallery, one line a robot."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from kinsym.command.options import add_json
from kinsym.errors import KinsymError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

HELP = "list the robots of the gallery"
_HEAD = ("name", "joints", "class", "table", "solutions")


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = (
        "List the robots of the gallery: joints (R turns, P slides), class, convention of the table, and how many"
        " solutions a pose has at most; ~ where one angle is the root of a polynomial."
    )
    command.add_argument(
        "word", metavar="WORD", nargs="*", help="only robots that have all of these in their name, title or line"
    )
    add_json(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Print the robots that are asked for."""
    entries = [entry for entry in _entries() if all(word.lower() in _text(entry) for word in options.word)]
    if not entries:
        from kinsym.robot import gallery
        from kinsym.robot.names import nearest, shown

        words = " and ".join(map(shown, options.word))
        hint = nearest(options.word[0], gallery())
        raise KinsymError(f"no robot of the gallery has {words}. {hint}The whole list: kinsym robots.")
    rows = [_HEAD, *map(_row, entries)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        screen.say("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    if options.json:
        screen.give({"status": 0, "robots": entries})
    return 0


def _entries() -> list[dict[str, Any]]:
    from kinsym.robot import gallery_heads, gallery_index

    index = gallery_index()
    return [{"name": name, **head, **index[name]} for name, head in gallery_heads().items()]


def _row(entry: dict[str, Any]) -> tuple[str, ...]:
    solutions = f"{entry['solutions']}{'' if entry['closed_form'] else ' ~'}"
    return entry["name"], entry["joints"], _class(entry), entry["convention"], solutions


def _class(entry: dict[str, Any]) -> str:
    return ", ".join([entry["class"], *(f"{joint} locked" for joint in entry["locked"])])


def _text(entry: dict[str, Any]) -> str:
    """What a word is looked for in."""
    return " ".join((*_row(entry), entry["title"])).lower()
