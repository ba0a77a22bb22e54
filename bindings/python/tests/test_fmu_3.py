"""Units of FMI 3.0, imported by FMPy: they give the results of those of FMI 2.0, and refuse what they do not have."""

import ctypes

import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi1 import FMICallException  # noqa: E402
from fmpy.fmi3 import FMU3Model, FMU3ScheduledExecution  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

from fmu_unit import DISCARD, Unit, flags  # noqa: E402

UNITS = [("line", []), ("point", ["--approach"]), ("line_rough", []), ("line_in_time", [])]


def outputs(unit):
    reals = [v.name for v in unit.description.modelVariables if v.causality == "output" and v.type in ("Real", "Float64")]
    return unit.get(*reals) + [float(truth) for truth in unit.truths()]


@pytest.mark.parametrize("kind, words", UNITS)
def test_both_versions_give_the_same_results_to_the_last_bit(kind, words, units):
    older, newer = (Unit(units(kind, *words, version=version)) for version in ["2", "3"])
    assert older.starts() == newer.starts()
    name, step = "approach" if words else "load", float(older.description.defaultExperiment.stepSize)
    first, seen = older.starts(), []
    for unit in [older, newer]:
        unit.start()
        rows = []
        for k in range(20):
            unit.set(**{name: first[name] * (1 + 1e-3 * np.sin(0.3 * k)), "srr": 0.01 * k})
            unit.step(step)
            rows.append(outputs(unit))
        seen.append(np.array(rows))
        assert unit.last_time() == pytest.approx(20 * step)
        unit.end()
    np.testing.assert_array_equal(*seen)


@pytest.mark.parametrize("kind, words", UNITS)
def test_descriptions_of_fmi_3_are_valid_and_complete(kind, words, units):
    path = units(kind, *words, version="3")
    assert validate_fmu(path) == []
    description = fmpy.read_model_description(path)
    own, steady = flags(path), "false" if kind == "line_in_time" else "true"
    assert own["canGetAndSetFMUState"] == own["canSerializeFMUState"] == "true"
    assert own["canHandleVariableCommunicationStepSize"] == "true"
    assert own["providesDirectionalDerivatives"] == own["providesAdjointDerivatives"] == steady
    references = [v.valueReference for v in description.modelVariables]
    assert len(set(references)) == len(references)
    assert [v.name for v in description.modelVariables if v.causality == "independent"] == ["time"]
    assert {v.type for v in description.modelVariables} == {"Float64", "Boolean"}
    older = fmpy.read_model_description(units(kind, *words, version="2"))
    named = lambda own: {(v.name, v.causality, v.unit, v.start) for v in own.modelVariables if v.name != "time"}
    assert named(description) == named(older)


def test_simulations_of_both_versions_agree(units):
    start = Unit(units("line")).starts()["load"]
    rows = [(0.0, start), (0.05, 1.3 * start), (0.1, 1.1 * start)]
    load = np.array(rows, dtype=[("time", float), ("load", float)])
    run = lambda version: fmpy.simulate_fmu(units("line", version=version), stop_time=0.1, step_size=0.01, input=load)
    older, newer = run("2"), run("3")
    assert len(newer) == 11 and (newer["h_c_m"] > 0).all()
    # FMPy sets inputs at the beginning of a step in both versions.
    for name in ["h_c_m", "h_min_m", "hertz.p_h_pa"]:
        np.testing.assert_array_equal(older[name], newer[name])


def test_what_units_do_not_have_is_refused_in_a_sentence(units):
    unit = Unit(units("line", version="3")).start()
    slave, film = unit.slave, unit.references["h_c_m"]
    before = outputs(unit)
    for refused, part in [
        (lambda: slave.getFloat32([film]), "Float32"),
        (lambda: slave.getInt32([film]), "Int32"),
        (lambda: slave.setUInt64([film], [1]), "UInt64"),
        (lambda: slave.getString([film]), "text variables"),
        (lambda: slave.setBoolean([unit.references["full"]], [True]), "Boolean variables that can be set"),
        (lambda: slave.getBoolean([film]), f"no Boolean variable {film}"),
        (lambda: slave.getClock([film]), "clocks"),
        (lambda: slave.enterEventMode(), "event mode"),
        (lambda: slave.enterConfigurationMode(), "structural parameters"),
        (lambda: slave.updateDiscreteStates(), "event mode"),
        (lambda: slave.fmi3GetNumberOfVariableDependencies(slave.component, film, ctypes.byref(ctypes.c_size_t())), "model description"),
        (lambda: slave.getOutputDerivatives([film], [1]), "derivatives of outputs by the time"),
        (lambda: slave.getFloat64([film], nValues=2), "1 scalar variables, but 2 values"),
        (lambda: slave.setFloat64([film], [1.0, 2.0]), "1 scalar variables, but 2 values"),
        (lambda: slave.setFloat64([unit.references["time"]], [1.0]), "no real variable"),
    ]:
        with pytest.raises(FMICallException) as raised:
            refused()
        assert raised.value.status == DISCARD and part in unit.said[-1], unit.said[-1]
    np.testing.assert_array_equal(outputs(unit), before)
    unit.end()


@pytest.mark.parametrize("kind", [FMU3Model, FMU3ScheduledExecution])
def test_other_kinds_of_units_are_refused_in_a_sentence(kind, units):
    path, said = units("line", version="3"), []
    description = fmpy.read_model_description(path)
    unit = kind(
        guid=description.guid,
        unzipDirectory=str(path.with_suffix("")),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="contact",
    )
    log = lambda environment, status, category, message: said.append(message.decode())
    try:
        unit.instantiate(logMessage=log)
        assert not unit.component
    except Exception:
        pass
    assert said == ["this unit is for co-simulation only"]


def test_all_functions_of_the_standard_are_there(units):
    path = units("line", version="3")
    (library,) = (path.with_suffix("") / "binaries").rglob("ehl_contact.*")
    assert library.parent.name == fmpy.platform_tuple
    loaded = ctypes.CDLL(str(library))
    names = [name for name in vars(fmpy.fmi3._FMU3) if name.startswith("fmi3")]
    assert len(names) > 70 and all(hasattr(loaded, name) for name in names)
