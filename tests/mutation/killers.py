"""Which tests a mutant has to face: those that concern its module, call by call, the fastest and deadliest first."""

from __future__ import annotations

FROZEN = "tests/test_frozen.py"
GOLDEN = "tests/mutation/golden.py"
SOLUTIONS = "tests/inverse/test_solutions.py"
#: Arms of a few classes between them need every rule.
_CLASSES = ("meeting_tip_sliding", "planar_part", "parallel_sliding", "few_joints_pose", "five_axes", "meeting_middle")
CLASSES = " ".join(f"tests/inverse/test_classes.py::test_random_arms_are_solved[{name}]" for name in _CLASSES)
POOL = "tests/inverse/test_pool.py"
SINGULAR = "tests/kinematics/test_singular.py"
TASKS = "tests/inverse/test_plan.py::test_the_task_that_fits_is_found_without_being_named"

#: By the beginning of a module's name, the longest that fits.
KILLERS: dict[str, tuple[str, ...]] = {
    "kinsym/algebra/": ("tests/algebra", GOLDEN, SINGULAR),
    "kinsym/algebra/symbolic.py": ("tests/algebra", "tests/test_api.py"),
    "kinsym/kinematics/": (GOLDEN, "tests/kinematics/test_forward.py", "tests/kinematics/test_convert.py"),
    "kinsym/kinematics/arm_class.py": (GOLDEN, "tests/terminal/test_lists_and_json.py::test_classes"),
    "kinsym/kinematics/convert.py": ("tests/kinematics/test_convert.py",),
    "kinsym/kinematics/singular/": (GOLDEN, SINGULAR),
    "kinsym/kinematics/tasks.py": (GOLDEN, TASKS, "tests/inverse/test_locks.py"),
    "kinsym/inverse/": (GOLDEN, SOLUTIONS, CLASSES),
    "kinsym/inverse/branches.py": (GOLDEN, "tests/control/test_branches.py"),
    "kinsym/inverse/cut.py": (GOLDEN, POOL, SOLUTIONS),
    "kinsym/inverse/families.py": (GOLDEN, "tests/inverse/test_families.py"),
    "kinsym/inverse/features.py": (GOLDEN, "tests/control/test_branches.py"),
    "kinsym/inverse/locks.py": ("tests/inverse/test_locks.py", GOLDEN),
    "kinsym/inverse/neighbours.py": ("tests/inverse/test_verdict.py",),
    "kinsym/inverse/nonzero.py": (GOLDEN, "tests/inverse/test_nonzero.py"),
    "kinsym/inverse/pool.py": (GOLDEN, POOL, SOLUTIONS),
    "kinsym/inverse/products.py": (GOLDEN, POOL, SOLUTIONS),
    "kinsym/inverse/verdict.py": ("tests/inverse/test_verdict.py",),
    "kinsym/inverse/rules/square_and_add.py": (GOLDEN, "tests/inverse/test_square_and_add.py", SOLUTIONS),
    "kinsym/inverse/rules/turned_pair.py": (GOLDEN, "tests/inverse/test_square_and_add.py", SOLUTIONS),
}


def calls(module: str) -> tuple[str, ...]:
    """What is given to pytest for a module, one call after the other until a test fails: the quickest first."""
    longest = max((name for name in KILLERS if module.startswith(name)), key=len)
    return (f"{module} {FROZEN}", *KILLERS[longest])
