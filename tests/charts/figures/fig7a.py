"""Fig. 7A: with every mutual interaction, the base ring adds the 31 % of tip angle that the paper measured."""

import look
import numpy as np
from matplotlib.figure import Figure
from matplotlib.pyplot import subplots
from study_table import Table

BOTH, TIP = {"ls": "-"}, {"ls": "--", "lw": 1.5}
ANGLES = (
    ("both_full", "both rings: full", look.LEVEL["full"], BOTH),
    ("both_preceding", "preceding", look.LEVEL["preceding"], BOTH),
    ("both_rings", "rings", look.LEVEL["rings"], BOTH),
    ("tip_full", "tip ring: full", look.LEVEL["full"], TIP),
    ("tip", "rings", look.LEVEL["rings"], TIP),
    ("helix", "helix alone", look.LEVEL["none"], BOTH),
)


def draw(table: Table) -> Figure:
    """Two panels: tip angles over the field, and the gain from the base ring beside the paper's."""
    figure, (left, right) = subplots(1, 2, figsize=(8.5, 4.4))
    look.title(
        figure,
        "Fig. 7A: with all interactions the base ring adds 31 % of angle, as measured",
        "colours: levels of interaction; left dashed: without the base ring; dots: the authors' scripts, both rings\n"
        "right solid: more angle in the same field; dashed: less field for the same angle",
    )
    field = table["field_mt"]
    angles(left, field, table)
    gains(right, field, table)
    return figure


def angles(axes, field: np.ndarray, table: Table) -> None:
    """Tip angles of the helix alone, with a tip ring, with both rings."""
    axes.set(xlabel="field across (mT)", ylabel="tip angle (°)", xlim=(0, field[-1]), ylim=(0, 60))
    axes.set_title("One segment bends by up to 58°")
    labels = []
    for name, words, colour, how in ANGLES:
        angle = table[f"alpha_{name}_deg"]
        axes.plot(field, angle, color=colour, **how)
        labels.append((field[-1], angle[-1], words, colour))
    axes.plot(
        field, table["alpha_authors_scripts_deg"], "o", color=look.MEASURED, ms=4, zorder=5, clip_on=False
    )
    look.ends(axes, labels)


def gains(axes, field: np.ndarray, table: Table) -> None:
    """Gain from the base ring at each level."""
    axes.set(xlabel="field across (mT)", ylabel="gain from the base ring (%)", xlim=(5, 25), ylim=(0, 40))
    axes.set_title("Only the level full gains as measured")
    last = np.flatnonzero(field == 25)[0]
    labels = []
    for level in ("full", "preceding", "rings"):
        colour = look.LEVEL[level]
        for what, how in (("angle", BOTH), ("field", TIP)):
            axes.plot(field, 100 * table[f"gain_{what}_{level}"], color=colour, **how)
        labels.append((field[last], 100 * table[f"gain_angle_{level}"][last], level, colour))
    look.ends(axes, labels)
    (_, paper) = table.marks()["paper, gain"]
    look.level(axes, 100 * paper, f"paper: {100 * paper:.0f} % for both", x=0.03)
