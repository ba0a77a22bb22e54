"""Models as Functional Mock-up Units, imported by FMPy: their results are those of ``solve``."""

import shutil
import threading
import time

import numpy as np
import pytest

import ehl_explorer as ehl

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi1 import FMICallException  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

from conftest import ROOT  # noqa: E402
from fmu_unit import DISCARD, Unit  # noqa: E402

KINDS = ["line", "point"]
VERSIONS = ["2", "3"]


def starts(unit):
    return unit.starts()


def contact_of(kind, given):
    names = ["radius", "speed", "load", "modulus", "viscosity", "alpha"]
    return ehl.Contact(contact=kind, srr=given["srr"], **{name: given[name] for name in names})


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind, words", [("line", []), ("point", []), ("point", ["--approach"])])
def test_validation_has_no_remarks_and_the_unit_is_small(kind, words, version, units):
    path = units(kind, *words, version=version)
    assert validate_fmu(path) == []
    (library,) = (path.with_suffix("") / "binaries").rglob("ehl_contact.*")
    assert library.stat().st_size < 15e6, library.stat().st_size


@pytest.mark.parametrize("kind, steps", [("line", 10_000), ("point", 1_000)])
def test_many_steps_are_what_solve_answers(kind, steps, units):
    unit = Unit(units(kind)).start()
    first = starts(unit)
    time = np.linspace(0, 1, steps)
    drive = {
        "load": first["load"] * (1 + 0.2 * np.sin(7 * time)),
        "speed": first["speed"] * (1 + 0.3 * np.sin(11 * time)),
        "radius": first["radius"] * (1 + 0.05 * np.cos(3 * time)),
        "srr": 0.1 * np.sin(5 * time),
    }
    names = ["h_c_m", "h_min_m", "traction", "friction_force", "hertz.p_h_pa"]
    seen, trained = np.empty((steps, len(names))), np.empty(steps)
    for k in range(steps):
        unit.set(**{name: float(values[k]) for name, values in drive.items()})
        unit.step(1 / steps)
        seen[k] = unit.get(*names)
        trained[k] = unit.truths()[0]
    unit.end()
    solved = ehl.solve_many(contact_of(kind, first), method="reduced", **drive)
    assert solved["converged"].all()
    np.testing.assert_array_equal(trained, solved["reduced.trained"])
    expected = [solved["h_c_m"], solved["h_min_m"], solved["traction"], solved["traction"] * drive["load"]]
    for k, column in enumerate([*expected, solved["hertz.p_h_pa"]]):
        np.testing.assert_allclose(seen[:, k], column, rtol=1e-12, atol=0, err_msg=names[k])


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind", KINDS)
def test_fmpy_simulates_it(kind, version, units):
    result = fmpy.simulate_fmu(units(kind, version=version), stop_time=0.1, step_size=0.01, output=["h_c_m", "reduced.trained"])
    assert len(result) == 11 and (result["h_c_m"] > 0).all() and result["reduced.trained"].all()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind, words", [("line", []), ("point", ["--approach"])])
def test_a_state_is_kept_written_and_set_again(kind, words, version, units):
    path = units(kind, *words, version=version)
    unit = Unit(path).start()
    first = starts(unit)
    name = "approach" if words else "load"
    unit.set(**{name: first[name] * 1.1})
    unit.step()
    state = unit.slave.getFMUState()
    written = unit.slave.serializeFMUState(state)
    outputs = ["h_c_m", "h_min_m", "load", "hertz.p_h_pa"]
    kept = unit.get(*outputs)

    def go_on(unit):
        films = []
        for k in range(5):
            unit.set(**{name: first[name] * (1.1 - 0.02 * k)})
            unit.step()
            films += unit.get(*outputs)
        return films

    onwards = go_on(unit)
    unit.slave.setFMUState(state)
    assert unit.get(*outputs) == kept
    assert go_on(unit) == onwards
    other = Unit(path).start()
    again = other.slave.deserializeFMUState(written)
    other.slave.setFMUState(again)
    np.testing.assert_allclose(other.get(*outputs), kept, rtol=1e-12)
    np.testing.assert_allclose(go_on(other), onwards, rtol=1e-12)
    for slave, held in [(unit.slave, state), (other.slave, again)]:
        slave.freeFMUState(held)
    with pytest.raises(FMICallException):
        other.slave.deserializeFMUState(written[:-1])
    assert "not a state of this unit" in other.said[-1]
    unit.end()
    other.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_reset_begins_anew(version, units):
    unit = Unit(units("line", version=version)).start()
    before = unit.get("h_c_m")
    unit.set(load=2 * unit.get("load")[0])
    unit.step()
    assert unit.get("h_c_m") != before
    unit.reset()
    unit.start()
    assert unit.get("h_c_m") == before
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_many_instances_work_at_once(version, units):
    path = units("line", version=version)
    films = {}

    def work(k):
        unit = Unit(path).start()
        first = starts(unit)
        films[k] = []
        for step in range(200):
            unit.set(load=first["load"] * (1 + 0.001 * step))
            unit.step()
            films[k].append(unit.get("h_c_m")[0])
        unit.end()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(films) == 8 and all(len(own) == 200 and own == films[0] for own in films.values())


