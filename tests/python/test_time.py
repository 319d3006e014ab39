"""Which input an output belongs to: fmpy's rows come one step late; what the README and the examples do about it."""

import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import fmpy.simulation
import numpy as np
import pytest
from conftest import PACKAGE, Archive, Device
from fmpy import simulate_fmu

sys.path.append(str(PACKAGE / "fmu" / "examples"))
import fmpy_plain

OUTPUTS = fmpy_plain.OUTPUTS
MOVED = "magnet.position[3]"

# Relative to the largest value of a quantity: the solver ends at 1e-11 of the elastic forces.
SLACK = 1e-9

# Nothing but the solver's end decides on an answer at this level, which `auto` ends within its tolerances.
SCENE = """
[design]
segments = 3
[magnet]
position_mm = [0.0, -80.0, 10.0]
orientation_wxyz = [0.0, 1.0, 0.0, 0.0]
[model]
interaction = "full"
"""

# Nine inputs, the only number for which fmpy's derivatives work: the moved one, and others at their start values.
NINE = {
    MOVED: 0.010,
    "magnet.position[1]": 0.0,
    "magnet.position[2]": -0.080,
    "magnet.strength": 1.0,
    **{f"field.uniform[{k}]": 0.0 for k in (1, 2, 3)},
    **{f"base.position[{k}]": 0.0 for k in (1, 2)},
}


def height(time: float) -> float:
    """Where the magnet is along the manipulator, m: a smooth way without a turning point."""
    return 0.010 + 0.004 * np.sin(time)


def speed(time: float) -> float:
    """Its derivative, m/s."""
    return 0.004 * np.cos(time)


def table(
    times: np.ndarray, way: Callable[[float], float] = height, names: tuple[str, ...] = (MOVED,)
) -> np.ndarray:
    """The inputs over time as fmpy wants them."""
    signals = np.zeros(len(times), dtype=[("time", float), *((name, float) for name in names)])
    signals["time"] = times
    for name in names:
        signals[name] = way(times) if name == MOVED else NINE[name]
    return signals


def times(step: float) -> np.ndarray:
    """One second in steps that are powers of two, so that no time is rounded."""
    return np.arange(round(1 / step) + 1) * step


@pytest.fixture(autouse=True)
def _fmpy_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """The example replaces a class of fmpy: undone after every test."""
    monkeypatch.setattr(fmpy.simulation, "Input", fmpy.simulation.Input)


@pytest.fixture(scope="module")
def mcm(pack: Callable[..., Archive]) -> Archive:
    """Three segments beside the magnet pair."""
    return pack(SCENE, "--shape-points", "4")


@pytest.fixture(scope="module")
def answers(mcm: Archive) -> Iterator[Callable[..., np.ndarray]]:
    """Solves inputs directly: a row for each, by the FMU's own initialisation."""
    device = Device(mcm)

    def answered(heights: np.ndarray) -> np.ndarray:
        rows = []
        for value in heights:
            device.start({MOVED: value})
            rows.append(device.get(OUTPUTS))
            device.slave.reset()
        return np.array(rows)

    yield answered
    device.slave.freeInstance()


def simulate(mcm: Archive, signals: np.ndarray, **options) -> np.ndarray:
    """What fmpy answers to a table, a step for each row; the first column is the time, the second the input."""
    step = signals["time"][1] - signals["time"][0]
    rows = simulate_fmu(
        str(mcm.path),
        stop_time=signals["time"][-1],
        output_interval=step,
        input=signals,
        output=[MOVED, *OUTPUTS],
        **options,
    )
    return np.array([[row[name] for name in ("time", MOVED, *OUTPUTS)] for row in rows])


