"""Runs the coupling from its SSP archive, in fmpy, libcosim or ecos.

    fmu/venv fmu/examples/requirements.txt
    .venv/bin/python fmu/examples/coupled_ssp.py coupling.ssp --master libcosim --out coupled.csv

fmpy's own `simulate_ssp` sets every input to zero for its first step, and a quaternion of zeros is no orientation: here
its parts are used with an exchange before that step.
"""

import argparse
import shutil
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import coupling
from fmpy import extract
from fmpy.ssp.simulation import do_step, free_fmu, get_value, instantiate_fmu
from fmpy.ssp.ssd import find_components, get_connections, read_ssd
from lxml import etree
from make_ssp import OMS, SSD


def experiment(ssp: Path) -> tuple[float, int]:
    """Communication step (s) and number of steps, as the archive says."""
    with zipfile.ZipFile(ssp) as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
    step = float(root.find(f".//{OMS}FixedStepMaster").get("stepSize"))
    stop = float(root.find(f"{SSD}DefaultExperiment").get("stopTime"))
    return step, round(stop / step)


def with_fmpy(ssp: Path) -> Iterator[list[float]]:
    """The rows of the table, by fmpy."""
    system = read_ssd(ssp).system
    components = {component.name: component for component in find_components(system)}
    connections = get_connections(system)
    step, steps = experiment(ssp)
    folder = extract(ssp)
    for component in components.values():
        instantiate_fmu(component, folder, start_time=0.0)
    try:
        for source, _ in connections:
            source.value = get_value(source.parent, source.name)
        for index in range(steps):
            for source, sink in connections:
                sink.value = source.value
            for component in components.values():
                do_step(component, index * step, step)
            values = [get_value(components[name], variable) for name, variable in coupling.RECORDED]
            yield [(index + 1) * step, *values]
    finally:
        for component in components.values():
            free_fmu(component)
        shutil.rmtree(folder, ignore_errors=True)


def with_libcosim(ssp: Path) -> Iterator[list[float]]:
    """The rows of the table, by libcosim."""
    import coupled_libcosim as master  # noqa: PLC0415 - one master is enough to run this program

    step, steps = experiment(ssp)
    folder = extract(ssp)
    try:
        master.log_output_level(master.CosimLogLevel.WARNING)
        nanoseconds = round(step * master.NANOSECONDS)
        execution = master.CosimExecution.from_ssp_file(str(folder), nanoseconds)
        yield from master.step(execution, steps)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def with_ecos(ssp: Path) -> Iterator[list[float]]:
    """The rows of the table, by ecos."""
    import coupled_ecos as master  # noqa: PLC0415

    step, steps = experiment(ssp)
    with master.EcosSimulation(step, ssp_path=str(ssp)) as simulation:
        yield from master.step(simulation, steps)


MASTERS: dict[str, Callable[[Path], Iterator[list[float]]]] = {
    "fmpy": with_fmpy,
    "libcosim": with_libcosim,
    "ecos": with_ecos,
}


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("ssp", type=Path, help="the archive, as `make_ssp.py` writes it")
    parser.add_argument("--master", choices=MASTERS, default="fmpy", help="who runs it")
    parser.add_argument("--out", type=Path, required=True, help="the table to write (CSV)")
    arguments = parser.parse_args()
    coupling.write(arguments.out, MASTERS[arguments.master](arguments.ssp))


if __name__ == "__main__":
    main()
