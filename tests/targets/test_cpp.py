"""The header of C++ in programs that use it, and the C and the header as CUDA."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from tests.arms import derivation
from tests.emit.built import numpy_module
from tests.emit.general_arms import general_schedule
from tests.emit.schedules import planar_2r, puma
from tests.targets.built import COMPILERS, compiled, needs_compiler, write

pytestmark = needs_compiler
CLANG, NVCC = shutil.which("clang++"), shutil.which("nvcc")
EIGEN = Path("/usr/include/eigen3")

#: What CUDA's own headers declare, as far as the C asks for it: attributes, and mathematics for host and device.
CUDA_STAND_IN = """#pragma once
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define NAN __builtin_nan("")
#define HUGE_VAL __builtin_huge_val()
#define isfinite __builtin_isfinite
#define isnan __builtin_isnan
#define ONE(name) __host__ __device__ double name(double);
#define TWO(name) __host__ __device__ double name(double, double);
extern "C" {
ONE(sin) ONE(cos) ONE(atan) ONE(sqrt) ONE(fabs) ONE(ceil) ONE(floor) ONE(rint)
TWO(atan2) TWO(hypot) TWO(fmax) TWO(fmin) TWO(pow) TWO(copysign)
}
"""
KERNEL = """
__global__ void ask(const double *T, const double *reference, double *q, int *count)
{
    count[0] = SPACENAME_ik_near(T, nullptr, reference, reinterpret_cast<double (*)[MACRO_JOINTS]>(q));
    count[1] = SPACENAME_nearest(T, nullptr, reference, nullptr, nullptr, nullptr, q);
}
"""


def mirrored() -> Schedule:
    """An arm without a closed form: its solver reads many tables."""
    return general_schedule("mirrored")


def run(folder: Path, source: str, *flags: str) -> list[str]:
    """The lines that a program prints."""
    (folder / "main.cpp").write_text(source, encoding="utf-8")
    compiled(COMPILERS[0], folder, "main.cpp", "-std=c++11", *flags, "-o", "program")
    return subprocess.run([str(folder / "program")], capture_output=True, text=True, check=True).stdout.splitlines()


def test_the_example_of_the_header_and_every_function(tmp_path: Path) -> None:
    """What stands in its head is compiled as it stands; results are those of NumPy."""
    write(puma(), "cpp", tmp_path)
    text = (tmp_path / "puma.hpp").read_text(encoding="utf-8")
    example = "\n".join(line[6:] for line in text.splitlines() if line.startswith(" *     "))
    program = f"""#include "puma.hpp"
#include <cstdio>
static void use(const puma::Joints &q)
{{
    for (double x : q) {{
        std::printf("%.17g ", x);
    }}
    std::printf("\\n");
}}
int main()
{{
{example}
    const puma::Solutions found = puma::solve(T);
    puma::Joints near = {{{{}}}}, seed = {{{{1.0, 0.2, 0.3, 0.4, 0.5, 0.6}}}};
    const puma::Status status = puma::nearest(T, seed, near);
    use(near);
    const char *name = puma::branch_name(found.marks[1].branch);
    std::printf("%d %d %d %s\\n", (int)status, (int)found.status, found.size(), name);
    puma::Pose bad = T;
    bad[0] = 2.0;
    std::printf("%d %d\\n", (int)puma::solve(bad).status, puma::solve(bad).size());
    use(puma::limits().high);
    std::printf("%.17g\\n", puma::jacobian(found[0])[7]);
}}
"""
    *solutions, near, told, refused, limits, slope = run(tmp_path, program)
    module = numpy_module(puma())
    q = np.arange(1, 7) / 10
    expected = module.ik(module.fk(q))
    np.testing.assert_allclose(np.array([line.split() for line in solutions], dtype=float), expected, atol=1e-12)
    np.testing.assert_allclose(np.array(near.split(), dtype=float), q, atol=1e-12)
    assert told == f"1 1 8 {module.BRANCHES[1]}"
    assert refused == "-1 0"
    assert limits.split() == ["inf"] * 6
    assert abs(float(slope) - module.jacobian(expected[0])[1, 1]) < 1e-12


def test_many_files_may_include_it(tmp_path: Path) -> None:
    """Nothing is defined twice, beside the header of the C as well, and the macros of the C are gone."""
    write(puma(), "cpp", tmp_path)
    write(puma(), "c", tmp_path)
    own = '#include "puma.h"\n#include "puma.hpp"\n#if defined(TURN) || defined(restrict)\n#error "left"\n#endif\n'
    (tmp_path / "other.cpp").write_text(own + "int joints() { return PUMA_JOINTS; }\n", encoding="utf-8")
    (tmp_path / "main.cpp").write_text(
        own + "int joints();\nint main() { return joints() - puma::joints; }\n", encoding="utf-8"
    )
    for compiler in COMPILERS:
        compiled(compiler, tmp_path, "main.cpp", "other.cpp", "-std=c++11", "-o", "program")
        assert subprocess.run([str(tmp_path / "program")], check=False).returncode == 0


def test_parameters_without_a_value_must_be_given(tmp_path: Path) -> None:
    write(planar_2r(a2=None), "cpp", tmp_path)
    program = """#include "planar.hpp"
