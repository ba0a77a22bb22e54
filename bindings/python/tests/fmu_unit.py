"""Instances of Functional Mock-up Units of both versions of the standard, imported by FMPy, with variables by name."""

import xml.etree.ElementTree as xml

import fmpy
from fmpy.fmi2 import FMU2Slave, calloc, fmi2CallbackAllocateMemoryTYPE, fmi2CallbackFreeMemoryTYPE
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE, free
from fmpy.fmi3 import FMU3Slave

DISCARD = 2


def flags(path):
    """Attributes of co-simulation in the model description of a unit, which FMPy does not read completely."""
    return xml.parse(path.with_suffix("") / "modelDescription.xml").find("CoSimulation").attrib


class Unit:
    """Instance of the unit in a file, which is also unpacked in a folder of the same name."""

    def __init__(self, path):
        self.description = fmpy.read_model_description(path)
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.newer = self.description.fmiVersion.startswith("3")
        self.said = []
        self.time = 0.0
        slave = FMU3Slave if self.newer else FMU2Slave
        self.slave = slave(
            guid=self.description.guid,
            unzipDirectory=str(path.with_suffix("")),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="contact",
        )
        if self.newer:
            self.slave.instantiate(logMessage=lambda environment, status, category, message: self.log(message))
        else:
            self.callbacks = fmi2CallbackFunctions()
            self.callbacks.logger = fmi2CallbackLoggerTYPE(
                lambda environment, name, status, category, message: self.log(message)
            )
            self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
            self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
            self.slave.instantiate(callbacks=self.callbacks)
        self.initialise()

    def log(self, message):
        self.said.append(message.decode())

    def initialise(self):
        if not self.newer:
            self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()

    def start(self):
        self.slave.exitInitializationMode()
        self.time = 0.0
        return self

    def reset(self):
        self.slave.reset()
        self.initialise()

    def set_reals(self, references, values):
        (self.slave.setFloat64 if self.newer else self.slave.setReal)(references, values)

    def get_reals(self, references):
        return (self.slave.getFloat64 if self.newer else self.slave.getReal)(references)

    def set(self, **values):
        self.set_reals([self.references[name] for name in values], list(values.values()))

    def get(self, *names):
        return self.get_reals([self.references[name] for name in names])

    def truths(self):
        return self.slave.getBoolean([self.references["reduced.trained"], self.references["full"]])

    def last_time(self):
        """Time of the last step that was taken, of a unit whose simulation may continue."""
        if self.newer:
            return self.get("time")[0]
        assert self.slave.getBooleanStatus(3) == 0
        return self.slave.getRealStatus(2)

    def derivatives(self, outputs, inputs):
        """Matrix of derivatives, a row per output."""
        rows = [self.references[name] for name in outputs]
        columns = [self.directional(rows, [self.references[name]], [1.0]) for name in inputs]
        return list(map(list, zip(*columns)))

    def directional(self, unknowns, knowns, seed):
        return self.slave.getDirectionalDerivative(unknowns, knowns, seed)

    def step(self, length=0.01):
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=length)
        self.time += length

    def end(self):
        self.slave.terminate()
        self.slave.freeInstance()

    def starts(self):
        """Start values of inputs and parameters."""
        return {v.name: float(v.start) for v in self.description.modelVariables if v.start is not None}
