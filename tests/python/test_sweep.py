"""The sweep on a cluster loses no row and has none twice, whoever is killed on the way."""

import csv
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import PACKAGE, Archive, Device
from distributed import Client, LocalCluster

COUNTS = (20, 3)
CASES = COUNTS[0] * COUNTS[1]
SLACK = 1e-9  # the worker and the test solve the same case in the same library


@pytest.fixture
def cluster() -> Iterator[LocalCluster]:
    """Two worker processes, which are not started anew when they die."""
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as made:
        yield made


def start(default: Archive, out: Path, *options: str) -> subprocess.Popen:
    """Starts the sweep."""
    axes = [
        f"magnet.position[3]=-0.04:0.08:{COUNTS[0]}",
        f"design.helix.length=0.0035:0.0045:{COUNTS[1]}",
    ]
    program = [sys.executable, PACKAGE / "fmu" / "examples" / "sweep_dask.py", default.path, "--out", out]
    vary = [word for axis in axes for word in ("--vary", axis)]
    return subprocess.Popen([*program, *vary, *options], stderr=subprocess.PIPE, text=True)


def rows(out: Path) -> list[dict[str, str]]:
    """What stands in the table."""
    if not out.exists():
        return []
    with out.open(newline="") as file:
        return list(csv.DictReader(file))


def wait_for_rows(out: Path, sweep: subprocess.Popen) -> None:
    """Until the first rows are there and others are missing."""
    end = time.monotonic() + 60
    while not rows(out):
        assert time.monotonic() < end
        assert sweep.poll() is None, sweep.stderr.read()
        time.sleep(0.01)
    assert len(rows(out)) < CASES


def check(default: Archive, out: Path) -> None:
    """Every case once, solved."""
    found = rows(out)
    assert sorted(int(row["case"]) for row in found) == list(range(CASES))
    assert {row["refused"] for row in found} == {""}
    for row in found[:: CASES // 5]:
        names = ["magnet.position[3]", "design.helix.length"]
        device = Device(default).start({name: float(row[name]) for name in names})
        assert float(row["tip.angle"]) == pytest.approx(device.get(["tip.angle"])[0], rel=SLACK)
        device.slave.freeInstance()


def test_a_worker_is_killed(default: Archive, cluster: LocalCluster, tmp_path: Path) -> None:
    out, picture = tmp_path / "sweep.csv", tmp_path / "sweep.png"
    with Client(cluster) as client:
        workers = client.run(os.getpid)
        sweep = start(default, out, "--scheduler", cluster.scheduler_address, "--picture", picture)
        wait_for_rows(out, sweep)
        os.kill(next(iter(workers.values())), signal.SIGKILL)
        _, told = sweep.communicate(timeout=90)
        assert sweep.returncode == 0, told
    check(default, out)
    assert picture.stat().st_size > 10_000


def test_the_program_is_killed(default: Archive, cluster: LocalCluster, tmp_path: Path) -> None:
    out = tmp_path / "sweep.csv"
    first = start(default, out, "--scheduler", cluster.scheduler_address)
    wait_for_rows(out, first)
    first.kill()
    first.communicate()
    kept = rows(out)
    with out.open("a") as file:
        file.write("{0a1b,17,0.01")  # as if it had been killed while it wrote
    second = start(default, out, "--scheduler", cluster.scheduler_address)
    _, told = second.communicate(timeout=90)
    assert second.returncode == 0, told
    check(default, out)
    assert rows(out)[: len(kept)] == kept, "nothing was solved again"
    text = out.read_text()
    out.write_text(text.replace(default.guid, "{another}"))
    third = start(default, out, "--scheduler", cluster.scheduler_address)
    _, told = third.communicate(timeout=90)
    assert (third.returncode, "holds another sweep" in told) == (1, True)
