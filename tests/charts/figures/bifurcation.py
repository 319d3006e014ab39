"""Where shapes end: stable and unstable equilibria over a load, their folds, and the path of slow loading."""

import look
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

WAY = {"color": "#f6dd8b", "lw": 6, "zorder": 1}  # of slow loading
JUMP = 15.0  # degrees between two shapes of slow loading that a snap lies between
CORE, ONE, THREE, NINE = look.EXACT, look.SEGMENTS[1], look.SEGMENTS[3], look.SEGMENTS[9]


def draw(table: Table) -> Figure:
    """Five diagrams, and the field at which rings snap together over their gap."""
    figure, grid = subplots(3, 2, figsize=(8.5, 9.2))
    (turning, growing), (nearing, pulling), (gap, critical) = grid

    diagram(turning, table, "turning_deg", [CORE])
    turning.set(
        title="A dipole on one core swings over\nas the field turns past 180°",
        xlabel="direction of a field of 61 mT (°)",
        xticks=(60, 120, 180, 240, 300),
    )
    look.label(turning, 90, 52.4, "stable", CORE, xytext=(0, 14), ha="center")
    look.label(turning, 173, -30, "unstable", CORE, ha="right", xytext=(-2, 0))
    look.label(turning, 182, -55, "snap", look.INK)

    diagram(growing, table, "growing_mt", [look.GREY, CORE])
    buckling = min(x for x, _ in folds(table, "growing"))
    growing.set(
        title=f"A field against the dipole buckles it\nat {buckling:.0f} mT; 1° aside there is no jump",
        xlabel="field (mT)",
    )
    look.label(growing, 18, 0, "exactly against it", look.GREY, xytext=(0, -9), ha="center")
    look.label(growing, 57, 79, "1° aside", CORE, xytext=(-4, 8), ha="right")

    diagram(nearing, table, "nearing_mm", [NINE])
    comes, goes = (fold[0] for *_, fold in steps(table, "nearing_mm") if fold)
    nearing.set(
        title=f"Nine segments snap as the magnets come\nto {comes:.0f} mm, and back only at {goes:.0f} mm",
        xlabel="distance of the magnets' axis (mm)",
    )

    diagram(pulling, table, "pulling_mt", [ONE, THREE])
    one, three = (x for x, _ in folds(table, "pulling"))
    pulling.set(
        title=f"Rings snap together: of one segment\nat {one:.0f} mT, of three at {three:.0f} mT",
        xlabel="field across the device (mT)",
    )
    look.label(pulling, 20, 42.6, "one segment", ONE, xytext=(2, -9))
    look.label(pulling, 5, 58.7, "three segments", THREE, xytext=(4, -9))

    diagram(gap, table, "gap_mt", [ONE] * 3)
    touching = next(y for name, _, y in table.places() if name.startswith("windings touch"))
    gap.axhline(touching, color=look.GREY, lw=1)
    look.label(gap, 0, touching, "windings touch", look.GREY, xytext=(2, -7))
    for branch, (words, above) in enumerate((("gap 3 mm", -8), ("3.4 mm", 7), ("4 mm, as built", -8))):
        angle = table[f"gap_{branch}_unstable_deg"]
        look.label(gap, 0, angle[np.isfinite(angle)][-1], words, ONE, xytext=(4, above))
    gap.set(
        title="Closer rings snap together in less field,\nall after the windings touch",
        xlabel="field across one segment (mT)",
    )

    for branch, colour, words in ((0, ONE, "one segment"), (1, THREE, "three segments")):
        field = table[f"critical_{branch}_stable_mt"]
        known = np.isfinite(field)
        x, y = table["critical_mm"][known], field[known]
        critical.plot(x, y, color=colour)
        look.label(critical, x[len(x) // 2], y[len(x) // 2], words, colour, xytext=(0, 12), ha="right")
    critical.set(
        title="The wider the gap, the more field until\nthe rings snap together",
        xlabel="gap between the rings (mm)",
        ylabel="critical field (mT)",
        ylim=(0, None),
    )

    look.title(
        figure,
        "Where shapes end: at folds, from which slow loading snaps",
        "Solid: stable; dashed: unstable; circles: folds and branching points. Broad: the path of slow loading, "
        "arrows: its snaps.\nFirst row: no interaction; nine segments: level rings; the others: level full.",
    )
    return figure


def diagram(axes: Axes, table: Table, load: str, colours: list) -> None:
    """Branches in their colours with their folds, and slow loading with an arrow at each snap."""
    name, _ = load.split("_")
    for branch, colour in enumerate(colours):
        axes.plot(table[load], table[f"{name}_{branch}_stable_deg"], color=colour, zorder=3)
        for piece in pieces(table[load], table[f"{name}_{branch}_unstable_deg"]):
            axes.plot(*piece, ls="--", color=colour, zorder=3)
    for start, end, fold in steps(table, load):
        if not fold:
            axes.plot(*zip(start, end, strict=True), **WAY)
            continue
        axes.plot(*zip(start, fold, strict=True), **WAY)
        how = {"arrowstyle": "-|>", "color": look.INK, "lw": 1.4, "shrinkA": 3, "shrinkB": 1}
        axes.annotate("", (fold[0], end[1]), fold, arrowprops=how, zorder=4)
    for fold in folds(table, name):
        axes.plot(*fold, "o", mfc="white", mec=look.INK, ms=6, mew=1.4, zorder=5)
    axes.set_ylabel("tip angle (°)")


def pieces(x: np.ndarray, y: np.ndarray) -> list[np.ndarray]:
    """The parts of a curve between empty rows, without what an earlier one has drawn: dashes stay dashes."""
    drawn = []
    near = 0.005 * np.array([np.nanmax(x) - np.nanmin(x), 90.0])
    for rows in np.split(np.arange(len(x)), np.flatnonzero(np.isnan(y))):
        piece = np.array([x[rows], y[rows]])[:, np.isfinite(y[rows])]
        if piece.size == 0:
            continue
        for earlier in drawn:
            fine = np.linspace(0, earlier.shape[1] - 1, 2000)
            line = np.array([np.interp(fine, np.arange(earlier.shape[1]), row) for row in earlier])
            apart = np.abs(piece[:, :, None] - line[:, None, :]) / near[:, None, None]
            piece = np.where((apart.max(axis=0) < 1).any(axis=1), np.nan, piece)
        drawn.append(piece)
    return drawn


def folds(table: Table, name: str) -> list[tuple[float, float]]:
    """Folds and branching points of a diagram."""
    return [(x, y) for mark, x, y in table.places() if mark.endswith(f", {name}") and np.isfinite(x)]


def steps(table: Table, load: str) -> list[tuple]:
    """Both ends of each step of slow loading, and the fold if it snaps: it turns far more than its neighbours."""
    name, _ = load.split("_")
    angle = table[f"{name}_loading_deg"]
    known = np.isfinite(angle)
    x, y = table[load][known], angle[known]
    apart, turned = np.abs(np.diff(x)), np.abs(np.diff(y))
    beside = np.maximum(np.append(turned[1:], 0.0), np.insert(turned[:-1], 0, 0.0))
    snaps = turned > np.maximum(JUMP, 2.5 * beside)
    found = []
    # A longer step leads from the end of one loading to the start of the next.
    for i in np.flatnonzero(apart < 2 * np.median(apart)):
        low, high = sorted(x[i : i + 2])
        within = [place for place in folds(table, name) if snaps[i] and low <= round(place[0], 6) <= high]
        fold = min(within, key=lambda place, i=i: abs(place[1] - y[i]), default=None)
        found.append(((x[i], y[i]), (x[i + 1], y[i + 1]), fold))
    return found