#include <cstdio>
int main()
{
    const planar::Parameters p = {0.7, 0.6};
    const planar::Pose T = planar::fk({{0.3, 0.4}}, p);
    std::printf("%.17g %d\\n", T[3], planar::solve(T, p).size());
}
"""
    (line,) = run(tmp_path, program)
    pose = numpy_module(planar_2r(a2=None)).fk([0.3, 0.4], a1=0.7, a2=0.6)
    assert abs(float(line.split()[0]) - pose[0, 3]) < 1e-15
    assert line.split()[1] == "2"
    (tmp_path / "main.cpp").write_text(program.replace("(T, p)", "(T)"), encoding="utf-8")
    with pytest.raises(AssertionError, match=r"too few arguments|no matching function"):
        compiled(COMPILERS[0], tmp_path, "main.cpp", "-std=c++11", "-fsyntax-only")


@pytest.mark.skipif(not EIGEN.is_dir(), reason="Eigen is not installed")
def test_the_example_with_eigen(tmp_path: Path) -> None:
    """The lines of docs/moveit.md: a map over the arrays, row-major."""
    page = (Path(__file__).resolve().parents[2] / "docs" / "moveit.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```cpp\n(.*?)```", page, re.DOTALL)
    write(build_schedule(derivation("ur5")), "cpp", tmp_path)
    (line,) = run(tmp_path, example, "-isystem", str(EIGEN))
    count, off = re.fullmatch(r"(\d+) solutions, the first off by (\S+)", line).groups()  # type: ignore[union-attr]
    assert int(count) == 8
    assert float(off) < 1e-14


def cuda(folder: Path, schedule: Schedule, target: str) -> None:
    """ask.cu: a kernel that calls the C of a schedule on the device."""
    write(schedule, target, folder)
    suffix, space = (".c", "") if target == "c" else (".hpp", f"{schedule.name}::core::")
    kernel = KERNEL.replace("SPACE", space).replace("NAME", schedule.name).replace("MACRO", schedule.name.upper())
    (folder / "ask.cu").write_text(f'#include "{schedule.name}{suffix}"\n{kernel}', encoding="utf-8")


def device_frontend(folder: Path) -> subprocess.CompletedProcess[str]:
    """What clang's front end says of ask.cu, for the host and for the device."""
    (folder / "math.h").write_text(CUDA_STAND_IN, encoding="utf-8")
    flags = ["-x", "cuda", "-std=c++17", "-nocudainc", "-nocudalib", "--cuda-gpu-arch=sm_70", "-fsyntax-only"]
    command = [CLANG or "clang++", *flags, "-Wno-unknown-cuda-version", "-I.", "-include", "math.h", "ask.cu"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.skipif(CLANG is None, reason="clang++ is not installed")
@pytest.mark.parametrize("make", [puma, planar_2r, mirrored])
def test_the_c_is_cuda(make: object, tmp_path: Path) -> None:
    """Every function is for host and device; without the macro the kernel is refused."""
    cuda(tmp_path, make(), "c")  # type: ignore[operator]
    assert device_frontend(tmp_path).stderr == ""
    own = (tmp_path / "ask.cu").read_text(encoding="utf-8")
    (tmp_path / "ask.cu").write_text(f"#define KINSYM_FN\n{own}", encoding="utf-8")
    assert device_frontend(tmp_path).returncode != 0


@pytest.mark.skipif(NVCC is None, reason="nvcc is not installed")
@pytest.mark.parametrize("target", ["c", "cpp"])
def test_nvcc_compiles_it_for_the_device(target: str, tmp_path: Path) -> None:
    cuda(tmp_path, planar_2r(), target)
    """Tables as well, which clang would take as they are: without the macro nvcc does not find them."""
    command = [NVCC or "nvcc", "-std=c++17", "-ptx", "ask.cu", "-o", "ask.ptx"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert ".visible .entry" in (tmp_path / "ask.ptx").read_text(encoding="utf-8")
    without = subprocess.run([*command, "-DKINSYM_DATA="], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "undefined in device code" in without.stdout + without.stderr


@pytest.mark.parametrize("make", [puma, mirrored])
def test_every_function_says_where_it_runs(make: object) -> None:
    """Also where no compiler of CUDA is at hand: what begins a line and has a body begins with the macro."""
    schedule = make()  # type: ignore[operator]
    text = TARGETS["c"](schedule)[f"{schedule.name}.c"]
    heads = re.findall(r"^(\w[^;={}]*)\n\{\n", text, re.MULTILINE)
    assert len(heads) > 20
    assert [head for head in heads if not head.startswith("KINSYM_FN ")] == []
    tables = re.findall(r"^(?:\w+ )*const \w+ \w+\[.*\] = ", text, re.MULTILINE)
    assert [table for table in tables if "KINSYM_DATA" not in table] == []
