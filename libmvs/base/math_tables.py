"""Writes math_tables.h, the tables of math_powers.cpp and math_angles.cpp, and the reference values of its test.

    python3 libmvs/base/math_tables.py            needs mpmath (PyPI)

Both files are checked in; this shows where their numbers come from. mpmath computes with 60 digits,
and each number is rounded once.
"""

from __future__ import annotations

import math
import random
import struct
from pathlib import Path

import mpmath
from mpmath import mpf

mpmath.mp.dps = 60
HERE = Path(__file__).resolve().parent
TABLES = HERE / "math_tables.h"
REFERENCE = HERE.parents[1] / "tests" / "base" / "math_reference.csv"

LOG_ENTRIES = 128
"""Intervals of the mantissa for log; 1 lies in the middle of one, so that its entry is c = 1."""
LOG_FIRST = 0x3FE6100000000000
"""Bits of the lowest mantissa of the table, 0.689453125."""
LOG_STEP = 1 << 45
EXP_ENTRIES = 128
ATAN_ENTRIES = 17
TWO_OVER_PI_WORDS = 38
"""32-bit words after the binary point: 1024 + 2 * 53 bits and room for the product."""


def from_bits(bits: int) -> float:
    """The double with these bits."""
    return struct.unpack("<d", struct.pack("<Q", bits))[0]


def rounded(x: mpf, unit: int) -> mpf:
    """x rounded to a multiple of 2^-unit."""
    return mpmath.nint(x * 2**unit) / mpf(2) ** unit


def pair(x: mpf) -> tuple[float, float]:
    """x as the sum of two doubles."""
    high = float(x)
    return high, float(x - mpf(high))


def log_rows() -> list[tuple[float, float, float]]:
    """c, about 1 / m for the middle m of an interval, with 10 bits; -log c in two parts."""
    rows = []
    for k in range(LOG_ENTRIES):
        low = from_bits(LOG_FIRST + k * LOG_STEP)
        high = from_bits(LOG_FIRST + (k + 1) * LOG_STEP)
        c = rounded(2 / (mpf(low) + mpf(high)), 9)
        if low < 1 < high:
            c = mpf(1)
        value = -mpmath.log(c)
        head = rounded(value, 42)
        rows.append((float(c), float(head), float(value - head)))
    return rows


def exp_rows() -> list[tuple[float, float]]:
    """2^(k / EXP_ENTRIES) in two parts."""
    return [pair(mpf(2) ** (mpf(k) / EXP_ENTRIES)) for k in range(EXP_ENTRIES)]


def atan_rows() -> list[tuple[float, float]]:
    """atan(k / 16) in two parts."""
    return [pair(mpmath.atan(mpf(k) / 16)) for k in range(ATAN_ENTRIES)]


def two_over_pi() -> list[int]:
    """The binary digits of 2 / pi after the point, by words of 32 bits."""
    with mpmath.workdps(400):
        digits = int(mpmath.floor(2 / mpmath.pi * mpf(2) ** (32 * TWO_OVER_PI_WORDS)))
    return [digits >> (32 * (TWO_OVER_PI_WORDS - 1 - k)) & 0xFFFFFFFF
            for k in range(TWO_OVER_PI_WORDS)]


def split(x: mpf, bits: int) -> tuple[float, float]:
    """x as a multiple of 2^-bits and the rest."""
    head = rounded(x, bits)
    return float(head), float(x - head)


def constant(name: str, value: float) -> str:
    return f"inline constexpr double {name} = {value.hex()};\n"


def table(name: str, columns: int, rows: list) -> str:
    """A two-dimensional array of doubles."""
    lines = ",\n".join("    {" + ", ".join(x.hex() for x in row) + "}" for row in rows)
    return f"inline constexpr double {name}[{len(rows)}][{columns}] = {{\n{lines}}};\n"


