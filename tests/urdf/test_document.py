"""What is wrong with a URDF file is one message with its place; nothing in it is run, fetched or expanded."""

from __future__ import annotations

import builtins
import contextlib
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kinsym.cli import main
from kinsym.errors import RobotError
from kinsym.robot import load
from kinsym.robot.urdf.document import LARGEST_FILE, read_urdf
from tests.urdf.trees import J, urdf, write

TWO = (J("j1", "revolute", "a", "b"), J("j2", "revolute", "b", "c", "0.4 0 0"))


def with_joint(**changes: str) -> str:
    """A file whose second joint is changed."""
    return urdf(TWO[0], J(**{**vars(TWO[1]), **changes}))


BAD: dict[str, tuple[str, str]] = {
    "not XML": ("name = 'arm'", "this is not XML"),
    "cut off": (urdf(*TWO)[:-20], "this is not XML"),
    "empty": ("", "this is not XML"),
    "nested too deeply": ("<robot>" + "<a>" * 5000 + "</a>" * 5000 + "</robot>", "this is not XML"),
    "another root": ("<sdf><model/></sdf>", "the root element is 'sdf', not <robot>"),
    "xacro": ('<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arm/></robot>', "this is xacro"),
    "no joints": ('<robot name="arm"><link name="a"/></robot>', "the file has no joints"),
    "NaN": (with_joint(xyz="0 nan 0"), "joint j2, origin xyz: NaN and infinity"),
    "infinity": (with_joint(rpy="0 -inf 0"), "joint j2, origin rpy: NaN and infinity"),
    "unit": (with_joint(xyz="0.1m 0 0"), "'0.1m' is not a decimal number"),
    "expression": (with_joint(rpy="pi/2 0 0"), "'pi/2' is not a decimal number"),
    "huge": (with_joint(xyz="1e999 0 0"), "'1e999' is not a decimal number"),
    "two numbers": (with_joint(xyz="0 0"), "'0 0' is not three numbers"),
    "unknown type": (with_joint(kind="revolut"), "unknown joint type 'revolut'. Did you mean revolute?"),
    "no type": (urdf(*TWO).replace(' type="revolute"', "", 1), "a joint has no type"),
    "no name": (urdf(*TWO).replace(' name="j1"', "", 1), "a joint has no name"),
    "no child": (urdf(*TWO).replace('<child link="b"/>', ""), "the joint has no child"),
    "unknown link": (urdf(*TWO).replace('<parent link="b"/>', '<parent link="bb"/>'), "there is no link 'bb'"),
    "joint twice": (with_joint(name="j1"), "there are two joints 'j1'"),
    "link twice": (urdf(*TWO).replace('<link name="b"/>', '<link name="b"/><link name="b"/>'), "two links 'b'"),
    "two parents": (urdf(*TWO, J("j3", "fixed", "a", "c")), "the link 'c' is the child of 'j2' as well"),
    "long name": (with_joint(name="j" * 300), "is longer than 200 letters"),
    "too many links": (
        urdf(*(J(f"j{i}", "fixed", "a", f"l{i}") for i in range(5001))),
        "the file has more than 5000 links",
    ),
    "limits": (with_joint(inside='<limit lower="1" upper="-1"/>'), "the lower limit is above the upper"),
    "limit is no number": (with_joint(inside='<limit lower="low" upper="1"/>'), "'low' is not a decimal number"),
}


