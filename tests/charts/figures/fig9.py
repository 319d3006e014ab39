"""Fig. 9: guided by a magnet through an aorta, nine segments turn into the artery, others less."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

DARK, MIDDLE, LIGHT = look.shades(look.LEVEL["rings"], 3)
FRICTIONS = (
    ("mcm", "no friction", LIGHT, "-"),
    ("mcm_oiled", "oiled: 0.04", MIDDLE, "--"),
    ("mcm_dry", "dry: 1", DARK, "-"),
)
DEVICES = (
    ("ptfe", "on PTFE", look.GREY, "-"),
    ("ptfe_wire", "... with guidewire", look.GREY, "--"),
    ("cylinder", "solid cylinder", look.CYLINDER, "-"),
    ("mcm", "nine segments", look.LEVEL["rings"], "-"),
)


def draw(table: Table) -> Figure:
    """Shaft inside and pull by friction on the left, turn of the tip and contacts by device on the right."""
    figure, ((inside, turn), (pull, contact)) = subplots(2, 2, figsize=(8.5, 6.2), sharex=True)
    look.title(
        figure,
        "Fig. 9: guided by a magnet, nine segments turn into the artery, others less",
        "predictions, level rings; left: nine segments by friction; right: no friction; circle: no further shape",
    )
    inside.set(title="Dry walls hold them at the port", ylabel="shaft inside (mm)")
    turn.set(title="Nine segments turn furthest", ylabel="turn of the tip (°)")
    pull.set(title="The pull stays below the paper's", ylabel="pull along the field (mN)", ylim=(-25, 105))
    contact.set(title="No contact presses with 0.1 N", ylabel="largest contact (mN)", ylim=(0, 105))
    for axes in (pull, contact):
        axes.set(xlabel="time (s)", xlim=(0, table["time_s"][-1]))
    curves(inside, table, FRICTIONS, "inside_mm", 1)
    curves(turn, table, DEVICES, "tip_heading_deg", 1)
    curves(pull, table, FRICTIONS, "axial_n", 1e3)
    curves(contact, table, DEVICES, "largest_contact_n", 1e3)
    paper = 1e3 * table.marks()["paper, pull"][1]
    look.level(pull, paper, f"paper: at most {paper:.0f} mN")
    return figure


def curves(axes, table: Table, cases: tuple, column: str, unit: float) -> None:
    """A curve for each case to where its path ends, and there what it is."""
    time, labels = table["time_s"], []
    for name, words, colour, style in cases:
        values = unit * table[f"{name}_{column}"]
        last = np.flatnonzero(np.isfinite(values))[-1]
        axes.plot(time, values, color=colour, ls=style)
        if last < len(time) - 1:
            axes.plot(time[last], values[last], "o", color=colour, mfc="white", mew=1.5, zorder=4)
        labels.append((time[-1], values[last], words, colour))
    look.ends(axes, labels)
