"""Measures the solves and fields beside their peers in one run and prints the tables in Markdown.

fmu/venv tests/bench/requirements.txt
.venv/bin/python tests/bench/table.py            all
.venv/bin/python tests/bench/table.py solve      only the solves beside scipy and PyElastica
.venv/bin/python tests/bench/table.py field      only the fields beside magba and magpylib

Each part leaves its rows in tests/charts/peers.csv, which `mcm study accuracy --peers` draws.
"""

import csv
import json
import math
import os
import platform
import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

try:
    import magpylib_field
    import pyelastica_peer
    import solve_bvp_peer
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: fmu/venv tests/bench/requirements.txt installs the peers") from error

PACKAGE = Path(__file__).resolve().parents[2]
PEERS = PACKAGE / "tests" / "charts" / "peers.csv"
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", PACKAGE / "target"))


def bench(name: str) -> tuple[dict[str, float], str]:
    """Runs one bench; median times (s) by identifier, and what it printed."""
    done = subprocess.run(
        ["cargo", "bench", "--quiet", "--bench", name, "--", "--quiet"],
        cwd=PACKAGE,
        check=True,
        text=True,
        stdout=subprocess.PIPE,
    )
    times = {}
    for description in TARGET.glob("criterion/**/new/benchmark.json"):
        identifier = json.loads(description.read_text())["full_id"]
        estimates = json.loads((description.parent / "estimates.json").read_text())
        times[identifier] = 1e-9 * estimates["median"]["point_estimate"]
    return times, done.stdout


def table(header: list[str], rows: list[list[str]]) -> None:
    """Prints a table in Markdown."""
    for row in [header, ["---"] * len(header), *rows]:
        print("| " + " | ".join(row) + " |")
    print()


def micro(seconds: float) -> str:
    """A time in microseconds, three digits."""
    return f"{1e6 * seconds:.3g}"


def solves() -> None:
    """Cold and warm solves, and the case with a closed form beside scipy."""
    times, printed = bench("solve")
    rows = []
    for segments in (1, 3, 9):
        for field in ("uniform", "pair"):
            for level in ("none", "rings", "full"):
                name = f"S={segments} {level} {field}"
                if f"warm {name}" not in times:
                    continue
                cold, warm = times[f"cold {name}"], times[f"warm {name}"]
                rows.append([str(segments), field, level, micro(cold), micro(warm)])
    table(["segments", "field", "interaction", "cold (us)", "warm (us)"], rows)

    errors = re.findall(r"target (.*): tip within (\S+) m, (\S+) deg", printed)
    rows = [[name, length, angle, micro(times[f"target {name}"])] for name, length, angle in errors]
    table(["target", "tip (m)", "angle (deg)", "warm (us)"], rows)

    sizes = (1, 2, 4, 9, 16, 32)
    rows = []
    for level in ("none", "rings", "full"):
        found = [times[f"growth S={size} {level}"] for size in sizes]
        rows.append([level, *map(micro, found), f"{math.log(found[3] / found[0], 9):.2f}"])
    table(["growth, warm (us)", *(f"S = {size}" for size in sizes), "exponent to 9"], rows)

    error = re.search(r"tip dipole: error of the angle (\S+) rad", printed)
    if error is None:
        raise RuntimeError("the bench has not told its error")
    cold, warm = times["cold tip dipole"], times["warm tip dipole"]
    rows = [["mcm", micro(cold), micro(warm), f"{float(error[1]):.0e}", "1", "1"]]
    peers = [
        ("tip dipole", "mcm", start, time, float(error[1]))
        for start, time in (("cold", cold), ("warm", warm))
    ]
    measured = [("scipy", "solve_bvp", solve_bvp_peer.measure(tolerance)) for tolerance in (1e-3, 1e-6, 1e-9)]
    measured += [("pyelastica", "settled", pyelastica_peer.measure(elements)) for elements in (4, 8, 16)]
    for package, way, peer in measured:
        for start, time in (("cold", peer.cold), ("warm", peer.warm)):
            peers.append(("tip dipole", f"{package} {way}", start, time, peer.error))
        name = f"{package} {version(package)} {way}, {peer.setting}"
        ratios = [f"{peer.cold / cold:.0f}", f"{peer.warm / warm:.0f}"]
        rows.append([name, micro(peer.cold), micro(peer.warm), f"{peer.error:.0e}", *ratios])
    leave(peers)
    table(
        ["tip dipole", "cold (us)", "warm (us)", "error (rad)", "times ours, cold", "times ours, warm"], rows
    )


def leave(peers: list[tuple[str, str, str, float, float]]) -> None:
    """Writes case, solver, variant, time (s) and error; rows of other cases stay."""
    header = ["case", "solver", "variant", "time_us", "error"]
    cases = {case for case, *_ in peers}
    before = []
    if PEERS.exists():
        with PEERS.open(newline="", encoding="utf-8") as file:
            before = [row for row in list(csv.reader(file))[1:] if row[0] not in cases]
    # Below the rounding of one nothing is told apart.
    least = sys.float_info.epsilon
    rows = [[*names, micro(time), f"{max(error, least):.2g}"] for *names, time, error in peers]
    with PEERS.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *sorted(before + rows, key=order)])


def order(row: list[str]) -> int:
    """Solves before fields."""
    return ["tip dipole", "ring near", "ring far"].index(row[0])


def fields() -> None:
    """Fields at single points: time and accuracy of models and beside magba, then those of magpylib."""
    peers = []
    for example in ("field_speed", "field_accuracy"):
        done = subprocess.run(
            ["cargo", "run", "--quiet", "--release", "--example", example],
            cwd=PACKAGE,
            check=True,
            text=True,
            stdout=subprocess.PIPE,
        )
        print(done.stdout, flush=True)
        for line in done.stdout.splitlines():
            peers += peers_of(line)
    for place, time, error in magpylib_field.report():
        peers.append((f"ring {place}", "magpylib batch", "", time, error))
    leave(peers)


def peers_of(line: str) -> list[tuple[str, str, str, float, float]]:
    """The rows that a line of the table of models has: the field, and with its gradient where there is one."""
    found = re.fullmatch(r"\| (near|far) \| (.*?)(?: to \d+)? \| (\S+) \| (\S+) \| (\S+) \| (\S+) \|", line)
    if found is None:
        return []
    place, name, *numbers = found.groups()
    field, both, of_field, of_gradient = map(float, numbers)
    rows = [(f"ring {place}", name, "", 1e-9 * field, of_field)]
    if not math.isnan(both):
        rows.append((f"ring {place}", name, "with gradient", 1e-9 * both, of_gradient))
    return rows


def main() -> None:
    """Prints what was asked for, after machine and versions."""
    parts = {"solve": solves, "field": fields}
    wanted = sys.argv[1:] or list(parts)
    rustc = subprocess.run(
        ["rustc", "--version"], check=True, text=True, stdout=subprocess.PIPE
    ).stdout.split()[1]
    info = Path("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.*)", info.read_text()) if info.exists() else None
    machine = model[1] if model else platform.machine()
    print(
        f"{machine}, {os.cpu_count()} cores; rustc {rustc}, Python {platform.python_version()}; medians\n",
        flush=True,
    )
    for name in wanted:
        parts[name]()


if __name__ == "__main__":
    main()
