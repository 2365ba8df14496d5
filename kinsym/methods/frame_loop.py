"""Base, station, wrist, tool and goal as one loop (lecture, slide 46); in numbers: :mod:`kinsym.frames`."""

from __future__ import annotations

import random

from kinsym.algebra.field import PRIME, circle_point
from kinsym.algebra.tree import Sym
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.forward import forward_kinematics
from kinsym.methods.document import INVERSE, Factor, Matrix, MethodDerivation, Product
from kinsym.methods.draft import Draft
from kinsym.methods.proof import Rows, multiplied
from kinsym.methods.tables import unlocked
from kinsym.robot.model import Robot

NAME, TITLE = "frames", "Tool and goal"


def frames(robot: Robot) -> MethodDerivation:
    """The loop of frames of a robot: its tool seen from a station, and the wrist that brings it to a goal."""
    chain = build_chain(unlocked(robot))
    draft = Draft(chain, method=NAME, title=TITLE)
    pose = Matrix(forward_kinematics(chain).pose)
    plain = robot.base is None and robot.tool is None
    columns = [tuple(Sym(f"{letter}_{row}") for letter in "uvwp") for row in "xyz"]
    bottom = (*(draft.tree(draft.ring.zero) for _ in range(3)), draft.tree(draft.ring.one))
    wrist = pose if plain else Matrix((*columns, bottom))
    draft.say(
        "The wrist `W` in the base `B` is the forward kinematics. A station `S` is given in the base, a tool `T` in "
        "the wrist: both ways from the base to the tool are one"
    )
    draft.name_matrix("T_B_W", wrist)
    _give_poses(draft)
    tool = Product((Factor("T_B_S", INVERSE), Factor("T_B_W"), Factor("T_W_T")))
    draft.name_matrix("T_S_T", tool)
    draft.state("T_B_W", Product((Factor("T_B_W"),)), wrist)
    draft.state("loop", Product((Factor("T_B_S"), Factor("T_S_T"))), Product((Factor("T_B_W"), Factor("T_W_T"))))
    draft.say("so that the tool seen from the station is")
    draft.state("tool", Product((Factor("T_S_T"),)), tool)
    draft.say("The tool is at a goal `G`, given in the station, if")
    draft.name_matrix("T_S_G", tool)
    draft.state("goal", Product((Factor("T_S_T"),)), Product((Factor("T_S_G"),)))
    draft.say("which is what the inverse kinematics is asked with:")
    wanted = Product((Factor("T_B_S"), Factor("T_S_G"), Factor("T_W_T", INVERSE)))
    draft.state("wrist", Product((Factor("T_B_W"),)), wanted)
    return draft.done()


def _give_poses(draft: Draft) -> None:
    """Random rigid transforms for the station and the tool."""
    generator = random.Random("frames")
    for witness in draft.witnesses:
        for name in ("T_B_S", "T_W_T"):
            witness.matrices[name] = _rigid(generator)


def _rigid(generator: random.Random) -> Rows:
    (a, b), (c, d) = circle_point(generator), circle_point(generator)
    x, y, z = (generator.randrange(PRIME) for _ in range(3))
    about_z = [[a, -b % PRIME, 0, x], [b, a, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]
    about_x = [[1, 0, 0, 0], [0, c, -d % PRIME, 0], [0, d, c, 0], [0, 0, 0, 1]]
    return multiplied(multiplied(about_z, about_x), about_z)
