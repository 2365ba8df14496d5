"""What a run over many poses found, as lines for the terminal and as a section of ``docs/reliability.md``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tests.stress.measure import FAULTS, INSIDE, OUTSIDE, PAIR, RANDOM, Kind

HEAD = f"{'robot':<20}{'poses':<34}{'number':>9}{'solutions':>11}  worst closure  " + "  ".join(FAULTS)

Results = Mapping[str, Sequence[Kind]]

_TEXT = """\
    {command}

The compiled C of each robot with a closed form is asked for poses of chosen joint vectors: a tenth of all poses at
and next to *each* singular set that the derivation lists (10^-15 to 10^-3 from it, one in thirteen exactly on it), some
where two of the sets meet, a tenth inside and a tenth outside the borders of the workspace (10^-15 to 10^-3 of the
arm's size deep), the rest anywhere. *Lost*: the joint vector that made the pose is neither among the solutions nor
joined to one by a way on which the pose stays; where two sets meet, or outside a border by less than 2e-15, no solution
at all. *Wrong*: a solution that misses its pose by more than 1e-9. *Copies*: two solutions within 1e-7. *Broken*: a
value that is no number, an angle outside (-pi, pi], a pose that is refused. *Batch*: poses, of which one in four is
tried, at which `ik_batch` answers otherwise than `ik_near`. Outside a border a solution may miss the pose by as much as
the pose is outside, up to the 1e-12 at which a solution in doubt is given up; its closure has its own column.
"""


def lines(robot: str, kinds: Sequence[Kind]) -> list[str]:
    """One line for each kind of pose of a robot, and the first poses of every fault."""
    rows = []
    for kind in kinds:
        name = kind.name if len(kind.name) < 34 else f"{kind.name[:30]}..."
        counts = "".join(f"{kind.faults[fault]:>{len(fault) + 2}}" for fault in FAULTS)
        rows.append(f"{robot:<20}{name:<34}{kind.poses:>9}{kind.solutions:>11}  {kind.worst:<13.0e}{counts}")
        for fault, examples in kind.examples.items():
            rows += [f"    {fault}: {' '.join(f'{value!r}' for value in example)}" for example in examples]
    return rows


def section(results: Results, command: str) -> list[str]:
    """The section of the page."""
    names = (
        "robot",
        "poses",
        "singular sets",
        "next to them",
        "at borders",
        "solutions",
        *FAULTS,
        "closure",
        "outside",
    )
    text = [*_TEXT.format(command=command).splitlines(), ""]
    text += [f"| {' | '.join(names)} |", "|---" * len(names) + "|"]
    text += [f"| {' | '.join(_row(robot, kinds))} |" for robot, kinds in results.items()]
    every = [kind for kinds in results.values() for kind in kinds]
    total = [str(sum(kind.faults[fault] for kind in every)) for fault in FAULTS]
    poses, solutions = (f"{sum(getattr(kind, name) for kind in every):,}" for name in ("poses", "solutions"))
    text += [
        "",
        f"In all {poses} poses and {solutions} solutions: "
        + ", ".join(f"{number} {fault}" for number, fault in zip(total, FAULTS, strict=True))
        + ".",
    ]
    faulty = [
        line for robot, kinds in results.items() for line in lines(robot, [k for k in kinds if any(k.faults.values())])
    ]
    return [*text, *(["", "```text", HEAD, *faulty, "```"] if faulty else [])]


def _row(robot: str, kinds: Sequence[Kind]) -> list[str]:
    sets = [kind for kind in kinds if kind.name not in (RANDOM, PAIR, INSIDE, OUTSIDE)]
    near = [kind for kind in kinds if kind.name == PAIR]
    edge = [kind for kind in kinds if kind.name in (INSIDE, OUTSIDE)]
    return [
        robot,
        str(_sum(kinds)),
        str(len(sets)),
        str(_sum([*sets, *near])),
        str(_sum(edge)) if edge else "",
        str(sum(kind.solutions for kind in kinds)),
        *(str(sum(kind.faults[fault] for kind in kinds)) for fault in FAULTS),
        f"{max(kind.worst for kind in kinds if kind.name != OUTSIDE):.0e}",
        f"{max(kind.worst for kind in edge):.0e}" if edge else "",
    ]


def _sum(kinds: Sequence[Kind]) -> int:
    return sum(kind.poses for kind in kinds)
