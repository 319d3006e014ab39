"""Fig. 5: relative magnetic moment over the number of segments."""

import look
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from matplotlib.ticker import MultipleLocator
from table import Table

CURVES = (
    ("closed", "a ring at both ends", look.BLUE),
    ("open", "a ring at the tip only", look.GREEN),
    ("plain", "no rings", look.GREY),
)


def draw(table: Table) -> Figure:
    """One panel: exact volumes as lines, the paper's formula dashed, its design as a point."""
    figure, axes = subplots()
    segments = table["segments"]
    for name, words, colour in CURVES:
        exact, printed = table[f"mu_rel_{name}_exact"], table[f"mu_rel_{name}_printed"]
        axes.plot(segments, exact, color=colour)
        axes.plot(segments, printed, color=colour, ls="--", lw=1.2)
        look.label(axes, segments[-1], exact[-1], words, colour)
    (x, y) = table.marks()["paper"]
    axes.plot(x, y, "o", color=look.MEASURED, zorder=5)
    look.label(axes, x, y, "paper: 0.2 at nine segments", look.MEASURED, xytext=(6, 10))
    axes.set(
        xlabel="number of segments", ylabel=r"relative magnetic moment $\mu_\mathrm{rel}$", ylim=(0, None)
    )
    axes.set_xlim(1, segments[-1])
    axes.xaxis.set_major_locator(MultipleLocator(2))
    look.title(
        figure, "Fig. 5: more segments carry less magnet per length", "dashed: the paper's Eq. (8) as printed"
    )
    return figure
