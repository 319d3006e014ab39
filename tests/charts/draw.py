"""Draws the tables of a folder: NAME.csv by the function `draw` of figures/NAME.py (`-` in a name is `_` there)."""

import argparse
import importlib
import sys
from pathlib import Path

import study_table

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "fmu"))
look = importlib.import_module("look")

FIGURES = sorted(path.stem for path in (HERE / "figures").glob("*.py"))


def module_of(name: str) -> str:
    """The module that draws a study."""
    return name.replace("-", "_")


def main() -> None:
    """Draws what is asked for, or all of the folder that has a figure."""
    parser = argparse.ArgumentParser(prog="tests/charts/draw", description=__doc__.splitlines()[0])
    parser.add_argument(
        "folder", nargs="?", type=Path, default=HERE / "data", help="where `mcm study` left its tables"
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="names of studies; all without")
    parser.add_argument("--out", type=Path, help="folder of the pictures; that of the tables without")
    asked = parser.parse_args()
    if not asked.folder.is_dir():
        parser.error(f"{asked.folder} is no folder")
    recorded = asked.folder.resolve() == HERE / "data"
    out = asked.out or (HERE if recorded else asked.folder)
    out.mkdir(parents=True, exist_ok=True)
    found = [path.stem for path in sorted(asked.folder.glob("*.csv")) if module_of(path.stem) in FIGURES]
    for name in asked.names:
        if module_of(name) not in FIGURES:
            parser.error(f"there is no figure {name}; there are {', '.join(FIGURES)}")
        if name not in found:
            parser.error(
                f"{asked.folder} has no {name}.csv: `mcm study {name} --out {asked.folder}` makes it"
            )
    if not found:
        parser.error(
            f"{asked.folder} has no table of a study: `mcm study all --out {asked.folder}` makes them"
        )
    for name in asked.names or found:
        module = importlib.import_module(f"figures.{module_of(name)}")
        written = look.save(module.draw(study_table.Table.read(asked.folder / f"{name}.csv")), out / name)
        print(*written)


if __name__ == "__main__":
    main()
