"""Draws which input an output belongs to: fmpy as it is, the README's way, and input derivatives, by the FMU itself.

.venv/bin/python tests/charts/fmu_time.py mcm.fmu --out tests/charts/fmu_time.png
"""

import argparse
import contextlib
import io
import sys
import tempfile
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu
from matplotlib.patches import ConnectionPatch

sys.path.append(str(Path(__file__).resolve().parents[2] / "fmu"))
sys.path.append(str(Path(__file__).resolve().parents[2] / "fmu" / "examples"))
import fmpy_plain
import look
from component import Component
from matplotlib.pyplot import subplots

INPUT, OUTPUT = "magnet.position[3]", "tip.angle"
STEP, STOP = 0.5, 3.0  # s
SHOWN = 3  # the row that is told apart
INK, GREY, BLUE, RED = look.INK, look.GREY, look.BLUE, look.VERMILION


def way(time: np.ndarray) -> np.ndarray:
    """Where the magnet is along the manipulator, m."""
    return 0.050 + 0.027 * np.sin(np.pi / 2 * time / STOP)


@dataclass
class Panel:
    """One way to run the table: what is drawn of it."""

    title: str
    note: str
    segments: list[
        tuple[tuple[float, float], tuple[float, float]]
    ]  # of the input, row by row: times (s), values (m)
    times: np.ndarray  # of the outputs, s
    angles: np.ndarray  # rad
    shown: int  # the output that belongs to the input `SHOWN`


def equilibria(fmu: Path, times: np.ndarray) -> np.ndarray:
    """Tip angle (rad) with the magnet where it is at these times."""
    device = Component("chart", fmu, {INPUT: way(times[0])})
    angles = []
    for value in way(times):
        device.set(INPUT, value)
        angles.append(device.get(OUTPUT))
    device.close()
    return np.array(angles)


def panels(fmu: Path) -> list[Panel]:
    """Runs the table in three ways."""
    times = np.arange(round(STOP / STEP) + 1) * STEP
    table = np.array(list(zip(times, way(times), strict=True)), dtype=[("time", float), (INPUT, float)])
    plain = simulate_fmu(str(fmu), stop_time=STOP, output_interval=STEP, input=table, output=[OUTPUT])
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        np.savetxt(
            file, np.transpose([times, way(times)]), delimiter=",", header=f"time,{INPUT}", comments=""
        )
        file.flush()
        held = fmpy_plain.run(fmu, Path(file.name))
        moved = fmpy_plain.run(fmu, Path(file.name), interpolate=True)
    z = way(times)
    steps = list(pairwise(times))
    return [
        Panel(
            "fmpy as it is",
            "a row answers the\ninput of a step before",
            [(step, (value, value)) for step, value in zip(steps, z[:-1], strict=True)],
            plain["time"],
            plain[OUTPUT],
            SHOWN + 1,
        ),
        Panel(
            "as in the README",
            "a row answers the\ninput of its own time",
            [((time - STEP, time), (value, value)) for time, value in zip(times, z, strict=True)],
            held["time"],
            held[OUTPUT],
            SHOWN,
        ),
        Panel(
            "with input derivatives",
            "the same; the input\nmoves during the step",
            [(step, ends) for step, ends in zip(steps, pairwise(z), strict=True)],
            moved["time"],
            moved[OUTPUT],
            SHOWN,
        ),
    ]


def draw_panel(above, below, panel: Panel, fine: tuple[np.ndarray, np.ndarray]) -> None:
    """Input above, output below; the row that is told apart in red, with an arrow from its input to its answer."""
    times = np.arange(round(STOP / STEP) + 1) * STEP
    for times_, values in panel.segments:
        before = times_[0] < 0
        shown = np.isclose(values[1], way(SHOWN * STEP))
        above.plot(
            times_,
            1e3 * np.array(values),
            color=RED if shown else BLUE,
            lw=2.6 if shown else 2,
            ls=":" if before else "-",
            solid_capstyle="butt",
            zorder=3,
        )
    above.plot(times, 1e3 * way(times), "o", mfc="white", mec=INK, ms=5, zorder=4)
    at = SHOWN * STEP, 1e3 * way(SHOWN * STEP)
    above.plot(*at, "o", mfc="white", mec=RED, mew=1.6, ms=6, zorder=5)
    below.plot(fine[0], np.degrees(fine[1]), color=GREY, lw=1.4, zorder=2)
    below.plot(panel.times, np.degrees(panel.angles), "o", color=BLUE, ms=5.5, zorder=4)
    answer = panel.times[panel.shown], np.degrees(panel.angles[panel.shown])
    below.plot(*answer, "o", color=RED, ms=7, zorder=5)
    end = max(times_[1] for times_, values in panel.segments if np.isclose(values[1], way(SHOWN * STEP)))
    arrow = ConnectionPatch(
        (end, at[1]),
        answer,
        "data",
        "data",
        axesA=above,
        axesB=below,
        arrowstyle="-|>",
        color=RED,
        lw=1.2,
        shrinkA=5,
        shrinkB=6,
        ls=(0, (4, 2)),
        zorder=6,
    )
    below.figure.add_artist(arrow)
    above.set_title(panel.title, loc="left")
    below.text(1.0, 0.03, panel.note, transform=below.transAxes, ha="right", fontsize=9)
    for axes in (above, below):
        axes.set_xticks(times, [f"{time:.0f}" if time == round(time) else "" for time in times])
        axes.grid(axis="y", visible=False)
        axes.set_xlim(-1.1 * STEP, STOP + 0.4 * STEP)
    below.set_xlabel("time (s)")


def draw(fmu: Path, picture: Path) -> None:
    """Writes the picture."""
    with contextlib.redirect_stdout(io.StringIO()):  # fmpy names every input that keeps its start value
        drawn = panels(fmu)
    instants = np.linspace(0, STOP, 121)
    fine = instants, equilibria(fmu, instants)
    figure, axes = subplots(2, 3, figsize=(8.5, 5.4), sharex=True, sharey="row")
    for (above, below), panel in zip(axes.T, drawn, strict=True):
        draw_panel(above, below, panel, fine)
    axes[0, 0].set_ylabel("input: magnet, z (mm)")
    axes[1, 0].set_ylabel("output: tip angle (°)")
    first = axes[0, 0], axes[1, 0]
    look.label(first[0], 1.0, 1e3 * way(0.5), "input held", BLUE, xytext=(4, 0))
    look.label(first[0], 0.5, 1e3 * way(0.0), "row of inputs", INK, xytext=(4, 0))
    look.label(first[1], 0.6, 15.6, "equilibrium", GREY, ha="right", xytext=(-2, 4))
    look.label(first[1], 1.5, np.degrees(drawn[0].angles[3]), "row of outputs", BLUE, xytext=(6, -4))
    look.title(
        figure,
        "fmpy's rows come one step late; relabelled, each answers its own input",
        "Red: one input and its answer.",
    )
    figure.savefig(picture)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("fmu", type=Path, help="the FMU, as `mcm pack` writes it")
    parser.add_argument("--out", type=Path, required=True, help="the picture to write (PNG)")
    arguments = parser.parse_args()
    draw(arguments.fmu, arguments.out)
    print(f"wrote {arguments.out}")


if __name__ == "__main__":
    main()
