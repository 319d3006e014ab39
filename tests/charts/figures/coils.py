"""Eight coils of 10 A reach at least 11 mT, or 0.15 T/m without a field, in every direction in their middle."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table


def draw(table: Table) -> Figure:
    """Two panels: field and gradient that are reached in every direction, along two axes."""
    figure, (left, right) = subplots(1, 2, figsize=(8.5, 4.2), sharex=True)
    look.title(
        figure,
        "Eight coils of 10 A reach 11 mT or 0.15 T/m in their middle, in any direction",
        "at most 10 A in each; the direction that is reached least counts; $z$: the upper coils' axis",
    )
    left.set_title("Field, whatever its gradient")
    left.set(ylabel="field (mT)", ylim=(0, 14))
    curves(left, table, "field_{}_mt")
    right.set_title("Gradient, without a field")
    right.set(ylabel="gradient (T/m)", ylim=(0, 0.21))
    curves(right, table, "gradient_{}_t_per_m")
    return figure


def curves(axes, table: Table, column: str) -> None:
    """Along x and along z."""
    place = table["place_mm"]
    axes.set(xlabel="distance from the middle (mm)", xlim=(place[0], place[-1]))
    for axis in ("z", "x"):
        values = table[column.format(axis)]
        axes.plot(place, values, color=look.EXACT, ls=look.AXIS[axis])
        look.label(axes, place[-1], values[-1], f"along ${axis}$", look.EXACT)
    middle = table[column.format("z")][np.flatnonzero(place == 0)[0]]
    axes.plot(0, middle, "o", color=look.EXACT)