def error(got: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference relative to the largest value of the column's quantity."""
    assert got.shape == expected.shape
    quantity = np.array([name.partition("[")[0] for name in OUTPUTS])
    size = [abs(expected[:, quantity == own]).max() for own in quantity]
    return (abs(got - expected) / size).max()


def test_fmpy_is_one_step_late(mcm: Archive, answers: Callable[..., np.ndarray]) -> None:
    signals = table(times(1 / 8))
    rows = simulate(mcm, signals)
    assert rows[:, 0].tolist() == signals["time"].tolist()
    inputs = signals[MOVED].tolist()
    assert rows[:, 1].tolist() == [inputs[0], *inputs[:-1]], "to the last bit"
    assert error(rows[1:, 2:], answers(inputs[:-1])) < SLACK
    assert error(rows[:1, 2:], answers(inputs[:1])) < SLACK, "the first row is the initialisation's"
    assert error(rows[1:, 2:], answers(inputs[1:])) > 1e-3, "the inputs of the same time are something else"


@pytest.mark.parametrize("interpolate", [False, True], ids=["held", "interpolated"])
@pytest.mark.parametrize("step", [1 / 8, 0.1])
def test_rows_of_the_example_belong_to_the_inputs_of_their_time(
    mcm: Archive,
    answers: Callable[..., np.ndarray],
    tmp_path: Path,
    step: float,
    *,
    interpolate: bool,
) -> None:
    signals = table(times(step))
    lines = [f"{time!r},{value!r}" for time, value in signals.tolist()]
    (tmp_path / "inputs.csv").write_text("\n".join([f"time,{MOVED}", *lines]))
    rows = fmpy_plain.run(mcm.path, tmp_path / "inputs.csv", interpolate=interpolate)
    np.testing.assert_allclose(rows["time"], signals["time"], rtol=1e-12, atol=1e-12)
    got = np.array([[row[name] for name in OUTPUTS] for row in rows])
    assert error(got, answers(signals[MOVED])) < SLACK


def test_rows_of_the_readme_belong_to_the_inputs_of_their_time(
    default: Archive, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = re.search(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)[1]
    # At the level `full` with the stop of `auto`, which may answer from another level after a way than at its start,
    # within its tolerances.
    start = '"design.helix.shore_a": 30.0'
    assert start in program
    full = {"design.helix.shore_a": 30.0, "model.interaction": 3, "model.bending_stop": True}
    (tmp_path / "mcm.fmu").write_bytes(default.path.read_bytes())
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(program.replace(f"{{{start}}}", repr(full)), names)
    magnet, result = names["magnet"], names["result"]
    np.testing.assert_allclose(result["time"], magnet["time"], rtol=1e-12, atol=1e-12)
    device = Device(default)
    for row, inputs in list(zip(result, magnet, strict=True))[::10]:
        device.slave.setBoolean(device.references(["model.bending_stop"]), [True])
        device.slave.setInteger(device.references(["model.interaction"]), [3])
        device.start({MOVED: inputs[MOVED], "design.helix.shore_a": 30.0})
        outputs = result.dtype.names[1:]
        np.testing.assert_allclose([row[name] for name in outputs], device.get(outputs), rtol=SLACK)
        device.slave.reset()
    device.slave.freeInstance()


def test_input_derivatives_of_fmpy_want_nine_inputs(mcm: Archive, answers: Callable[..., np.ndarray]) -> None:
    with pytest.raises(ValueError, match="same size"):
        simulate(mcm, table(times(1 / 8)), set_input_derivatives=True)
    straight = table(times(1 / 8), lambda time: 0.010 + 0.004 * time, tuple(NINE))
    rows = simulate(mcm, straight, set_input_derivatives=True)
    # No slope at the first row: its input is held. From then on a straight way is followed exactly.
    assert rows[:2, 1].tolist() == [straight[MOVED][0]] * 2
    assert error(rows[2:, 2:], answers(straight[MOVED][2:])) < SLACK


def orders(errors: list[float]) -> list[float]:
    """Orders at which errors fall while steps are halved."""
    return np.log2(np.array(errors[:-1]) / errors[1:]).tolist()


def test_orders_in_fmpy(mcm: Archive, answers: Callable[..., np.ndarray]) -> None:
    held, derived = [], []
    for step in (1 / 16, 1 / 32, 1 / 64):
        signals = table(times(step), names=tuple(NINE))
        expected = answers(signals[MOVED][2:])
        held.append(error(simulate(mcm, signals)[2:, 2:], expected))
        rows = simulate(mcm, signals, set_input_derivatives=True)
        derived.append(error(rows[2:, 2:], expected))
    assert orders(held) == pytest.approx([1, 1], abs=0.1), held
    assert orders(derived) == pytest.approx([2, 2], abs=0.1), derived


def test_orders_of_the_fmu(mcm: Archive, answers: Callable[..., np.ndarray]) -> None:
    device = Device(mcm)
    held, derived = [], []
    for step in (1 / 16, 1 / 32, 1 / 64):
        for errors, order in ((held, 0), (derived, 1)):
            device.start({MOVED: height(0.0)})
            rows = []
            for time in times(step)[:-1]:
                if order:
                    device.set({MOVED: height(time)})
                    device.slave.setRealInputDerivatives(device.references([MOVED]), [1], [speed(time)])
                device.step(step, {MOVED: height(time)})
                rows.append(device.get(OUTPUTS))
            errors.append(error(np.array(rows), answers(height(times(step)[1:]))))
            device.slave.reset()
    device.slave.freeInstance()
    assert orders(held) == pytest.approx([1, 1], abs=0.1), held
    assert orders(derived) == pytest.approx([2, 2], abs=0.1), derived


def test_model_exchange_answers_at_the_time_of_its_inputs(default: Archive) -> None:
    """In a solver of fmpy each row is what co-simulation answers to the inputs of its time."""
    table = np.genfromtxt(
        PACKAGE / "fmu" / "examples" / "magnet_pass.csv", delimiter=",", names=True, deletechars=""
    )
    names = list(table.dtype.names[1:])
    outputs = ["tip.angle", "tip.position[2]", "magnet.reaction_force[2]"]
    level = 2  # rings: one model, whatever the way
    for solver in ("CVode", "Euler"):
        got = simulate_fmu(
            str(default.path),
            fmi_type="ModelExchange",
            solver=solver,
            input=table,
            output=outputs,
            start_values={"model.interaction": level},
            stop_time=table["time"][-1],
            output_interval=0.1,
            step_size=0.1,
        )
        assert len(got) == len(table)
        device = Device(default)
        device.slave.setInteger(device.references(["model.interaction"]), [level])
        device.start({name: table[name][0] for name in names})
        for row, answer in zip(table, got, strict=True):
            device.step(0.1, {name: row[name] for name in names})
            assert answer["time"] == pytest.approx(row["time"], abs=1e-9)
            for name, value in zip(outputs, device.get(outputs), strict=True):
                assert answer[name] == pytest.approx(value, rel=1e-8, abs=1e-12), (solver, row["time"], name)
        device.slave.freeInstance()
