"""Which shape a method finds over direction and strength of a field, and whether it reports when it has none."""

import look
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.pyplot import figure as new_figure
from matplotlib.ticker import PercentFormatter
from study_table import Table

# Verdicts from best to worst for who does not check the result: words and colour.
VERDICTS = {
    "branch": ("the stable shape of slow loading", "#a9d3c3"),
    "other_stable": ("another stable shape", "#4f9d88"),
    "stalled": ("none found, and reported so", look.LIGHT),
    "diverged": ("diverged, and reported so", "#b4b9c1"),
    "unstable": ("unstable shape, not reported", look.ORANGE),
    "wrong": ("no equilibrium, not reported", look.VERMILION),
}
SILENT = ("unstable", "wrong")
LEVELS = ("none", "rings", "full")
COMMON = LEVELS[:2]  # the levels that all methods have
STARTS = {"cold": "cold, from the straight shape", "warm": "warm, the field grows by 1 mT"}
GAP = (14.0, 8.0, 2.0)  # between two maps in degrees, two rows in mT, and more between two methods


def draw(table: Table) -> Figure:
    """Shares of all attempts above; below a small map of direction and strength for each method, level and design."""
    methods = list(dict.fromkeys(table["method"]))
    figure = new_figure(figsize=(8.5, 9.6))
    grid = figure.add_gridspec(3, 2, height_ratios=(1, 0.18, 2.4))
    shares, maps = ([figure.add_subplot(grid[row, column]) for column in range(2)] for row in (0, 2))
    strip = figure.add_subplot(grid[1, :])
    strip.set_axis_off()
    for left, (start, words) in zip((True, False), STARTS.items(), strict=True):
        above, below = (axes[0 if left else 1] for axes in (shares, maps))
        own = table.where(start=start)
        draw_shares(above, own, methods)
        draw_maps(below, own, methods)
        above.set_title(words[0].upper() + words[1:])
        if not left:
            above.tick_params(labelleft=False)
            below.tick_params(labelleft=False)
    keys = [Patch(color=colour, label=words) for words, colour in VERDICTS.values()]
    strip.legend(handles=keys, ncols=3, loc="center", handlelength=1.0)
    silent = {name: np.isin(table["verdict"][table["method"] == name], SILENT).mean() for name in methods}
    honest = [name for name, share in silent.items() if share == 0]
    look.title(
        figure,
        f"Only the {honest[0]} method never takes an unstable shape for a solution"
        if len(honest) == 1
        else "Which shape a method finds, and whether it reports when it has none",
        "Above: all attempts at the levels none and rings; numbers: not reported. Below: maps by level and number of "
        "segments S;\nacross: direction of the field, 0° to 180° from the axis; upwards: its strength, 5 to 40 mT.",
    )
    return figure


def draw_shares(axes: Axes, table: Table, methods: list[str]) -> None:
    """Bars of the verdicts of all methods at the levels that all have."""
    common = np.isin(table["interaction"], COMMON)
    for row, method in enumerate(methods):
        own = table["verdict"][common & (table["method"] == method)]
        left = 0.0
        for verdict, (_, colour) in VERDICTS.items():
            share = np.mean(own == verdict)
            axes.barh(row, share, left=left, color=colour, height=0.78)
            left += share
        silent = np.isin(own, SILENT).mean()
        axes.text(1.01, row, f"{100 * silent:.0f} %", va="center", fontsize=9)
    axes.set(xlim=(0, 1), yticks=range(len(methods)), yticklabels=methods, ylim=(len(methods) - 0.5, -0.5))
    axes.xaxis.set_major_formatter(PercentFormatter(1.0))
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


def draw_maps(axes: Axes, table: Table, methods: list[str]) -> None:
    """Maps in rows of methods and levels and columns of numbers of segments, on one pair of axes."""
    segments = np.unique(table["segments"])
    directions, strengths = np.unique(table["direction_deg"]), np.unique(table["field_mt"])
    step = directions[1] - directions[0], strengths[1] - strengths[0]
    size = len(directions) * step[0], len(strengths) * step[1]
    verdicts = list(VERDICTS)
    colours = ListedColormap([colour for _, colour in VERDICTS.values()])
    top, places, words = 0.0, [], []
    for method in methods:
        for level in LEVELS:
            if not np.any((table["method"] == method) & (table["interaction"] == level)):
                continue
            for column, number in enumerate(segments):
                own = table.where(method=method, interaction=level, segments=number)
                cells = np.full((len(strengths), len(directions)), np.nan)
                across = np.searchsorted(directions, own["direction_deg"])
                cells[np.searchsorted(strengths, own["field_mt"]), across] = [
                    verdicts.index(verdict) for verdict in own["verdict"]
                ]
                left = column * (size[0] + GAP[0])
                extent = (left, left + size[0], top - size[1], top)
                axes.imshow(
                    cells, origin="lower", extent=extent, cmap=colours, vmin=-0.5, vmax=len(verdicts) - 0.5
                )
            places.append(top - size[1] / 2)
            words.append(f"{method}, {level}" if level == LEVELS[0] else level)
            top -= size[1] + GAP[1]
        top -= GAP[1] * GAP[2]
    width = len(segments) * (size[0] + GAP[0]) - GAP[0]
    axes.set(xlim=(0, width), ylim=(top, 0), aspect="auto", yticks=places, yticklabels=words)
    ticks = [column * (size[0] + GAP[0]) for column in range(len(segments))]
    axes.set_xticks([tick + size[0] / 2 for tick in ticks], [f"S = {number:.0f}" for number in segments])
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
