"""Hysteresis: a magnet that passes turns nine segments over at one place, and back at another, 5 mm further."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

COLOUR = look.LEVEL["rings"]


def draw(table: Table) -> Figure:
    """Two panels: tip angle and place of the tip over the place of the magnet, forth and back."""
    figure, (left, right) = subplots(1, 2, figsize=(8.5, 4.4), sharex=True)
    look.title(
        figure,
        "Hysteresis: nine segments snap over at two places of the magnet, 5 mm apart",
        "magnet 120 mm aside, its field against the segments; level rings, bending stop; solid: forth, dashed: back",
    )
    left.set(title="The tip angle jumps", ylabel="tip angle (°)")
    loop(left, table, "alpha_{}_deg", "angle", {"forth": (-18.4, 152), "back": (-24, 171)})
    right.set(title="The tip goes to the other side", ylabel="tip, away from the magnet (mm)")
    loop(right, table, "tip_y_{}_mm", "tip", {"forth": (-13.3, 3), "back": (-24, 3)})
    return figure


def loop(axes, table: Table, column: str, quantity: str, words: dict[str, tuple[float, float]]) -> None:
    """Both directions with their snaps as arrows, and words at these places."""
    z, marks = table["magnet_z_mm"], table.marks()
    axes.set(xlabel="place of the magnet along the axis (mm)", xlim=(z[0], z[-1]))
    for way, other, ahead in (("forth", "back", 1), ("back", "forth", -1)):
        place, height = marks[f"snap {way}, {quantity}"]
        values, landed = table[column.format(way)], np.interp(place, z, table[column.format(other)])
        before = ahead * (z - place) < 0
        x = np.concatenate([z[before][::ahead], [place, place], z[~before][::ahead]])
        y = np.concatenate([values[before][::ahead], [height, landed], values[~before][::ahead]])
        axes.plot(x, y, color=COLOUR, ls=look.WAY[way])
        head(axes, place, height, landed)
        side = "right" if way == "back" else "center"
        text = f"{way}: at\n{place:.2f} mm".replace("-", "\u2212")
        look.label(axes, *words[way], text, COLOUR, ha=side, xytext=(0, 0))


def head(axes, place: float, start: float, end: float) -> None:
    """The head of an arrow in the middle of a snap."""
    middle, on = 0.5 * (start + end), 0.6 * end + 0.4 * start
    arrow = {"arrowstyle": "-|>", "color": COLOUR, "lw": 0, "mutation_scale": 18, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (place, on), (place, middle), arrowprops=arrow)
