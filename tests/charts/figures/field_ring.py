"""Fig. 3E: close to a ring a dipole's field is far too large; the authors' fits are near the exact field."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table


def draw(table: Table) -> Figure:
    """Maps of the field and of a gradient above, both on the axis below."""
    figure, axes = subplots(2, 2, figsize=(8.5, 6.2))
    look.title(
        figure,
        "Fig. 3E: 5 mm from a ring's centre, the field of a dipole is 28 % too large",
        "dashed: a dipole of the same moment; dots: the authors' fits of Fig. 7A (full) and Fig. 8 (open)",
    )
    chart(axes[0, 0], table, "b_mt", "Size of the field $|B|$ (mT)", range(10, 45, 5))
    chart(axes[0, 1], table, "dbz_dz_t_per_m", r"Gradient $\partial B_z/\partial z$ (T/m)", range(-28, 1, 4))
    on_axis(axes[1, 0], table, "axis_bz_{}_mt", "Field on the axis", "$B_z$ (mT)")
    on_axis(
        axes[1, 1],
        table,
        "axis_dbz_dz_{}_t_per_m",
        "Gradient on the axis",
        r"$\partial B_z/\partial z$ (T/m)",
    )
    return figure


def chart(axes, table: Table, name: str, words: str, levels: range) -> None:
    """A map with a colour bar and contour lines."""
    y, z, values = table.grid("y_mm", "z_mm", name)
    colours = "viridis" if values.mean() > 0 else "viridis_r"
    drawn = axes.contourf(
        y,
        z,
        values.T,
        levels=np.arange(np.floor(values.min()), values.max() + 1),
        cmap=colours,
    )
    drawn.set_edgecolor("face")
    lines = axes.contour(y, z, values.T, levels=levels, colors="white", linewidths=0.9, linestyles="solid")
    axes.clabel(lines, fontsize=8)
    bar = axes.figure.colorbar(drawn, cax=axes.inset_axes([1.03, 0, 0.04, 1]), ticks=levels)
    bar.outline.set_visible(False)
    axes.set(
        title=words,
        xlabel="$y$ (mm)",
        ylabel="$z$ from the ring's centre (mm)",
        yticks=np.arange(3, 5.1, 0.5),
    )
    axes.grid(visible=False)


def on_axis(axes, table: Table, column: str, words: str, label: str) -> None:
    """The exact field on the axis beside a dipole and the authors' fits."""
    rows = np.isfinite(table[column.format("exact")])
    z = table["z_mm"][rows]
    exact, dipole = (table[column.format(name)][rows] for name in ("exact", "dipole"))
    axes.plot(z, exact, color=look.EXACT)
    axes.plot(z, dipole, color=look.GREY, ls="--")
    for name, style in (("fit_7a", {"mfc": look.MEASURED}), ("fit_8", {"mfc": "white"})):
        axes.plot(
            z, table[column.format(name)][rows], "o", color=look.MEASURED, zorder=3, clip_on=False, **style
        )
    axes.set(
        title=words,
        xlabel="$z$ from the ring's centre (mm)",
        ylabel=label,
        xlim=(z[0], z[-1]),
        xticks=np.arange(3, 5.1, 0.5),
    )
    look.ends(axes, [(z[-1], exact[-1], "exact", look.EXACT), (z[-1], dipole[-1], "dipole", look.GREY)])
