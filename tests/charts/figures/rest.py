"""Without any load, spirals that are all alike bend nine segments by 11°; mirrored or turned ones by less than 1°."""

import look
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

DARK, LIGHT = look.shades(look.LEVEL["full"], 3)[::2]
ARRANGEMENTS = (
    ("helical", "all alike", look.LEVEL["full"], "o"),
    ("alternating", "every second\none mirrored", LIGHT, "s"),
    ("turned", "turned by\n0, 240, 120°", DARK, "^"),
)


def draw(table: Table) -> Figure:
    """One panel: the tip angle at rest over the number of segments, for three arrangements of the spirals."""
    figure, axes = subplots(figsize=(8.5, 4.2))
    look.title(
        figure,
        "At rest, spirals all alike bend nine segments by 11°, mirrored ones by 1°",
        "no load at all; level full: each ring attracts the spirals beside it, which are not symmetric about the axis",
    )
    segments = table["segments"]
    axes.set(xlabel="number of segments", ylabel="tip angle without load (°)", ylim=(-0.5, 16))
    axes.set(xlim=(0.7, segments[-1] + 0.2), xticks=segments)
    labels = []
    for name, words, colour, marker in ARRANGEMENTS:
        angle = table[f"alpha_{name}_deg"]
        axes.plot(segments, angle, color=colour, marker=marker)
        labels.append((segments[-1], angle[-1], words, colour))
    look.ends(axes, labels, away=9)
    return figure
