"""Directional derivatives of units: those of the results of ``solve``."""

import numpy as np
import pytest

import ehl_explorer as ehl

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi1 import FMICallException  # noqa: E402

from fmu_unit import DISCARD, Unit, flags  # noqa: E402

VERSIONS = ["2", "3"]
INPUTS = ["radius", "speed", "srr", "load"]
OUTPUTS = ["h_c_m", "h_min_m", "traction", "friction_force", "hertz.p_h_pa", "hertz.a_m", "approach"]


def solved(kind, given):
    """Outputs of ``solve`` with the values of a unit."""
    names = ["radius", "speed", "load", "modulus", "viscosity", "alpha", "srr"]
    result = ehl.solve(ehl.Contact(contact=kind, **{name: given[name] for name in names}), method="reduced")
    depth = result.a_m**2 / given["radius"]
    line = 0.5 * np.log(result.a_m / given["radius"]) if kind == "line" else 0.0
    films = [result.h_c_m, result.h_min_m, result.traction, result.traction * given["load"]]
    return np.array([*films, result.p_h_pa, result.a_m, -depth * (result.H_0 + line)])


def differences(outputs, given, name, step=3e-5):
    """Central differences of fourth order."""
    at = lambda times: outputs({**given, name: given[name] * (1 + times * step)})
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step * given[name])


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind", ["line", "point"])
def test_derivatives_are_those_of_solve(kind, version, units):
    unit = Unit(units(kind, version=version)).start()
    given = {**unit.starts(), "srr": 0.05}
    unit.set(srr=given["srr"])
    unit.step()
    own = np.array(unit.derivatives(OUTPUTS, INPUTS))
    values = np.abs(unit.get(*OUTPUTS))
    for k, name in enumerate(INPUTS):
        wanted = differences(lambda given: solved(kind, given), given, name)
        # Relative to the output over the input.
        scale = values / given[name]
        np.testing.assert_allclose(own[:, k] / scale, wanted / scale, rtol=1e-5, atol=1e-5, err_msg=name)
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_direction_is_the_sum_over_its_inputs(version, units):
    unit = Unit(units("point", version=version)).start()
    rows, columns = ([unit.references[name] for name in names] for names in [OUTPUTS, INPUTS])
    matrix = np.array(unit.derivatives(OUTPUTS, INPUTS))
    seed = [1e-5, 0.3, 0.02, -2.0]
    np.testing.assert_allclose(unit.directional(rows, columns, seed), matrix @ seed, rtol=1e-9)
    if version == "3":
        weights = np.arange(1.0, len(OUTPUTS) + 1)
        adjoint = unit.slave.getAdjointDerivative(rows, columns, list(weights), nSensitivity=len(columns))
        np.testing.assert_allclose(adjoint, weights @ matrix, rtol=1e-9)
    # The state is the same as before.
    before = unit.get(*OUTPUTS)
    unit.step()
    assert unit.get(*OUTPUTS) == before
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind", ["line", "point"])
@pytest.mark.parametrize("place", [-0.5, 1.0, 8.0], ids=["open", "trained", "heavy"])
def test_the_stiffness_is_a_derivative(kind, place, version, units):
    unit = Unit(units(kind, "--approach", version=version))
    given = unit.starts()
    given["approach"] *= place
    names = ["load", "friction_force", "hertz.p_h_pa", "h_c_m"]

    def outputs(given):
        unit.set(**given)
        unit.step()
        return np.array(unit.get(*names))

    unit.set(**given)
    unit.start()
    own, values = np.array(unit.derivatives(names, ["approach", "speed"])), np.abs(unit.get(*names))
    assert own[0, 0] > 0
    for k, name in enumerate(["approach", "speed"]):
        wanted = differences(outputs, given, name)
        scale = values / abs(given[name])
        np.testing.assert_allclose(own[:, k] / scale, wanted / scale, rtol=1e-5, atol=1e-5, err_msg=name)
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_derivatives_that_do_not_exist_are_refused_in_a_sentence(version, units):
    unit = Unit(units("line", version=version)).start()
    film, load, trained = (unit.references[name] for name in ["h_c_m", "load", "reduced.trained"])
    for unknowns, knowns, part in [
        ([load], [load], "`load` is no output"),
        ([film], [film], "`h_c_m` is an output"),
        ([99], [load], "no real variable 99"),
        ([film], [98], "no real variable 98"),
    ]:
        with pytest.raises(FMICallException) as raised:
            unit.directional(unknowns, knowns, [1.0])
        assert raised.value.status == DISCARD and part in unit.said[-1], unit.said[-1]
    if version == "3":
        for refused in [lambda: unit.directional([trained], [load], [1.0]), lambda: unit.directional([film], [load], [])]:
            with pytest.raises(FMICallException):
                refused()
    unit.set(load=40 * unit.starts()["load"])
    with pytest.raises(FMICallException):
        unit.directional([film], [load], [1.0])
    assert "outside the trained range" in unit.said[-1]
    unit.set(load=unit.starts()["load"])
    assert np.isfinite(unit.directional([film], [load], [1.0])).all()
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_transient_units_provide_no_derivatives(version, units):
    path = units("line_in_time", version=version)
    assert flags(path)["providesDirectionalDerivative" + ("s" if version == "3" else "")] == "false"
    unit = Unit(path).start()
    with pytest.raises(FMICallException):
        unit.derivatives(["h_c_m"], ["load"])
    assert "a transient unit provides no derivatives" in unit.said[-1]
    unit.end()
