"""Error against time: all methods beside the magnet pair by design and level, and cases that other software solves."""

from pathlib import Path

import look
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.pyplot import figure as new_figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from study_table import Table

FIELD = "pair"
LEVELS = ("none", "rings", "full")
DEFAULT = ("potential", "degree 2, pairs 1e-5")  # name and resolution of the default setting
PLAIN = ("warm", "")  # variants of the cases of other software with filled points
TARGET = 1.0  # micrometres, for which the panels name the fastest
FRONT = {"color": "#f6dd8b", "lw": 7, "solid_joinstyle": "round", "zorder": 1}
PEERS = Path(__file__).resolve().parents[1] / "peers.csv"


def draw(table: Table) -> Figure:
    """Rows of designs and columns of levels; the last row holds the cases of other software."""
    table = placed(table.where(field=FIELD))
    segments = np.unique(table["segments"])
    figure = new_figure(figsize=(8.5, 3.1 + 2.35 * len(segments)))
    grid = figure.add_gridspec(len(segments) + 2, 3, height_ratios=(0.2, *[1] * len(segments), 1.1))
    draw_key(figure.add_subplot(grid[0, :]), table)
    panels, first = [], None
    limits = min(table["known_um"]) / 5, max(table["error_um"]) * 5
    for row, number in enumerate(segments, start=1):
        for column, level in enumerate(LEVELS):
            axes = figure.add_subplot(grid[row, column], sharex=first, sharey=first)
            first = first or axes
            own = table.where(segments=number, interaction=level)
            panels.append(own)
            draw_panel(axes, own, limits)
            axes.set_title(f"S = {number:.0f}, {level}; {fastest(own)}", fontsize=8.5)
            axes.tick_params(labelbottom=row == len(segments), labelleft=column == 0)
            if column == 0:
                axes.set_ylabel("tip error (µm)")
            if row == len(segments):
                axes.set_xlabel("time of a solve (µs)")
    draw_peers([figure.add_subplot(grid[-1, column]) for column in range(3)])
    look.title(figure, title(panels), SENTENCE)
    return figure


SENTENCE = (
    "S segments beside the magnet pair at a level. Filled: warm; hollow: cold; broad: Pareto front; circle: default;\n"
    "squares: a lower level in place of full; grey: uncertainty of the reference. Last row: other software, and its\n"
    "time over that of mcm; hollow: cold, or with the gradient of the field."
)


# Solvers of the cases of other software: words, colour, and where the label stands from the first point.
SOLVERS = {
    "mcm": ("mcm", look.BLUE, {"xytext": (0, 9), "ha": "center"}),
    "scipy solve_bvp": ("scipy", look.METHOD["collocation"], {"xytext": (0, 8), "ha": "center"}),
    "pyelastica settled": ("PyElastica", look.VERMILION, {"xytext": (-7, 0), "ha": "right"}),
    "dipole": ("dipole", look.GREY, {"xytext": (0, 8), "ha": "center"}),
    "multipoles": ("multipoles", look.SKY, {"xytext": (10, -8)}),
    "exact": ("exact", look.BLUE, {"xytext": (0, 9), "ha": "center"}),
    "magba": ("magba", look.VERMILION, {"xytext": (0, 18), "ha": "center"}),
    "magpylib batch": ("magpylib", look.PURPLE, {"xytext": (0, 9), "ha": "center"}),
}
OURS = ("mcm", "exact")  # the times of the others are told relative to one of these
OTHERS = ("scipy solve_bvp", "pyelastica settled", "magba", "magpylib batch")
CASES = {
    "tip dipole": ("A dipole on one core", "error of the angle (rad)", "time of a solve (µs)"),
    "ring near": ("Field of a ring, 2 to 6 radii off", "relative error", "time of a point (µs)"),
    "ring far": ("The same, 17 to 48 radii off", "", "time of a point (µs)"),
}


def placed(table: Table) -> Table:
    """Only what was solved, with errors in micrometres, none below the uncertainty of its reference."""
    length = 1e3 * table["length_mm"]
    known = length * table["reference_over_length"]
    error = np.maximum(length * table["tip_over_length"], known)
    solved = np.isfinite(table["time_us"]) & np.isfinite(error)
    columns = table.columns | {"error_um": error, "known_um": known}
    return Table(table.path, {name: cells[solved] for name, cells in columns.items()})


def front(table: Table) -> np.ndarray:
    """Rows in order of time than which none is both faster and better."""
    order = np.argsort(table["time_us"], kind="stable")
    error = table["error_um"][order]
    best = np.minimum.accumulate(error)
    return order[np.append(True, error[1:] < best[:-1])]


