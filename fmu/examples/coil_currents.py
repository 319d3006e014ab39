"""Currents through eight coils for a wanted field at the tip, with the FMU's exact derivatives.

    mcm pack --scene fmu/examples/eight_coils.toml --out coils.fmu
    .venv/bin/python fmu/examples/coil_currents.py coils.fmu

Without bodies that magnetise, the field is linear in the currents: the least currents for a field at a point
follow from one matrix (Kummer et al., IEEE Transactions on Robotics 26 (2010), 1006). The tip moves as the field
turns it, so the step is repeated until the tip's field is the wanted one.
"""

import argparse
import shutil

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

WANTED = np.array([0.0, 0.015, 0.0])  # T
STEPS = 20
STEP = 0.1  # s
CLOSE = 1e-9  # T


def open_fmu(path: str):
    """The FMU, initialised, with the value references of its variables and the folder in which it is unpacked."""
    folder, description = extract(path), read_model_description(path)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="coils",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    return fmu, references, folder


def main() -> None:
    """Finds the currents and prints what they do."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fmu", help="an FMU packed from a scene with coils")
    fmu, references, folder = open_fmu(parser.parse_args().fmu)
    currents = [reference for name, reference in references.items() if name.endswith("].current")]
    field = [references[f"field.tip[{axis}]"] for axis in (1, 2, 3)]
    tip = [references[f"tip.position[{axis}]"] for axis in (1, 2, 3)]
    answer, time = np.zeros(len(currents)), 0.0
    for _ in range(STEPS):
        missing = WANTED - np.array(fmu.getReal(field))
        if np.linalg.norm(missing) < CLOSE:
            break
        columns = [fmu.getDirectionalDerivative(field, [current], [1.0]) for current in currents]
        # The least currents with this derivative that make the field.
        matrix = np.array(columns).T
        answer = np.linalg.lstsq(matrix, missing + matrix @ answer, rcond=None)[0]
        fmu.setReal(currents, list(answer))
        fmu.doStep(time, STEP)
        time += STEP
    angle = np.degrees(fmu.getReal([references["tip.angle"]])[0])
    print("currents: " + " ".join(f"{current:.3f}" for current in answer) + " A")
    print("field at the tip: " + " ".join(f"{1e3 * part:.4f}" for part in fmu.getReal(field)) + " mT")
    print("tip: " + " ".join(f"{1e3 * part:.3f}" for part in fmu.getReal(tip)) + f" mm, {angle:.2f} deg")
    print(f"steps: {round(time / STEP)}, field off by {1e3 * np.linalg.norm(missing):.1e} mT")
    fmu.terminate()
    fmu.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
