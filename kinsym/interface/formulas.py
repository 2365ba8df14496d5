"""Forward kinematics, Jacobian and singular poses as a user of Python meets them: formulas that can be called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING

from kinsym.algebra.nested import nested
from kinsym.algebra.symbolic import expression
from kinsym.algebra.tree import ONE, ZERO, Tree
from kinsym.derivation import Derivation
from kinsym.display import Displayed
from kinsym.emit.markdown import derivation as markdown
from kinsym.emit.text.equations import forward_kinematics, jacobian, links
from kinsym.emit.text.page import Page
from kinsym.emit.text.singular import singular_poses
from kinsym.kinematics.forward import Link
from kinsym.kinematics.singular import Condition

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from sympy import Expr, ImmutableDenseMatrix

    from kinsym.live import Floats

Module = Callable[[], ModuleType]
"""The NumPy module of a derivation, made when it is first asked for."""


@dataclass(frozen=True, eq=False)
class Formulas(Displayed):
    """A part of a derivation."""

    derivation: Derivation

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.derivation.robot.name}>"

    def __str__(self) -> str:
        return self.text()


@dataclass(frozen=True, eq=False, repr=False)
class ForwardKinematics(Formulas):
    """T = A1 A2 ... An; called with joint vectors it returns numbers."""

    module: Module

    def __call__(self, q: ArrayLike, **parameters: float) -> Floats:
        """Poses (..., 4, 4) of joint vectors (..., n), angles in radians; parameters by their names.

        Raises TypeError for a parameter without a value, ValueError for what is no joint vector.
        """
        result: Floats = self.module().fk(q, **parameters)
        return result

    def text(self) -> str:
        """The link transforms, their product and its entries for a terminal."""
        found = self.derivation
        return "\n\n".join((links(found.robot, found.forward), forward_kinematics(found)))

    def markdown(self) -> str:
        """The same, and what its shorthand means, as Markdown."""
        return markdown.forward(self.derivation)

    @property
    def links(self) -> tuple[Link, ...]:
        """The link transforms A1 ... An, or the screw displacements, in shorthand: c1 is cos(theta1)."""
        return self.derivation.forward.links

    def sympy(self) -> ImmutableDenseMatrix:
        """T (4, 4), base and tool included, as a matrix of SymPy over the joint variables and parameters.

        >>> import kinsym as ks
        >>> ks.derive(ks.load("planar_rr")).fk.sympy()[0, 3]
        l1*cos(theta1) + l2*cos(theta1 + theta2)
        """
        ring, columns = self.derivation.chain.ring, self.derivation.forward.columns
        rows = [[nested(ring, column[row]) for column in columns] for row in range(3)]
        return _matrix([*rows, [ZERO, ZERO, ZERO, ONE]], _names(self.derivation))


@dataclass(frozen=True, eq=False, repr=False)
class Jacobian(Formulas):
    """The geometric Jacobian in the base frame, velocity above; called with joint vectors it returns numbers."""

    module: Module

    def __call__(self, q: ArrayLike, **parameters: float) -> Floats:
        """Jacobians (..., 6, n) of joint vectors (..., n); raises what :class:`ForwardKinematics` raises."""
        result: Floats = self.module().jacobian(q, **parameters)
        return result

    def text(self) -> str:
        """The columns for a terminal, and the names that they are written in."""
        if self.derivation.long:
            return Page().prose("The entries multiplied out would fill pages; the code finds them frame by frame.")
        return jacobian(self.derivation.forward, self.derivation.jacobian)

    def markdown(self) -> str:
        """The same as Markdown."""
        return markdown.jacobian(self.derivation)

    def sympy(self) -> ImmutableDenseMatrix:
        """J (6, n) as a matrix of SymPy over the joint variables and parameters."""
        names = _names(self.derivation)
        for item in self.derivation.jacobian.definitions:
            names[item.name] = expression(item.value, names)
        return _matrix(self.derivation.jacobian.entries, names)


@dataclass(frozen=True, eq=False, repr=False)
class SingularPoses(Formulas):
    """det J in factors, and what each of them means."""

    def text(self) -> str:
        """det J, its zeros and the families of solutions for a terminal."""
        return singular_poses(self.derivation.singular, self.derivation.families, Page())

    def markdown(self) -> str:
        """The same as Markdown."""
        return markdown.singular(self.derivation)

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions under which the arm is singular, in the order in which they are shown."""
        return self.derivation.singular.listed

    @property
    def determinant(self) -> Tree:
        """det J, a product of factors."""
        return self.derivation.singular.determinant


def _names(derivation: Derivation) -> dict[str, Expr]:
    """What the shorthand of angles and the constants of the table stand for."""
    from sympy import Symbol, cos, sin

    names: dict[str, Expr] = {}
    for angle in derivation.angles:
        total = sum(sign * Symbol(name) for name, sign in angle.terms)
        names |= {angle.name: total, angle.cosine: cos(total), angle.sine: sin(total)}
    for item in derivation.constants:
        names[item.name] = expression(item.value, names)
    return names


def _matrix(rows: Iterable[Iterable[Tree]], names: Mapping[str, Expr]) -> ImmutableDenseMatrix:
    from sympy import ImmutableDenseMatrix

    return ImmutableDenseMatrix([[expression(cell, names) for cell in row] for row in rows])