@pytest.mark.parametrize("version", VERSIONS)
def test_what_makes_no_sense_is_refused_in_a_sentence_and_changes_nothing(version, units):
    unit = Unit(units("line", version=version)).start()
    before = unit.get("h_c_m", "load")
    for name, value in [("load", float("nan")), ("speed", float("inf")), ("h_c_m", 1.0)]:
        with pytest.raises(FMICallException):
            unit.set(**{name: value})
        assert f"`{name}`" in unit.said[-1], unit.said
    assert unit.get("h_c_m", "load") == before
    unit.set(load=-5.0)
    with pytest.raises(FMICallException):
        unit.step()
    assert "load" in unit.said[-1]
    unit.set(load=before[1])
    unit.step()
    assert unit.get("h_c_m", "load") == before
    with pytest.raises(FMICallException):
        unit.get_reals([99])
    assert "99" in unit.said[-1]
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind, heavier", [("line", 40), ("point", 10)])
def test_a_step_beyond_the_trained_range_is_discarded_with_the_reason_of_solve(kind, heavier, version, units):
    unit = Unit(units(kind, version=version)).start()
    first, outputs = starts(unit), ["h_c_m", "traction", "approach"]
    before = unit.get(*outputs)
    solved = ehl.solve(contact_of(kind, {**first, "load": heavier * first["load"]}), method="reduced")
    assert not getattr(solved, "trained", False)
    for _ in range(3):
        unit.set(load=heavier * first["load"])
        for refused in [unit.step, lambda: unit.get("h_c_m"), unit.truths]:
            with pytest.raises(FMICallException) as raised:
                refused()
            assert raised.value.status == DISCARD
            assert solved.warnings[0] in unit.said[-1], unit.said
        # The simulation may continue.
        assert unit.last_time() == 0.0
        unit.set(load=first["load"])
        assert unit.get(*outputs) == before
    unit.step()
    assert unit.get(*outputs) == before and unit.truths() == [True, False]
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_unit_that_begins_beyond_the_trained_range_may_begin_elsewhere(version, units):
    unit = Unit(units("line", version=version))
    first = starts(unit)
    unit.set(load=40 * first["load"])
    with pytest.raises(FMICallException):
        unit.start()
    unit.set(load=first["load"])
    unit.start()
    unit.step()
    assert unit.truths() == [True, False]
    unit.end()


@pytest.mark.parametrize("kind", KINDS)
def test_stiffness_is_the_same_from_two_units_and_from_one(kind, units):
    def approach(unit, load):
        unit.set(load=load)
        unit.step()
        return unit.get("approach")[0]

    one, other = (Unit(units(kind)).start() for _ in range(2))
    load = starts(one)["load"]
    light, heavy = approach(one, load), approach(one, 1.01 * load)
    assert approach(other, 1.01 * load) == heavy > light > 0
    radius, half_width = one.get("radius", "hertz.a_m")
    solved = ehl.solve(contact_of(kind, {**starts(one), "load": 1.01 * load}), method="reduced")
    np.testing.assert_allclose(half_width, solved.a_m, rtol=1e-12)
    depth = half_width**2 / radius
    wanted = -depth * (solved.H_0 + (0.5 * np.log(half_width / radius) if kind == "line" else 0))
    np.testing.assert_allclose(heavy, wanted, rtol=1e-12)
    assert ("approach_reference" in one.references) == (kind == "line")
    if kind == "line":
        assert one.get("approach_reference") == [radius]
    one.end()
    other.end()


def test_an_approach_gives_the_film_of_its_load(units):
    unit = Unit(units("point", "--approach")).start()
    first = starts(unit)
    for share in [0.95, 1.0, 1.1]:
        unit.set(approach=share * first["approach"])
        unit.step()
        load, film = unit.get("load", "h_c_m")
        solved = ehl.solve(contact_of("point", {**first, "load": load}), method="reduced")
        np.testing.assert_allclose(film, solved.h_c_m, rtol=1e-11)
        np.testing.assert_allclose(-solved.H_0 * solved.a_m**2 / first["radius"], share * first["approach"], rtol=1e-10)
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_unit_with_another_model_is_refused(version, units, tmp_path):
    path = units("line", version=version)
    folder = tmp_path / "other"
    shutil.copytree(path.with_suffix(""), folder)
    shutil.copy(ROOT / "assets" / "point.rom", folder / "resources" / "model.rom")
    shutil.copy(path, tmp_path / "other.fmu")
    with pytest.raises(Exception):
        Unit(tmp_path / "other.fmu")


def test_exports_that_make_no_sense_are_refused(program, tmp_path):
    line, out = ROOT / "assets" / "line.rom", tmp_path / "unit.fmu"
    for words, part in [
        (["fmu", "no_such.rom"], "no_such.rom"),
        (["fmu", line, "--lubricant", "squalane-pip"], "another lubricant"),
        (["fmu", line, "--lubricant", "butter"], "accepted are"),
        (["fmu", line, "--fmi", "4"], "accepted are 2 and 3"),
        (["fmu", line, "--library", "no_such.so"], "no_such.so"),
    ]:
        said = program("export", *words, "--out", out, code=2)
        assert part in said and said.count("\n") == 1, said
    assert not out.exists()
    program("export", "fmu", line, "--out", tmp_path / "no" / "folder.fmu", code=2)


def test_a_step_costs_little_more_than_the_solve(units):
    unit = Unit(units("line")).start()
    first = starts(unit)
    contact, runs = contact_of("line", first), 300
    references, get = [unit.references["load"]], [unit.references["h_c_m"]]

    def steps():
        begun = time.perf_counter()
        for k in range(runs):
            unit.slave.setReal(references, [first["load"] * (1 + 1e-6 * k)])
            unit.slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.01)
            unit.slave.getReal(get)
        return time.perf_counter() - begun

    from ehl_explorer import _native

    times = [(steps(), _native.measure(contact, runs, "reduced")) for _ in range(5)]
    ratio = min(own for own, _ in times) / min(other for _, other in times)
    print(f"a step takes {ratio:.2f} of the library's call")
    unit.end()
    assert ratio < 2
