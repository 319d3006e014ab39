"""Fig. 8: two rings bend each other further, but the fields of four or five straighten the last one."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

COUNTS = dict(zip((2, 3, 4, 5), look.shades(look.EXACT, 4), strict=True))
DEFLECTION, TORQUE = "deflection of adjacent rings (°)", "torque (µN m)"


def draw(table: Table) -> Figure:
    """Torques by gradient and field, their sum over angle and spacing, and where they balance."""
    figure, ((parts, sums), (spaced, balance)) = subplots(2, 2, figsize=(8.5, 6.2))
    look.title(
        figure,
        "Fig. 8: two rings bend each other further, four or five straighten each other",
        "torque on the last ring by those before it; positive bends it further; 4 mm apart, but where spacings vary",
    )
    parts.set(title="Gradient and field nearly cancel", xlabel=DEFLECTION, ylabel=TORQUE)
    sums.set(title="Below 35°, four or five straighten", xlabel=DEFLECTION, ylabel=TORQUE)
    spaced.set(title="At 20°, closer rings bend further", xlabel="spacing (mm)", ylabel=TORQUE)
    balance.set(title="Closer than this, the gradient wins", xlabel=DEFLECTION, ylabel="spacing (mm)")
    deflection, spacing = table["deflection_deg"], table["spacing_mm"]
    curves(parts, deflection, table, "gradient_torque_{}_rings_unm")
    curves(parts, deflection, table, "field_torque_{}_rings_unm")
    look.label(parts, 3, 22, "by the gradient,\nbends further", look.INK)
    look.label(parts, 3, -22, "by the field,\nstraightens", look.INK)
    labelled(sums, curves(sums, deflection, table, "torque_{}_rings_unm"))
    labelled(spaced, curves(spaced, spacing, table, "torque_at_20_deg_{}_rings_unm"))
    labelled(balance, curves(balance, deflection, table, "balance_spacing_{}_rings_mm"))
    for axes in (parts, sums, spaced):
        axes.axhline(0, color=look.GREY, lw=0.8, zorder=1)
    return figure


def curves(axes, places: np.ndarray, table: Table, column: str) -> list[tuple[float, float, int]]:
    """A curve for each number of rings; returns their ends and numbers."""
    ends = []
    for count, colour in COUNTS.items():
        values = table[column.format(count)]
        axes.plot(places, values, color=colour)
        ends.append((places[-1], values[-1], count))
    axes.set_xlim(0 if places[0] == 1 else places[0], places[-1])
    return ends


def labelled(axes, ends: list[tuple[float, float, int]]) -> None:
    """The numbers of rings at the ends of their curves."""
    look.ends(
        axes, [(x, y, f"{count} rings" if count == 2 else f"{count}", COUNTS[count]) for x, y, count in ends]
    )
