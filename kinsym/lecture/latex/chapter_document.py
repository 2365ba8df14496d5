"""``kinsym latex --lecture``: the chapter, section by section."""

from __future__ import annotations

from collections.abc import Sequence

from kinsym.emit.latex.article import framed, rendered
from kinsym.emit.latex.sentences import escape
from kinsym.lecture.latex.section_page import Chapter
from kinsym.lecture.latex.shown import Shown, shown
from kinsym.lecture.report import left_open
from kinsym.lecture.sections import Further, Section, further, sections
from kinsym.lecture.verdict import Truth, Verdict

TITLE = "Kinematic Analysis"


def chapter_document(found: Sequence[Verdict]) -> str:
    """The lecture as a LaTeX article: contents, every section with its derivations, and the lecture's mistakes.

    ``found`` are the verdicts on the whole lecture. The same bytes every time.
    """
    chapter = Chapter()
    parts = [_section(section, chapter, found) for section in sections()]
    parts += [_further(one, chapter) for one in further()]
    body = rendered(
        "lecture",
        {
            "sections": parts,
            "entries": len(found),
            "systems": len({v.chapter.robot for v in found if v.chapter.robot}),
            "errata": chapter.remarks.errata,
            "hold": sum(v.truth is Truth.TRUE for v in found),
        },
    )
    return framed("chapter", body, title=TITLE, about="The lecture, derived by kinsym.", referring=True)


def _section(section: Section, chapter: Chapter, found: Sequence[Verdict]) -> str:
    """A section: its derivations with the lecture's numbers, then what else its slides hold."""
    rest = [verdict for verdict in found if section.holds(verdict.entry.slide)]
    derivations = shown(section.derivations)
    parts = [_heading(section)]
    parts += [chapter.remarks.printer.told(text) for text in dict.fromkeys(left_open(v.chapter) for v in rest) if text]
    for one in derivations:
        text, placed = chapter.derivation(one, rest, heading=_title(one, derivations))
        parts.append(text)
        rest = [verdict for verdict in rest if verdict not in placed]
    parts.append(chapter.rest(rest, heading="Also on these slides" if derivations else ""))
    return "\n\n".join(filter(None, parts))


def _heading(section: Section) -> str:
    first, last = section.slides
    between = "and" if last == first + 1 else "to"
    slides = f"slide {first}" if first == last else f"slides {first} {between} {last}"
    title = escape(section.title).replace("Denavit-Hartenberg", "Denavit--Hartenberg")
    return f"\\section[{title}]{{{title} \\hspace*{{\\fill}}\\mbox{{\\normalfont\\small\\itshape {slides}}}}}"


def _title(one: Shown, others: Sequence[Shown]) -> str:
    """A heading that tells the derivations of a section apart; empty where there is only one."""
    if len(others) == 1:
        return ""
    method = escape(one.derivation.title)
    return method if one.robot is None or _same_arm(others) else f"{method}: {escape(one.robot.title)}"


def _same_arm(derivations: Sequence[Shown]) -> bool:
    return len({one.derivation.robot for one in derivations}) == 1


def _further(one: Further, chapter: Chapter) -> str:
    """A section beyond the lecture."""
    parts = [
        f"\\section{{{escape(one.title)}}}\n\nThe lecture leaves the inverse kinematics of this arm to its reader."
    ]
    parts += [chapter.derivation(item, (), heading="")[0] for item in shown(one.derivations)]
    return "\n\n".join(parts)
