"""What changes the tip angle: tolerances, what the model leaves out, and what the paper measured."""

import look
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

GROUPS = {
    "Tolerances": ("combined", "tolerance"),
    "Left out of the model": ("omission",),
    "Model compared with the paper": ("paper",),
}
LIMITS = -48, 26  # percent
SHUT = 23.0  # percent, where the bar of a device ends whose rings snap together
SMALL = 0.2  # percent; what is less in all scenes is left out
HEIGHT = 0.36  # of a bar; rows are 1 apart


def draw(table: Table) -> Figure:
    """One row a quantity, a bar for each scene; numbers are those of the first scene."""
    figure, axes = subplots(figsize=(8.5, 7.4))
    y, places, words = 0.0, [], []
    for heading, kinds in GROUPS.items():
        places.append(y)
        words.append(heading)
        own = [
            rows
            for kind in kinds
            for quantity in dict.fromkeys(table.where(kind=kind)["quantity"])
            if size(rows := table.where(kind=kind, quantity=quantity)) > SMALL
        ]
        for rows in own:
            y -= 1.0
            places.append(y)
            words.append(named(rows))
            bars(axes, y, rows)
            axes.text(1.01, y, numbers(rows), transform=axes.get_yaxis_transform(), va="center", fontsize=9)
        y -= 1.6
    axes.set_yticks(places, words)
    for text in axes.get_yticklabels():
        text.set_fontweight("bold" if text.get_text() in GROUPS else "normal")
    axes.tick_params(axis="y", length=0)
    for number, scene in enumerate(dict.fromkeys(scene for scene in table["scene"] if scene)):
        axes.text(
            LIMITS[0] + 23 * number,
            0,
            f"■ {scene}",
            color=look.SEGMENTS[int(scene[0])],
            va="center",
            fontsize=9,
        )
    axes.axvline(0, color=look.INK, lw=0.8, zorder=4)
    axes.set(
        xlim=LIMITS, ylim=(y + 1, 0.7), xlabel="change of the tip angle, or difference from the paper (%)"
    )
    axes.grid(axis="y", visible=False)
    axes.spines["left"].set_visible(False)
    look.title(
        figure,
        f"No tolerance matters as much as the {table.where(kind='tolerance')['quantity'][0]}",
        f"Level full, field across the device; numbers: one segment. Less than {SMALL} % is left out.\n"
        "Arrows, “shut”: a device that is so soft snaps shut, ring on ring, before the field is reached.",
    )
    return figure


def bars(axes: Axes, y: float, rows: Table) -> None:
    """The bars of a quantity, one a scene; an arrow where the rings snap together before the full change."""
    for number, scene in enumerate(rows["scene"]):
        colour = look.SEGMENTS[int(scene[0])] if scene else look.MEASURED
        middle = y + (HEIGHT * (0.5 - number) if scene else 0.0)
        shut = rows["pulled_shut"][number] == "true"
        least = np.nanmin([rows["least_percent"][number], 0.0])
        largest = SHUT if shut else np.nanmax([rows["largest_percent"][number], 0.0])
        axes.barh(middle, largest - least, left=least, height=HEIGHT, color=colour, zorder=3)
        if shut:
            axes.plot(SHUT + 0.6, middle, ">", color=colour, ms=6, clip_on=False, zorder=3)


def size(rows: Table) -> float:
    """The largest change of a quantity in any scene, percent."""
    return np.nanmax(np.abs([rows["least_percent"], rows["largest_percent"]]))


def named(rows: Table) -> str:
    """A quantity with its change."""
    words = ", ".join(filter(None, (rows["quantity"][0], rows["change"][0])))
    return words.replace(" deg", "°").replace(" -", " \N{MINUS SIGN}")


def numbers(rows: Table) -> str:
    """The smallest and largest change of a quantity in the first scene, or one number if they are equal."""
    least, largest = rows["least_percent"][0], rows["largest_percent"][0]
    if least == largest:
        return signed(least)
    return f"{signed(least)} to {'shut' if np.isnan(largest) else signed(largest)}"


def signed(percent: float) -> str:
    """A number with its sign."""
    return f"{percent:+.{1 if abs(percent) < 10 else 0}f}".replace("-", "\N{MINUS SIGN}")
