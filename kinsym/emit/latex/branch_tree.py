r"""The solutions of a derivation as a tree of braces: one unknown after the other, a brace where it has several values.

theta1 (+ ... / - ...) is set as \theta_1 \begin{cases} + \;\; \theta_3 \cdots \\ - \;\; \theta_3 \cdots \end{cases}
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

#: A tree of more leaves than this says less than the numbers of its branches.
MOST_LEAVES = 16


@dataclass(frozen=True, kw_only=True)
class Fork:
    """An unknown in LaTeX and a mark for each of its values; a single mark is not printed."""

    unknown: str
    marks: tuple[str, ...]


def leaves(forks: Sequence[Fork]) -> int:
    """How many solutions there are at most.

    >>> leaves([Fork(unknown="x", marks=("+", "-")), Fork(unknown="y", marks=("",))])
    2
    """
    count = 1
    for fork in forks:
        count *= len(fork.marks)
    return count


def branch_tree(forks: Sequence[Fork]) -> str:
    r"""The tree as a formula; empty where there is nothing to tell apart, or too much of it.

    >>> print(branch_tree([Fork(unknown="x", marks=("+", "-")), Fork(unknown="y", marks=("",))]))
    x \begin{cases} + & y \\ - & y \end{cases}
    """
    return _branch(list(forks)) if 1 < leaves(forks) <= MOST_LEAVES else ""


def _branch(forks: Sequence[Fork]) -> str:
    for index, fork in enumerate(forks):
        if len(fork.marks) > 1:
            behind = _branch(forks[index + 1 :])
            rows = " \\\\ ".join(f"{mark} & {behind}".rstrip(" &") for mark in fork.marks)
            before = ",\\; ".join(one.unknown for one in forks[: index + 1])
            return f"{before} \\begin{{cases}} {rows} \\end{{cases}}"
    return ",\\; ".join(fork.unknown for fork in forks)
