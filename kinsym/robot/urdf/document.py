"""The links and joints of a URDF file, its numbers exactly as they are written.

lxml reads the XML. The readers of whole robots (yourdfpy, urdf_parser_py, urchin) load meshes and viewers that a
table does not need, turn every origin into floats, and some mend broken XML in silence; ``docs/urdf.md`` compares
them. Six elements matter here: link, joint, origin, axis, limit, mimic. Geometry, inertia and everything else is
passed over, so that missing meshes do no harm.

The file is hostile until proved harmless: it may hold no document type, so there are no entities to expand, nothing
is fetched, and its size and depth are bounded.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

from kinsym.errors import KinsymError, RobotError
from kinsym.robot.names import nearest, shown
from kinsym.robot.reading import read_text

LARGEST_FILE = 8 << 20
TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
MOST_LINKS = 5000
LONGEST_NAME = 200
LONGEST_NUMBER = 60
LARGEST_EXPONENT = 30

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")
_INSTALL = "reading URDF needs lxml, which is not installed. Run: pip install 'kinsym[urdf]'."

Triple = tuple[Fraction, Fraction, Fraction]
_ORIGIN: Triple = (Fraction(0), Fraction(0), Fraction(0))
_AXIS: Triple = (Fraction(1), Fraction(0), Fraction(0))


@dataclass(frozen=True, kw_only=True)
class UrdfJoint:
    """One ``<joint>``: the child's frame is the parent's moved by ``xyz`` (metres) and turned by ``rpy`` (radians).

    ``axis`` is in the child's frame and need not be of length one. ``limits`` are (lower, upper), None without a
    range; ``mimic`` names the joint that this one follows. ``where`` is the place for messages.
    """

    name: str
    kind: str
    parent: str
    child: str
    xyz: Triple
    rpy: Triple
    axis: Triple
    limits: tuple[Fraction, Fraction] | None
    mimic: str | None
    where: str


@dataclass(frozen=True, kw_only=True)
class Urdf:
    """The tree of a file: links in the order of the file, joints likewise."""

    name: str
    links: tuple[str, ...]
    joints: tuple[UrdfJoint, ...]


def read_urdf(path: Path, *, shown_as: str) -> Urdf:
    """The links and joints of a file; ``shown_as`` is how messages name it.

    Raises KinsymError where lxml is missing and RobotError for everything that is wrong with the file.
    """
    text = read_text(path, shown_as=shown_as, largest=LARGEST_FILE)
    return _Document(_parsed(text, shown_as), shown_as).urdf()


def _parsed(text: str, where: str) -> Any:
    try:
        from lxml import etree
    except ImportError:
        raise KinsymError(_INSTALL) from None
    # lxml expands entities in attributes whatever it is told, so that a document type is refused before it is parsed.
    if re.search(r"<!\s*(DOCTYPE|ENTITY)", text, re.IGNORECASE):
        raise RobotError(
            "the file holds a document type or entities", where=where, remedy="URDF needs none; take them out."
        )
    parser = etree.XMLParser(
        encoding="utf-8", resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, recover=False
    )
    try:
        root = etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        line = f", line {error.lineno}" if error.lineno else ""
        reason = ascii(str(error.msg or "no element"))[1:-1]
        raise RobotError(f"this is not XML: {reason}", where=f"{where}{line}", remedy="Name a URDF file.") from None
    return root


class _Document:
    def __init__(self, root: Any, where: str) -> None:
        self.root, self.where = root, where

    def urdf(self) -> Urdf:
        if self.root.tag != "robot":
            raise RobotError(
                f"the root element is {shown(str(self.root.tag))}, not <robot>",
                where=self.where,
                remedy="Name a URDF file (for SDF and MJCF convert it first).",
            )
        children = [item for item in self.root if isinstance(item.tag, str)]
        if any("xacro" in item.tag for item in children):
            raise RobotError(
                "this is xacro, from which URDF is made", where=self.where, remedy="Run: xacro FILE > robot.urdf."
            )
        links = [self.attribute(item, "name", "link") for item in children if item.tag == "link"]
        joints = [self.joint(item) for item in children if item.tag == "joint"]
        self.check(links, joints)
        return Urdf(name=self.root.get("name", "").strip(), links=tuple(links), joints=tuple(joints))

    def check(self, links: list[str], joints: list[UrdfJoint]) -> None:
        if not joints:
            raise RobotError("the file has no joints", where=self.where, remedy="A robot moves: add a joint.")
        if max(len(links), len(joints)) > MOST_LINKS:
            raise RobotError(f"the file has more than {MOST_LINKS} links", where=self.where, remedy="Take some out.")
        for kind, names in (("link", links), ("joint", [joint.name for joint in joints])):
            twice = next((name for name, count in Counter(names).items() if count > 1), None)
            if twice is not None:
                raise RobotError(f"there are two {kind}s {shown(twice)}", where=self.where, remedy="Rename one.")
        parents: dict[str, str] = {}
        known = set(links)
        for joint in joints:
            for link in (joint.parent, joint.child):
                if link not in known:
                    raise RobotError(
                        f"there is no link {shown(link)}",
                        where=joint.where,
                        remedy=f"{nearest(link, links)}Add it, or name another.",
                    )
            if joint.child in parents:
                raise RobotError(
                    f"the link {shown(joint.child)} is the child of {shown(parents[joint.child])} as well",
                    where=joint.where,
                    remedy="The links of a URDF form a tree; a closed chain has to be cut.",
                )
            parents[joint.child] = joint.name

    def joint(self, item: Any) -> UrdfJoint:
        name = self.attribute(item, "name", "joint")
        where = f"{self.where}, line {item.sourceline}, joint {shown(name)[1:-1]}"
        kind = self.attribute(item, "type", "joint")
        if kind not in TYPES:
            raise RobotError(
                f"unknown joint type {shown(kind)}",
                where=where,
                remedy=f"{nearest(kind, TYPES)}The types are {', '.join(TYPES)}.",
            )
        origin, axis = item.find("origin"), item.find("axis")
        mimic = item.find("mimic")
        return UrdfJoint(
            name=name,
            kind=kind,
            parent=self.link_of(item, "parent", where),
            child=self.link_of(item, "child", where),
            xyz=_triple(origin, "xyz", _ORIGIN, f"{where}, origin xyz"),
            rpy=_triple(origin, "rpy", _ORIGIN, f"{where}, origin rpy"),
            axis=_triple(axis, "xyz", _AXIS, f"{where}, axis xyz"),
            limits=_limits(item.find("limit"), f"{where}, limit") if kind in ("revolute", "prismatic") else None,
            mimic=None if mimic is None else mimic.get("joint", ""),
            where=where,
        )

    def link_of(self, item: Any, tag: str, where: str) -> str:
        found = item.find(tag)
        link = "" if found is None else found.get("link", "")
        if not link:
            raise RobotError(f"the joint has no {tag}", where=where, remedy=f'Add <{tag} link="..."/>.')
        return str(link)

    def attribute(self, item: Any, key: str, tag: str) -> str:
        value = item.get(key)
        if not value:
            raise RobotError(
                f"a {tag} has no {key}", where=f"{self.where}, line {item.sourceline}", remedy=f'Add {key}="...".'
            )
        if len(value) > LONGEST_NAME:
            raise RobotError(
                f"the {key} {shown(value)} is longer than {LONGEST_NAME} letters",
                where=f"{self.where}, line {item.sourceline}",
                remedy="Shorten it.",
            )
        return str(value)


def _triple(item: Any, key: str, default: Triple, where: str) -> Triple:
    text = None if item is None else item.get(key)
    if text is None:
        return default
    words = text.split()
    if len(words) != 3:
        raise RobotError(f"{shown(text)} is not three numbers", where=where, remedy='Write, for example, "0 0 0.1".')
    x, y, z = (_number(word, where) for word in words)
    return x, y, z


def _limits(item: Any, where: str) -> tuple[Fraction, Fraction] | None:
    """The range of a joint; lower and upper are 0 where they are left out, and an empty range is none."""
    if item is None:
        return None
    low, high = (_number(item.get(key, "0").strip(), f"{where} {key}") for key in ("lower", "upper"))
    if low > high:
        raise RobotError("the lower limit is above the upper", where=where, remedy="Exchange them.")
    return (low, high) if low < high else None


def _number(word: str, where: str) -> Fraction:
    if _NUMBER.fullmatch(word) and len(word) <= LONGEST_NUMBER:
        value = Decimal(word)
        # Programs write -7.46298e-34 for zero, which nothing can tell from it.
        if not value or value.adjusted() < -LARGEST_EXPONENT:
            return Fraction(0)
        if value.adjusted() <= LARGEST_EXPONENT:
            return Fraction(value)
    if word.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise RobotError("NaN and infinity are not numbers of a robot", where=where, remedy="Write a finite number.")
    raise RobotError(
        f"{shown(word)} is not a decimal number",
        where=where,
        remedy="Write plain metres and radians without a unit, for example 0.1.",
    )
