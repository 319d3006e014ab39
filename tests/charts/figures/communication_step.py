"""In few steps of the magnet or in many, the tip ends in the same place; the one step that cannot is refused."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

COLOUR = look.LEVEL["rings"]
WAYS = (
    ("pass", "past the device,\nback, and a turn"),
    ("half_orbit", "half around it"),
    ("snap_forth", "the path forth,\nwith a snap"),
    ("snap_back", "the path back,\nwith a snap"),
)


def draw(table: Table) -> Figure:
    """A row for each path of the magnet, a dot for each length of its steps, a cross where a step is refused."""
    figure, axes = subplots(figsize=(8.5, 3.6))
    worst = max(row(axes, table, name, height) for height, (name, _) in enumerate(WAYS))
    within = f"$10^{{{np.ceil(np.log10(worst)):.0f}}}$ mm"
    look.title(
        figure,
        "In few steps or in many, the same path of the magnet ends in the same place",
        f"dots: tip within {within} of where 1000 steps lead, with as many snaps; cross: refused",
    )
    axes.set_yticks(range(len(WAYS)), [words for _, words in WAYS])
    axes.set(xscale="log", xlabel="longest step of the magnet (mm)", ylim=(len(WAYS) - 0.5, -0.5))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.grid(visible=False, axis="y")
    axes.spines.left.set_visible(False)
    axes.tick_params(axis="y", length=0)
    return figure


def row(axes, table: Table, name: str, height: int) -> float:
    """One path; returns the largest distance of a tip that is solved (mm)."""
    step, apart = table[f"{name}_step_mm"], table[f"{name}_apart_mm"]
    refused = table[f"refused_{name}"] > 0
    axes.plot(np.sort(step), np.full(len(step), height), color=look.LIGHT, lw=6, zorder=1)
    axes.plot(step[~refused], np.full(np.sum(~refused), height), "o", color=COLOUR, ms=7)
    axes.plot(step[refused], np.full(np.sum(refused), height), "x", color=look.INK, ms=9, mew=2.5)
    for place in step[refused]:
        look.label(axes, place, height, "one step straight\nthrough the device", look.INK, xytext=(9, 0))
    return apart[~refused].max()
