"""Fig. 5: the more segments, the smaller the relative moment; nine have the paper's 0.2."""

import look
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from matplotlib.ticker import FixedLocator
from study_table import Table

CURVES = (
    ("closed", "closed cores", look.GREY),
    ("open", "open cores,\nas built", look.EXACT),
    ("plain", "no particles\nin the helices", look.GREY),
)


def draw(table: Table) -> Figure:
    """One panel: exact volumes as lines, the paper's formula dashed, its design as a point."""
    figure, axes = subplots(figsize=(8.5, 4.4))
    segments = table["segments"]
    for name, words, colour in CURVES:
        exact, printed = table[f"mu_rel_{name}_exact"], table[f"mu_rel_{name}_printed"]
        axes.plot(segments, exact, color=colour)
        axes.plot(segments, printed, color=colour, **look.PRINTED)
        look.label(axes, segments[-1], exact[-1], words, colour)
    (x, y) = table.marks()["paper"]
    axes.plot(x, y, "o", color=look.MEASURED, ms=7, zorder=5)
    look.label(axes, x, y, f"paper: {y:g} with {x:g} segments", look.MEASURED, xytext=(2, 12))
    axes.set(
        xlabel="number of segments", ylabel=r"relative magnetic moment $\mu_\mathrm{rel}$", ylim=(0, 0.4)
    )
    axes.set_xlim(1, segments[-1])
    axes.xaxis.set_major_locator(FixedLocator([1, 3, 5, 9, 15, 20]))
    look.title(
        figure,
        "Fig. 5: more segments, less relative moment; nine have the paper's 0.2",
        "lines: exact volume of the spiral; dashed: Eq. (8) as printed, which takes the spiral 3.5 % too large",
    )
    return figure