def write_tables() -> None:
    ln2, pi = mpmath.log(2), mpmath.pi
    log_ln2, exp_ln2 = split(ln2, 42), split(ln2 / EXP_ENTRIES, 41)
    half_pi = [rounded(pi / 2, 32)]
    half_pi.append(rounded(pi / 2 - half_pi[0], 65))
    text = "// Tables of math_powers.cpp and math_angles.cpp. Written by math_tables.py; do not edit.\n"
    text += "// clang-format off\n#pragma once\n\n#include <cstdint>\n\nnamespace mvs::core::math::tables {\n\n"
    text += f"inline constexpr uint64_t log_first = {LOG_FIRST:#x};\n"
    text += constant("log_ln2_high", log_ln2[0]) + constant("log_ln2_low", log_ln2[1])
    text += constant("exp_ln2_high", exp_ln2[0]) + constant("exp_ln2_low", exp_ln2[1])
    text += constant("exp_per_ln2", float(EXP_ENTRIES / ln2))
    text += constant("two_over_pi_rounded", float(2 / pi))
    text += constant("half_pi_1", float(half_pi[0])) + constant("half_pi_2", float(half_pi[1]))
    text += constant("half_pi_3", float(pi / 2 - half_pi[0] - half_pi[1]))
    text += constant("half_pi_high", pair(pi / 2)[0]) + constant("half_pi_low", pair(pi / 2)[1])
    text += "\n// c, the head of -log c, its tail\n" + table("log_table", 3, log_rows())
    text += "\n// 2^(k / 128), head and tail\n" + table("exp_table", 2, exp_rows())
    text += "\n// atan(k / 16), head and tail\n" + table("atan_table", 2, atan_rows())
    words = ", ".join(f"{word:#010x}" for word in two_over_pi())
    text += f"\n// binary digits of 2 / pi\ninline constexpr uint32_t two_over_pi[] = {{{words}}};\n"
    text += "\n}  // namespace mvs::core::math::tables\n"
    TABLES.write_text(text)


def arguments(rng: random.Random) -> dict[str, list[tuple[float, ...]]]:
    """Arguments of the reference values: the ranges in use, borders of intervals, extremes."""
    def spread(low: float, high: float, n: int) -> list[float]:
        return [rng.uniform(low, high) for _ in range(n)]

    def scaled(n: int, low: int, high: int) -> list[float]:
        return [rng.uniform(1, 2) * 2.0 ** rng.randint(low, high) for _ in range(n)]

    def signed(xs: list[float]) -> list[float]:
        return [x if rng.random() < 0.5 else -x for x in xs]

    near_one = [1 + rng.choice((-1, 1)) * 2.0**-rng.uniform(1, 52) for _ in range(60)]
    edges = [from_bits(LOG_FIRST + k * LOG_STEP + d) for k in range(0, 128, 5) for d in (-1, 0, 1)]
    logs = spread(0, 2, 60) + near_one + edges + scaled(60, -1074, 1023) + [5e-324, 1.7e308]
    exps = spread(-1, 1, 60) + spread(-745, 709, 80) + signed(scaled(40, -60, -1)) + [-745.1, 709.78]
    turns = spread(-7, 7, 100) + signed(scaled(60, -40, 60)) + signed(scaled(30, 61, 1023))
    turns += [float(k * mpmath.pi / 2) for k in (1, 2, 3, 5, 11, 1000, 123456789)]
    turns += [6381956970095103.0 * 2.0**797]  # the double nearest to a multiple of pi / 2
    small = spread(-0.3, 0.3, 80) + spread(-40, 709, 60) + signed(scaled(60, -60, 3))
    powers = [(rng.uniform(0, 3), rng.uniform(-20, 20)) for _ in range(80)]
    powers += [(rng.uniform(0.9, 1.1), rng.uniform(-5000, 5000)) for _ in range(80)]
    powers += [(x, rng.uniform(0, 1)) for x in scaled(60, -1000, 1000)]
    planes = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(150)]
    planes += list(zip(signed(scaled(60, -30, 30)), signed(scaled(60, -30, 30))))
    planes += list(zip(signed(scaled(20, -1000, 1000)), signed(scaled(20, -1000, 1000))))
    return {"log": [(x,) for x in logs], "exp": [(x,) for x in exps],
            "expm1": [(x,) for x in small], "sin": [(x,) for x in turns],
            "cos": [(x,) for x in turns], "pow": powers, "atan2": planes}


FUNCTIONS = {"log": mpmath.log, "exp": mpmath.exp, "expm1": mpmath.expm1, "sin": mpmath.sin,
             "cos": mpmath.cos, "pow": mpmath.power, "atan2": mpmath.atan2}


def write_reference() -> None:
    """Rows of function, arguments, and the value as the sum of two doubles."""
    lines = ["function,x,y,head,tail"]
    for name, list_of_arguments in arguments(random.Random(19)).items():
        for xs in list_of_arguments:
            with mpmath.workdps(700 if name in ("sin", "cos") else 60):
                value = FUNCTIONS[name](*map(mpf, xs))
            head = float(value)
            if not math.isfinite(head) or abs(head) < 2.3e-308:
                continue
            tail = float(value - mpf(head))
            y = xs[1].hex() if len(xs) == 2 else ""
            lines.append(f"{name},{xs[0].hex()},{y},{head.hex()},{tail.hex()}")
    REFERENCE.parent.mkdir(exist_ok=True)
    REFERENCE.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write_tables()
    write_reference()
