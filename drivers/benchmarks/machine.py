"""What the figures were measured on."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from pathlib import Path

import numpy
import scipy


def first_line(words: list[str]) -> str:
    """Of what a program says; empty where it is not there."""
    try:
        out = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""
    return out.strip().splitlines()[0] if out.strip() else ""


def processor() -> dict[str, object]:
    """Name and what it can do side by side."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return {"processor": platform.machine(), "cores": os.cpu_count(), "simd": []}
    name = re.search(r"model name\s*:\s*(.*)", text)
    flags = re.search(r"flags\s*:\s*(.*)", text)
    simd = [word for word in (flags.group(1).split() if flags else []) if re.match(r"sse|avx|fma", word)]
    return {"processor": name.group(1) if name else platform.machine(), "cores": os.cpu_count(), "simd": simd}


def header_value(header: str, name: str) -> str:
    """A macro of an installed C header; empty where it is not there."""
    for folder in ("/usr/include", "/usr/local/include"):
        path = Path(folder) / header
        if path.is_file():
            found = re.search(rf'#define\s+{name}\s+"?([^"\n]+)"?', path.read_text(encoding="utf-8", errors="replace"))
            return found.group(1).strip() if found else ""
    return ""


def describe(program: Path) -> dict[str, object]:
    """The machine, and versions of all that was measured."""
    return processor() | {
        "load_before": round(os.getloadavg()[0], 2),
        "reedvalve": first_line([str(program), "--version"]),
        "c_compiler": first_line(["gcc", "--version"]),
        "fortran_compiler": first_line(["gfortran", "--version"]),
        "sundials": header_value("sundials/sundials_config.h", "SUNDIALS_VERSION"),
        "boost": header_value("boost/version.hpp", "BOOST_LIB_VERSION").replace("_", "."),
        "python": platform.python_version(),
        "numpy": numpy.__version__,
        "scipy": scipy.__version__,
    }
