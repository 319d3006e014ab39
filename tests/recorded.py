#!/usr/bin/env python3
"""Solves random scenes with one build of `mcm` and compares the answers with those of another one.

    tests/recorded.py record target/release/mcm before.jsonl
    tests/recorded.py compare before.jsonl after.jsonl

A rewrite keeps its numbers if the second command ends with 0. Scenes follow from the seed alone, so that both builds
solve the same ones; every line of a record holds its scene, with which a difference can be looked into.
"""

import argparse
import itertools
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from random_scenes import Draw, toml

# Processor time of one scene: `mcm` is told of no limit, as its answer would depend on the load of the machine.
LIMIT_S = 60

# Largest distance between two shapes of one scene, relative to the length of the device.
SAME_SHAPE = 1e-9

# Keys of an answer that tell how it was found: these may change with the order of additions.
HOW_FOUND = {"iterations", "residual", "progress"}

# Smallest scale of forces: what is left of forces that cancel is compared with a thousandth of what bends a device.
SMALL_N = 1e-3


def solve(binary: Path, folder: Path, number: int, text: str) -> dict:
    """What the program makes of a scene: its exit status (-24 beyond the limit of time), JSON and messages."""
    scene = folder / f"{number}.toml"
    scene.write_text(text)
    command = [binary, "solve", scene.name, "--json", "--shape-points", "21"]
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        resource.prlimit(run.pid, resource.RLIMIT_CPU, (LIMIT_S, LIMIT_S + 1))
        printed, said = run.communicate()

    # What the program says of its progress depends on how fast it is.
    messages = [line for line in said.splitlines() if not line.endswith(" ...")]
    answer = json.loads(printed) if printed else None
    return {"number": number, "status": run.returncode, "answer": answer, "messages": messages, "scene": text}


def record(binary: Path, out: Path, count: int, seed: int) -> None:
    """Solves scenes and writes a line for each."""
    binary = binary.resolve(strict=True)
    vessels = {}
    for name in ("aorta", "aorta-spatial"):
        printed = subprocess.run(
            [binary, "init", "--vessel", name], capture_output=True, text=True, check=True
        )
        vessels[name] = tomllib.loads(printed.stdout)["vessel"]

    texts = [toml(Draw(seed, number, vessels).scene()) for number in range(count)]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as workers:
        folders, binaries = itertools.repeat(Path(folder)), itertools.repeat(binary)
        answers = list(workers.map(solve, binaries, folders, range(count), texts))

    out.write_text("".join(json.dumps(answer) + "\n" for answer in answers))
    statuses = [answer["status"] for answer in answers]
    counted = ", ".join(f"{statuses.count(one)} with status {one}" for one in sorted(set(statuses)))
    print(f"{out}: {count} scenes, {counted}")


@dataclass
class Difference:
    """The largest difference of an output, relative to its scale, and the scene that has it."""

    largest: float = 0.0
    number: int | None = None

    def update(self, size: float, number: int) -> None:
        """Takes the difference of one more scene."""
        if size > self.largest:
            self.largest, self.number = size, number


def flat(value: object, key: str = "") -> Iterator[tuple[str, object]]:
    """What stands in an answer, piece by piece, with the key it is under; entries of a list have its key."""
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from flat(inner, f"{key}.{name}" if key else name)
    elif isinstance(value, list):
        yield key, len(value)
        for inner in value:
            yield from flat(inner, key)
    else:
        yield key, value


def words(value: object) -> str:
    """A text without its numbers, which may differ in their last digit."""
    return re.sub(r"[\d.]+", "0", str(value))


def same(before: object, after: object) -> bool:
    """Whether counts and truth values are equal, and texts have the same words."""
    texts = isinstance(before, str) and isinstance(after, str)
    return words(before) == words(after) if texts else before == after


def is_number(value: object) -> bool:
    """A number that was computed; counts and truth values are compared as they are."""
    return isinstance(value, float)


def scale(key: str, pieces: list[tuple[str, object]], length: float) -> float:
    """The scale of an output: the length of the device, its largest force, or its own size."""
    own = [abs(value) for name, value in pieces if name == key and is_number(value)]
    forces = [abs(value) for name, value in pieces if name.endswith("_n") and is_number(value)]
    force = max(forces, default=0.0) + SMALL_N
    unit = key.rsplit("_", 1)[-1]
    moment = force * length
    least = {
        "m": length,
        "rad": 1.0,
        "margin": 1.0,
        "n": force,
        "nm": moment,
        "j": moment,
        "per_m": 1 / length,
    }
    return max(least.get("per_m" if key.endswith("_per_m") else unit, 0.0), *own, sys.float_info.min)


def compare_answers(one: dict, other: dict, differences: dict[str, Difference]) -> str | None:
    """Tells what is not the same in the answers to one scene; numbers go into the table of differences."""
    number = one["number"]
    if one["scene"] != other["scene"]:
        return "is another scene"
    if one["status"] != other["status"]:
        return f"status {one['status']}, then {other['status']}"
    first, second = ([*flat(run["answer"] or {})] for run in (one, other))
    if [key for key, _ in first] != [key for key, _ in second]:
        return "other outputs"

    # A scene without a shape has no length: all its numbers are null.
    arc_lengths = [value for key, value in first if key == "shape_arc_lengths_m" and is_number(value)]
    length = max(arc_lengths, default=1.0)
    scales = {key: scale(key, first, length) for key, value in first if is_number(value)}

    shape = 0.0
    for (key, before), (_, after) in zip(first, second, strict=True):
        if is_number(before) and is_number(after):
            size = abs(after - before) / scales[key]
            differences.setdefault(key, Difference()).update(size, number)
            shape = max(shape, size) if key in {"shape_m", "tip_position_m", "ring_positions_m"} else shape
        elif key not in HOW_FOUND and not same(before, after):
            return f"{key} {before}, then {after}"
    if shape > SAME_SHAPE:
        return f"another shape, by {shape:.1e} of the length"
    return None if words(one["messages"]) == words(other["messages"]) else "other messages"


def compare(before: Path, after: Path) -> int:
    """Prints the largest differences and the scenes that are not answered the same; 1 if there are any."""
    records = [[json.loads(line) for line in path.read_text().splitlines()] for path in (before, after)]
    if len(records[0]) != len(records[1]) or not records[0]:
        print(f"{len(records[0])} scenes, then {len(records[1])}")
        return 1

    differences: dict[str, Difference] = {}
    told = []
    for one, other in zip(*records, strict=True):
        if said := compare_answers(one, other, differences):
            told.append(f"scene {one['number']}: {said}")

    for key, found in sorted(differences.items()):
        where = "" if found.number is None else f"  scene {found.number}"
        print(f"{key:40} {found.largest:8.1e}{where}")
    print("\n".join([*told, f"{len(told)} of {len(records[0])} scenes differ"]))
    return 1 if told else 0


def main() -> int:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    forms = parser.add_subparsers(dest="form", required=True)
    recording = forms.add_parser("record", help="solve random scenes")
    recording.add_argument("binary", type=Path)
    recording.add_argument("out", type=Path)
    recording.add_argument("--count", type=int, default=200)
    recording.add_argument("--seed", type=int, default=1)
    comparing = forms.add_parser("compare", help="compare two records")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    given = parser.parse_args()
    if given.form == "record":
        record(given.binary, given.out, given.count, given.seed)
        return 0
    return compare(given.before, given.after)


if __name__ == "__main__":
    sys.exit(main())
