"""Sweeps magnet poses and designs with the FMU on a `dask.distributed` cluster.

    fmu/venv fmu/examples/requirements.txt
    .venv/bin/python fmu/examples/sweep_dask.py mcm.fmu --vary 'magnet.position[3]=-0.04:0.08:25' \\
        --vary design.helix.length=0.0035:0.0045:5 --out sweep.csv --picture sweep.png

Every combination is a case, solved from the unloaded shape, and becomes a row. By default two workers run on this
machine; `--scheduler tcp://host:8786` takes a running cluster, whose workers need fmpy and get the FMU sent. The cases
of a worker that is lost are solved by another one. Rows are on disk as soon as they are solved: the same command again,
after whatever stopped it, solves what is missing.
"""

import argparse
import csv
import itertools
import os
import shutil
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from tqdm import tqdm

try:
    from distributed import Client, LocalCluster, as_completed, get_worker
    from distributed.diagnostics.plugin import UploadFile
except ModuleNotFoundError as error:
    needed = "fmu/venv fmu/examples/requirements.txt installs what this example needs"
    raise SystemExit(f"{error}: {needed}") from error

CASES_PER_TASK = 8
OUTPUTS = ["tip.angle", *(f"tip.position[{k}]" for k in (1, 2, 3)), "stability.margin"]

Row = list[int | float | str]


@dataclass
class Axis:
    """A variable and the values that it takes."""

    name: str
    values: list[float]

    @classmethod
    def parse(cls, text: str) -> "Axis":
        """Reads NAME=START:STOP:COUNT."""
        name, _, span = text.rpartition("=")
        try:
            start, stop, count = span.split(":")
            return cls(name, np.linspace(float(start), float(stop), int(count)).tolist())
        except ValueError as error:
            raise argparse.ArgumentTypeError(f"`{text}` is not NAME=START:STOP:COUNT") from error


def solve(fmu: str, names: list[str], cases: list[tuple[int, tuple[float, ...]]]) -> list[Row]:
    """Runs on a worker: the rows of some cases. A case that the FMU refuses has a last column that says so."""
    archive = Path(get_worker().local_directory) / fmu
    description = read_model_description(archive, validate=False)
    references = {v.name: v.valueReference for v in description.modelVariables}
    folder = extract(archive)
    device = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="sweep",
    )
    device.instantiate()
    rows = []
    for number, values in cases:
        try:
            device.setupExperiment(startTime=0.0)
            device.enterInitializationMode()
            device.setReal([references[name] for name in names], values)
            device.exitInitializationMode()
            answer = [*device.getReal([references[name] for name in OUTPUTS]), ""]
        except FMICallException as refusal:
            answer = [*(float("nan") for _ in OUTPUTS), str(refusal)]
        rows.append([description.guid, number, *values, *answer])
        device.reset()
    device.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)
    return rows


class Table:
    """The rows on disk; each case stands there once."""

    def __init__(self, path: Path, guid: str, names: list[str], cases: list[tuple[float, ...]]) -> None:
        self.path = path
        self.header = ["fmu", "case", *names, *OUTPUTS, "refused"]
        self.drop_half_a_line()
        if not path.stat().st_size:
            self.append([self.header])
        with path.open(newline="") as file:
            header, *rows = csv.reader(file)
        self.done = {int(row[1]) for row in rows if row[0] == guid and self.is_case(row, cases)}
        if header != self.header or len(self.done) != len(rows):
            raise SystemExit(f"{path} holds another sweep: remove it, or name another file")

    @staticmethod
    def is_case(row: list[str], cases: list[tuple[float, ...]]) -> bool:
        """Whether a row's number and varied values are those of a case."""
        number = int(row[1])
        return number < len(cases) and tuple(map(float, row[2 : 2 + len(cases[0])])) == cases[number]

    def drop_half_a_line(self) -> None:
        """Whoever was stopped while writing left a line without an end."""
        with self.path.open("ab+") as file:
            file.seek(0)
            file.truncate(file.read().rfind(b"\n") + 1)

    def append(self, rows: list[Row]) -> None:
        """Adds rows, on disk when it returns."""
        with self.path.open("a", newline="") as file:
            csv.writer(file).writerows(rows)
            file.flush()
            os.fsync(file.fileno())


