"""Fig. 7B: 20 mT bends three segments to some 120°, as measured, but the solid cylinder to 9°, not to 16°."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

STOP, FREE = {"ls": "-"}, {"ls": "--", "lw": 1.5}
CURVES = (
    ("full_stop", "full", look.LEVEL["full"], STOP),
    ("rings_stop", "rings", look.LEVEL["rings"], STOP),
    ("full", "", look.LEVEL["full"], FREE),
    ("rings", "", look.LEVEL["rings"], FREE),
    ("preceding", "preceding", look.LEVEL["preceding"], FREE),
    ("cylinder", "solid cylinder", look.CYLINDER, STOP),
)


def draw(table: Table) -> Figure:
    """Two panels: a growing field across, and one that turns, with the ends of branches."""
    figure, (left, right) = subplots(1, 2, figsize=(8.5, 4.8), sharey=True)
    look.title(
        figure,
        "Fig. 7B: 20 mT bends three segments to some 120°, the solid cylinder to 9°",
        "colours: levels; solid: windings stop the bending; dashed: they do not; circles: the shape ends",
    )
    left.set_title("A field across bends them to 82°")
    left.set(xlabel="field across (mT)", ylabel="tip angle (°)", ylim=(0, 135))
    right.set_title("Turned on, it bends them as far as measured")
    right.set(xlabel="direction of the field from the base's axis (°)")
    curves(left, table["field_mt"], "across", table)
    curves(right, table["turn_deg"], "turned", table)
    return figure


def curves(axes, places: np.ndarray, way: str, table: Table) -> None:
    """All devices along one path of the field."""
    axes.set_xlim(places[0], places[-1])
    labels = []
    marks = table.marks()
    for name, words, colour, how in CURVES:
        angle = table[f"alpha_{way}_{name}_deg"]
        end = marks.get(f"end {way} {name}")
        solved = np.isfinite(angle)
        x, y = places[solved], angle[solved]
        if end:
            x, y = np.append(x, end[0]), np.append(y, end[1])
            axes.plot(*end, "o", color=colour, mfc="white", mew=1.5, zorder=4)
            look.label(axes, *end, words, colour, xytext=(6, -2))
        axes.plot(x, y, color=colour, **how)
        if words and not end:
            labels.append((x[-1], y[-1], words, colour))
    for device, x in (("segments", 0.03), ("cylinder", 0.5)):
        (_, paper) = marks[f"paper, {device}"]
        look.level(axes, paper, f"paper, {device}: {paper:g}°", x=x)
    look.ends(axes, labels)
