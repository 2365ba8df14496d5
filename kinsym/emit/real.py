"""The type of the numbers in generated C, with all that depends on how many digits it has.

Every tolerance of the templates in ``templates/c`` stands here, for double and for single precision. Those of double
precision are the policy of ``docs/architecture.md``, "Numbers". Single precision takes each by the rule it follows
there, for a unit roundoff that is 2^29 times as large:

* what bounds the rounding of a few operations grows with the roundoff: ``tau``, ``rounding``, ``polished``,
  ``damping``, ``epsilon``, ``roots``;
* where two solutions meet an error e of the pose is one of sqrt(e) of the joint, where two borders cross one of its
  fourth root: ``alike`` and ``alike_in_doubt`` are these of ``in_doubt``;
* ``NEAR`` tolerances are about 64 times the square root of the roundoff, so that an angle keeps all but its last
  digits wherever a root is not marked;
* what a caller gives, and what is compared with it, is known to fewer digits: ``pose``, ``bottom``, ``slack``, ``tie``,
  ``reached``.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True, kw_only=True)
class Real:
    """A type of C and the numbers that belong to it, as they are printed before a suffix is put behind them.

    name, precision     the type, and what it is called in sentences.
    size                its bytes.
    tau                 to what a pose is taken as known, in the unit of an equation.
    near, near_text     how far beside a special pose a root is marked, in ``tau``; the same as a share of the unit.
    rounding            a rotation that is off by no more is only rounded.
    pose, pose_inside   by how much a rotation may be off; the batch leaves what is next to that to the single call.
    bottom              by how much the last row of a pose may be off.
    farthest            positions from here on are refused: their squares would overflow in later steps.
    polished, damping   the distance at which a root is not polished on, and the least damping of a step.
    steady              the least damping of steps that leave alone what the pose hardly feels.
    in_doubt, reached   how near to its pose a root in doubt and any other solution must come, in units of the arm.
    alike_in_doubt, alike
                        how near to another solution a polished one, in doubt or not, counts as its copy.
    slack               the share of a limit, or of 1, within which a joint value is on it.
    tie, tie_digits     the share by which a sum must be less to be less, and the digits that agree in a tie.
    epsilon             half the distance of two numbers about pi.
    least, largest      of a normal number, and about half of the largest number.
    above_minus_pi      the number above -pi.
    eighth              pi/4 in two parts: small multiples of the first are exact.
    arctangent          the coefficients of the polynomial of ``tests/emit/atan_polynomial.py``, the highest first.
    arctangent_text     its degree and its relative error.
    roots               rounding errors of the sum and the slope of a quartic, in what is summed up.
    below_minus_pi      an angle below this counts as pi.
    angle, angle_text   up to this sum of angles, in radians, quarter turns are taken off by ``quarter``.
    whole, whole_bits   3/2 times the number from which on there are no fractions, and its logarithm.
    quarter, quarter_bits
                        pi/2 in three parts, of which the first two have so many bits.
    lanes, angles       how many poses, and angles, a processor computes in one instruction.
    """

    name: str
    precision: str
    size: int
    tau: Fraction
    near: str
    near_text: str
    rounding: str
    pose: str
    pose_inside: str
    bottom: str
    farthest: str
    polished: str
    damping: str
    steady: str
    in_doubt: str
    reached: str
    alike_in_doubt: str
    alike: str
    slack: str
    tie: str
    tie_digits: str
    epsilon: str
    least: str
    largest: str
    above_minus_pi: str
    eighth: tuple[str, str]
    arctangent: tuple[str, ...]
    arctangent_text: tuple[str, str]
    roots: tuple[str, str]
    below_minus_pi: str
    angle: str
    angle_text: str
    whole: str
    whole_bits: int
    quarter: tuple[str, str, str]
    quarter_bits: int
    lanes: tuple[str, str]
    angles: str

    @property
    def single(self) -> bool:
        """Whether it is not C's ordinary type."""
        return self.name == "float"

    def of(self, integer: str) -> str:
        """An integer of C as this type; in double precision every int is a number without a cast."""
        return f"({self.name}){integer}" if self.single else integer


DOUBLE = Real(
    name="double",
    precision="double precision",
    size=8,
    tau=Fraction(1, 2**46),
    near="67108864.0",
    near_text="a millionth",
    rounding="1e-14",
    pose="1e-6",
    pose_inside="0.999e-6",
    bottom="1e-9",
    farthest="1e150",
    polished="1e-15",
    damping="1e-14",
    steady="1e-7",
    in_doubt="1e-12",
    reached="1e-9",
    alike_in_doubt="1e-3",
    alike="1e-6",
    slack="1e-12",
    tie="1e-9",
    tie_digits="nine",
    epsilon="2.220446049250313e-16",
    least="2.2250738585072014e-308",
    largest="8e307",
    above_minus_pi="-3.1415926535897927",
    eighth=("0.7853981633670628", "3.038550253253096e-11"),
    arctangent=(
        "-0.017905061337117334",
        "0.03806216094782117",
        "-0.05039191303310834",
        "0.05847859480223268",
        "-0.06663099234101118",
        "0.07692059720288083",
        "-0.09090897725424531",
        "0.11111110782161499",
        "-0.14285714280166703",
        "0.1999999999995325",
        "-0.333333333333332",
    ),
    arctangent_text=("ten", "1.3e-18"),
    roots=("4.5e-16", "2.2e-16"),
    below_minus_pi="-3.1415926534",
    angle="10000.0",
    angle_text="10000",
    whole="6755399441055744.0",
    whole_bits=52,
    quarter=("1.5707963267341256", "6.077100506303966e-11", "2.0222662487959506e-21"),
    quarter_bits=33,
    lanes=("2", "8"),
    angles="four or eight",
)

SINGLE = Real(
    name="float",
    precision="single precision",
    size=4,
    tau=Fraction(1, 2**19),
    near="8192.0",
    near_text="a 64th",
    rounding="2e-6",
    pose="1e-3",
    pose_inside="0.999e-3",
    bottom="1e-5",
    farthest="1e15",
    polished="5e-7",
    damping="5e-6",
    steady="2e-3",
    in_doubt="1e-4",
    reached="1e-4",
    alike_in_doubt="0.03",
    alike="0.003",
    slack="1e-5",
    tie="1e-5",
    tie_digits="five",
    epsilon="1.1920929e-07",
    least="1.1754944e-38",
    largest="1.5e38",
    above_minus_pi="-3.1415925",
    eighth=("0.785398006439209", "1.5695823932524066e-07"),
    arctangent=(
        "-0.06078222139068224",
        "0.10593814088333538",
        "-0.14243533403285769",
        "0.19998471519067726",
        "-0.33333315188677604",
    ),
    arctangent_text=("four", "6.8e-10"),
    roots=("2.4e-7", "1.2e-7"),
    below_minus_pi="-3.1415",
    angle="100.0",
    angle_text="100",
    whole="12582912.0",
    whole_bits=23,
    quarter=("1.57080078125", "-4.45445766672492e-06", "2.563344151594519e-12"),
    quarter_bits=17,
    lanes=("4", "16"),
    angles="eight or sixteen",
)
