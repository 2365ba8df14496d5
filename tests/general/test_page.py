"""What the terminal and the document say of an arm without a closed form."""

from __future__ import annotations

import pytest

from kinsym.emit.latex import document
from kinsym.emit.text import equations
from tests.general.arms import derived


@pytest.mark.parametrize("name", ["random1", "crx10ia", "slide3"])
def test_the_steps_name_every_joint_and_why(name: str) -> None:
    derivation = derived(name)
    plan = derivation.general
    assert plan is not None
    page = equations(derivation)
    steps = page[page.index("Inverse kinematics") :]
    for joint in derivation.chain.joints:
        assert joint.variable in steps
    assert "no closed form for theta1" in steps
    assert f"Opened behind joint {plan.cuts[0].dropped}" in steps
    assert f"f(theta{plan.cuts[0].suppressed})" in steps
    assert "at most 16 solutions" in steps
    assert ("two ranks" in steps) == plan.cuts[0].bordered
    assert "{" not in steps
    assert all(len(line) <= 96 for line in steps.splitlines())


def test_two_slides_have_a_page_of_their_own() -> None:
    page = equations(derived("slide24"))
    steps = page[page.index("Inverse kinematics") :]
    assert "R1 A1 R2 A2 R3 A3 R4 A4 = I" in steps
    assert "at most 8 solutions" in steps
    text = document(derived("slide24"))
    assert r"\rho^{2} \det[k_{1}" in text
    assert "$R_{2}$ turns $A_{2} R_{3} A_{3} z$ into $u$" in text


def test_five_joints_are_completed() -> None:
    assert "turns the tool about its own axis by an angle phi" in " ".join(equations(derived("five1")).split())
    assert r"\phi" in document(derived("five1"))


@pytest.mark.parametrize("name", ["random1", "crx10ia", "slide3"])
def test_the_document_sets_its_mathematics(name: str) -> None:
    text = document(derived(name))
    section = text[text.index(r"\section{Inverse kinematics}") :]
    assert r"\psi_{0}" in section
    assert r"P\ 14 \times 27" in section
    assert "textasciicircum" not in section
    assert r"\{" not in section
    assert section.count(r"\subsection*{Step ") == 8
