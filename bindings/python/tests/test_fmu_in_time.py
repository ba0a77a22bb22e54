"""Transient models as Functional Mock-up Units, imported by FMPy: their state advances with the communication step like
the march of the Python module."""

import threading

import numpy as np
import pytest

import ehl_explorer as ehl

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi1 import FMICallException  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

from conftest import ROOT  # noqa: E402
from fmu_unit import Unit  # noqa: E402

POINT = dict(radius=0.002, speed=5.0, load=2e5, modulus=2.31e11, viscosity=0.01, alpha=1e-8)
STEP = 0.01
FILMS = ["h_c_m", "h_min_m"]


@pytest.fixture(scope="session")
def model(program, in_time_training, tmp_path_factory):
    folder = tmp_path_factory.mktemp("in_time")
    (folder / "scene.ron").write_text(in_time_training)
    program("train", folder / "scene.ron", "--out", folder / "contact.rom")
    return folder / "contact.rom"


@pytest.fixture(scope="session")
def path(program, model):
    path = model.with_suffix(".fmu")
    program("export", "fmu", model, "--out", path)
    fmpy.extract(path, unzipdir=path.with_suffix(""))
    return path


@pytest.fixture(scope="session")
def scales():
    """Time of one unit of T [s], and film thickness of one unit of H [m]."""
    result = ehl.solve(ehl.Contact(**POINT, dx=0.02), method="full")
    return result.a_m / POINT["speed"], result.a_m**2 / POINT["radius"]


def begun(path, **values):
    unit = Unit(path)
    unit.set(load=POINT["load"], **values)
    return unit.start()


def loads(count):
    return POINT["load"] * (1 + 0.08 * np.sin(0.05 * np.arange(1, count + 1)))


def march(model, loads, every=1):
    """March of the Python module by the model, with these loads at every n-th step."""
    times = STEP * every * np.arange(len(loads) + 1)
    values = np.concatenate([[1.0], loads / POINT["load"]])
    contact = ehl.Contact(**POINT)
    table = ehl.transient(contact, times[-1], STEP, load=(list(times), list(values)), model=model)
    return table[::every]


def test_validation_has_no_remarks_and_only_what_was_trained_is_an_input(path):
    assert validate_fmu(path) == []
    description = fmpy.read_model_description(path)
    of = lambda causality: {v.name for v in description.modelVariables if v.causality == causality}
    assert of("input") == {"load", "srr"}
    assert of("parameter") == set()
    assert {*FILMS, "approach", "friction_force", "hertz.p_h_pa", "hertz.a_m", "approach_reference", "reduced.trained"} <= of("output")
    assert float(description.defaultExperiment.stepSize) > 0


def test_ten_thousand_steps_are_the_march_of_the_library(path, model, scales):
    seconds, metres = scales
    told = loads(10_000)
    wanted = march(model, told)
    unit = begun(path)
    seen = np.empty((len(told), 2))
    for k, load in enumerate(told):
        unit.set(load=float(load))
        unit.step(STEP * seconds)
        seen[k] = unit.get(*FILMS)
        assert unit.truths() == [True, False]
    assert unit.said == []
    unit.end()
    for k, name in enumerate(["H_c", "H_min"]):
        np.testing.assert_allclose(seen[:, k], wanted[name][1:] * metres, rtol=1e-12, atol=0, err_msg=name)


def test_a_step_that_is_longer_is_divided_and_one_that_does_not_fit_is_divided_evenly(path, model, scales):
    seconds, metres = scales
    told = loads(200)[::4]
    wanted = march(model, told, every=4)
    unit, films = begun(path), []
    for load in told:
        unit.set(load=float(load))
        unit.step(4 * STEP * seconds)
        films += unit.get("h_c_m")
    unit.end()
    np.testing.assert_allclose(films, wanted["H_c"][1:] * metres, rtol=1e-12)
    # A communication step of 2.5 model steps is divided into three shorter ones.
    unit, other = begun(path), []
    for load in told[:20]:
        unit.set(load=float(load))
        unit.step(2.5 * STEP * seconds)
        other += unit.get("h_c_m")
    assert np.isfinite(other).all() and max(other) / min(other) < 1.5
    unit.end()


def test_outputs_stay_until_a_step_is_taken_and_a_reset_begins_anew(path, scales):
    unit = begun(path)
    first = unit.get(*FILMS, "approach")
    unit.set(load=1.05 * POINT["load"])
    assert unit.get(*FILMS, "approach") == first
    unit.step(10 * STEP * scales[0])
    assert unit.get("approach")[0] > first[2] and unit.get(*FILMS) != first[:2]
    with pytest.raises(FMICallException):
        unit.slave.doStep(currentCommunicationPoint=99.0, communicationStepSize=STEP * scales[0])
    assert "continues from its present time" in unit.said[-1]
    unit.reset()
    unit.start()
    assert unit.get(*FILMS, "approach") == first
    unit.end()


def test_a_contact_may_begin_under_another_load(path, model, scales):
    unit = Unit(path)
    unit.set(load=1.06 * POINT["load"])
    unit.start()
    film = unit.get("h_c_m")[0]
    wanted = ehl.solve(ehl.Contact(**{**POINT, "load": 1.06 * POINT["load"]}, dx=0.02), method="full")
    np.testing.assert_allclose(film, wanted.h_c_m, rtol=5e-3)
    assert unit.truths()[0]
    unit.end()


