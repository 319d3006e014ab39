"""Fig. 4: with all interactions the paper's design is close to the best; by the paper's model alone it is not."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

PANELS = (
    ("deflection_preceding", "Deflection, Eq. (17), level preceding", 1),
    ("moment_preceding", "Moment, Eq. (18), as printed", 1),
    ("sum_preceding", "Their sum, level preceding", 2),
    ("sum_full", "The same, level full", 2),
)
GOOD = 0.95  # of the best score


def draw(table: Table) -> Figure:
    """Four maps of scores over helix length and boundary angle, with the paper's choice."""
    figure, axes = subplots(2, 2, figsize=(8.5, 6), sharex=True, sharey=True)
    look.title(
        figure,
        "Fig. 4: with all interactions the paper's design is close to the best score",
        "cells: designs within constraints; lines every 0.2; circle: the paper's; cross: best; dots: within 5 % of it",
    )
    for panel, (name, words, most) in zip(axes.flat, PANELS, strict=True):
        chart(panel, table, f"score_{name}", words, most)
    for panel in axes[1]:
        panel.set_xlabel("helix length (mm)")
    for panel in axes[:, 0]:
        panel.set_ylabel("boundary angle (°)")
    return figure


def chart(axes, table: Table, name: str, words: str, most: float) -> None:
    """A score, with lines of equal scores, the best ones, and what the paper's design has of the best."""
    length, angle, score = table.grid("length_mm", "boundary_angle_deg", name)
    drawn = axes.pcolormesh(length, angle, score.T, vmin=0, vmax=most, shading="nearest", rasterized=True)
    axes.contour(length, angle, score.T, levels=np.arange(0.2, most, 0.2), colors="white", linewidths=0.7)
    bar = axes.figure.colorbar(drawn, ax=axes, pad=0.02, ticks=np.linspace(0, most, 5), format="{x:g}")
    bar.outline.set_visible(False)
    bar.set_label("score")
    best = np.nanmax(score)
    for i, j in np.argwhere(score >= GOOD * best):
        shape = {"marker": "x", "ms": 7, "mew": 2} if score[i, j] == best else {"marker": ".", "ms": 3}
        axes.plot(length[i], angle[j], color=look.INK, **shape)
    (x, y) = table.marks()["paper"]
    axes.plot(x, y, "o", mfc="none", color=look.MEASURED, ms=10, mew=1.8)
    own = score[np.argmin(abs(length - x)), np.argmin(abs(angle - y))] / best
    look.label(axes, x, y, f"paper: {own:.0%} of the best".replace("%", " %"), look.MEASURED, xytext=(26, -8))
    axes.set_title(words)
