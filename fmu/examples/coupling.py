"""The coupling that the masters of this folder run: a compliant robot arm carries the external magnet.

The arm (`arm.fmu`) says where the magnet is, the manipulator (`mcm.fmu`) says what force its magnets exert on it; the
force deflects the arm. Both step at once with what the other answered at the end of the step before (Jacobi scheme).
"""

import argparse
import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

# What a master says whose package is missing.
INSTALL = "fmu/venv fmu/examples/requirements.txt installs what this example needs"

STEP = 0.05  # communication step, s
STEPS = 100

# Which output goes to which input: (from, variable), (to, variable).
CONNECTIONS = [
    *((("arm", f"position_{axis}"), ("mcm", f"magnet.position[{k}]")) for k, axis in enumerate("xyz", 1)),
    *(
        (("arm", f"orientation_{axis}"), ("mcm", f"magnet.orientation[{k}]"))
        for k, axis in enumerate("wxyz", 1)
    ),
    *((("mcm", f"magnet.reaction_force[{k}]"), ("arm", f"force_{axis}")) for k, axis in enumerate("xyz", 1)),
]

# What is recorded after every step.
RECORDED = [
    *(("arm", f"{quantity}_{axis}") for quantity in ("position", "deflection") for axis in "xyz"),
    ("mcm", "tip.angle"),
    *(("mcm", f"{name}[{k}]") for name in ("tip.position", "magnet.reaction_force") for k in (1, 2, 3)),
]


def parser(description: str) -> argparse.ArgumentParser:
    """The command line of a master: two FMUs, a table to write."""
    made = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    made.add_argument("mcm", type=Path, help="the manipulator's FMU, as `mcm pack` writes it")
    made.add_argument("arm", type=Path, help="the arm's FMU, as `pack_arm.py` writes it")
    made.add_argument("--out", type=Path, required=True, help="the table to write (CSV)")
    return made


def write(out: Path, rows: Iterable[Sequence[float]]) -> None:
    """Writes the table; a row is the time and the recorded values."""
    with out.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *(f"{component}.{variable}" for component, variable in RECORDED)])
        writer.writerows([round(time, 9), *values] for time, *values in rows)
    print(f"wrote {out}")
