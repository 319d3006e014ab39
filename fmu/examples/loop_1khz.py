"""How long the steps of a 1 kHz loop take: the magnet of `fmu/demo` passes, one step of the FMU every millisecond.

    .venv/bin/python fmu/examples/loop_1khz.py mcm.fmu --out loop.csv --picture loop.png

A step is what a control loop does: it sets the magnet's pose, calls `fmi2DoStep` and reads tip position, tip angle,
force and status, all through fmpy. The loop does not wait for the next millisecond, so that it measures work. Reading
`stability.margin` as well would compute it anew in every step, which takes several milliseconds.
"""

import argparse
import csv
import gc
import sys
import time
from pathlib import Path

import numpy as np
from tqdm import tqdm

sys.path.append(str(Path(__file__).resolve().parents[1]))
import demo
import look
from matplotlib.pyplot import subplots

STEP = 1e-3  # communication step, s
FIRST = 2000  # steps from the start of the demo's path that come before the measured ones
READ = (
    "tip.angle",
    "force.magnetic[2]",
    "force.magnetic[3]",
    "tip.position[2]",
    "tip.position[3]",
)


def measure(device: demo.Device, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Time (s) and tip angle (rad) of each step."""
    slave = device.slave
    references = [device.reference[name] for name in READ]
    times, angles = np.empty(steps), np.empty(steps)
    device.start(demo.DISTANCE)
    gc.disable()
    for index in tqdm(range(FIRST + steps), unit="step"):
        begin = time.perf_counter()
        device.place((index + 1) * STEP, demo.DISTANCE)
        slave.doStep(currentCommunicationPoint=index * STEP, communicationStepSize=STEP)
        values = slave.getReal(references)
        status = device.status()
        if index >= FIRST:
            times[index - FIRST], angles[index - FIRST] = time.perf_counter() - begin, values[0]
        if status == demo.NOT_SOLVED:
            raise SystemExit(f"step {index} is not solved")
    gc.enable()
    return times, angles


def draw(picture: Path, times: np.ndarray) -> None:
    """Draws how often a step takes how long."""
    figure, axes = subplots(figsize=(8.5, 3.8))
    edges = np.geomspace(0.1, 100, 121)  # ms
    taken, kept = 1e3 * times, times <= STEP
    axes.hist([taken[kept], taken[~kept]], bins=edges, stacked=True, color=[look.BLUE, look.GREY])
    within, median = np.mean(kept), np.median(taken)
    axes.axvline(1e3 * STEP, color=look.INK, lw=1.2)
    look.label(
        axes,
        1e3 * STEP,
        0.95,
        "1 ms",
        look.INK,
        xytext=(-6, 0),
        ha="right",
        xycoords=axes.get_xaxis_transform(),
    )
    axes.set(xscale="log", yscale="log", xlabel="time of a step through fmpy (ms)", ylabel="number of steps")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter("{x:g}")
    look.title(
        figure,
        f"{100 * within:.0f} % of the steps of a 1 kHz loop end within 1 ms",
        f"Nine segments beside the passing magnet pair, level auto; {len(times)} steps, median {median:.2f} ms.",
    )
    figure.savefig(picture)
    print(f"wrote {picture}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument("--steps", type=int, default=10_000, help="number of measured steps (default 10000)")
    parser.add_argument("--out", type=Path, help="a table of the times and tip angles to write (CSV)")
    parser.add_argument("--picture", type=Path, help="the histogram to write (PNG)")
    arguments = parser.parse_args()
    device = demo.Device(arguments.fmu)
    times, angles = measure(device, arguments.steps)
    device.close()
    quantiles = {"median": 0.5, "99 %": 0.99, "99.9 %": 0.999, "longest": 1.0}
    told = ", ".join(f"{name} {1e3 * np.quantile(times, at):.2f} ms" for name, at in quantiles.items())
    print(f"{len(times)} steps: {told}; within 1 ms: {np.mean(times <= STEP):.2%}")
    if arguments.out:
        with arguments.out.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["time_s", "step_time_us", "tip_angle_deg"])
            for index, (taken, angle) in enumerate(zip(times, angles, strict=True)):
                moment = round((FIRST + index + 1) * STEP, 9)
                writer.writerow([moment, round(1e6 * taken, 1), np.degrees(angle)])
        print(f"wrote {arguments.out}")
    if arguments.picture:
        draw(arguments.picture, times)


if __name__ == "__main__":
    main()
