"""Couples the manipulator with the robot arm in ecos, which needs Debian's package libtbb12.

    fmu/venv fmu/examples/requirements.txt
    .venv/bin/python fmu/examples/coupled_ecos.py mcm.fmu arm.fmu --out coupled.csv

With `--apart` the manipulator runs in a process of its own. What ecos tells of an output after a step is its value
with the inputs of the next: the manipulator's rows are one step ahead of those of the other masters.
"""

import stat
from collections.abc import Iterator
from pathlib import Path

import coupling

try:
    import ecospy
    from ecospy import EcosSimulation, EcosSimulationStructure
    from ecospy.lib import EcosLib
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: {coupling.INSTALL}") from error
except OSError as error:
    raise SystemExit(f"ecos cannot be loaded ({error}); on Debian: apt-get install libtbb12") from error

NOT_SOLVED = 3  # `solver.status` when the other outputs are the last good ones


def port(component: str, variable: str) -> str:
    """A variable's name in ecos."""
    return f"{component}::{variable}"


def step(simulation: EcosSimulation, steps: int) -> Iterator[list[float]]:
    """The rows of the table."""
    if not simulation.init():
        raise SystemExit(f"ecos cannot initialise: {EcosLib.get_last_error()}")
    for _ in range(steps):
        time = simulation.step()
        # ecos goes on after a step that failed: the manipulator itself says whether it was solved.
        if simulation.get_integer(port("mcm", "solver.status")) == NOT_SOLVED:
            raise SystemExit(f"the manipulator has no solution at {time:.3f} s")
        yield [time, *(simulation.get_real(port(*name)) for name in coupling.RECORDED)]
    simulation.terminate()


def in_own_process(fmu: Path) -> str:
    """Where ecos finds an FMU that is to run in a process of its own; its package lacks the right to execute."""
    program = Path(ecospy.__file__).parent / "binaries" / "proxyfmu"
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return f"proxyfmu://localhost?file={fmu.resolve()}"


def run(mcm: Path, arm: Path, *, apart: bool = False) -> Iterator[list[float]]:
    """Couples the FMUs and runs them."""
    with EcosSimulationStructure() as structure:
        structure.add_model("mcm", in_own_process(mcm) if apart else str(mcm))
        structure.add_model("arm", str(arm))
        for source, sink in coupling.CONNECTIONS:
            structure.make_real_connection(port(*source), port(*sink))
        with EcosSimulation(coupling.STEP, structure=structure) as simulation:
            yield from step(simulation, coupling.STEPS)


def main() -> None:
    """Reads the command line."""
    parser = coupling.parser(__doc__)
    parser.add_argument("--apart", action="store_true", help="run the manipulator in its own process")
    arguments = parser.parse_args()
    coupling.write(arguments.out, run(arguments.mcm, arguments.arm, apart=arguments.apart))


if __name__ == "__main__":
    main()
