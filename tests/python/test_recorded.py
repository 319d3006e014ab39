"""Tables of pages that repeat the recorded tables in `tests/charts/data`, which the charts show too."""

import csv
import re
from collections import Counter
from pathlib import Path

from conftest import PACKAGE
from markdown_pages import table

DATA = PACKAGE / "tests" / "charts" / "data"
STUDIES = PACKAGE / "src" / "studies" / "README.md"
MODELS = PACKAGE / "src" / "manipulator" / "README.md"
BENCH = PACKAGE / "tests" / "bench" / "README.md"

# Columns of the table of methods, after method, level, start and number of attempts.
VERDICTS = ["branch", "other_stable", "stalled", "diverged", "unstable", "wrong"]

# Scenes of the columns of the table of models.
SCENES = [
    "1 segment, 10 mT turning",
    "1 segment, pair passing",
    "3 segments, pair passing",
    "9 segments, pair passing",
]


def recorded(name: str) -> list[dict[str, str]]:
    """The rows of a recorded table."""
    with (DATA / f"{name}.csv").open(newline="") as lines:
        return list(csv.DictReader(lines))


def time(text: str) -> str:
    """Microseconds to three digits."""
    return f"{float(f'{float(text):.3g}'):g}"


def error(text: str) -> str:
    """An error to one digit: 4e-5, 0.7, 2."""
    one = f"{float(text):.0e}"
    return re.sub(r"e-0?", "e-", one) if float(one) < 0.1 else f"{float(one):g}"


def plain(cell: str) -> str:
    """A cell without the marks of code."""
    return cell.replace("`", "")


def assert_rows(shown: list[list[str]], expected: list[list[str]], page: Path) -> None:
    """A table of a page has these rows; a failure shows them as they should stand there."""
    got, wanted = ("\n".join(f"| {' | '.join(cells)} |" for cells in rows) for rows in (shown, expected))
    assert got == wanted, f"{page}:\n{wanted}"


def test_verdicts_on_methods() -> None:
    attempts = Counter()
    for row in recorded("stability"):
        levels = "`full`" if row["interaction"] == "full" else "`none`, `rings`"
        attempts[f"`{row['method']}`", levels, row["start"], row["verdict"]] += 1
    shown = table(STUDIES, "| method | level | start | attempts")
    expected = []
    for cells in shown:
        counts = [attempts.pop((*cells[:3], verdict), 0) for verdict in VERDICTS]
        expected.append([*cells[:3], str(sum(counts)), *map(str, counts)])
    assert not attempts
    assert_rows(shown, expected, STUDIES)


def test_models_by_tolerance() -> None:
    rows = {(row["scene"], row["model"], row["tolerance"]): row for row in recorded("fidelity")}
    shown = table(MODELS, "| model | 1 segment, 10 mT turning")
    expected = []
    for name, *_ in shown:
        model, tolerance = re.fullmatch(
            r"(.*?)(?:, bending stop|, (1e-\d)(?: of the length)?)?", plain(name)
        ).groups()
        key = (model, "" if tolerance is None else f"{float(tolerance):.5f}".rstrip("0"))
        found = [rows[scene, *key] for scene in SCENES]
        expected.append(
            [name, *(f"{time(row['time_us'])}, {error(row['tip_over_length'])}" for row in found)]
        )
    assert_rows(shown, expected, MODELS)


def test_settings_by_accuracy() -> None:
    rows = {
        (row["segments"], row["interaction"], row["name"], row["resolution"]): row
        for row in recorded("accuracy")
        if row["field"] == "pair" and row["start"] == "warm"
    }
    shown = table(BENCH, "| segments | level | method | resolution | time (us)")
    expected = []
    for segments, level, method, resolution, *_ in shown:
        replaced = re.fullmatch(r"(level \w+) instead", plain(resolution))
        own = (replaced[1], "degree 2") if replaced else (method, resolution.removesuffix(" (the default)"))
        row = rows[segments, plain(level), *own]
        errors = [error(row[name]) for name in ("tip_over_length", "angle_deg", "wrench_relative")]
        known = error(row["reference_over_length"])
        expected.append([segments, level, method, resolution, time(row["time_us"]), *errors, known])
    assert_rows(shown, expected, BENCH)
