"""What stands on a page, that nothing of the user's can break it, and that it is the same at every run."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kinsym.check import compare
from kinsym.check.compare import Findings
from kinsym.check.report import FAILED, Check
from kinsym.cli import main
from kinsym.robot import from_inline, load
from kinsym.workspace import reached
from kinsym.workspace.orientations import orientations
from tests.page.pages import Made, Outline, made, make
from tests.test_nominal import FIVE

HOSTILE = '</script><img src=x onerror=alert(1)>{{ 7*7 }} & "quotes" \u2028'
NAMES = ("planar_rr", "stanford_screw", "scorbot_5r", "kuka_iiwa", "general_3r")


@pytest.fixture(params=NAMES)
def arm(request: pytest.FixtureRequest) -> Made:
    return made(request.param)


def test_every_element_ends_and_every_identity_is_there_once(arm: Made) -> None:
    outline = Outline(arm.text)
    identities = [given["id"] for _, given in outline.tags if "id" in given]
    assert len(identities) == len(set(identities))
    referred = [given[key] for _, given in outline.tags for key in ("for", "aria-labelledby") if key in given]
    links = [str(given["href"])[1:] for tag, given in outline.tags if tag == "a"]
    assert {*referred, *links} <= set(identities)


def test_the_page_tells_every_step(arm: Made) -> None:
    words = Outline(arm.text).plain()
    assert arm.derivation.plan is not None
    steps = arm.derivation.plan.steps
    assert all(f"Step{step.number}:" in words for step in steps)
    assert words.count("Solution:") == len(steps)


def test_the_table_shows_every_solution_of_the_first_pose(arm: Made) -> None:
    """The values in the table lead to the pose beside it."""
    rows = re.findall(r'<tr data-branch="(\d+)".*?</tr>', arm.text, re.DOTALL)
    assert rows == [str(number) for number in range(arm.schedule.maximum)]
    assert arm.text.count('class="current"') == 1
    table = arm.text.partition('id="solutions"')[2].partition("</table>")[0]
    kinds = arm.shown.shape.kinds
    cells = re.findall(r'<td class="value">([^<]+)</td>', table)
    values = np.array([float(cell.replace("−", "-").rstrip("°")) for cell in cells]).reshape(-1, len(kinds))
    q = np.where([kind == "R" for kind in kinds], np.radians(values), values)
    off = arm.shown.arm.fk(q) - arm.shown.pose
    assert len(q) == len(arm.shown.solutions) > 0
    assert np.abs(off[:, :3, 3]).max() < 2e-3 * arm.shown.shape.size


def test_the_first_posture_is_inside_the_limits_and_not_singular(arm: Made) -> None:
    q, limits = np.array(arm.shown.q), arm.shown.shape.limits
    assert ((q >= limits[:, 0] - 1e-9) & (q <= limits[:, 1] + 1e-9)).all()
    sizes = np.linalg.svd(arm.shown.arm.module.jacobian(q, **arm.shown.arm.values), compute_uv=False)
    assert sizes.min() > 1e-3 * sizes.max()


def test_the_slice_shows_what_is_reached() -> None:
    """A shaded cell is reached with some orientation, a bare one with none of those that were tried."""
    page = make(load("stanford_arm"))
    svg = page.text.partition('class="slice"')[2].partition("</svg>")[0]
    box = re.search(r'class="sheet" x="0" y="0" width="([\d.]+)" height="([\d.]+)"', svg)
    assert box is not None
    wide, high = map(float, box.groups())
    low_x, high_x, low_z, high_z = (float(text.replace("−", "-")) for text in re.findall(r">([−\d.]+)</text>", svg))
    places = re.findall(r'<rect class="shade\d" x="([^"]+)" y="([^"]+)" width="([^"]+)" height="([^"]+)"', svg)
    cells = [tuple(map(float, place)) for place in places]
    side = min(cell[3] for cell in cells) - 0.5
    assert len(cells) > 20
    points, shaded = [], []
    for column in range(2, int(wide / side) - 1, 7):
        for row in range(2, int(high / side) - 1, 7):
            x, y = (column + 0.5) * side, (row + 0.5) * side
            points.append((low_x + x / wide * (high_x - low_x), 0.0, high_z - y / high * (high_z - low_z)))
            shaded.append(any(a <= x <= a + w and b <= y <= b + h for a, b, w, h in cells))
    inside = reached(page.shown.arm, points, orientations(page.shown.arm, 24)).any(axis=-1)
    assert np.mean(inside == shaded) > 0.95  # the letters at the axes have three digits
    assert 0.2 < np.mean(shaded) < 1.0


def test_nothing_of_the_user_breaks_out() -> None:
    page = make(replace(load("planar_rr"), title=HOSTILE, source=HOSTILE))
    outline = Outline(page.text)
    assert "img" not in {tag for tag, _ in outline.tags}
    assert "{{7*7}}" in outline.plain()
    assert [tag for tag, _ in outline.tags].count("script") == 2


def test_the_policy_names_style_and_script_and_nothing_else(arm: Made) -> None:
    (policy,) = [
        str(given["content"])
        for tag, given in Outline(arm.text).tags
        if tag == "meta" and given.get("http-equiv") == "Content-Security-Policy"
    ]
    rules = dict(rule.split(maxsplit=1) for rule in policy.split("; "))
    assert rules.pop("default-src") == "'none'"
    for element, rule in (("style", "style-src"), ("script", "script-src")):
        (text,) = re.findall(f"<{element}>(.*?)</{element}>", arm.text, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert rules.pop(rule) == f"'sha256-{digest}'"
    assert set(rules.values()) == {"'none'"}
    assert "http://" not in arm.text.replace("http://www.w3.org", "")
    assert " style=" not in arm.text


def test_the_data_is_json_that_cannot_end_its_element(arm: Made) -> None:
    (data,) = re.findall(r'<script type="application/json" id="robot">(.*?)</script>', arm.text, re.DOTALL)
    assert "<" not in data
    assert json.loads(data)["q"] == list(arm.shown.q)


def test_the_same_robot_gives_the_same_bytes() -> None:
    assert make(load("stanford_screw")).text == made("stanford_screw").text


def test_an_arm_next_to_a_special_one_shows_both() -> None:
    """The closed form of the nominal arm, then the general solver's steps."""
    page = make(replace(from_inline(FIVE, convention="paul", name="five"), nominal=True))
    outline = Outline(page.text)
    nominal = page.derivation.nominal
    assert nominal is not None
    assert nominal.derivation.plan is not None
    words = outline.plain()
    assert words.count("Solution:") == len(nominal.derivation.plan.steps)
    assert "ClosedformoftheNominalarm".lower() in words.lower()
    assert "polynomialofdegree" in words
    assert "function candidates" not in page.text


