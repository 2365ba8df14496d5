"""``kinsym lecture``: every equation of the lecture against kinsym's own derivations."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from kinsym.command.options import add_quiet
from kinsym.errors import KinsymError

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.lecture.verdict import Verdict

SOURCE = "H. D. Taghirad, Robotics: Mechanics & Control, chapter 3: Kinematic Analysis"


HELP = "hold the lecture's equations against what kinsym derives"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("system", metavar="SYSTEM", nargs="?", help="one system of the lecture (default: all)")
    command.add_argument("--errata", action="store_true", help="list the lecture's mistakes with the reason")
    command.add_argument("--markdown", action="store_true", help="print docs/lecture.md, the sections beside kinsym")
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Print a verdict on every equation, or the mistakes; 1 unless every entry is accounted for."""
    from kinsym.lecture.report import chosen, errata, forms, lines, missing, summary, ways
    from kinsym.lecture.verdict import failed_ways, verdicts

    found: list[Verdict] = []
    failed: list[str] = []
    if options.markdown:
        return _page(options, screen)
    selected = chosen(options.system)
    screen.say(f"{SOURCE}\n")
    for chapter in selected:
        own = list(verdicts([chapter]))
        found += own
        astray = failed_ways(chapter)
        failed += [f"{chapter.system}: {name}" for name in astray]
        if options.errata:
            continue
        screen.say(f"{chapter.title}\n{'-' * len(chapter.title)}")
        screen.say("\n".join([*lines(own), *ways(chapter, astray)]) + "\n")
        if note := missing(chapter):
            screen.say(note + "\n")
    if options.errata:
        mistakes = list(errata(found))
        screen.say("\n\n".join(mistakes) if mistakes else "  no mistakes")
        screen.say(f"\n{len(mistakes)} mistakes among {len(found)} entries")
    else:
        screen.say("\n\n".join(part for part in (summary(found), forms(found)) if part))
    for name in failed:
        screen.warn(f"a way through all joints does not lead to the pose with the solutions claimed: {name}")
    return 0 if not failed and all(verdict.accounted for verdict in found) else 1


def _page(options: argparse.Namespace, screen: Screen) -> int:
    """Print docs/lecture.md."""
    from kinsym.lecture.document import markdown
    from kinsym.lecture.verdict import verdicts

    if options.system is not None or options.errata:
        raise KinsymError("--markdown is the page of the whole lecture. Leave out the system and --errata.")
    found = list(verdicts())
    screen.say(markdown(found).rstrip("\n"), plain=True)
    return 0 if all(verdict.accounted for verdict in found) else 1