def checked_guid(fmu: Path, axes: list[Axis]) -> str:
    """The FMU's GUID; stops unless it has these variables and they can be set."""
    description = read_model_description(fmu)
    variables = {v.name: v for v in description.modelVariables}
    for axis in axes:
        variable = variables.get(axis.name)
        if variable is None or variable.type != "Real" or variable.causality not in {"input", "parameter"}:
            raise SystemExit(f"{fmu} has no real input or parameter `{axis.name}`")
    return description.guid


def sweep(client: Client, fmu: Path, guid: str, axes: list[Axis], out: Path) -> None:
    """Solves the cases that the table lacks."""
    names = [axis.name for axis in axes]
    cases = list(itertools.product(*(axis.values for axis in axes)))
    table = Table(out, guid, names, cases)
    missing = [case for case in enumerate(cases) if case[0] not in table.done]
    client.register_plugin(UploadFile(str(fmu), load=False))  # also to workers that come later
    tasks = [
        client.submit(solve, fmu.name, names, missing[start : start + CASES_PER_TASK], pure=False)
        for start in range(0, len(missing), CASES_PER_TASK)
    ]
    with tqdm(total=len(cases), initial=len(table.done), desc="sweep", unit="case") as bar:
        for task in as_completed(tasks):
            rows = task.result()
            table.append(rows)
            bar.update(len(rows))


def draw(table: Path, axes: list[Axis], picture: Path) -> None:
    """Draws the tip angle over the first variable, a line for each combination of the others."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415 - after the choice of how to draw

    with table.open(newline="") as file:
        rows = sorted(csv.DictReader(file), key=lambda row: int(row["case"]))
    figure, plot = plt.subplots(figsize=(7, 4.5), layout="constrained")
    first, *others = (axis.name for axis in axes)
    lines: dict[tuple[str, ...], list[dict]] = {}
    for row in rows:
        lines.setdefault(tuple(row[name] for name in others), []).append(row)
    for values, line in lines.items():
        label = ", ".join(f"{name} = {float(value):.4g}" for name, value in zip(others, values, strict=True))
        angles = np.degrees([float(row["tip.angle"]) for row in line])
        plot.plot([float(row[first]) for row in line], angles, marker=".", label=label)
    plot.set(xlabel=first, ylabel="tip angle (deg)")
    if others:
        plot.legend(fontsize="small")
    figure.savefig(picture, dpi=120)
    print(f"wrote {picture}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument(
        "--vary",
        type=Axis.parse,
        action="append",
        required=True,
        metavar="NAME=START:STOP:COUNT",
        help="an input or parameter and its values, SI units; can be given again",
    )
    parser.add_argument("--out", type=Path, required=True, help="the table to write or to complete (CSV)")
    parser.add_argument("--picture", type=Path, help="the picture to write (PNG)")
    parser.add_argument("--scheduler", help="address of a running cluster")
    parser.add_argument("--workers", type=int, default=2, help="workers on this machine, without --scheduler")
    arguments = parser.parse_args()
    guid = checked_guid(arguments.fmu, arguments.vary)
    cluster = arguments.scheduler or LocalCluster(
        n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None
    )
    with Client(cluster) as client:
        sweep(client, arguments.fmu, guid, arguments.vary, arguments.out)
    if not arguments.scheduler:
        cluster.close()
    print(f"wrote {arguments.out}")
    if arguments.picture:
        draw(arguments.out, arguments.vary, arguments.picture)


if __name__ == "__main__":
    main()
