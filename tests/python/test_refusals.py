"""What is wrong is refused with a status and a message, and the instance goes on."""

import math
import re
from collections.abc import Callable

import pytest
from conftest import Archive, Device
from fmpy.fmi1 import FMICallException

NOT_SOLVED = 3  # `solver.status`
CONTACT, INPUT_REFUSED = 3, 6  # `solver.outcome`

# Nine segments, and a magnet that passes by with its field against them: they turn over, and back later.
PASSING = """
[design]
segments = 9
[magnet]
position_mm = [0, -120, -80]
turn_deg = 180
[model]
interaction = "none"
"""


def refused(device: Device, call: str, *arguments: object) -> str:
    """Asserts that a call is refused with an error; its message."""
    before = len(device.log)
    with pytest.raises(FMICallException) as refusal:
        getattr(device.slave, call)(*arguments)
    assert refusal.value.status == 3
    assert len(device.log) == before + 1
    return device.log[-1]


def test_wrong_guid(default: Archive) -> None:
    heard: list[str] = []

    class Listening(Device):
        def tell(self, *arguments: object) -> None:
            heard.append(arguments[-1].decode())

    with pytest.raises(Exception, match="Failed to instantiate"):
        Listening(default, guid="{00000000-0000-0000-0000-000000000000}")
    assert default.guid in heard[0]
    assert "00000000-0000" in heard[0]


def test_unknown_value_reference(device: Device) -> None:
    device.start()
    for call, arguments in [("getReal", [[99999]]), ("setReal", [[99999], [1.0]]), ("getString", [[0]])]:
        message = refused(device, call, *arguments)
        assert "99999" in message or "not a variable of type String" in message
    device.step(0.1)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_number_that_is_none(device: Device, value: float) -> None:
    device.start()
    angle = device.get(["tip.angle"])
    message = refused(device, "setReal", device.references(["magnet.position[2]"]), [value])
    assert "magnet.position[2]" in message
    assert "finite" in message
    assert "magnet.position[2] was refused" in refused(device, "doStep", 0.0, 0.1)
    assert (device.status(), device.outcome()) == (NOT_SOLVED, INPUT_REFUSED)
    assert device.get(["tip.angle"]) == angle
    device.step(0.1, {"magnet.position[2]": -0.12})
    assert (device.status(), device.outcome()) == (0, 0)
    assert device.get(["tip.angle"]) == pytest.approx(angle, rel=1e-9)


def test_quaternion_that_is_no_rotation(device: Device) -> None:
    device.start()
    device.set({"magnet.orientation[1]": 2.5})
    assert "magnet.orientation" in refused(device, "doStep", 0.0, 0.1)
    device.step(0.1, {"magnet.orientation[1]": 0.0})


def test_call_in_the_wrong_state(device: Device) -> None:
    assert "before initialisation" in refused(device, "doStep", 0.0, 0.1)
    assert "before initialisation" in refused(device, "getReal", [0])
    assert "before initialisation" in refused(device, "exitInitializationMode")
    device.start()
    assert "between communication steps" in refused(device, "enterInitializationMode")
    assert "between communication steps" in refused(
        device, "setReal", device.references(["design.helix.length"]), [0.005]
    )
    device.step(0.1)
    device.slave.terminate()
    assert "after termination" in refused(device, "doStep", 0.1, 0.1)


def test_design_that_cannot_be_built(device: Device) -> None:
    device.slave.setupExperiment(startTime=0.0)
    device.slave.enterInitializationMode()
    device.set({"design.helix.core_inner_radius": 0.003})
    message = refused(device, "exitInitializationMode")
    assert "radius" in message
    device.set({"design.helix.core_inner_radius": 0.00075})
    device.slave.exitInitializationMode()
    device.step(0.1)


def test_outputs_cannot_be_set(device: Device) -> None:
    device.start()
    assert "tip.angle" in refused(device, "setReal", device.references(["tip.angle"]), [0.0])


