"""Tolerances of the design explain the measured gain of the base ring, but not the measured bend of the cylinder."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

FULL = look.LEVEL["full"]


def draw(table: Table) -> Figure:
    """Four quantities with their bands of 95 %, three of them beside what the paper measured."""
    figure, ((one, gain), (three, cylinder)) = subplots(2, 2, figsize=(8.5, 6.2))
    look.title(
        figure,
        "Tolerances explain the measured gain, but not the cylinder's 16°",
        "bands of 95 %; standard deviations: 1 Shore A, 2 % of remanence, 0.05 mm between rings; level full",
    )
    field, direction = table["field_mt"], table["direction_deg"]
    banded(one, field, [table[f"alpha{end}_deg"] for end in ("", "_low", "_high")], FULL)
    banded(gain, field, [100 * table[f"gain{end}"] for end in ("", "_low", "_high")], FULL)
    banded(three, direction, [table[f"alpha_three{end}_deg"] for end in ("", "_low", "_high")], FULL)
    banded(
        cylinder,
        direction,
        [table[f"alpha_cylinder{end}_deg"] for end in ("", "_low", "_high")],
        look.CYLINDER,
    )
    measured(gain, three, cylinder, table.marks())
    one.set(title="One segment: 50° ± 7° at 25 mT", ylabel="tip angle (°)", ylim=(0, 60))
    gain.set(title="Gain from the base ring: inside", ylabel="more tip angle (%)", ylim=(0, 50))
    three.set(title="Three segments: outside at 170°", ylabel="tip angle (°)", ylim=(40, 140))
    cylinder.set(
        title="Solid cylinder: outside everywhere",
        ylabel="tip angle (°)",
        ylim=(0, 20),
        yticks=range(0, 21, 5),
    )
    for axes in (one, gain):
        axes.set(xlabel="field across (mT)", xlim=(0, 25))
    for axes in (three, cylinder):
        axes.set(xlabel="direction of 20 mT from the base's axis (°)", xlim=(60, 170))
    return figure


def banded(axes, places: np.ndarray, values: list[np.ndarray], colour: str) -> None:
    """A curve with its band."""
    middle, low, high = values
    axes.fill_between(places, low, high, color=colour, alpha=0.25, lw=0)
    axes.plot(places, middle, color=colour)


def measured(gain, three, cylinder, marks: dict[str, tuple[float, float]]) -> None:
    """What the paper measured."""
    value = 100 * marks["paper, gain"][1]
    look.level(gain, value, f"paper: {value:.0f} %", x=0.72, above=False)
    for axes, name in ((three, "three segments"), (cylinder, "cylinder")):
        value = marks[f"paper, {name}"][1]
        look.level(axes, value, f"paper: {value:.0f}°", x=0.03)
