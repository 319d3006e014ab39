"""Couples the manipulator with the robot arm in libcosim.

fmu/venv fmu/examples/requirements.txt
.venv/bin/python fmu/examples/coupled_libcosim.py mcm.fmu arm.fmu --out coupled.csv
"""

from collections.abc import Iterator
from pathlib import Path

import coupling

try:
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: {coupling.INSTALL}") from error

NANOSECONDS = 1_000_000_000  # libcosim counts time in whole nanoseconds


class Indices:
    """Indices and value references of the variables of an execution, by name."""

    def __init__(self, execution: CosimExecution) -> None:
        self.slaves = {name: execution.slave_index_from_instance_name(name) for name in ("mcm", "arm")}
        self.references = {
            (name, variable.name.decode()): variable.reference
            for name, slave in self.slaves.items()
            for variable in execution.slave_variables(slave)
            if variable.type == CosimVariableType.REAL.value
        }

    def of(self, port: tuple[str, str]) -> tuple[int, int]:
        """Slave and value reference of a variable."""
        return self.slaves[port[0]], self.references[port]


def step(execution: CosimExecution, steps: int) -> Iterator[list[float]]:
    """The rows of the table."""
    indices = Indices(execution)
    observer = CosimObserver.create_last_value()
    if not execution.add_observer(observer):
        raise SystemExit("libcosim takes no observer")
    for index in range(1, steps + 1):
        if not execution.step():
            raise SystemExit(f"libcosim stopped in step {index}")
        time = execution.status().current_time / NANOSECONDS
        values = [observer.last_real_values(slave, [r])[0] for slave, r in map(indices.of, coupling.RECORDED)]
        yield [time, *values]


def run(mcm: Path, arm: Path) -> Iterator[list[float]]:
    """Couples the FMUs and runs them."""
    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_step_size(round(coupling.STEP * NANOSECONDS))
    for name, fmu in (("mcm", mcm), ("arm", arm)):
        if execution.add_local_slave(CosimLocalSlave(str(fmu), name)) < 0:
            raise SystemExit(f"libcosim cannot load {fmu}")
    indices = Indices(execution)
    for source, sink in coupling.CONNECTIONS:
        if execution.connect_real_variables(*indices.of(source), *indices.of(sink)) != 0:
            raise SystemExit(f"libcosim cannot connect {source} to {sink}")
    yield from step(execution, coupling.STEPS)


def main() -> None:
    """Reads the command line."""
    arguments = coupling.parser(__doc__).parse_args()
    coupling.write(arguments.out, run(arguments.mcm, arguments.arm))


if __name__ == "__main__":
    main()
