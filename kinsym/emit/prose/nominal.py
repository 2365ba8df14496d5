"""What terminal, document, source and report say of a nominal arm: whose closed form it is, and what is guaranteed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from sympy import Expr

from kinsym.robot.model import Deviation
from kinsym.robot.text import cell_text

TITLE = "Closed form of the nominal arm, then Newton's steps with the true arm"
NOMINAL = "Inverse kinematics of the nominal arm"
SINGULAR = "Singular poses of the nominal arm"
IN_DOUBT = "Inverse kinematics where that is in doubt"
GUARANTEE = (
    "Every vector that is returned is a solution of the true arm to machine precision. That none is missed is measured,"
    " not proved."
)
BESIDE = (
    "The nominal arm is the special one next to this arm. Its closed form is solved for the pose, and from each of its"
    " solutions Newton's steps with the forward kinematics and the Jacobian of this arm lead to one of this arm."
)
HEAD = ("where", "this arm", "nominal arm", "off by")
LONG = "The twelve entries multiplied out would fill pages; the code multiplies the links."


def doubts(band: Fraction) -> str:
    """When the general solver is asked instead."""
    return (
        "In doubt is a pose at which a root of the nominal arm is free, is on a border or misses one by less than"
        f" {float(band):g} of its equation's unit, or at which a Newton step is longer than a quarter of the last one."
        " There all solutions come from the general solver of this arm, which needs no nominal one."
    )


def difference(deviation: Deviation) -> str:
    """How far the arms are apart."""
    return (
        f"Its forward kinematics differs from that of this arm by at most {deviation.position:.1e} in position and"
        f" {deviation.rotation:.1e} rad. Its table, in Paul's convention, differs in"
    )


def changes(deviation: Deviation) -> list[tuple[str, str, str, str]]:
    """The cells in which the arms differ, one row each."""
    return [(c.where, c.written, c.read_as, f"{c.difference:.1e}") for c in deviation.changes]


def offsets(values: Mapping[str, Expr]) -> str:
    """From where the joint values of the nominal arm count; empty where they count as those of this arm."""
    parts = [f"{name} by {cell_text(value)}" for name, value in values.items()]
    return f"Its joint values are ahead of those of this arm: {', '.join(parts)}." if parts else ""


def label(deviation: Deviation, band: Fraction) -> Iterator[str]:
    """The sentences for the head of a source file, and for the report."""
    yield f"Inverse kinematics: {TITLE[0].lower()}{TITLE[1:]}."
    yield f"{difference(deviation)} {'; '.join(_words(changes(deviation)))}."
    yield doubts(band)
    yield GUARANTEE


def _words(rows: Iterable[tuple[str, str, str, str]]) -> Iterator[str]:
    for where, written, read_as, off in rows:
        yield f"{where}: {written} read as {read_as} (off by {off})"
