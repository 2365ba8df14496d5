"""Which tests a mutant has to face: those that concern its module, call by call, the fastest and deadliest first."""

from __future__ import annotations

FROZEN = "tests/test_frozen.py"
GOLDEN = "tests/mutation/golden.py"
WAYS = "tests/inverse/test_ways.py"
LINKS = "tests/kinematics/test_links.py tests/kinematics/test_moves.py tests/kinematics/test_forward.py"
ZEROS = "tests/kinematics/test_angle_sums.py tests/kinematics/test_meaning.py tests/kinematics/test_zeros.py"
SINGULAR = "tests/kinematics/test_singular.py"
COSTS = "tests/inverse/test_costs.py"
VERDICT = "tests/inverse/test_verdict.py"
NEIGHBOURS = "tests/inverse/test_neighbours.py"
_SQUARES = "tests/inverse/test_square_and_add.py"
SQUARES = (
    f"{_SQUARES}::test_the_degree_that_is_left_of_squares_and_its_coefficient "
    f"{_SQUARES}::test_the_scale_of_one_side_multiplies_the_others"
)
BRANCHES = " ".join(
    f"tests/control/test_branches.py::{test}"
    for test in (
        "test_names_say_how_the_arm_stands",
        "test_a_planar_elbow_is_left_or_right_of_the_way",
        "test_the_sign_of_a_slide",
        "test_the_sign_of_the_first_link_is_that_of_the_table",
    )
)
_FAMILIES = "tests/inverse/test_families.py"
FAMILIES = f"{_FAMILIES}::test_known_families {_FAMILIES}::test_what_has_to_vanish_is_told_and_a_length_never_does"
TASKS = "tests/inverse/test_plan.py::test_the_task_that_fits_is_found_without_being_named"

#: By the beginning of a module's name, the longest that fits.
KILLERS: dict[str, tuple[str, ...]] = {
    "kinsym/algebra/": ("tests/algebra", GOLDEN, SINGULAR),
    "kinsym/algebra/symbolic.py": ("tests/algebra", "tests/test_api.py"),
    "kinsym/kinematics/": (GOLDEN, LINKS, ZEROS),
    "kinsym/kinematics/constants.py": ("tests/kinematics/test_constants.py", GOLDEN, LINKS),
    "kinsym/kinematics/arm_class.py": (GOLDEN, "tests/terminal/test_lists_and_json.py::test_classes"),
    "kinsym/kinematics/convert.py": ("tests/kinematics/test_convert.py",),
    "kinsym/kinematics/singular/": (GOLDEN, ZEROS, SINGULAR),
    "kinsym/kinematics/tasks.py": ("tests/kinematics/test_tasks.py", GOLDEN, TASKS, "tests/inverse/test_locks.py"),
    "kinsym/inverse/": (GOLDEN, WAYS),
    "kinsym/inverse/assemble.py": ("tests/inverse/test_assemble.py", GOLDEN, WAYS),
    "kinsym/inverse/branches.py": (GOLDEN, BRANCHES),
    "kinsym/inverse/features.py": (GOLDEN, BRANCHES),
    "kinsym/inverse/families.py": ("tests/inverse/test_constant_sums.py", GOLDEN, FAMILIES),
    "kinsym/inverse/knowledge.py": ("tests/inverse/test_knowledge.py", GOLDEN, WAYS),
    "kinsym/inverse/locks.py": ("tests/inverse/test_locks.py",),
    "kinsym/inverse/neighbours.py": (NEIGHBOURS, VERDICT),
    "kinsym/inverse/choices.py": ("tests/terminal/test_explain.py",),
    "kinsym/inverse/needed.py": ("tests/terminal/test_explain.py",),
    "kinsym/inverse/nonzero.py": (
        "tests/inverse/test_eliminant.py tests/inverse/test_zeros_of_trees.py",
        GOLDEN,
        WAYS,
        "tests/inverse/test_nonzero.py::test_the_plan_lists_what_it_needs_and_no_more",
    ),
    "kinsym/inverse/rules/": (COSTS, GOLDEN, WAYS),
    "kinsym/inverse/rules/base.py": ("tests/inverse/test_rule_base.py", GOLDEN, WAYS),
    "kinsym/inverse/rules/linear_pole.py": (COSTS, GOLDEN, "tests/inverse/test_linear_pole.py", WAYS),
    "kinsym/inverse/rules/square_and_add_slide.py": (COSTS, GOLDEN, SQUARES, WAYS),
    "kinsym/inverse/rules/turned_pair.py": (
        "tests/inverse/test_turned_pair.py tests/inverse/test_eliminant.py",
        GOLDEN,
        WAYS,
    ),
    "kinsym/inverse/search.py": (GOLDEN, "tests/inverse/test_search.py", VERDICT, WAYS),
    "kinsym/inverse/substitution.py": (GOLDEN, "tests/inverse/test_substitution.py", WAYS),
    "kinsym/inverse/verdict.py": (NEIGHBOURS, VERDICT),
}


def calls(module: str) -> tuple[str, ...]:
    """What is given to pytest for a module, one call after the other until a test fails: the quickest first."""
    longest = max((name for name in KILLERS if module.startswith(name)), key=len)
    return (f"{module} {FROZEN}", *KILLERS[longest])
