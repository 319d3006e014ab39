"""The charts: each is drawn from its recorded table, in the size of talks, and wrong calls are told in words."""

import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PACKAGE
from PIL import Image

CHARTS = PACKAGE / "tests" / "charts"
DATA = CHARTS / "data"
FIGURES = {path.stem for path in (CHARTS / "figures").glob("*.py")}
RECORDED = sorted(path.stem for path in DATA.glob("*.csv") if path.stem.replace("-", "_") in FIGURES)
LEAST_WIDTH = 1600  # pixels: 8 inches at 200 dpi


def draw(*words: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs the program behind tests/charts/draw."""
    command = [sys.executable, str(CHARTS / "draw.py"), *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_recorded_tables_are_drawn_as_png_and_svg(tmp_path: Path) -> None:
    assert len(RECORDED) > 12
    done = draw(DATA, "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {
        f"{name}{end}" for name in RECORDED for end in (".png", ".svg")
    }
    for name in RECORDED:
        with Image.open(tmp_path / f"{name}.png") as drawn, Image.open(CHARTS / f"{name}.png") as kept:
            assert drawn.size == kept.size, f"{name}.png is of another table or look than its figure"
            assert drawn.width >= LEAST_WIDTH
            assert len(drawn.convert("RGB").getcolors(1 << 24)) > 10, f"{name}.png is empty"


def test_a_curve_follows_its_table(tmp_path: Path) -> None:
    for scale in (1.0, 0.5):
        folder = tmp_path / str(scale)
        folder.mkdir()
        (folder / "fig5-marks.csv").write_text((DATA / "fig5-marks.csv").read_text())
        header, *rows = (line.split(",") for line in (DATA / "fig5.csv").read_text().splitlines())
        scaled = [",".join([row[0], *(str(scale * float(cell)) for cell in row[1:])]) for row in rows]
        (folder / "fig5.csv").write_text("\n".join([",".join(header), *scaled]) + "\n")
        assert draw(folder, "fig5").returncode == 0
    assert (tmp_path / "1.0/fig5.svg").read_bytes() != (tmp_path / "0.5/fig5.svg").read_bytes()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["no_folder"], "no_folder is no folder"),
        ([DATA, "fig6"], "there is no figure fig6"),
        ([PACKAGE / "src", "fig5"], "`mcm study fig5 --out"),
        ([PACKAGE / "src"], "`mcm study all --out"),
    ],
)
def test_wrong_calls_are_told(words: list[str | Path], told: str) -> None:
    done = draw(*words)
    assert done.returncode == 2
    assert told in done.stderr


def test_a_table_without_a_column_is_told(tmp_path: Path) -> None:
    (tmp_path / "fig5.csv").write_text("segments,mu_rel\n1,0.2\n")
    done = draw(tmp_path)
    assert done.returncode == 1
    assert "has no column" in done.stderr
