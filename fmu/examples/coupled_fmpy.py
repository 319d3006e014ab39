"""Couples the manipulator with the robot arm in a master of a few lines, on fmpy.

    .venv/bin/python fmu/examples/coupled_fmpy.py mcm.fmu arm.fmu --out coupled.csv

What other masters do in the same scheme is compared with this one. `--stiffness` shows what the coupling does: a stiff
arm keeps to its path.
"""

from collections.abc import Iterator
from pathlib import Path

import coupling
from component import Component


def run(mcm: Path, arm: Path, stiffness: float | None = None) -> Iterator[list[float]]:
    """The rows of the table: exchange all, then step all."""
    components = {
        "mcm": Component("mcm", mcm, {}),
        "arm": Component("arm", arm, {} if stiffness is None else {"stiffness": stiffness}),
    }
    try:
        for index in range(coupling.STEPS):
            answers = [components[name].get(variable) for (name, variable), _ in coupling.CONNECTIONS]
            for (_, (name, variable)), answer in zip(coupling.CONNECTIONS, answers, strict=True):
                components[name].set(variable, answer)
            for component in components.values():
                component.slave.doStep(index * coupling.STEP, coupling.STEP)
            recorded = [components[name].get(variable) for name, variable in coupling.RECORDED]
            yield [(index + 1) * coupling.STEP, *recorded]
    finally:
        for component in components.values():
            component.close()


def main() -> None:
    """Reads the command line."""
    parser = coupling.parser(__doc__)
    parser.add_argument("--stiffness", type=float, help="stiffness of the arm's wrist, N/m")
    arguments = parser.parse_args()
    coupling.write(arguments.out, run(arguments.mcm, arguments.arm, arguments.stiffness))


if __name__ == "__main__":
    main()
