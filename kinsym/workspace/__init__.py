"""What an arm can reach: the reachable, the dexterous and the constant-orientation workspace (lecture, slides 49, 50).

The lecture's words are corrected as its errata say: dexterous is what is reached with every *orientation*, and the
third is what is reached with one *orientation*, not with one configuration. For two parallel axes that turn the result
is closed (:func:`closed`); for any robot with numbers it is evaluated point by point, or as a sweep over a grid:

    found = sweep(ask(load("puma560"), plane=("z", 0.2)))  # for kinsym.plot.workspace, or kinsym.workspace.files
"""

from kinsym.methods.planar_workspace import Case, closed
from kinsym.workspace.asking import ask
from kinsym.workspace.evaluate import constant_orientation, dexterous, grid, reachable, reached
from kinsym.workspace.sweeping import Question, Workspace, sweep

__all__ = [
    "Case",
    "Question",
    "Workspace",
    "ask",
    "closed",
    "constant_orientation",
    "dexterous",
    "grid",
    "reachable",
    "reached",
    "sweep",
]
