"""Level auto over its tolerance: its error, and its time beside that of the richest model."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from matplotlib.ticker import FuncFormatter, NullLocator
from study_table import Table

WIDE = 1e-3  # the times of tolerances from here on are told together
LEAST = 1e-7  # errors below are off the picture


def draw(table: Table) -> Figure:
    """Errors on the left, times on the right; a line for each scene."""
    figure, (errors, times) = subplots(1, 2, figsize=(8.5, 4.4))
    auto = table.where(model="auto")
    tolerances = np.unique(auto["tolerance"])[[-1, 0]]
    errors.fill_between(tolerances, tolerances, 1, color=look.LIGHT, lw=0)
    errors.text(
        0.95, 0.93, "above the tolerance", color=look.GREY, fontsize=9, ha="right", transform=errors.transAxes
    )
    times.axhline(1, color=look.GREY, lw=1)
    look.label(times, tolerances[0], 1, "the richest model", look.GREY, xytext=(0, 7))
    labels = []
    for scene in dict.fromkeys(auto["scene"]):
        own = auto.where(scene=scene)
        order = np.argsort(-own["tolerance"])
        passes = "pair" in scene
        colour = look.SEGMENTS[int(scene[0])]
        how = {"color": colour, "ls": "-" if passes else (0, (4, 2)), "marker": "o", "ms": 4}
        errors.plot(own["tolerance"][order], own["tip_over_length"][order], **how)
        times.plot(own["tolerance"][order], own["time_relative"][order], **how)
        words = scene.split(",")[0] + ("" if passes else ",\nfield turning")
        labels.append((tolerances[1], own["time_relative"][order[-1]], words, colour))
    for axes in (errors, times):
        axes.set(xscale="log", yscale="log", xlabel="tolerance of the tip, over the length")
        axes.set_xlim(tolerances[0] * 1.3, tolerances[1] / 1.3)
        axes.xaxis.set_major_formatter(FuncFormatter(percent))
    errors.yaxis.set_major_formatter(FuncFormatter(percent))
    errors.set(ylim=(LEAST, 0.3), ylabel="largest error of the tip, over the length")
    errors.set_title("The error stays below the tolerance")
    wide = np.median(auto["time_relative"][auto["tolerance"] >= WIDE])
    times.set_title(f"Down to {percent(WIDE)} it takes {100 * wide:.0f} % of the time")
    times.set_ylabel("time of a step, over the richest model's")
    times.set_yticks([1 / 8, 1 / 4, 1 / 2, 1, 2, 4], ["⅛", "¼", "½", "1", "2", "4"])
    times.yaxis.set_minor_locator(NullLocator())
    look.title(
        figure,
        "Level auto takes as much model as the tolerance needs",
        "Solid: beside the magnet pair, which passes; dashed: in a field of 10 mT that turns.",
    )
    look.ends(times, labels)
    return figure


def percent(share: float, _: int = 0) -> str:
    """A share as a percentage."""
    return f"{100 * share:.6f}".rstrip("0").rstrip(".") + " %"
