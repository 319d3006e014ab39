"""An FMU in fmpy, from instantiation to its end, variables by name."""

import shutil
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


class Component:
    """An initialised instance; `start` holds inputs and parameters that differ from the FMU's start values."""

    def __init__(self, name: str, fmu: Path, start: dict[str, float | int]) -> None:
        self.description = read_model_description(fmu)
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.folder = extract(fmu)
        self.slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.slave.instantiate()
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        reals = {v.name for v in self.description.modelVariables if v.type == "Real"}
        for variable, value in start.items():
            if variable in reals:
                self.set(variable, value)
            else:  # an integer or an enumeration
                self.slave.setInteger([self.references[variable]], [value])
        self.slave.exitInitializationMode()

    def get(self, variable: str) -> float:
        """Reads a real."""
        return self.slave.getReal([self.references[variable]])[0]

    def set(self, variable: str, value: float) -> None:
        """Sets a real."""
        self.slave.setReal([self.references[variable]], [value])

    def derivative(self, output: str, variable: str) -> float:
        """Partial derivative of an output by an input, at the inputs now set."""
        known, unknown = [self.references[variable]], [self.references[output]]
        return self.slave.getDirectionalDerivative(unknown, known, [1.0])[0]

    def close(self) -> None:
        """Ends it and removes its folder."""
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)
