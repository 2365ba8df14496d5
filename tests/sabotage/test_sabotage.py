"""Mutants of one small arm: what changes a result is caught, what changes none is told from it, and nothing hangs."""

import math
from dataclasses import replace

import pytest

from tests import arms
from tests.emit.built import needs_compiler
from tests.sabotage import c_text, python_text, run
from tests.sabotage.mutant import BRANCH, CONSTANT, GUARD, KINDS, PARAMETER, SIGN, TRIG, Mutant, turned
from tests.sabotage.reasons import BANDS, LANES, REST, STARTS, WINDINGS, reason_of
from tests.sabotage.record import Record
from tests.sabotage.run import CAUGHT, CRASHED, ENDLESS, EQUAL, LANGUAGES, STILLBORN, SURVIVED, Outcome, Sabotage
from tests.sabotage.table import lines, percent, section
from tests.sabotage.transcript import ROUNDING, difference

ROBOT = "planar_rr"
SAMPLE = 4
C = """
#define NEAR 2.5
#ifdef __cplusplus
x = 7.0;
#endif
/* a - b */
int f(double a1, double a2)
{
    if (a1 > 1.5 && ok(a2)) {
        return -1;
    }
    for (int i = 0; i < n1; ++i) {
        y += c1 * a1 - s1;
    }
    return a1 > 0.0 ? 1 : 2;
}
"""
PYTHON = """
def f(a1, a2):
    if not a1 > 1.5:
        raise ValueError("a1 - a2")
    return c1 * a1 - s1 if ok and a2 else -math.cos(a1)
"""


@pytest.fixture(scope="module")
def sabotage():
    return Sabotage(arms.derivation(ROBOT))


def changes(mutants, kind):
    return sorted(mutant.make() for mutant in mutants if mutant.kind == kind)


def test_changes_of_c():
    found = c_text.mutants(C, ("a1", "a2"))
    assert {mutant.kind for mutant in found} == set(KINDS)
    assert changes(found, SIGN) == sorted(
        [C.replace("return -1", "return  1"), C.replace("+=", "-="), C.replace("a1 - s1", "a1 + s1")]
    )
    assert C.replace("&& ok(a2)", "") in changes(found, GUARD)
    assert C.replace("(a1 > 1.5 && ok(a2))", "(0)") in changes(found, GUARD)
    assert C.replace("i < n1", "i < n1 - 1") in changes(found, BRANCH)
    assert C.replace("2.5", "2.5000025") in changes(found, CONSTANT)
    assert not any("7.000007" in text for text in changes(found, CONSTANT))
    assert changes(found, TRIG) == sorted([C.replace("c1 *", "s1 *"), C.replace("- s1", "- c1")])
    assert len(changes(found, PARAMETER)) == 4


def test_changes_of_python():
    found = python_text.mutants(PYTHON, ("a1", "a2"))
    assert changes(found, SIGN) == sorted([PYTHON.replace("a1 - s1", "a1 + s1"), PYTHON.replace("-math", "math")])
    assert changes(found, GUARD) == sorted([PYTHON.replace("not a1 > 1.5", "False"), PYTHON.replace(" and a2", "")])
    assert changes(found, BRANCH) == sorted(PYTHON.replace("ok and a2", value) for value in ("False", "True"))
    assert PYTHON.replace("math.cos", "math.sin") in changes(found, TRIG)
    assert changes(found, CONSTANT) == [PYTHON.replace("1.5", repr(1.5 * (1 + 1e-6)))]


def test_names_of_sines_and_cosines():
    assert [turned(name) for name in ("c1", "s23", "c2m3", "c", "size", "cos", "m1")] == [
        "s1", "c23", "s2m3", "s", None, None, None
    ]  # fmt: skip


def test_a_rotation_that_is_known_to_few_digits_tells_no_more_of_its_solutions(sabotage):
    (each, *_), label = sabotage._inputs, "near solutions of choice 0"
    good = {label: each.q[:, None].copy()}

    def gap(row):
        found = good[label].copy()
        found[row] += 1e-8
        return difference(good, {label: found}, [each]).size

    assert each.noise[0] > 1e-7 > each.noise[each.ordinary[0]] == 0.0
    assert 0.0 < gap(0) <= ROUNDING
    assert gap(each.ordinary[0]) == math.inf