def test_a_parameter_without_a_number_gets_a_slider_and_one_with_a_number_none() -> None:
    page = make(from_inline("pi/2 0 d1 theta1; 0 a2 0 theta2; beta 0.3 0 theta3", convention="paul", name="mixed"))
    assert re.findall(r'data-parameter="(\d)"', page.text) == ["0", "1", "2"]


@pytest.mark.usefixtures("few_poses")
def test_the_command_writes_the_page_with_its_checks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "arm.html"
    assert main(["report", "planar_rr", "-o", str(target)]) == 0
    words = Outline(target.read_text(encoding="utf-8")).plain()
    assert "Verdict:passed" in words
    assert "deffk(q,*,l1,l2)" in words
    assert str(target) in capsys.readouterr().out


def test_a_page_that_is_there_is_replaced_only_by_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "planar_rr.html").write_text("mine")
    assert main(["report", "planar_rr", "--no-check"]) == 2
    assert "planar_rr.html is there already" in capsys.readouterr().err
    assert (tmp_path / "planar_rr.html").read_text() == "mine"
    (tmp_path / "folder").mkdir()
    assert main(["report", "planar_rr", "--no-check", "-o", "folder"]) == 2
    assert "is a folder" in capsys.readouterr().err


def test_a_failed_check_stands_on_the_page_and_in_the_exit_status(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    failed = Check(law="planted", subject="C", status=FAILED, failed=3)
    figures = {"poses": 1, "poses_by_kind": {"uniform": 1}}
    monkeypatch.setattr(compare, "compare", lambda *_: Findings(checks=(failed,), figures=figures, measured={}))
    assert main(["report", "planar_rr", "-o", str(tmp_path / "arm.html"), "--quiet"]) == 1
    assert "Verdict:failed" in Outline((tmp_path / "arm.html").read_text(encoding="utf-8")).plain()
