"""What notebooks typeset: Markdown whose mathematics MathJax and KaTeX know, and in which no word is a mark."""

from __future__ import annotations

import re
from functools import cache
from html import unescape

import pytest

import kinsym as ks
from kinsym.display import Displayed
from kinsym.emit.markdown.words import words
from kinsym.methods import METHODS
from kinsym.robot.files import from_draft

# Commands of the TeX input of MathJax 3 (packages base and ams) that KaTeX has as well; every formula of these pages
# was also given to both of them (mathjax-full 3.2, katex 0.16 in its strict mode).
COMMANDS = set(
    r"""\\ \, \; \  \begin \end \tag \notag \quad \qquad \text \mathrm \operatorname \frac \tfrac \sqrt \vec \sum \det
    \sin \cos \tan \bigl \bigr \Bigl \Bigr \biggl \biggr \lbrace \rbrace \lvert \rvert \pm \times \cdot \arctan
    \le \ge \ne
    \neq \alpha \beta \gamma \delta \epsilon \zeta \eta \theta \iota \kappa \lambda \mu \nu \xi \pi \rho \sigma \tau
    \upsilon \phi \chi \psi \omega \Gamma \Delta \Theta \Lambda \Xi \Pi \Sigma \Phi \Psi \Omega \_""".split()
) | {"\\ "}
ENVIRONMENTS = {"align", "align*", "equation", "bmatrix"}
MATHEMATICS = re.compile(
    r"\$\$.*?\$\$|\\begin\{(align\*?|equation)\}.*?\\end\{\1\}|\$[^$\n]+\$",
    re.DOTALL,
)

HOSTILE = from_draft(
    {
        "name": "hostile",
        "title": "50% of $x_1$ <script>alert(1)</script> \\input{a} | **b** `c` [d](e) # &amp; ~~f~~ # g",
        "convention": "paul",
        "joints": [
            {"type": "R", "alpha": "deg(30)", "a": "a_1", "d": "0", "theta": "theta1"},
            {"type": "P", "alpha": "0", "a": "a1", "d": "d2", "theta": "0"},
        ],
        "base": {"xyz": ["b", "0", "sqrt(2)"], "rpy": ["0", "0", "pi/4"]},
        "parameters": {"a1": "0.25"},
    },
    where="hostile",
)
NAMES = ("puma560", "stanford_screw", "planar_rr", "raven_2")
PAGES = [
    *((name, part) for name in NAMES for part in ("robot", "fk", "ik", "jacobian", "singular")),
    *(("puma560", method) for method in ("pieper", "zyz", "craig", "screws", "half_angle")),
    *(("planar_rrr_craig", method) for method in ("loop_closure", "geometric", "algebraic", "frames")),
    ("planar_rr", "workspace"),
    ("elbow_6r_screw", "screws_inverse"),
]


@cache
def derived(name: str) -> ks.Solution:
    return ks.derive(HOSTILE if name == "hostile" else ks.load(name))


def object_of(name: str, part: str) -> Displayed:
    """A page's object: a part of the derivation, or a method applied to the robot."""
    if part in METHODS:
        return METHODS[part](ks.load(name))
    thing = getattr(derived(name), part)
    assert isinstance(thing, Displayed)
    return thing


def formulas(page: str) -> list[str]:
    return [match[0] for match in MATHEMATICS.finditer(page)]


def check(page: str) -> None:
    """Only known commands and environments, all in mathematics; braces, dollars and table cells in their pairs."""
    inside = formulas(page)
    unknown = {command for text in inside for command in re.findall(r"\\(?:[A-Za-z]+|.)", text)} - COMMANDS
    assert unknown == set()
    assert {name for text in inside for name in re.findall(r"\\begin\{(.*?)\}", text)} <= ENVIRONMENTS
    for text in inside:
        plain = re.sub(r"\\.", "", text)
        assert plain.count("{") == plain.count("}"), text
        assert "|" not in plain, text
        assert "&#" not in text, text
    outside = MATHEMATICS.sub("", page)
    assert not re.search(r"[\\$<>]", outside), outside
    assert "\n\n\n" not in page
    assert page == page.strip()
    for line in page.splitlines():
        assert line == line.rstrip()


@pytest.mark.parametrize(("name", "part"), PAGES, ids=str)
def test_pages_hold_what_front_ends_know(name: str, part: str) -> None:
    bundle = object_of(name, part)._repr_mimebundle_()
    assert list(bundle) == ["text/plain", "text/markdown"]
    check(bundle["text/markdown"])
    assert "\\" not in bundle["text/plain"]
    assert "dataclass" not in bundle["text/plain"]


