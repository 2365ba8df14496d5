"""What kinsym derives in a section of the lecture: which arm, by which method."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from kinsym.lecture.case import find
from kinsym.lecture.printed import chain_names
from kinsym.lecture.shape import NameOf, name
from kinsym.lecture.system import System, system
from kinsym.methods import METHODS
from kinsym.methods.document import Equation, MethodDerivation, Sentence
from kinsym.methods.general_link import general_link
from kinsym.methods.half_angle import general
from kinsym.robot.model import Convention, Robot

GENERAL_SCREW = "A"
"""The displacement of any screw, by its name in the method ``screws``."""
_EXAMPLE = "stanford_screw"


@dataclass(frozen=True)
class Shown:
    """A derivation with the names of its symbols.

    ``robot`` is the arm whose table stands above it, None where the derivation is of no arm in particular.
    ``elsewhere`` are labels of equations that another derivation has printed.
    """

    robot: Robot | None
    derivation: MethodDerivation
    arm: System
    names: NameOf
    elsewhere: tuple[tuple[str, str], ...] = ()


def shown(derivations: Sequence[tuple[str, str]]) -> tuple[Shown, ...]:
    """The derivations of a section in order, each given as a robot and a method."""
    return tuple(derived(robot, method) for robot, method in derivations)


@lru_cache(maxsize=64)
def derived(robot: str, method: str) -> Shown:
    """One derivation; of an arm, unless the method has letters for everything."""
    if (robot, method) in _GENERAL:
        return _GENERAL[robot, method]()
    arm = system(robot)
    derivation = METHODS[method](arm.robot)
    elsewhere: tuple[tuple[str, str], ...] = ()
    if method == "screws":
        derivation = _without_general(derivation)
        elsewhere = ((GENERAL_SCREW, "screw_link:screws:A"),)
    return Shown(arm.robot, derivation, arm, chain_names(arm.chain), elsewhere)


def _general_link(convention: Convention) -> Shown:
    arm = system(f"{convention.value}_link")
    return Shown(None, general_link(convention), arm, chain_names(arm.chain))


def _any_equation() -> Shown:
    return Shown(None, replace(general(), robot="any_equation"), system("planar_rr"), name)


def _general_screw() -> Shown:
    """The general displacement, which the method states of every arm and proves with each of its joints."""
    derivation = METHODS["screws"](system(_EXAMPLE).robot)
    place = _place_of_general(derivation)
    passages = derivation.passages[place - 1 : place + 1]
    alone = replace(derivation, robot="screw_link", title="The displacement of a screw", passages=passages)
    return Shown(None, alone, find("screw_link", random.Random("chapter")), name)


def _without_general(derivation: MethodDerivation) -> MethodDerivation:
    """A derivation that refers to the general displacement instead of stating it."""
    place = _place_of_general(derivation)
    before, behind = derivation.passages[: place - 1], derivation.passages[place + 1 :]
    said = Sentence(
        f"Put into the general displacement, {{{GENERAL_SCREW}}}, they give the displacement of each joint."
    )
    return replace(derivation, passages=(*before, said, *behind[1:]))


def _place_of_general(derivation: MethodDerivation) -> int:
    return next(
        k
        for k, passage in enumerate(derivation.passages)
        if isinstance(passage, Equation) and passage.name == GENERAL_SCREW
    )


_GENERAL: dict[tuple[str, str], Callable[[], Shown]] = {
    ("craig_link", "general_link"): lambda: _general_link(Convention.CRAIG),
    ("paul_link", "general_link"): lambda: _general_link(Convention.PAUL),
    ("screw_link", "general_screw"): _general_screw,
    ("any_equation", "half_angle"): _any_equation,
}
