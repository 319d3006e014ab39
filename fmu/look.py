"""The look of all pictures of the project: one colour for one meaning, labels at the curves, PNG and SVG."""

import io
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

plt.style.use(Path(__file__).with_suffix(".mplstyle"))

INK, GREY, LIGHT = "#22252a", "#80868f", "#e3e5e9"
NORTH, SOUTH = "#c8553d", "#4f7cac"  # poles of magnets
WALL, LUMEN = "#cf958e", "#f7e6e3"  # of vessels

# Colours that people with colour blindness can tell apart: M. Okabe and K. Ito, Color Universal Design (2002).
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"

MEASURED = INK  # what the paper measured or states
LEVEL = {"none": SKY, "preceding": ORANGE, "rings": GREEN, "full": BLUE, "auto": VERMILION}
CYLINDER = PURPLE  # the solid cylinder beside which the paper measures
EXACT = LEVEL["full"]  # the exact model, where nothing interacts

# Line styles of components along an axis, of lines along an axis, and of the ways of a load.
AXIS = {"x": "--", "y": (0, (1, 1.2)), "z": "-"}
WAY = {"forth": "-", "back": "--"}
PRINTED = {"ls": "--", "lw": 1.2}  # formulas of the paper as printed


def shades(colour: str, count: int) -> list[tuple[float, ...]]:
    """A colour from dark to light, for values that have an order."""
    base, black, white = (np.array(mpl.colors.to_rgb(name)) for name in (colour, "black", "white"))
    mixed = [
        base + part * (white - base) if part > 0 else base - part * (black - base)
        for part in np.linspace(-0.5, 0.45, count)
    ]
    return [tuple(one) for one in mixed]


# Methods: that of the project, and the others in the muted colours of P. Tol, Colour Schemes (2021).
METHOD = {
    "potential": BLUE,
    "collocation": "#882255",
    "multiple-shooting": "#999933",
    "shooting": "#cc6677",
    "shooting-fd": "#aa4499",
    "planar": "#44aa99",
    "constant-curvature": INK,
}
SEGMENTS = {1: "#9181d4", 3: "#6444a8", 9: "#331266"}  # number of segments: the more, the darker


def label(axes, x: float, y: float, text: str, colour: str, **how) -> None:
    """Writes what a curve is at a place beside it, in its colour, 4 points to the right unless told otherwise."""
    how = {"xytext": (4, 0), "textcoords": "offset points", "ha": "left", "va": "center", "fontsize": 9} | how
    axes.annotate(text, (x, y), color=colour, annotation_clip=False, **how)


def ends(axes, labels: list[tuple[float, float, str, str]], away: float = 4, **how) -> None:
    """Writes `(x, y, text, colour)` at the right ends of curves, moved apart where they would overlap.

    They are `away` points from the ends. Titles and limits have to be set before: they decide how much room there is.
    """
    axes.figure.draw_without_rendering()
    size = how.get("fontsize", 9)
    lines = [1.3 * size * (1 + text.count("\n")) for _, _, text, _ in labels]
    heights = [axes.transData.transform((x, y))[1] * 72 / axes.figure.dpi for x, y, _, _ in labels]
    for (x, y, text, colour), shift in zip(labels, apart(heights, lines), strict=True):
        label(axes, x, y, text, colour, **({"xytext": (away, shift)} | how))


def apart(heights: list[float], sizes: list[float]) -> np.ndarray:
    """Least shifts, by their squares, after which things of these sizes that are centred at these heights are apart."""
    order = np.argsort(heights)
    heights, sizes = (np.array(values, dtype=float) for values in (heights, sizes))
    stacked = np.cumsum(sizes[order]) - 0.5 * sizes[order]
    # Relative to a stack without gaps the heights may only rise: neighbours that fall are pooled to their mean.
    pools: list[tuple[float, int]] = []
    for height in heights[order] - stacked:
        pools.append((height, 1))
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (low, few), (high, many) = pools.pop(), pools.pop()
            pools.append(((low * few + high * many) / (few + many), few + many))
    placed, counts = zip(*pools, strict=True)
    shifts = np.empty_like(heights)
    shifts[order] = np.repeat(placed, counts) + stacked - heights[order]
    return shifts


def level(axes, y: float, text: str, x: float = 0.02, above: bool = True) -> None:
    """A value of the paper as a line across, and what it is, at a part of the width above or below it."""
    axes.axhline(y, color=MEASURED, lw=1.2, zorder=1.5)
    how = {"va": "bottom", "xytext": (0, 2)} if above else {"va": "top", "xytext": (0, -3)}
    label(axes, x, y, text, MEASURED, xycoords=axes.get_yaxis_transform(), **how)


def band(axes, limits: tuple[float, float], text: str, x: float = 0.02) -> None:
    """A range of the paper as a band across, and in it what it is, at a part of the width."""
    axes.axhspan(*limits, color=MEASURED, alpha=0.12, lw=0, zorder=0.5)
    how = {"xytext": (0, 0), "xycoords": axes.get_yaxis_transform()}
    label(axes, x, 0.5 * sum(limits), text, MEASURED, **how)


def title(figure, text: str, sentence: str = "") -> None:
    """The title of a picture, and under it the sentence that it shows."""
    figure.suptitle(text, x=0.01, ha="left", fontweight="bold")
    if sentence:
        figure.supxlabel(sentence, x=0.01, ha="left", color=GREY, fontsize=9)  # keeps room for itself


def save(figure, path: Path) -> list[Path]:
    """Writes a figure to `path` with the endings .png (200 dpi, 256 colours) and .svg, and closes it."""
    written = [path.with_suffix(ending) for ending in (".png", ".svg")]
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", metadata={"Software": None})
    # A third of the bytes; areas keep their colours, pixels at the edge of a line are off by 20 of 255 at most.
    few = Image.open(drawn).convert("RGB").quantize(256, kmeans=5, dither=Image.Dither.NONE)
    few.save(written[0], optimize=True)
    figure.savefig(written[1], metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return written
