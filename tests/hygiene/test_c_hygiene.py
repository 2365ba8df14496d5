"""An arm of each kind of generated C: no warning, nothing shared, no call that misbehaves whatever it is given.

The whole gallery, valgrind and the thread sanitizer are ``python -m tests.hygiene``.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kinsym.command.rendering import REALS, of_real
from kinsym.emit import TARGETS
from kinsym.emit.schedule import Schedule
from tests.hygiene.arms import KINDS, schedule
from tests.hygiene.building import GLIBC, Failed, hostile, quiet, threads, traps, writable, write

TEMPLATES = Path(__file__).resolve().parents[2] / "templates"

pytestmark = pytest.mark.skipif(
    not all(map(shutil.which, ("cc", "gcc", "nm"))), reason="gcc and the programs around it are not installed"
)


@pytest.mark.parametrize("name", KINDS)
def test_no_compiler_warns_in_any_standard(name: str, tmp_path: Path) -> None:
    write(schedule(name), tmp_path)
    assert quiet(schedule(name), tmp_path) >= 4


@pytest.mark.parametrize("name", KINDS)
def test_nothing_can_be_written_between_calls_and_threads_do_not_meet(name: str, tmp_path: Path) -> None:
    write(schedule(name), tmp_path)
    assert writable(schedule(name), tmp_path) == []
    assert "poses reached" in threads(schedule(name), tmp_path)


@pytest.mark.parametrize("name", KINDS)
def test_hostile_numbers_get_a_status(name: str, tmp_path: Path) -> None:
    write(schedule(name), tmp_path)
    answered, refused = (int(word) for word in hostile(schedule(name), tmp_path).split() if word.isdigit())
    assert answered > 1000
    assert refused > 1000


def test_hostile_numbers_get_a_status_in_single_precision(tmp_path: Path) -> None:
    arm = of_real("float", schedule("planar_rr"))
    write(arm, tmp_path)
    answered, refused = (int(word) for word in hostile(arm, tmp_path).split() if word.isdigit())
    assert answered > 1000
    assert refused > 1000
    assert writable(arm, tmp_path) == []
    assert "poses reached" in threads(arm, tmp_path)


def test_state_that_threads_share_is_seen(tmp_path: Path) -> None:
    write(schedule("planar_rr"), tmp_path)
    with (tmp_path / "planar_rr.c").open("a", encoding="utf-8") as file:
        file.write("int calls_so_far; static double last;\ndouble keep(double x) { last += x; return last; }\n")
    assert sorted(writable(schedule("planar_rr"), tmp_path)) == ["calls_so_far", "last"]


def test_the_arms_use_every_kernel() -> None:
    sources = "".join(text for name in KINDS for text in TARGETS["c"](schedule(name)).values())
    for kernel in (TEMPLATES / "c" / "kernels").iterdir():
        assert f"int solve_{kernel.name.partition('.')[0]}(" in sources


def broken(folder: Path, old: str, new: str) -> Schedule:
    """The planar arm with a fault in its C."""
    arm = schedule("planar_rr")
    write(arm, folder)
    source = folder / "planar_rr.c"
    text = source.read_text(encoding="utf-8")
    assert old in text
    source.write_text(text.replace(old, new), encoding="utf-8")
    return arm


#: What is put into the C, and what the hostile calls then say.
FAULTS = {
    "a row too many": (
        "return settled(q,",
        "q[PLANAR_RR_MAX_SOLUTIONS][0] = 0.0;\n    return settled(q,",
        "heap-buffer-overflow",
    ),
    "a parameter that is NaN": ("if (!usable(p)) {", "if (p == NULL) {", "line"),
    "a pose that is infinite": ("if (defect < 0.0) {", "if (defect < -2.0) {", "line"),
    "an index that no int can hold": ("int arms = 0;", "int arms = (int)(reference[0] * 0.0);", "runtime error"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_hostile_numbers_find_what_is_wrong(fault: str, tmp_path: Path) -> None:
    old, new, said = FAULTS[fault]
    with pytest.raises(Failed, match=said):
        hostile(broken(tmp_path, old, new), tmp_path)


needs_glibc = pytest.mark.skipif(not GLIBC, reason="floating-point traps are turned on by a function of glibc")


@needs_glibc
@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("name", ["planar_rr", "skew_wrist"])
def test_calls_for_one_pose_do_not_trap(name: str, real: str, tmp_path: Path) -> None:
    arm = of_real(real, schedule(name))
    write(arm, tmp_path)
    assert "no trap" in traps(arm, tmp_path)


@needs_glibc
def test_a_trap_is_seen(tmp_path: Path) -> None:
    """Where a branch has no solution its sine and cosine are both 0."""
    arm = broken(tmp_path, "/ (least > below ? least : below);", "/ below;")
    with pytest.raises(Failed, match="status -8"):
        traps(arm, tmp_path)


def test_threads_that_meet_are_seen(tmp_path: Path) -> None:
    """A pose that is kept between calls is another thread's before it is read."""
    arm = broken(tmp_path, "    double M[12];\n", "    static double M[12];\n")
    assert writable(arm, tmp_path)
    with pytest.raises(Failed, match=r"data race|line"):
        threads(arm, tmp_path, "-fsanitize=thread")


def test_a_warning_is_an_error(tmp_path: Path) -> None:
    arm = broken(tmp_path, "double M[12];", "double M[12]; const float less = T[0]; (void)less;")
    with pytest.raises(Failed, match="conversion"):
        quiet(arm, tmp_path)
