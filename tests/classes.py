"""Random arms of the classes that have a closed form: one function a class, robot TOML text from a random.Random.

Tables are drawn in Paul's rows, where three consecutive axes i, i+1, i+2 meet if a_i = a_{i+1} = d_{i+1} = 0 and are
parallel if both twists between them are 0 or pi, and written in Paul's or Craig's convention. Lengths are symbols,
numbers, equal numbers or zeros; twists are right angles, 30, 45 or 60 degrees, or symbols; angles have offsets.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random

RIGHT = ("pi/2", "-pi/2")
SKEW = ("deg(30)", "deg(45)", "-deg(60)", "deg(60)", "-deg(45)")
PARALLEL = ("0", "pi")
OFFSETS = ("pi/2", "-pi/2", "pi", "deg(30)", "-0.3")
NUMBERS = ("0.4", "0.25", "-0.3", "0.612", "0.1", "0.4", "0.35")


@dataclass
class Arm:
    """Rows of Paul's table while they are drawn; ``twist`` and ``length`` draw a cell as the arm's style has it."""

    random: Random
    kinds: str
    style: str = ""
    alpha: list[str] = field(default_factory=list)
    a: list[str] = field(default_factory=list)
    d: list[str] = field(default_factory=list)
    offset: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.style = self.random.choice(("symbols", "numbers", "skew", "sparse", "dense"))
        for row in range(1, len(self.kinds) + 1):
            self.alpha.append(self.twist(row))
            self.a.append(self.length(f"a{row}"))
            self.d.append(self.length(f"l{row}"))
            self.offset.append(self.random.choice(OFFSETS) if self.random.random() < 0.15 else "0")

    def twist(self, row: int) -> str:
        """A twist between axes that are not parallel."""
        if self.style in ("skew", "dense") and self.random.random() < 0.5:
            return self.random.choice(SKEW)
        if self.style == "symbols" and self.random.random() < 0.15:
            return f"alpha{row}"
        return self.random.choice(RIGHT)

    def length(self, name: str) -> str:
        """An offset, which may be zero."""
        if self.random.random() < {"sparse": 0.6, "dense": 0.0}.get(self.style, 0.3):
            return "0"
        return self.link(name)

    def link(self, name: str) -> str:
        """A length that is not zero."""
        numeric = self.style == "numbers" or (self.style == "skew" and self.random.random() < 0.5)
        return self.random.choice(NUMBERS) if numeric else name

    def meet(self, first: int) -> Arm:
        """Three consecutive axes, the first of them ``first``, meet in a point."""
        self.a[first - 1] = self.a[first] = self.d[first] = "0"
        return self

    def pair(self, first: int) -> Arm:
        """Two consecutive axes meet."""
        self.a[first - 1] = "0"
        return self

    def parallel(self, first: int, count: int = 3) -> Arm:
        """Consecutive axes are parallel, a link between each two."""
        for row in range(first, first + count - 1):
            self.alpha[row - 1] = self.random.choice(PARALLEL) if self.random.random() < 0.3 else "0"
            if self.kinds[row - 1 : row + 1] == "RR":
                self.a[row - 1] = self.link(f"a{row}")
        return self

    def text(self, task: str = "", *, framed: bool = True) -> str:
        """The robot file, sometimes with a base or a tool."""
        convention = self.random.choice(("paul", "craig"))
        alpha, a = self.alpha, self.a
        if convention == "craig":
            last = f'  {{ type = "fixed", alpha = "{alpha[-1]}", a = "{a[-1]}", d = "0", theta = "0" }},'
            alpha, a = ["0", *alpha[:-1]], ["0", *a[:-1]]
        lines = ['name = "arm"', f'convention = "{convention}"', *([f'task = "{task}"'] if task else []), "joints = ["]
        for row, kind in enumerate(self.kinds):
            offset, slide = self.offset[row], self.d[row]
            theta, d = (f"theta{row + 1}", slide) if kind == "R" else (offset, f"d{row + 1}")
            if kind == "R" and offset != "0":
                theta += f" + {offset}"
            lines.append(
                f'  {{ type = "{kind}", alpha = "{alpha[row]}", a = "{a[row]}", d = "{d}", theta = "{theta}" }},'
            )
        lines += [last, "]"] if convention == "craig" else ["]"]
        if framed and self.random.random() < 0.1:
            lines += ["", "[base]", 'xyz = ["0.1", "h", "0"]', 'rpy = ["0.3", "0", "pi/4"]']
        if framed and self.random.random() < 0.1:
            lines += ["", "[tool]", 'xyz = ["0", "0.05", "0.12"]', 'rpy = ["pi/2", "0", "deg(45)"]']
        return "\n".join(lines) + "\n"


def _mixed(random: Random, count: int, sliding: int = 1) -> str:
    """Some joints, up to ``sliding`` of them prismatic."""
    kinds = ["R"] * count
    for place in random.sample(range(count), random.randint(0, min(count, sliding))):
        kinds[place] = "P"
    return "".join(kinds)


def meeting_tip(random: Random) -> str:
    """Axes 4, 5, 6 meet (Pieper)."""
    return Arm(random, "RRRRRR").meet(4).text()


def meeting_base(random: Random) -> str:
    """Axes 1, 2, 3 meet."""
    return Arm(random, "RRRRRR").meet(1).text()


def meeting_middle(random: Random) -> str:
    """Axes 2, 3, 4 or 3, 4, 5 meet."""
    return Arm(random, "RRRRRR").meet(random.choice((2, 3))).text()


def parallel_three(random: Random) -> str:
    """Three consecutive parallel axes anywhere."""
    return Arm(random, "RRRRRR").parallel(random.choice((1, 2, 3, 4))).text()


def meeting_tip_sliding(random: Random) -> str:
    """A wrist at the tip, behind three joints of which some slide."""
    kinds = random.choice(("RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP"))
    return Arm(random, kinds + "RRR").meet(4).text()


def meeting_base_sliding(random: Random) -> str:
    """A spherical shoulder before three joints of which some slide."""
    kinds = random.choice(("RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP"))
    return Arm(random, "RRR" + kinds).meet(1).text()


def meeting_middle_sliding(random: Random) -> str:
    """Three axes that meet in the middle, other joints sliding."""
    first = random.choice((2, 3))
    outer = random.choice(("PRR", "RPR", "RRP", "PPR", "PRP", "RPP", "PPP"))
    return Arm(random, outer[: first - 1] + "RRR" + outer[first - 1 :]).meet(first).text()


def parallel_sliding(random: Random) -> str:
    """Three consecutive parallel revolute axes, other joints sliding."""
    first = random.choice((1, 2, 3, 4))
    outer = random.choice(("PRR", "RPR", "RRP"))
    return Arm(random, outer[: first - 1] + "RRR" + outer[first - 1 :]).parallel(first).text()


def planar_part(random: Random) -> str:
    """A planar arm of three joints, one sliding across the axes, somewhere in an arm of revolute joints."""
    first, slide = random.choice((1, 2, 3, 4)), random.choice((0, 1, 2))
    kinds = ["R"] * 6
    kinds[first - 1 + slide] = "P"
    arm = Arm(random, "".join(kinds))
    row = first - 1 + slide
    arm.alpha[row] = "pi/2"
    if slide:
        arm.alpha[row - 1] = "-pi/2"
    if slide == 0:
        arm.parallel(first + 1, 2)
    if slide == 2:
        arm.parallel(first, 2)
        arm.alpha[row] = random.choice(RIGHT)
    arm.offset[row] = "0"
    return arm.text()


def three_slides(random: Random) -> str:
    """Three prismatic and three revolute joints in any order, no two axes special."""
    kinds = list("RRRPPP")
    random.shuffle(kinds)
    return Arm(random, "".join(kinds)).text()


def gantry_wrist(random: Random) -> str:
    """A gantry with a wrist."""
    arm = Arm(random, "PPPRRR").meet(4)
    arm.alpha[:2], arm.offset[:3] = ["pi/2", "-pi/2"], ["0", "pi/2", "0"]
    return arm.text()


def cylindrical_wrist(random: Random) -> str:
    """A cylindrical arm with a wrist."""
    arm = Arm(random, "RPPRRR").meet(4)
    arm.alpha[:2] = ["0", random.choice(RIGHT)]
    return arm.text()


def spherical_wrist(random: Random) -> str:
    """A spherical (polar) arm with a wrist."""
    arm = Arm(random, "RRPRRR").meet(4).pair(1)
    return arm.text()


def scara_wrist(random: Random) -> str:
    """A SCARA arm with a wrist, the slide at any place."""
    kinds = random.choice(("RRP", "RPR", "PRR"))
    arm = Arm(random, kinds + "RRR").meet(4)
    for row in range(2):
        arm.alpha[row] = random.choice(PARALLEL)
        arm.a[row] = arm.link(f"a{row + 1}")
    return arm.text()


def elbow_wrist(random: Random) -> str:
    """The industrial arm: axes 2 and 3 parallel, a wrist, any offsets; often with equal lengths."""
    arm = Arm(random, "RRRRRR").meet(4).parallel(2, 2)
    if random.random() < 0.3:
        arm.d[3] = arm.a[1]
    return arm.text()


def parallel_and_pairs(random: Random) -> str:
    """Axes 2, 3, 4 parallel between two pairs that meet, as in cobots of UR's kind."""
    return Arm(random, "RRRRRR").parallel(2).pair(1).pair(5).text()


