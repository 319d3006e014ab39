"""How many instructions whole commands take, against a budget: times are noisy, counts are not.

`MCM_WRITE=1 pytest tests/python/test_instructions.py` writes the budget anew. Counted by callgrind with the
instructions that every processor has (`MCM_PORTABLE`).
"""

import csv
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import PACKAGE, program

BUDGET = PACKAGE / "tests" / "bench" / "instructions.csv"

# A regression beyond this fails. Compilers and mathematical libraries differ by less.
REGRESSION = 1.05

PAIR = "[magnet]\norientation_wxyz = [0, 1, 0, 0]\n"
TURNING = "field.turn_deg=0:10:101"
PASSING = "magnet.position_mm[3]=20:30:101"
SHORTLY = "magnet.position_mm[3]=20:25:51"


def scene(segments: int, interaction: str, field: str) -> str:
    """A scene file."""
    return f'{field}[design]\nsegments = {segments}\n[model]\ninteraction = "{interaction}"\ntime_budget_s = 600\n'


# Scenes, and what varies in a sweep; `None` is one cold solve.
SCENES = {
    "S=1 rings, field turning": (scene(1, "rings", "[field]\nuniform_mt = [0, 20, 0]\n"), TURNING),
    "S=9 rings, pair passing": (scene(9, "rings", PAIR), PASSING),
    "S=1 full, pair passing": (scene(1, "full", PAIR), PASSING),
    "S=9 full, pair passing": (scene(9, "full", PAIR), SHORTLY),
    "S=9 auto, pair passing": (scene(9, "auto", PAIR), SHORTLY),
    "S=9 full, pair, cold": (scene(9, "full", PAIR), None),
}


def counted(folder: Path, name: str) -> int:
    """Instructions from the start of the program to its end, on one thread."""
    text, vary = SCENES[name]
    (folder / "scene.toml").write_text(text)
    task = ["sweep", "--vary", vary, "--out", "sweep.csv"] if vary else ["solve"]
    command = [
        "valgrind",
        "--tool=callgrind",
        "--callgrind-out-file=/dev/null",
        program(),
        *task,
        "scene.toml",
    ]
    environment = {**os.environ, "MCM_PORTABLE": "1", "RAYON_NUM_THREADS": "1"}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=600
    )
    assert done.returncode == 0, done.stderr
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found, done.stderr
    return int(found[1])


def budget() -> dict[str, float]:
    """Millions of instructions by scene."""
    with BUDGET.open(newline="") as file:
        return {row["scene"]: float(row["million_instructions"]) for row in csv.DictReader(file)}


@pytest.mark.parametrize("name", SCENES)
def test_commands_take_no_more_instructions_than_before(tmp_path: Path, name: str) -> None:
    count = counted(tmp_path, name) / 1e6
    if os.environ.get("MCM_WRITE"):
        rows = {**(budget() if BUDGET.exists() else {}), name: round(count, 1)}
        with BUDGET.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["scene", "million_instructions"])
            writer.writerows([own, rows[own]] for own in SCENES if own in rows)
        return
    allowed = budget()[name]
    print(f"{name}: {count:.1f} million instructions, {count / allowed:.3f} of the budget")
    assert count <= REGRESSION * allowed