def test_a_state_is_kept_written_and_set_again(path, scales):
    seconds = scales[0]

    def go_on(unit):
        films = []
        # Up and down, no faster than in the training.
        for load in POINT["load"] * (1 + 0.02 * np.sin(2 * np.pi * np.arange(1, 16) / 15)):
            unit.set(load=float(load))
            unit.step(1.3 * STEP * seconds)
            films += unit.get(*FILMS, "approach", "friction_force")
        return films

    unit = begun(path, srr=0.01)
    go_on(unit)
    state, time = unit.slave.getFMUState(), unit.time
    written = unit.slave.serializeFMUState(state)
    kept = unit.get(*FILMS, "approach")
    onwards = go_on(unit)
    unit.slave.setFMUState(state)
    unit.time = time
    assert unit.get(*FILMS, "approach") == kept
    assert go_on(unit) == onwards
    other = begun(path, srr=0.01)
    again = other.slave.deserializeFMUState(written)
    other.slave.setFMUState(again)
    other.time = time
    np.testing.assert_allclose(other.get(*FILMS, "approach"), kept, rtol=1e-12)
    np.testing.assert_allclose(go_on(other), onwards, rtol=1e-12)
    with pytest.raises(FMICallException):
        other.slave.deserializeFMUState(written[:-1])
    assert "not a state of this unit" in other.said[-1]
    for slave, held in [(unit.slave, state), (other.slave, again)]:
        slave.freeFMUState(held)
    unit.end()
    other.end()


def test_many_instances_work_at_once(path, scales):
    films = {}

    def work(k):
        unit = begun(path)
        films[k] = []
        for load in loads(100):
            unit.set(load=float(load))
            unit.step(STEP * scales[0])
            films[k] += unit.get("h_c_m")
        unit.end()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(films) == 8 and all(len(own) == 100 and own == films[0] for own in films.values())


def test_a_step_beyond_the_training_is_discarded_and_changes_nothing(path, scales):
    unit = begun(path)
    before = unit.get(*FILMS, "approach")
    # Much faster than the harmonic load of the training, and much higher.
    for load, length, reason in [(1.08, STEP, "faster than the trained"), (1.5, 100 * STEP, "outside the trained")]:
        unit.set(load=load * POINT["load"])
        with pytest.raises(FMICallException) as raised:
            unit.slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=length * scales[0])
        assert raised.value.status == 2 and reason in unit.said[-1], unit.said
        assert unit.get(*FILMS, "approach") == before and unit.truths() == [True, False]
        assert unit.last_time() == 0.0
    # The same change in more time.
    unit.set(load=1.08 * POINT["load"])
    unit.step(20 * STEP * scales[0])
    assert unit.get("approach")[0] > before[2] and unit.truths() == [True, False]
    unit.end()


def test_stiffness_is_the_same_from_two_units_and_from_one_march(path, scales):
    light, heavy = 0.995 * POINT["load"], 1.005 * POINT["load"]
    one, other = Unit(path), Unit(path)
    one.set(load=light)
    other.set(load=heavy)
    one.start(), other.start()
    begun = one.get("approach")[0]
    one.set(load=heavy)
    for _ in range(500):
        one.step(STEP * scales[0])
    (by_march,), (by_unit,) = one.get("approach"), other.get("approach")
    np.testing.assert_allclose(by_march - begun, by_unit - begun, rtol=1e-2)
    one.end()
    other.end()


def test_what_makes_no_sense_is_refused_in_a_sentence_and_changes_nothing(path, scales):
    unit = begun(path)
    before = unit.get(*FILMS)
    for name, value in [("load", float("nan")), ("h_c_m", 1.0)]:
        with pytest.raises(FMICallException):
            unit.set(**{name: value})
        assert f"`{name}`" in unit.said[-1], unit.said
    unit.set(load=-5.0)
    with pytest.raises(FMICallException):
        unit.step(STEP * scales[0])
    assert "load" in unit.said[-1] and unit.get(*FILMS) == before
    unit.time = 0.0
    unit.set(load=POINT["load"])
    with pytest.raises(FMICallException):
        unit.step(1e6)
    assert "steps of the model's own" in unit.said[-1]
    unit.time = 0.0
    unit.step(STEP * scales[0])
    np.testing.assert_allclose(unit.get(*FILMS), before, rtol=1e-6)
    unit.end()


def test_models_of_both_kinds_are_told_apart(program, model):
    text = program("info", model)
    assert "transient line contacts" in text and "load 0.9" in text and "sampled equations" in text
    with pytest.raises(ehl.EhlError, match="transient reduced model"):
        ehl.Model.load(model)
    with pytest.raises(ehl.EhlError, match="steady contacts"):
        ehl.transient(ehl.Contact(**POINT), 0.1, 0.01, model=ROOT / "assets" / "line.rom")


def test_the_library_warns_of_what_was_not_trained(model):
    with pytest.warns(UserWarning, match="faster than the trained"):
        ehl.transient(ehl.Contact(**POINT), 0.1, 0.01, load=([0.0, 0.01, 0.1], [1.0, 1.09, 1.09]), model=model)
