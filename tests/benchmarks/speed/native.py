"""C programs for the clock: each function of a library is called for many inputs inside one call from Python.

An adapter is compiled together with the library's source by the same compiler with the same flags. All adapters have
one interface: ``run(in, number, out, stride, counts)`` reads ``number`` inputs one after the other, and writes the
answer of each ``stride`` doubles behind the one before (0: all to one place, so that memory is not what is timed).
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

#: What the header of the generated C recommends, and what a careful user writes who has not read it.
PLAIN = "-O3 -std=c99"
RECOMMENDED = "-O3 -march=native -fno-math-errno"
COMPILERS = ("gcc", "clang")


def _loop(call: str, before: str = "") -> str:
    """The function run; ``call`` answers input k."""
    return f"""
void run(const double *in, long number, double *out, long stride, int *counts)
{{
    {before}
    for (long k = 0; k < number; ++k) {{
        {call}
    }}
}}
"""


@dataclass(frozen=True, kw_only=True)
class Program:
    """Sources of a library in one folder, and the adapter that calls it."""

    folder: Path
    sources: tuple[str, ...]
    adapter: str

    def build(self, compiler: str, flags: str) -> Path:
        """The shared library, under a name that no other adapter, source, compiler or set of flags gives."""
        said = "\n".join([compiler, flags, *self.sources, self.adapter])
        name = f"run_{hashlib.sha256(said.encode()).hexdigest()[:16]}"
        (self.folder / f"{name}.c").write_text(self.adapter, encoding="utf-8")
        library = self.folder / f"{name}.so"
        # Robotics Toolbox reads M_PI_2, which C99 alone does not have.
        command = [
            compiler,
            *flags.split(),
            "-D_DEFAULT_SOURCE",
            "-fPIC",
            "-shared",
            f"{name}.c",
            *self.sources,
            "-o",
            str(library),
            "-lm",
        ]
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True, text=True)
        return library


def compilers() -> list[str]:
    """The compilers that are there."""
    return [name for name in COMPILERS if shutil.which(name)]


def kinsym_solver(name: str, struct: str) -> str:
    """All solutions by ``NAME_ik``; ``struct`` are the values of the parameters, empty if they are bound."""
    call = f"counts[k] = {name}_ik(&in[16 * k], {'&given' if struct else 'NULL'}, (void *)&out[stride * k]);"
    if not struct:
        return f'#include <stddef.h>\n#include "{name}.h"\n{_loop(call)}'
    # Volatile: the compiler must not fold the values in.
    values = f"static volatile {name}_params source = {{{struct}}};"
    return f'#include "{name}.h"\n{values}\n{_loop(call, f"const {name}_params given = source;")}'


def kinsym_batch(name: str) -> str:
    """All solutions by ``NAME_ik_batch``, a block of poses in a call."""
    rows = f"{name.upper()}_MAX_SOLUTIONS * {name.upper()}_JOINTS"
    return f"""#include <stddef.h>
#include "{name}.h"
enum {{ BLOCK = 256 }};
static double place[BLOCK * {rows}];
void run(const double *in, long number, double *out, long stride, int *counts)
{{
    for (long k = 0; k < number; k += BLOCK) {{
        const int n = number - k < BLOCK ? (int)(number - k) : BLOCK;
        {name}_ik_batch(&in[16 * k], n, NULL, NULL, (void *)(stride ? &out[k * stride] : place), &counts[k]);
    }}
}}
"""


def kinsym_line(name: str, function: str) -> str:
    """Forward kinematics or the Jacobian."""
    call = f"{name}_{function}(&in[{name.upper()}_JOINTS * k], NULL, &out[stride * k]);\n        counts[k] = 1;"
    return f'#include <stddef.h>\n#include "{name}.h"\n{_loop(call)}'


def toolbox_solver(name: str) -> str:
    """The function that Robotics Toolbox generates, with the tolerance that it has in Python."""
    head = f"int {name}(const double T[16], double tol, double solutions[64][6], int *count);\n"
    return head + _loop(f"{name}(&in[16 * k], 1e-6, (void *)&out[stride * k], &counts[k]);")


def casadi_line(name: str, joints: int) -> str:
    """A function that casadi generates of scalars: it needs no integers beside its work space."""
    call = f"""const double *arg[1] = {{&in[{joints} * k]}};
        double *res[1] = {{&out[stride * k]}};
        {name}(arg, res, (void *)0, work, 0);
        counts[k] = 1;"""
    head = f"int {name}(const double **arg, double **res, long long *iw, double *w, int mem);\n"
    return f"{head}static double work[4096];\n{_loop(call)}"