def test_bytes_that_are_no_state(device: Device, pack: Callable[..., Archive]) -> None:
    device.start()
    state = device.slave.getFMUstate()
    whole = device.slave.serializeFMUstate(state)
    device.slave.freeFMUstate(state)
    assert "none of this FMU" in refused(device, "deSerializeFMUstate", b"no state, but as long as a header")
    assert "bytes where" in refused(device, "deSerializeFMUstate", whole[:-1])
    altered = whole[:200] + bytes([whole[200] ^ 1]) + whole[201:]
    assert "checksum" in refused(device, "deSerializeFMUstate", altered)
    other = Device(pack("[design]\nsegments = 1"))
    assert "of the design {" in refused(other, "deSerializeFMUstate", whole)
    other.slave.freeInstance()
    device.step(0.1)


def test_derivatives_that_there_are_not(device: Device) -> None:
    device.start()

    def by(unknown: str, known: str) -> str:
        references = (device.references([unknown]), device.references([known]), [1.0])
        return refused(device, "getDirectionalDerivative", *references)

    assert "stability.margin has no derivatives" in by("stability.margin", "magnet.strength")
    assert "solver.status has no derivatives" in by("solver.status", "magnet.strength")
    assert "by design.helix.length" in by("tip.angle", "design.helix.length")
    device.step(0.1)


def test_magnet_upon_the_manipulator(device: Device) -> None:
    """A pose inside the magnet is refused with the reason; the last good outputs stay, and a reset recovers."""
    device.start()
    angle = device.get(["tip.angle"])
    device.set({"magnet.position[2]": -0.02, "magnet.position[3]": 0.02})
    message = refused(device, "doStep", 0.0, 0.1)
    assert "% of the way: " in message
    assert "the last good outputs can be read" in message
    assert device.status() == NOT_SOLVED
    assert device.get(["tip.angle"]) == angle
    assert 0.0 <= device.get(["solver.progress"])[0] < 1.0
    values = dict(zip(device.reals(), device.get(device.reals()), strict=True))
    assert {name: value for name, value in values.items() if not math.isfinite(value)} == {}
    device.slave.reset()
    device.start()
    assert device.get(["tip.angle"]) == angle


def test_first_pose_inside_the_magnet(device: Device) -> None:
    """There are no good outputs yet, so none are promised nor given; a reset recovers."""
    device.slave.setupExperiment(startTime=0.0)
    device.slave.enterInitializationMode()
    device.set({"magnet.position[2]": -0.023, "magnet.strength": 1e-6})
    message = refused(device, "exitInitializationMode")
    assert "for the first inputs" in message
    assert "bodies touch: " in message
    assert re.search(r"mm deep in part \d of the external magnet", message)
    assert "last good" not in message
    assert device.status() == NOT_SOLVED
    assert device.outcome() == CONTACT
    assert "no equilibrium was found yet" in refused(device, "getReal", device.references(["tip.angle"]))
    device.slave.reset()
    device.start()
    device.step(0.1)


def test_nothing_but_ok_through_snaps_and_unexpected_steps(pack: Callable[..., Archive]) -> None:
    """A host that stops at every status but OK runs on: what happened stands in outputs and in the log."""
    device = Device(pack(PASSING))
    codes = []

    def heard(function: Callable[..., int], name: str) -> Callable[..., int]:
        def call(*arguments: object) -> int:
            codes.append((name, function(*arguments)))
            return codes[-1][1]

        return call

    for name in ("fmi2DoStep", "fmi2GetReal", "fmi2ExitInitializationMode"):
        setattr(device.slave, name, heard(getattr(device.slave, name), name))
    device.start()
    for z in [*range(-80, 71, 5), *range(65, -81, -5)]:
        device.step(0.1, {"magnet.position[3]": 1e-3 * z})
        device.get(["tip.angle"])
    device.slave.doStep(device.time + 7.0, 0.1)
    assert {status for _, status in codes} == {0}
    assert len(codes) > 100
    assert device.slave.getInteger(device.references(["stability.snaps"])) == [2]
    said = [line for line in device.log if line.startswith("logStatusWarning: ")]
    assert sum("snapped to another branch" in line for line in said) == 2
    assert sum("but the last one ended at" in line for line in said) == 1
    device.slave.freeInstance()
