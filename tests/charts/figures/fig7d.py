"""Fig. 7D: 40 mm from the magnet pair, field and gradient along the device are those that the paper states."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

DARK, _, LIGHT = look.shades(look.EXACT, 3)
DISTANCES = {30: DARK, 40: look.EXACT, 50: LIGHT}
STATED = 40  # mm from the surface, where the paper states field and gradient


def draw(table: Table) -> Figure:
    """Sizes of field and gradient at three distances above, their components where the paper states them below."""
    figure, axes = subplots(2, 2, figsize=(8.5, 6), sharex=True)
    look.title(
        figure,
        "Fig. 7D: 40 mm from the magnet pair, field and gradient are as the paper states",
        "$z$: along the device, $y$: away from the magnet; nine segments reach 23 mm to both sides of its middle",
    )
    z, marks = table["z_mm"], table.marks()
    for column, parts, quantity in (
        (axes[:, 0], ("bz_at_{}_mt", "by_at_{}_mt"), "field"),
        (axes[:, 1], ("dbz_dz_at_{}_t_per_m", "dbz_dy_at_{}_t_per_m"), "gradient"),
    ):
        sizes(column[0], z, {mm: [table[part.format(mm)] for part in parts] for mm in DISTANCES})
        components(column[1], z, [table[part.format(STATED)] for part in parts])
        limits = tuple(marks[f"paper, {quantity} {end}"][1] for end in ("from", "to"))
        look.band(column[0], limits, "paper")
        column[1].set(
            xlabel="$z$ from the magnet's middle (mm)", xlim=(z[0], z[-1]), xticks=range(-120, 121, 40)
        )
    words(axes)
    return figure


def sizes(axes, z: np.ndarray, parts: dict[int, list[np.ndarray]]) -> None:
    """Sizes at all distances, each with its distance."""
    middle = len(z) // 2
    for mm, colour in DISTANCES.items():
        size = np.hypot(*parts[mm])
        axes.plot(z, size, color=colour, lw=2.4 if mm == STATED else 1.4)
        if mm < STATED:
            beside = np.flatnonzero(z == 50)[0]
            look.label(axes, 50, size[beside], f"{mm} mm", colour, xytext=(5, 4))
        else:
            look.label(axes, 0, size[middle], f"{mm} mm", colour, xytext=(0, -4), ha="center", va="top")
    axes.set_ylim(0, None)


def components(axes, z: np.ndarray, parts: list[np.ndarray]) -> None:
    """The components, in the styles of their axes."""
    axes.axhline(0, color=look.GREY, lw=0.8, zorder=1)
    for part, axis in zip(parts, ("z", "y"), strict=True):
        axes.plot(z, part, color=DISTANCES[STATED], ls=look.AXIS[axis])


def words(axes: np.ndarray) -> None:
    """Titles of the panels, and what the components are."""
    axes[0, 0].set_title("Along the device, the field is as stated")
    axes[0, 0].set_ylabel(r"$|B|$ (mT)")
    axes[0, 1].set_title("... and the gradient of $B_z$")
    axes[0, 1].set_ylabel(r"$|\nabla B_z|$ (T/m)")
    axes[1, 0].set_title("Components of the field at 40 mm")
    axes[1, 0].set_ylabel("field (mT)")
    axes[1, 1].set_title("Components of the gradient at 40 mm")
    axes[1, 1].set_ylabel("gradient (T/m)")
    for panel, place, text, side in (
        (axes[1, 0], (16, 26), "$B_z$", "left"),
        (axes[1, 0], (-66, 26), "$B_y$", "right"),
        (axes[1, 1], (-32, 0.75), r"$\partial B_z/\partial z$", "left"),
        (axes[1, 1], (-32, -0.8), r"$\partial B_z/\partial y$", "right"),
    ):
        look.label(panel, *place, text, DISTANCES[STATED], ha=side)