def test_the_steps_stand_in_the_derivation() -> None:
    whole = derived("puma560").ik.markdown()
    for step in derived("puma560").ik:
        check(step.markdown())
        assert step.markdown().splitlines()[-1] in whole
    theta4 = derived("puma560").ik["theta4"].markdown()
    assert theta4.startswith(r"**Step 4: $\theta_{4}$** by homogeneous equation $a c + b s = 0$; two solutions.")
    assert r"If ${}^{1}w_{6,z}^{2} + {}^{3}w_{6,x}^{2} = 0$ the unknown $\theta_{4}$ is free" in theta4


def test_tables_have_as_many_cells_as_heads() -> None:
    for page in (derived("puma560").markdown(), derived("raven_2").robot.markdown(), HOSTILE.markdown()):
        widths = [line.count("|") for line in page.splitlines() if line.startswith("|")]
        assert len(widths) > 2
        for table in re.findall(r"(?:^\|.*\n?)+", page, re.MULTILINE):
            assert len({line.count("|") for line in table.splitlines()}) == 1, table


def test_the_page_of_everything_holds_its_parts() -> None:
    found = derived("planar_rr")
    whole = found.markdown()
    check(whole)
    for part in (found.robot.markdown(), found.fk.markdown(), found.ik.markdown(), found.singular.markdown()):
        assert part in whole


def test_an_arm_beside_a_special_one_shows_both() -> None:
    """A wrist whose axes miss each other by a tenth of a millimetre: no closed form, beside one that has one."""
    from dataclasses import replace
    from fractions import Fraction

    robot = ks.bind(ks.load("puma560"), {"a2": Fraction("0.4318"), "a3": Fraction("0.0203")})
    joints = list(robot.joints)
    joints[4] = replace(joints[4], a=joints[4].a + type(joints[1].a)(1) / 10000)
    page = ks.derive(replace(robot, joints=tuple(joints), nominal=True)).ik.markdown()
    check(page)
    assert "Closed form of the nominal arm, then Newton" in page
    assert "**Step 6: $\\theta_{6}$**" in page
    assert "root of a polynomial" in page


def test_a_title_is_words() -> None:
    """Whatever a file says stays text: no markup, no formula, no command, no cell of a table."""
    page = derived("hostile").robot.markdown()
    check(page)
    title = page.splitlines()[0]
    assert (
        unescape(title) == "**50% of $x_1$ <script>alert(1)</script> \\input{a} | **b** `c` [d](e) # &amp; ~~f~~ # g**"
    )
    assert not re.search(r"[<>$`|\[\]\\~]|\*\*.*\*\*.*\*\*", title)
    assert r"\mathrm{a\_1}" in page or r"$a_{1}$" in page
    assert r"T_{\mathrm{base}}" in page
    check(derived("hostile").markdown())
    assert words("a\u202eb\x00c") == "abc"


def test_locked_joints_are_named_with_their_values() -> None:
    """An input of the solver, and one that stands at a value."""
    assert "Locked: $\\theta_{3}$, an input of the inverse kinematics" in ks.load("kuka_iiwa").markdown()
    held = ks.lock(ks.load("kuka_iiwa"), {"theta3": "pi/4", "theta5": "0.3"}).markdown()
    check(held)
    assert "Locked: $\\theta_{3} = \\pi/4$, $\\theta_{5} = 0.3$." in held


def test_an_equation_alone_keeps_its_number() -> None:
    """The page of a method counts its equations, and sentences refer to them by that number."""
    page = METHODS["pieper"](ks.load("puma560"))
    one = page.equation("theta3.collected")
    assert f"\\tag{{{one.number}}}" in one.markdown()
    assert formulas(one.markdown()) == [one.markdown()]
    assert one.text().startswith(f"  ({one.number})")
    numbers = [int(number) for number in re.findall(r"\\tag\{(\d+)\}", page.markdown())]
    assert numbers == sorted(set(numbers) & {equation.number for equation in page.equations})
    assert {page.equation(name).number for name in ("f1", "theta3.collected", "theta6")} <= set(numbers)
    assert f"Put into ({page.equation('theta3.equation').number})" in page.markdown()
    assert "\\label" not in page.markdown()


def test_what_has_no_page_says_so() -> None:
    with pytest.raises(TypeError, match="a Displayed has no page"):
        Displayed().markdown()
    with pytest.raises(TypeError, match="a Displayed has no page"):
        Displayed().text()
