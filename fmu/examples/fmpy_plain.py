"""Runs the FMU alone in fmpy: the magnet passes, the manipulator bends.

    .venv/bin/python fmu/examples/fmpy_plain.py mcm.fmu --out driven.csv --picture driven.png

The inputs are a table over time, by default `magnet_pass.csv`: from its start pose beside the middle the magnet goes
60 mm along the manipulator and 10 mm aside and turns by 0.5 rad. A row of the outputs is the answer to the inputs of
the same time.

fmpy sets the inputs of a time `t`, holds them during a step `h` and writes the answer in the row at `t + h`: one step
late. So this runs one step longer, leaves out fmpy's first row and gives every row the time of its inputs. With
`--interpolate` the inputs move on straight lines from row to row instead, by fmpy's `set_input_derivatives`: then the
row at `t + h` is the answer to the inputs of `t + h`, and the manipulator has followed the path between.
"""

import argparse
import csv
from pathlib import Path

import fmpy.simulation
import matplotlib as mpl
import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.util import read_csv

INPUTS = Path(__file__).parent / "magnet_pass.csv"
OUTPUTS = [
    "tip.angle",
    *(
        f"{name}[{k}]"
        for name in ("tip.position", "force.magnetic", "magnet.reaction_force")
        for k in (1, 2, 3)
    ),
]


class InterpolatedInput(fmpy.simulation.Input):
    """What `set_input_derivatives` needs of fmpy 0.3.32, whose own class refuses any other number of inputs than nine.

    At the time of a row fmpy takes the slope from the row before, and none at the first row. A table that is earlier by
    far less than a step has the slope to the next row there.
    """

    def __init__(self, *arguments, **options) -> None:
        super().__init__(*arguments, **options)
        if self.t is not None:
            self.t = self.t - 1e-12 * np.ptp(self.t)
            self.continuous = [group._replace(derivatives=type(group.values)()) for group in self.continuous]


def run(fmu: Path, inputs: Path, *, interpolate: bool = False) -> np.ndarray:
    """The outputs at the times of the inputs."""
    signals = read_csv(inputs)
    times = signals["time"]
    step = times[1] - times[0]
    if not np.allclose(np.diff(times), step):
        raise SystemExit(f"{inputs}: the times are not evenly spaced")
    known = {variable.name for variable in read_model_description(str(fmu)).modelVariables}
    if unknown := set(signals.dtype.names) - {"time"} - known:
        # fmpy itself leaves such a column aside without a word.
        raise SystemExit(f"{inputs}: the FMU has no input {', '.join(sorted(unknown))}")
    if interpolate:
        fmpy.simulation.Input = InterpolatedInput
    rows = simulate_fmu(
        str(fmu),
        start_time=times[0],
        stop_time=times[-1] if interpolate else times[-1] + step,
        output_interval=step,
        input=signals,
        output=OUTPUTS,
        set_input_derivatives=interpolate,
    )
    if interpolate:
        return rows
    rows = rows[1:]
    rows["time"] -= step
    return rows


def write(out: Path, table: np.ndarray) -> None:
    """Writes the table with all digits."""
    with out.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *OUTPUTS])
        writer.writerows([round(time, 9), *values] for time, *values in table.tolist())
    print(f"wrote {out}")


def draw(picture: Path, table: np.ndarray) -> None:
    """Draws tip angle and force on the magnet over time."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415 - after the choice of how to draw

    figure, (angle, force) = plt.subplots(2, sharex=True, figsize=(7, 5), layout="constrained")
    angle.plot(table["time"], np.degrees(table["tip.angle"]), color="black")
    angle.set_ylabel("tip angle (deg)")
    for k, axis in enumerate("xyz", 1):
        force.plot(table["time"], 1e3 * table[f"magnet.reaction_force[{k}]"], label=axis)
    force.set(ylabel="force on the magnet (mN)", xlabel="time (s)")
    force.legend()
    figure.savefig(picture, dpi=120)
    print(f"wrote {picture}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument("--inputs", type=Path, default=INPUTS, help="input variables over time (CSV)")
    parser.add_argument("--interpolate", action="store_true", help="move the inputs from row to row")
    parser.add_argument("--out", type=Path, required=True, help="the table to write (CSV)")
    parser.add_argument("--picture", type=Path, help="the picture to write (PNG)")
    arguments = parser.parse_args()
    table = run(arguments.fmu, arguments.inputs, interpolate=arguments.interpolate)
    write(arguments.out, table)
    if arguments.picture:
        draw(arguments.picture, table)


if __name__ == "__main__":
    main()
