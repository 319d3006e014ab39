"""Tables that `mcm study` leaves: columns of numbers and words, and marks of the paper or of events."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Table:
    """The columns of a CSV file by name: arrays of numbers with NaN for empty cells, or lists of words."""

    path: Path
    columns: dict[str, np.ndarray]

    @classmethod
    def read(cls, path: Path) -> "Table":
        """The table in a file with a header."""
        with path.open(newline="") as file:
            header, *rows = csv.reader(file)
        columns = {name: column([row[i] for row in rows]) for i, name in enumerate(header)}
        return cls(path, columns)

    def __getitem__(self, name: str) -> np.ndarray:
        """A column; without one of this name the program ends and says which there are."""
        if name not in self.columns:
            raise SystemExit(f"{self.path} has no column {name}; it has {', '.join(self.columns)}")
        return self.columns[name]

    def where(self, **values) -> "Table":
        """The rows in which these columns have these values."""
        rows = np.all([self[name] == value for name, value in values.items()], axis=0)
        return Table(self.path, {name: cells[rows] for name, cells in self.columns.items()})

    def grid(self, x: str, y: str, value: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Two columns that span a grid, each value once, and a third one on it: `value[i, j]` at `x[i]`, `y[j]`."""
        (across, i), (along, j) = (np.unique(self[name], return_inverse=True) for name in (x, y))
        values = np.full((len(across), len(along)), np.nan)
        values[i, j] = self[value]
        return across, along, values

    def marks(self) -> dict[str, tuple[float, float]]:
        """The marks beside this table, in NAME-marks.csv: name, and place (NaN where it has none)."""
        return {name: (x, y) for name, x, y in self.places()}

    def places(self) -> list[tuple[str, float, float]]:
        """The same marks in order, where several have one name."""
        table = Table.read(self.path.with_name(f"{self.path.stem}-marks.csv"))
        return list(zip(table["mark"], table["x"], table["y"], strict=True))


def column(cells: list[str]) -> np.ndarray:
    """Numbers if all filled cells are numbers, else words."""
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)
