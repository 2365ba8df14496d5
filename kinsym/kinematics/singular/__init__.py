"""Where an arm is singular: det J in factors, what each of them means, and random postures at which it vanishes."""

from kinsym.kinematics.singular.conditions import Condition
from kinsym.kinematics.singular.singularities import SingularSet, singular_set

__all__ = ["Condition", "SingularSet", "singular_set"]