def powers(axes: Axes) -> None:
    """Both axes in powers of ten, few of them with numbers."""
    axes.set(xscale="log", yscale="log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=6))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(FuncFormatter(plain))


def draw_panel(axes: Axes, table: Table, limits: tuple[float, float]) -> None:
    """Methods of one design and level."""
    powers(axes)
    axes.set_ylim(limits)
    if not len(table["name"]):
        axes.text(0.5, 0.5, "no stable shape", transform=axes.transAxes, ha="center", color=look.GREY)
        return
    best = front(table)
    axes.plot(table["time_us"][best], table["error_um"][best], **FRONT)
    axes.axhspan(limits[0], max(table["known_um"]), color=look.LIGHT, lw=0, zorder=0)
    for name in dict.fromkeys(table["name"]):
        for start in ("cold", "warm"):
            own = table.where(name=name, start=start)
            level = name.removeprefix("level ")
            colour = look.METHOD.get(name) or look.LEVEL[level]
            how = {"marker": "s" if level != name else "o", "ms": 3.6, "mew": 0.9, "color": colour}
            how |= {
                "mfc": colour if start == "warm" else "white",
                "lw": 0.9,
                "alpha": 1 if start == "warm" else 0.6,
            }
            for part in parts(own):
                axes.plot(part["time_us"], part["error_um"], **how, zorder=3)
    default = table.where(name=DEFAULT[0], resolution=DEFAULT[1], start="warm")
    axes.plot(default["time_us"], default["error_um"], "o", mfc="none", mec=look.INK, ms=9, mew=1.4, zorder=4)


def parts(table: Table) -> list[Table]:
    """Points of one method that differ in one resolution: those of the potential method have a line for each degree."""
    kinds = np.array([words.split(",")[0] if "," in words else "" for words in table["resolution"]])
    return [
        Table(table.path, {name: cells[kinds == kind] for name, cells in table.columns.items()})
        for kind in dict.fromkeys(kinds)
    ]


def fastest(table: Table) -> str:
    """Who is first to solve warm with at most the error `TARGET`, and who is next."""
    good = table.where(start="warm")
    good = Table(good.path, {name: cells[good["error_um"] <= TARGET] for name, cells in good.columns.items()})
    times = sorted((good["time_us"][good["name"] == name].min(), name) for name in set(good["name"]))
    if not times:
        return f"to {TARGET:.0f} µm:\nno method"
    words = [f"{name} {time_in_words(time)}" for time, name in times[:2]]
    return f"to {TARGET:.0f} µm:\n{', '.join(words)}"


def time_in_words(time: float) -> str:
    """Microseconds with two digits, or milliseconds."""
    return f"{float(f'{time:.2g}'):g} µs" if time < 1000 else f"{float(f'{time / 1000:.2g}'):g} ms"


def title(panels: list[Table]) -> str:
    """Whether one method alone forms all fronts of warm starts."""
    names = set()
    for panel in panels:
        warm = panel.where(start="warm")
        names |= set(warm["name"][front(warm)]) if len(warm["name"]) else set()
    methods = names & set(look.METHOD)
    if methods == {"potential"}:
        return "No method is both faster and more exact than the potential method"
    return "Error against time: which method for which accuracy"


def plain(value: float, _: int) -> str:
    """Small powers of ten as numbers, others as powers."""
    return f"{value:g}" if 1e-3 < value <= 1e3 else f"$10^{{{round(np.log10(value))}}}$"


def draw_key(axes: Axes, table: Table) -> None:
    """The methods in their colours, in a line."""
    axes.set_axis_off()
    names = [name for name in look.METHOD if name in table["name"]]
    handles = [axes.plot([], [], "o", ms=4, color=look.METHOD[name], label=name)[0] for name in names]
    legend = axes.legend(
        handles=handles,
        ncols=len(names),
        loc="center left",
        bbox_to_anchor=(-0.01, 0.5),
        handletextpad=0,
        columnspacing=0.8,
    )
    legend.set_in_layout(False)
    for text, name in zip(legend.get_texts(), names, strict=True):
        text.set_color(look.METHOD[name])


def draw_peers(panels: list[Axes]) -> None:
    """Cases that other software solves as well."""
    peers = Table.read(PEERS)
    for axes, (case, (words, quantity, time)) in zip(panels, CASES.items(), strict=True):
        own = peers.where(case=case)
        powers(axes)
        best = {}
        for solver in dict.fromkeys(own["solver"]):
            name, colour, beside = SOLVERS[solver]
            for variant in dict.fromkeys(own["variant"]):
                points = own.where(solver=solver, variant=variant)
                plain_one = variant in PLAIN
                how = {
                    "marker": "o",
                    "ms": 3.6,
                    "mew": 0.9,
                    "lw": 0.9,
                    "mfc": colour if plain_one else "white",
                }
                axes.plot(
                    points["time_us"], points["error"], color=colour, alpha=1 if plain_one else 0.6, **how
                )
                if plain_one:
                    best[solver] = min(points["time_us"])
                    look.label(axes, points["time_us"][0], points["error"][0], name, colour, **beside)
        ours = next(best[solver] for solver in OURS if solver in best)
        others = (
            f"{SOLVERS[name][0]} {float(f'{best[name] / ours:.2g}'):g}\N{MULTIPLICATION SIGN}"
            for name in OTHERS
            if name in best
        )
        axes.set_title(f"{words}:\n{', '.join(others)}", fontsize=8.5)
        axes.set(xlabel=time, ylabel=quantity)
        axes.margins(x=0.25, y=0.18)
