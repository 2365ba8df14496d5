"""Pages for the tests, each robot derived once."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from html.parser import HTMLParser

from kinsym.check.reporting import report_of
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.live import live_module
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.page import page
from kinsym.page.shown import Shown, shown
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from tests.arms import robot

#: Elements that have no end in HTML.
EMPTY = frozenset("meta input br wbr".split())


LIMITED = "puma560_limited"
#: Of joints that turn from -60 to 240 degrees, so that angles next to -pi have to be wound.
LIMITS = (Fraction(-1047, 1000), Fraction(4189, 1000))

SKEW_SCREWS = "skew_screws"
#: Axes that neither meet nor are parallel, each named by a point far from where the links are.
SKEW = {
    "name": SKEW_SCREWS,
    "convention": "screw",
    "joints": [
        {"type": "R", "variable": "theta1", "s": ["0", "0", "1"], "s0": ["0", "0", "0"]},
        {"type": "R", "variable": "theta2", "s": ["0", "1", "0"], "s0": ["0.3", "5", "0.4"]},
        {"type": "R", "variable": "theta3", "s": ["1", "0", "0"], "s0": ["2", "0.2", "0.7"]},
    ],
    "home": {"u0": ["1", "0", "0"], "v0": ["0", "1", "0"], "w0": ["0", "0", "1"], "q0": ["1", "0.5", "0.9"]},
}


@dataclass(frozen=True)
class Made:
    """A page with what it was made of."""

    derivation: Derivation
    schedule: Schedule
    shown: Shown
    text: str


def make(arm: Robot) -> Made:
    """The page of a robot, without checks and with a few words in the place of its code."""
    derivation = derive(arm)
    schedule = build_schedule(derivation)
    numbers = shown(derivation, live_module(schedule))
    sources = {f"{arm.name}.py": "print(1 < 2)\n", f"{arm.name}.c": "int main(void);\n"}
    text = page(derivation, schedule, sources, report_of(derivation.robot, schedule, sources, None), numbers)
    return Made(derivation, schedule, numbers, text)


@cache
def made(name: str) -> Made:
    """The page of a robot of the gallery, of a shape of the tests, or of one of ours."""
    if name == SKEW_SCREWS:
        return make(from_draft(SKEW, where=name))
    if name == LIMITED:
        arm = robot("puma560")
        joints = tuple(replace(joint, limits=LIMITS) for joint in arm.joints)
        return make(replace(arm, joints=joints))
    return make(robot(name))


class Outline(HTMLParser):
    """Reads a page; raises ValueError where an element ends that is not the one that is open."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()
        if self.open:
            raise ValueError(f"left open: {self.open}")

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            raise ValueError(f"</{tag}> at line {self.getpos()[0]}")

    def handle_data(self, data: str) -> None:
        if not {"script", "style"} & set(self.open):
            self.words.append(data)

    def plain(self) -> str:
        """What a reader sees, blanks removed."""
        return re.sub(r"\s+", "", "".join(self.words))