def planar(random: Random) -> str:
    """Three joints in a plane."""
    kinds = random.choice(("RRR", "RPR", "PRR", "RRP", "PPR", "RPP", "PRP"))
    arm = Arm(random, kinds)
    for row in range(3):
        crossing = row < 2 and kinds[row] != kinds[row + 1]
        arm.alpha[row] = random.choice(RIGHT) if crossing else "0"
        if kinds[row] == "R" and row < 2 and kinds[row + 1] == "R":
            arm.a[row] = arm.link(f"a{row + 1}")
        if kinds[row : row + 2] == "PP":
            arm.alpha[row] = random.choice(RIGHT)
            arm.offset[row + 1] = "pi/2"
            if row == 1:
                arm.alpha[0] = random.choice(RIGHT)
            elif len(kinds) > 2:
                arm.alpha[1] = random.choice(RIGHT)
    return arm.text()


def position(random: Random) -> str:
    """Two or three joints that place a point."""
    return Arm(random, _mixed(random, 3, 3)).text("position")


def orientation(random: Random) -> str:
    """Two or three revolute joints that turn a frame."""
    return Arm(random, "R" * random.choice((2, 3))).text("orientation")


def scara(random: Random) -> str:
    """Four joints with parallel axes, one sliding along them at any place."""
    kinds = ["R"] * 4
    kinds[random.randrange(4)] = "P"
    return Arm(random, "".join(kinds)).parallel(1, 4).text()


