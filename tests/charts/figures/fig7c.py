"""Fig. 7C: the magnet pulls nine segments 1.8 times as hard as a solid cylinder."""

import look
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

DEVICES = (("manipulator", "nine segments", look.EXACT), ("cylinder", "solid cylinder", look.CYLINDER))


def draw(table: Table) -> Figure:
    """Two panels: force along the device and towards the magnet over the magnet's offset."""
    figure, (left, right) = subplots(1, 2, figsize=(8.5, 4.2), sharex=True)
    look.title(
        figure,
        "Fig. 7C: the magnet pulls nine segments 1.8 times as hard as the cylinder",
        "both held straight, 40 mm from the magnet pair's surface; cylinder: volume fraction 0.2",
    )
    axial(left, table)
    across(right, table)
    return figure


def panel(axes, component: str, table: Table) -> None:
    """A component of the force on both devices, mN."""
    offset = table["offset_mm"]
    for name, _, colour in DEVICES:
        axes.plot(offset, 1e3 * table[f"{component}_{name}_n"], color=colour)
    axes.axhline(0, color=look.GREY, lw=0.8, zorder=1)
    axes.set(xlabel="offset of the magnet (mm)", xlim=(offset[0], offset[-1]), xticks=range(-120, 121, 40))


def axial(axes, table: Table) -> None:
    """Along the device, with the largest force of the paper."""
    axes.set_title("Along the device: 14 % more than measured")
    axes.set(ylabel="axial force (mN)", ylim=(-130, 130))
    panel(axes, "axial_force", table)
    low, high = (1e3 * table.marks()[f"paper, axial force {end}"][1] for end in ("from", "to"))
    look.level(axes, high, f"paper: at most {high:.0f} mN", x=0.03)
    look.level(axes, low, "")


def across(axes, table: Table) -> None:
    """Towards the magnet, with the labels of the devices."""
    axes.set_title("Towards the magnet: strongest beside it")
    axes.set(ylabel="attraction (mN)")
    panel(axes, "attraction", table)
    (_, segments, blue), (name, cylinder, purple) = DEVICES
    look.label(axes, 22, 110, segments, blue, xytext=(8, 0))
    most = 1e3 * table[f"attraction_{name}_n"].max()
    look.label(axes, 0, most, cylinder.replace(" ", "\n"), purple, xytext=(0, -6), ha="center", va="top")
