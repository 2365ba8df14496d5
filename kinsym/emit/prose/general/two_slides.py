"""Two joints that slide: the orientation is a matter of four angles, one of them the root of a polynomial."""

from __future__ import annotations

from collections.abc import Iterator

from kinsym.emit.prose.general.loop import Loop
from kinsym.emit.prose.general.stage import Formula, Stage, inline


class TwoSlides(Loop):
    """The words of a plan for two sliding joints: the orientation is a matter of four angles."""

    def stages(self) -> Iterator[Stage]:
        """All of them."""
        yield self._loop()
        yield self._orientation()
        yield self._plane()
        yield self._rest()
        yield self._polish()

    @property
    def _turning(self) -> list[str]:
        """The four joints that turn, the suppressed one first."""
        order = [self.cut.order[k % 6] for k in range(2, 8)]
        return [self.variables[number - 1] for number in order if self.plan.kinds[number - 1] == "R"]

    @property
    def _slides(self) -> list[str]:
        order = [self.cut.order[k % 6] for k in range(2, 8)]
        return [self.variables[number - 1] for number in order if self.plan.kinds[number - 1] == "P"]

    def _orientation(self) -> Stage:
        first, second, third, fourth = self._turning
        names = ", ".join(map(inline, (first, second, third, fourth)))
        return Stage(
            (third, second, fourth),
            f"from the orientation, for a value of {first}",
            (
                f"A slide turns nothing: the orientation of the loop is a matter of {names}, of which {{Rk}} are the"
                " turns and {Ak} the constant rotations between them:",
                Formula(
                    ("R1 A1 R2 A2 R3 A3 R4 A4", "I"),
                    (r"R_{1} A_{1} R_{2} A_{2} R_{3} A_{3} R_{4} A_{4}", "I"),
                ),
                f"With {{u = A1^T R1^T A4^T z}} the entry {{zz}} of {{A2 R3 A3}} gives two values of {inline(third)}:",
                Formula(
                    ("a cos t + b sin t", "u_z - (A2)_zz (A3)_zz"),
                    (r"a \cos t + b \sin t", r"u_{z} - (A_{2})_{zz} (A_{3})_{zz}"),
                ),
                Formula(
                    ("a", "(A2)_zx (A3)_xz + (A2)_zy (A3)_yz,  b = (A2)_zy (A3)_xz - (A2)_zx (A3)_yz"),
                    (
                        "a",
                        r"(A_{2})_{zx} (A_{3})_{xz} + (A_{2})_{zy} (A_{3})_{yz} , \quad"
                        r" b = (A_{2})_{zy} (A_{3})_{xz} - (A_{2})_{zx} (A_{3})_{yz}",
                    ),
                ),
                "Then {R2} turns {A2 R3 A3 z} into {u}, and {R4} is what is left.",
            ),
        )

    def _plane(self) -> Stage:
        unknown, slides = self._turning[0], " and ".join(map(inline, self._slides))
        name = self.name(unknown)
        return Stage(
            (unknown,),
            "the root of a polynomial of degree 8",
            (
                f"Going round the loop adds up to {{r}} and to {slides} times their directions {{k1}} and {{k2}}. It"
                " closes if the three vectors lie in one plane; with {rho^2 = 1 - u_z^2} and both roots {+} and {-}:",
                Formula(
                    (f"f({unknown})", "rho^2 det[k1 k2 r]_+ det[k1 k2 r]_- = 0"),
                    (f"f({name})", r"\rho^{2} \det[k_{1}\, k_{2}\, r]_{+} \det[k_{1}\, k_{2}\, r]_{-} = 0"),
                ),
                "It is a trigonometric polynomial of degree 4, so there are at most eight solutions. Its coefficients"
                " follow from samples, its real roots are isolated on eight arcs of the circle by Descartes' rule.",
            ),
        )

    def _rest(self) -> Stage:
        one, two = self._slides
        return Stage(
            (one, two),
            "by least squares",
            (
                Formula(
                    (f"{one} k1 + {two} k2", "-r"),
                    (f"{self.name(one)} k_{{1}} + {self.name(two)} k_{{2}}", "-r"),
                ),
            ),
        )