@needs_compiler
@pytest.mark.parametrize("language", LANGUAGES)
def test_what_changes_a_result_is_caught(sabotage, language):
    outcomes = [sabotage.try_out(mutant) for mutant in sabotage.sample(language, SAMPLE, 1)]
    assert [one for one in outcomes if one.outcome == SURVIVED] == []
    assert any(one.outcome == CAUGHT for one in outcomes)
    assert sabotage.sample(language, SAMPLE, 1)[0].where == outcomes[0].mutant.where


@needs_compiler
@pytest.mark.parametrize(
    ("change", "outcome", "reason"),
    [
        (("c1 = cos(theta1);", "c1 = sin(theta1);"), CAUGHT, "forward kinematics"),
        (("int count = 0;\n", "int count = 0; for (;;) { count = (count + 1) % 7; }\n"), CAUGHT, ENDLESS),
        (("int count = 0;\n", "int count = 0; *(volatile int *)8 = 1;\n"), CAUGHT, CRASHED),
        (("int count = 0;\n", "int count = 0 + 0;\n"), EQUAL, ""),
        (("int count = 0;\n", "int count = ;\n"), STILLBORN, ""),
    ],
    ids=["wrong", "endless", "crashing", "the same", "no program"],
)
def test_one_mutant(sabotage, monkeypatch, change, outcome, reason):
    monkeypatch.setattr(run, "SECONDS", 4)
    base = sabotage.mutants(c_text.LANGUAGE)[0]
    text = run.c_source(sabotage.schedule)
    assert change[0] in text
    found = sabotage.try_out(replace(base, make=lambda: text.replace(*change)))
    assert found.outcome == outcome
    assert reason in found.reason


def test_a_change_is_named_by_its_function():
    assert [mutant.where.partition(":")[0] for mutant in c_text.mutants(C, ())][:2] == ["the head, line 2", "f, line 9"]
    assert {mutant.where.partition(",")[0] for mutant in python_text.mutants(PYTHON, ())} == {"f"}


def test_what_was_tried_is_kept(tmp_path):
    mutant = Mutant(language="c", kind=SIGN, where="f, line 7:3", before="a + b", after="a - b", make=str)
    outcome = Outcome(robot="one", mutant=mutant, outcome=CAUGHT, reason="C: a law")
    assert Record(tmp_path / "kept").find("one", mutant) is None
    assert Record(tmp_path / "kept").keep(outcome) == outcome
    again = Record(tmp_path / "kept")
    assert again.find("one", mutant) == outcome
    assert again.find("two", mutant) is again.find("one", replace(mutant, after="a * b")) is None
    assert Record(None).keep(outcome) == outcome


def test_reasons_are_told_by_the_part_of_the_code():
    def told(where, language="c"):
        base = Mutant(language=language, kind=SIGN, where=where, before="", after="", make=str)
        return reason_of("arm", base)

    assert told("arm_within, line 1:1") == told("_windings, line 1:1", "numpy") == WINDINGS
    assert told("lane_triangle, line 1:1") == told("_scalar_triangle, line 2:2") == told("solve_triangle, x") == BANDS
    assert told("solve_block, line 1:1") == LANES
    assert told("step 1, theta2, reference", "plan") == STARTS
    assert told("fk, line 1:1") == REST


def test_the_table_has_the_score_and_the_survivors():
    mutant = Mutant(language="c", kind=SIGN, where="line 7", before="a + b", after="a - b", make=str)
    caught = [Outcome(robot="one", mutant=mutant, outcome=CAUGHT, reason="C: a law")] * 299
    lived = Outcome(robot="one", mutant=mutant, outcome=SURVIVED, reason="near solutions of choice 0")
    assert percent(caught) == "100.0"
    assert percent([*caught, lived]) == "99.6"
    same = Outcome(robot="one", mutant=replace(mutant, where="polish, line 9:1"), outcome=EQUAL, reason="")
    text = "\n".join(section({("one", "c"): [*caught, lived, same]}, "python -m tests.sabotage one"))
    assert "    python -m tests.sabotage one\n" in text
    assert "| one | 301 | 299 | 1 | 1 | 0 | 0 | 99.6 |" in text
    assert "| 1 | a root is moved onto its pose" in text
    assert "| a law | 299 |" in text
    assert "SURVIVED (near solutions of choice 0): one, c, line 7: sign flipped: a + b -> a - b" in text
    assert lines("one", "c", [lived])[1].endswith("a + b -> a - b")