def few_joints_pose(random: Random) -> str:
    """Two to five joints asked for a full pose: only solutions that reach it."""
    return Arm(random, _mixed(random, random.choice((2, 3, 4, 5)))).text("pose")


def five_axes(random: Random) -> str:
    """Five joints for a position and an axis, three axes meeting or parallel."""
    arm = Arm(random, "RRRRR")
    first = random.choice((1, 2, 3))
    (arm.parallel if random.random() < 0.5 else arm.meet)(first)
    return arm.text("position_axis")


def five_axes_wrist(random: Random) -> str:
    """Five joints for a position and an axis that meets the last axes."""
    arm = Arm(random, _mixed(random, 3) + "RR").pair(4)
    arm.a[4] = arm.d[4] = "0"
    return arm.text("position_axis", framed=False)


CLASSES: dict[str, Callable[[Random], str]] = {
    function.__name__: function
    for function in (
        meeting_tip,
        meeting_base,
        meeting_middle,
        parallel_three,
        meeting_tip_sliding,
        meeting_base_sliding,
        meeting_middle_sliding,
        parallel_sliding,
        planar_part,
        three_slides,
        gantry_wrist,
        cylindrical_wrist,
        spherical_wrist,
        scara_wrist,
        elbow_wrist,
        parallel_and_pairs,
        planar,
        position,
        orientation,
        scara,
        few_joints_pose,
        five_axes,
        five_axes_wrist,
    )
}


def arms(name: str, count: int, seed: int = 0) -> Sequence[str]:
    """Robot files of a class, the same on every machine."""
    return [CLASSES[name](Random(f"{name} {seed} {number}")) for number in range(count)]
