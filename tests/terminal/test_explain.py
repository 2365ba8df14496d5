"""``kinsym explain``: it tells what was derived, leaves out nothing that is needed, and tells nothing else."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from kinsym.algebra.tree import Definition, symbols
from kinsym.cli import main
from kinsym.deriving import derive
from kinsym.emit.prose.lessons import LESSONS, comparison
from kinsym.emit.text.explain import explanation
from kinsym.emit.text.explain_general import elimination
from kinsym.emit.text.page import Page
from kinsym.inverse.choices import Choice, _met, choices
from kinsym.inverse.needed import needed, solvable
from kinsym.inverse.plan import Step, Window
from kinsym.inverse.rules import TITLES
from kinsym.inverse.rules.base import Names
from kinsym.inverse.search import ranked
from kinsym.inverse.state import shortened, start
from kinsym.robot import load
from tests.arms import PUMA, derivation

ARMS = ("fanuc_s900w", "ur5", "stanford_paul", "scorbot_5r", "five_joints", "parallel_123", "planar_rpr")
PAGE = Page(width=80)


def test_every_rule_has_a_lesson() -> None:
    """A rule that is added needs one, and none is left of a rule that has gone."""
    assert set(LESSONS) == set(TITLES)


@pytest.mark.parametrize("name", ARMS)
def test_the_choices_are_those_of_the_search(name: str) -> None:
    """Every step was chosen or came with the one before; the cheapest candidate stands first and was taken."""
    found = derivation(name)
    assert found.plan is not None
    met = choices(found.solved, found.plan)
    for step in found.plan.steps:
        if step.number not in met:
            before = found.plan.steps[step.number - 2]
            assert (before.rule, step.rule) in {
                ("triangle", "direction"),
                ("quartic", "quotient"),
                ("linear", "length"),
                ("length", "quotient"),
            }
            continue
        order = [(choice.cost, choice.terms, choice.unknown) for choice in met[step.number]]
        assert order == sorted(order)
        taken = [choice for choice in met[step.number] if choice.taken]
        assert [(choice.unknown, choice.rule) for choice in taken] == [(step.unknown, step.rule)]
        assert taken[0] == met[step.number][0]


def test_the_one_that_was_taken_is_marked_wherever_it_stands() -> None:
    """After a dead end the search goes on with a later candidate: each of them, in turn, is the beginning of a way."""
    found = derivation("planar_rpr")
    assert found.plan is not None
    state, _ = start(found.solved, found.plan.task)
    while (step := shortened(state)) is not None:
        state = step[0]
    names = Names(set(found.solved.ring.index))
    every = list(ranked(state))
    assert len(every) > 1
    for place, candidate in enumerate(every):
        outcome = candidate.build(Names(set(names.taken)))
        met = _met(state, names, [item for item in outcome.items if isinstance(item, Step)])
        assert met is not None
        assert [number for number, choice in enumerate(met[1]) if choice.taken] == [place]
        assert met[0] == outcome


def test_a_plan_of_another_search_has_no_choices() -> None:
    """The steps are compared with what the search meets, not taken on trust."""
    one, other = derivation("planar_rr"), derivation("scara")
    assert other.plan is not None
    assert choices(one.solved, other.plan) == {}


@pytest.mark.parametrize("name", ARMS)
def test_what_is_needed_is_there_and_nothing_more(name: str) -> None:
    """Every name of the kept items is found before it is read; each step kept finds something that is read later."""
    found = derivation(name)
    plan = found.plan
    assert plan is not None
    made = {name for item in plan.items for name in _made(item)}
    for unknown in solvable(plan):
        items = needed(plan, unknown)
        known: set[str] = set()
        wanted = {unknown, *(n for value in plan.values if value.variable == unknown for n in symbols(value.value))}
        for item in items:
            inside: set[str] = set()
            for definition in item.definitions if isinstance(item, Window) else ():
                assert set(symbols(definition.value)) & made <= known | inside
                inside.add(definition.name)
            if not isinstance(item, Window):
                assert _read(item) & made <= known | set(_made(item))
            known.update(_made(item))
        assert wanted & made <= known
        for place, item in enumerate(items):
            if isinstance(item, Step):
                later = {n for other in items[place + 1 :] for n in _read(other)}
                assert set(_made(item)) & (wanted | later)


def _made(item: Definition | Window | Step) -> list[str]:
    if isinstance(item, Step):
        return [item.unknown, *item.outputs, *(definition.name for definition in item.coefficients)]
    return [one.name for one in (item.definitions if isinstance(item, Window) else (item,))]


def _read(item: Definition | Window | Step) -> set[str]:
    if isinstance(item, Step):
        trees = [*item.inputs.values(), *(definition.value for definition in item.coefficients)]
    else:
        trees = [one.value for one in (item.definitions if isinstance(item, Window) else (item,))]
    return {name for tree in trees for name in symbols(tree)}


def test_one_angle_of_the_fanuc_arm() -> None:
    """theta3 after theta1 and nothing else: equation, its place, rule, solution, branches and borders."""
    found = derivation("fanuc_s900w")
    assert found.plan is not None
    text = explanation(found, found.plan, ["theta3"], PAGE)
    assert re.findall(r"^Step \d: \w+$", text, re.MULTILINE) == ["Step 1: theta1", "Step 2: theta3"]
    for line in (
        "  Known: the pose and theta1. Wanted: theta3. Open after it: theta2, theta4,",
        "      p16_x = c1*p06_x + s1*p06_y - a1",
        "    rows x and y, column p of T_1_6 = A2 A3 A4 A5 A6:",
        "      p16_x = a2*c2 + a3*c23 + d4*s23",
        "  Rule: two-link triangle (square and add)",
        "      taken    28  theta3        2  two-link triangle (square and add)",
        "               32  theta3        2  one linear equation a c + b s = e",
        "    theta3 = Atan2(s3, c3)",
        "    +: elbow down (shoulder right) or elbow up (shoulder left)",
        "    real if k_3^2 <= lambda1^2",
    ):
        assert f"\n{line}\n" in text
    assert "w16_x" not in text
    assert "theta1 is free; theta2 and theta3 stay constant;" in text


def test_sums_are_taken_apart_at_last() -> None:
    """theta4 of a UR5 is theta234 less what it holds, which takes every step; theta234 itself takes two."""
    found = derivation("ur5")
    assert found.plan is not None
    assert explanation(found, found.plan, ["theta4"], PAGE).endswith(
        "At last\n-------\n  theta4 = theta234 - theta2 - theta3\n  taken into (-pi, pi].\n"
    )
    assert explanation(found, found.plan, ["theta234"], PAGE).count("\nStep ") == 2


@pytest.mark.parametrize("name", ["ur5", "kuka_iiwa", "stanford_paul", "planar_rrr_screw"])
def test_everything_fits_80_columns(name: str) -> None:
    """The walk through all of an arm."""
    found = derivation(name)
    assert found.plan is not None
    text = explanation(found, found.plan, solvable(found.plan), PAGE)
    assert max(map(len, text.splitlines())) <= 80
    assert text.count("\nStep ") == len(found.plan.steps)


def test_a_cheaper_way_that_led_nowhere_is_told() -> None:
    """And what costs the same or more is compared."""
    cheap = Choice(unknown="theta2", rule="direct", branches=1, cost=0, terms=4, taken=False)
    taken = Choice(unknown="theta1", rule="linear", branches=2, cost=30, terms=6, taken=True)
    dear = Choice(unknown="theta3", rule="linear", branches=2, cost=30, terms=9, taken=False)
    assert comparison((cheap, taken)).startswith("What costs less (theta2) was tried and led nowhere")
    assert comparison((taken,)) == "No other equation fits a rule yet."
    assert comparison((taken, dear)) == "theta3 costs the same, but its equations are longer."
    first = replace(cheap, taken=True)
    assert comparison((first, dear)).startswith("It costs least (one value, and nothing to divide by). Next would be ")
    assert comparison((first, replace(dear, rule="direct"))) == "It costs least: theta3 by the same rule costs more."


def test_an_arm_next_to_a_special_one(capsys: pytest.CaptureFixture[str]) -> None:
    """It is said that the closed form is the special arm's."""
    rows = PUMA.replace(" a2 ", " 0.4318 ").replace("a3 d3", "0.0203 0.15005").replace("0 d4", "0.0005 0.4318")
    words = ["explain", "--dh", rows, "--convention", "paul", "--exact", "--nominal", "theta1"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert out.startswith("This arm has no closed form of its own.")
    assert "theta1 = Atan2(p_x, -p_y)" in out


def test_an_arm_without_a_closed_form() -> None:
    """The elimination up to the unknown that was asked for, and why it is needed."""
    found = derive(load("ufactory_xarm6"))
    assert found.general is not None
    text = elimination(found, found.general, ["theta4"], PAGE)
    assert "no rule\n  applies to the equations that are left" in text
    assert "theta4 is known after step 5; what comes later is left out here." in text
    assert "  5. theta4: the root of a polynomial of degree 16\n" in text
    assert text.count("  6. ") == 1
    variables = [joint.variable for joint in found.solved.joints]
    for variable in variables:
        assert f"\n  {variable} is known after step" in elimination(found, found.general, [variable], PAGE)
    whole = elimination(found, found.general, variables, PAGE)
    assert whole.count("  8. polished, sorted\n") == 2
    assert max(map(len, whole.splitlines())) <= 80


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["planar_rr", "theta2"], 0, "How theta2 is found"),
        (["--dh", "0 a1 0 theta1; 0 a2 0 theta2", "--convention", "paul", "theta2"], 0, "How theta2 is found"),
        (["planar_rr"], 0, "How the inverse kinematics is found"),
        (["planar_rr", "thta2"], 2, "planar_rr: no step finds 'thta2'. Did you mean theta2?"),
        (["kuka_iiwa", "theta3"], 2, "theta3 is locked: it is given, not solved for"),
        (["planar_r"], 2, "Did you mean planar_rr?"),
    ],
)
def test_the_command(words: list[str], status: int, told: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A wrong name gets the nearest one."""
    assert main(["explain", *words]) == status
    out, err = capsys.readouterr()
    assert told in (err if status else out)