@pytest.mark.parametrize(("text", "words"), BAD.values(), ids=BAD)
def test_a_bad_file_is_one_message(tmp_path: Path, text: str, words: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(RobotError) as caught:
        read_urdf(path, shown_as="arm.urdf")
    assert words in str(caught.value)
    assert str(caught.value).startswith("arm.urdf")
    assert caught.value.remedy


def test_messages_name_the_line(tmp_path: Path) -> None:
    with pytest.raises(RobotError, match=r"arm\.urdf, line 8, joint j2, origin xyz: 'x y' is not three numbers"):
        read_urdf(write(tmp_path, with_joint(xyz="x y")), shown_as="arm.urdf")


SECRET = "the contents of a file"
HOSTILE = {
    "entity bomb": '<!DOCTYPE robot [<!ENTITY a "0"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>',
    "external entity": '<!DOCTYPE robot [<!ENTITY a SYSTEM "SECRET">]>',
    "fetched document type": '<!DOCTYPE robot SYSTEM "http://127.0.0.1:9/none.dtd">',
    "in small letters": '<!doctype robot [<!entity a "0">]>',
}


@pytest.mark.parametrize("declaration", HOSTILE.values(), ids=HOSTILE)
def test_a_document_type_is_refused(tmp_path: Path, declaration: str) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text(SECRET)
    text = urdf(*TWO, name="&a;", before=declaration.replace("SECRET", secret.as_uri()))
    with pytest.raises(RobotError, match="document type or entities") as caught:
        read_urdf(write(tmp_path, text), shown_as="arm.urdf")
    assert SECRET not in str(caught.value)


def test_a_declared_encoding_hides_nothing(tmp_path: Path) -> None:
    """In UTF-7 a document type is written without its letters; the file is read as UTF-8 whatever it says."""
    declaration = "+ADwAIQ-DOCTYPE robot +AFsAPAAh-ENTITY a +ACI-0+ACIAPgBdAD4-"
    text = urdf(*TWO, before=declaration).replace('"1.0"?', '"1.0" encoding="utf-7"?')
    with pytest.raises(RobotError, match="this is not XML"):
        read_urdf(write(tmp_path, text), shown_as="arm.urdf")


def test_a_large_file_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path, urdf(*TWO) + " " * LARGEST_FILE)
    with pytest.raises(RobotError, match="larger than 8 MiB"):
        read_urdf(path, shown_as="arm.urdf")


def test_numbers_are_those_written(tmp_path: Path) -> None:
    """0.1 is a tenth; what stands in other elements, and a joint inside of a transmission, does not matter."""
    inside = '<limit lower="-1e-1" upper="+.5" effort="x"/><dynamics damping="nan"/><calibration/>'
    text = with_joint(xyz="0.1 -2.5e-3 .5", inside=inside).replace(
        "</robot>", '<transmission><joint name="j1"/></transmission><!-- DOC --><gazebo/></robot>'
    )
    joint = read_urdf(write(tmp_path, text), shown_as="arm.urdf").joints[1]
    assert [str(value) for value in joint.xyz] == ["1/10", "-1/400", "1/2"]
    assert joint.limits is not None
    assert [str(value) for value in joint.limits] == ["-1/10", "1/2"]


def test_what_programs_write_for_zero(tmp_path: Path) -> None:
    """Such numbers stand in the URDF files of iCub and Romeo."""
    joint = read_urdf(write(tmp_path, with_joint(xyz="-7.46298e-34 0 1e-999")), shown_as="arm.urdf").joints[1]
    assert joint.xyz == (0, 0, 0)


@settings(max_examples=60)
@given(st.integers(0, len(urdf(*TWO)) - 1), st.text(max_size=6), st.integers(0, 12))
def test_any_damage_is_refused_or_harmless(place: int, inserted: str, removed: int) -> None:
    """Whatever is put into the file or taken out of it: a robot or one message."""
    text = urdf(*TWO)
    with tempfile.TemporaryDirectory() as folder, contextlib.suppress(RobotError):
        load(str(write(Path(folder), text[:place] + inserted + text[place + removed :])))


def test_without_lxml_one_line_tells_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    real = builtins.__import__

    def without_lxml(name: str, *rest: Any, **named: Any) -> Any:
        if name.startswith("lxml"):
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", without_lxml)
    assert main(["show", str(write(tmp_path, urdf(*TWO)))]) == 2
    expected = "kinsym: reading URDF needs lxml, which is not installed. Run: pip install 'kinsym[urdf]'.\n"
    assert capsys.readouterr().err == expected
