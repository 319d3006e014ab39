"""The look of all pictures of the project: one colour for one meaning, labels at the curves, PNG and SVG."""

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt

plt.style.use(Path(__file__).with_suffix(".mplstyle"))

INK, GREY, LIGHT = "#22252a", "#80868f", "#e3e5e9"
NORTH, SOUTH = "#c8553d", "#4f7cac"  # poles of magnets

# Colours that people with colour blindness can tell apart: M. Okabe and K. Ito, Color Universal Design (2002).
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"

MEASURED = INK  # what the paper measured or states
LEVEL = {"none": SKY, "preceding": ORANGE, "rings": GREEN, "full": BLUE, "auto": VERMILION}
CYLINDER = PURPLE  # the solid cylinder beside which the paper measures


def label(axes, x: float, y: float, text: str, colour: str, **how) -> None:
    """Writes what a curve is at a place beside it, in its colour, 4 points to the right unless told otherwise."""
    how = {"xytext": (4, 0), "textcoords": "offset points", "ha": "left", "va": "center", "fontsize": 9} | how
    axes.annotate(text, (x, y), color=colour, annotation_clip=False, **how)


def title(figure, text: str, sentence: str = "") -> None:
    """The title of a picture, and under it the sentence that it shows."""
    figure.suptitle(text, x=0.01, ha="left", fontweight="bold")
    if sentence:
        figure.text(0.01, 0.0, sentence, ha="left", va="bottom", color=GREY, fontsize=9)


def save(figure, path: Path) -> list[Path]:
    """Writes a figure to `path` with the endings .png (200 dpi) and .svg, and closes it."""
    written = [path.with_suffix(ending) for ending in (".png", ".svg")]
    figure.savefig(written[0], metadata={"Software": None})
    figure.savefig(written[1], metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return written
