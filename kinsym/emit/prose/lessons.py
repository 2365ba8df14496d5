"""What a student wants to know of a rule: how it solves its equations, and what speaks for it or against it."""

from __future__ import annotations

from dataclasses import dataclass

from kinsym.inverse.choices import Choice


@dataclass(frozen=True)
class Lesson:
    """Two sentences on a rule: how it comes to its values, and what it costs the reader and the code."""

    how: str
    price: str


LESSONS = {
    "direct": Lesson(
        "Two equations are linear in the cosine and the sine, and their determinant is a constant: Cramer's rule gives"
        " both, and Atan2 of the two is the angle, in its right quadrant.",
        "one value, and nothing to divide by",
    ),
    "quotient": Lesson(
        "Two equations are linear in the cosine and the sine: Cramer's rule gives both, and Atan2 of the two is the"
        " angle. The determinant depends on what was found before, and where it vanishes the equations say nothing.",
        "one value, but a determinant that can vanish",
    ),
    "length": Lesson(
        "The length stands in the equation once, with a constant factor: it is taken to one side.",
        "one value, and nothing to divide by",
    ),
    "quotient_length": Lesson(
        "The length stands in the equation once, with a factor that depends on what was found before: it is taken to"
        " one side, and divided by the factor.",
        "one value, but a factor that can vanish",
    ),
    "homogeneous": Lesson(
        "a c + b s = 0 says that the direction (c, s) is at right angles to (a, b). There are two of them, (b, -a) and"
        " (-b, a): two angles, half a turn apart.",
        "two values from one equation without a constant term, so that no pose is out of reach",
    ),
    "homogeneous2": Lesson(
        "a c + b s = 0 says that the direction (c, s) is at right angles to (a, b): two angles, half a turn apart. The"
        " arm has fewer joints than the pose has equations, and a second one says the same of this angle; it takes over"
        " where the first one vanishes.",
        "two values from one equation without a constant term",
    ),
    "triangle": Lesson(
        "The two equations are the sides of a triangle: two links, and the way from the start of the first to the end"
        " of the second, which is known. Squared and added, the direction of the first link drops out, and the law of"
        " cosines is left: the second link makes the angle with the first that gives the third side its length. It"
        " can bend to either side.",
        "two values, and the angle of the first link with them",
    ),
    "direction": Lesson(
        "The three sides of the triangle are known now. Its third side points to the goal, and the first link stands"
        " off from it by the angle at the base, which Atan2 gives with its sign.",
        "one value, which the triangle brings with it",
    ),
    "linear_pole": Lesson(
        "With r = sqrt(a^2 + b^2) the equation a c + b s = e is r cos(theta - Atan2(b, a)) = e: the angle lies at equal"
        " distances on either side of Atan2(b, a). The two meet where axes come in line; the root is taken of the"
        " entries of the pose that vanish there, so that no digits are lost.",
        "two values, exact also where they meet",
    ),
    "linear": Lesson(
        "With r = sqrt(a^2 + b^2) the equation a c + b s = e is r cos(theta - Atan2(b, a)) = e: the angle lies at equal"
        " distances on either side of Atan2(b, a).",
        "two values, and a square root that may not be real",
    ),
    "quadratic": Lesson(
        "The equation is quadratic in the length, with the usual two roots.",
        "two values, and a square root that may not be real",
    ),
    "quartic": Lesson(
        "Two equations are linear in the cosine and the sine of one unknown. Squared and added they lose it, and with"
        " the tangent of half of the other unknown a polynomial of degree four in that one is left (Pieper). The"
        " unknown that was lost follows from the same two equations.",
        "four values, the roots of a polynomial: the last resort",
    ),
}


def comparison(choices: tuple[Choice, ...]) -> str:
    """Why the candidate that was taken was preferred."""
    place = next(number for number, choice in enumerate(choices) if choice.taken)
    taken = choices[place]
    if place:
        cheaper = ", ".join(dict.fromkeys(choice.unknown for choice in choices[:place]))
        return f"What costs less ({cheaper}) was tried and led nowhere: the joints left after it have no rule."
    if len(choices) == 1:
        return "No other equation fits a rule yet."
    second = choices[1]
    if second.cost == taken.cost:
        behind = "its equations are longer" if second.terms > taken.terms else "it comes later in the alphabet"
        if second.rule == taken.rule == "triangle":
            behind = "its triangle is longer, or seen from the tip instead of the base"
        return f"{second.unknown} costs the same, but {behind}."
    if second.rule == taken.rule:
        own = "another of its equations" if second.unknown == taken.unknown else second.unknown
        return f"It costs least: {own} by the same rule costs more."
    return (
        f"It costs least ({LESSONS[taken.rule].price}). Next would be {second.unknown} ({LESSONS[second.rule].price})."
    )
