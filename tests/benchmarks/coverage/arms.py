"""Random arms by class, the same for a seed on every machine: what a user may write that no one has seen before.

An arm is a Denavit-Hartenberg table. Even numbers carry named parameters with values, odd ones have the numbers in
their cells. ``sparse`` tables look like machines (right angles, parallel neighbours, many zeros), ``full`` ones have
every length, ``skew`` ones turn by 30, 45 and 60 degrees.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot
from tests.benchmarks.coverage.oracle import Screws

TRIES = 200
SKEW = ("pi/6", "pi/4", "pi/3", "-pi/6", "-pi/4", "-pi/3")
RIGHT = ("pi/2", "-pi/2")
STYLES = ("sparse", "full", "skew")


@dataclass
class Draft:
    """A table in the making."""

    rng: random.Random
    style: str
    named: bool
    convention: str = "paul"
    task: str | None = None
    rows: list[dict[str, str]] = field(default_factory=list)
    values: dict[str, str] = field(default_factory=dict)

    def length(self, letter: str, *, needed: bool = False) -> str:
        """A cell for a length of this row: a name or a number, in a sparse table zero every other time."""
        if self.style == "sparse" and not needed and self.rng.random() < 0.5:
            return "0"
        millimetres = self.rng.randint(50, 600) * self.rng.choice((1, 1, 1, -1))
        return self.named_value(f"{letter}{len(self.rows) + 1}", Fraction(millimetres, 1000))

    def named_value(self, name: str, value: Fraction) -> str:
        """The value itself or its name."""
        text = f"{float(value):.3f}"
        if not self.named:
            return text
        self.values[name] = text
        return name

    def twist(self, *, crossing: bool = True) -> str:
        """A cell for the angle to the next axis; ``crossing`` excludes parallel ones."""
        if self.style == "sparse" and not crossing and self.rng.random() < 0.4:
            return "0"
        return self.rng.choice(SKEW if self.style == "skew" else RIGHT)

    def row(self, kind: str, alpha: str, a: str, d: str) -> None:
        """Append a row whose joint is of ``kind`` R or P; a joint that slides has no use for ``d``."""
        number = len(self.rows) + 1
        if kind == "P":
            self.values.pop(d, None)
        name = f"theta{number}" if kind == "R" else f"d{number}"
        cells = {"theta": name, "d": d} if kind == "R" else {"theta": self.rng.choice(("0", "pi/2")), "d": name}
        self.rows.append({"type": kind, "variable": name, "alpha": alpha, "a": a, **cells})

    def robot(self, name: str) -> Robot:
        """The robot, read as a file is read."""
        draft: dict[str, object] = {"name": name, "convention": self.convention, "joints": self.rows}
        if self.task:
            draft["task"] = self.task
        if self.values:
            draft["parameters"] = self.values
        return from_draft(draft, where=name)


Maker = Callable[[Draft], None]


def joints(kinds: str, *, meet: int = 0, parallel: int = 0) -> Maker:
    """Joints of these kinds in order; axes ``meet`` to meet + 2 go through one point, ``parallel`` likewise."""

    def make(draft: Draft) -> None:
        for number, kind in enumerate(kinds, start=1):
            last = number == len(kinds)
            if meet and number in (meet, meet + 1):
                draft.row(kind, draft.twist(), "0", "0" if number == meet + 1 else draft.length("l"))
            elif parallel and number in (parallel, parallel + 1):
                draft.row(kind, "0", draft.length("a", needed=True), draft.length("l"))
            else:
                alpha = "0" if last else draft.twist(crossing=False)
                draft.row(kind, alpha, draft.length("a"), draft.length("l"))

    return make


def shuffled(kinds: str) -> Maker:
    """The same joints in a random order."""

    def make(draft: Draft) -> None:
        joints("".join(draft.rng.sample(kinds, len(kinds))))(draft)

    return make


def few(count: int, *, task: str | None) -> Maker:
    """An arm of ``count`` joints, one of four sliding, asked for ``task`` or for what fits it."""

    def make(draft: Draft) -> None:
        draft.task = task
        joints("".join(draft.rng.choice("RRRP") for _ in range(count)))(draft)

    return make


def based(kinds: str, twists: tuple[str, ...]) -> Maker:
    """A classical base of three joints with a wrist whose axes meet: gantry, cylindrical, spherical, SCARA."""

    def make(draft: Draft) -> None:
        for kind, twist in zip(kinds, twists, strict=True):
            draft.row(kind, twist, draft.length("a", needed=kind == "R" and twist == "0"), draft.length("l"))
        draft.row("R", draft.twist(), "0", draft.length("l"))
        draft.row("R", draft.twist(), "0", "0")
        draft.row("R", "0", draft.length("a"), draft.length("l"))

    return make


def cobot(draft: Draft) -> None:
    """Axes 2 and 3 parallel, 4 and 5 meet, 5 and 6 meet elsewhere (Fanuc CRX, xArm 6, Gen3 lite)."""
    draft.row("R", draft.twist(), "0", draft.length("l"))
    draft.row("R", "0", draft.length("a", needed=True), "0")
    draft.row("R", draft.twist(), draft.length("a"), draft.length("l"))
    draft.row("R", draft.twist(), "0", draft.length("l", needed=True))
    draft.row("R", draft.twist(), "0", draft.length("l", needed=True))
    draft.row("R", "0", "0", draft.length("l"))


def locked(elbow: bool) -> Maker:
    """Seven joints with one held: axes 1-3 meet and 5-7, or with ``elbow`` offsets at joints 4, 5 and 7 (Franka)."""

    def make(draft: Draft) -> None:
        held = draft.rng.randint(1, 7)
        draft.convention = "craig"
        for number in range(1, 8):
            offset = elbow and number in (4, 5, 7)
            alpha = "0" if number == 1 else draft.twist()
            d = draft.length("l", needed=True) if number % 2 else "0"
            draft.row("R", alpha, draft.length("a", needed=True) if offset else "0", d)
        row = draft.rows[held - 1]
        angle = Fraction(draft.rng.randint(-300, 300), 100)
        del row["variable"]
        row.update(type="fixed", theta=draft.named_value(f"q{held}", angle))

    return make


CLASSES: dict[str, tuple[Maker, tuple[str, ...]]] = {
    "three axes meet, 4-6": (joints("RRRRRR", meet=4), STYLES),
    "three axes meet, 1-3": (joints("RRRRRR", meet=1), STYLES),
    "three axes meet, 2-4": (joints("RRRRRR", meet=2), STYLES),
    "three axes meet, 3-5": (joints("RRRRRR", meet=3), STYLES),
    "three axes parallel, 1-3": (joints("RRRRRR", parallel=1), STYLES),
    "three axes parallel, 2-4": (joints("RRRRRR", parallel=2), STYLES),
    "three axes parallel, 3-5": (joints("RRRRRR", parallel=3), STYLES),
    "three axes parallel, 4-6": (joints("RRRRRR", parallel=4), STYLES),
    "gantry and wrist": (based("PPP", ("pi/2", "pi/2", "0")), ("sparse", "skew")),
    "cylindrical and wrist": (based("RPP", ("0", "-pi/2", "0")), ("sparse", "skew")),
    "spherical and wrist": (based("RRP", ("pi/2", "pi/2", "0")), ("sparse", "skew")),
    "SCARA and wrist": (based("RRP", ("0", "0", "0")), ("sparse", "skew")),
    "one slide anywhere": (shuffled("PRRRRR"), STYLES),
    "two slides anywhere": (shuffled("PPRRRR"), STYLES),
    "three slides anywhere": (shuffled("PPPRRR"), STYLES),
    "two joints, task that fits": (few(2, task=None), STYLES),
    "three joints, task that fits": (few(3, task=None), STYLES),
    "four joints, task that fits": (few(4, task=None), STYLES),
    "five joints, task that fits": (few(5, task=None), STYLES),
    "two joints, full pose": (few(2, task="pose"), STYLES),
    "three joints, full pose": (few(3, task="pose"), STYLES),
    "four joints, full pose": (few(4, task="pose"), STYLES),
    "five joints, full pose": (few(5, task="pose"), STYLES),
    "offset-wrist cobot": (cobot, ("full", "skew")),
    "7R locked, spherical ends": (locked(elbow=False), ("full", "skew")),
    "7R locked, elbow offsets": (locked(elbow=True), ("full", "skew")),
    "general 6R": (joints("RRRRRR"), ("full", "skew")),
}
"""Classes and the styles they take in turn."""


def arms(name: str, count: int, seed: int) -> Iterator[Robot]:
    """The first ``count`` arms of a class."""
    for number in range(count):
        yield arm(name, number, seed)


def arm(name: str, number: int, seed: int) -> Robot:
    """One arm of a class. Tables whose joints cannot move independently anywhere are drawn again."""
    make, styles = CLASSES[name]
    rng = random.Random(f"{seed}, {name}, {number}")
    for _ in range(TRIES):
        draft = Draft(rng=rng, style=styles[number % len(styles)], named=number % 2 == 0)
        make(draft)
        robot = draft.robot(f"arm_{number}")
        if moves(robot):
            return robot
    raise RuntimeError(f"{name}: no arm that moves in {TRIES} tries")


def moves(robot: Robot) -> bool:
    """Whether the columns of the Jacobian are independent at some pose, and some length counts."""
    screws = Screws(robot)
    jacobian = screws.jacobian(np.linspace(0.3, 2.3, screws.count)[None])[0]
    jacobian[:3] /= screws.size
    return bool(np.linalg.svd(jacobian, compute_uv=False)[-1] > 1e-3)
