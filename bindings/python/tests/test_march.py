"""Transient marches: a failed step is reported in every interface, with the rows computed so far."""

import json
import pickle
import warnings

import numpy as np
import pytest

import ehl_explorer as ehl

SI = dict(radius=0.002, speed=5.0, load=2e5, modulus=2.31e11, viscosity=0.01, alpha=1e-8)
CONTACT = ehl.Contact(**SI, dx=0.02)
# A load that increases by a factor of thirty within one step.
JUMP = ([0.0, 1.0, 1.05, 2.0], [1.0, 1.0, 30.0, 30.0])


def scene(study):
    at = ", ".join(f"{name}: {value!r}" for name, value in SI.items())
    return f"""Scene(version: 1, title: "jump", at: Si({at}), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(
        inputs: (load: Sampled(times: {JUMP[0]}, values: {JUMP[1]})), duration: 2.0, time_step: Fixed(0.05){study}))"""


def stopped(**options):
    with pytest.raises(ehl.MarchStopped) as stopped, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ehl.transient(CONTACT, duration=2, step=0.05, load=JUMP, **options)
    return stopped.value


def test_a_march_that_stops_is_an_exception_with_what_it_reached():
    error = stopped()
    assert isinstance(error, ehl.EhlError) and isinstance(error, ValueError)
    assert str(error).startswith("the march could not take the step of ")
    reached = error.reached
    assert 1 < len(reached) < 41 and reached["T"][0] == 0 and np.isfinite(reached["H_c"]).all()
    # The rows equal those of a march that ends before the jump.
    before = ehl.transient(CONTACT, duration=0.5, step=0.05, load=JUMP)
    np.testing.assert_array_equal(before["H_c"], reached["H_c"][: len(before)])
    ended = error.warning["ended"]["step_refused"]
    assert error.warning["kind"] == "march_stopped" and error.warning["reached"] == reached["T"][-1]
    assert 1.0 < ended["time"] < 1.06 and 0 < ended["step"] < 0.05 and error.warning["text"] == str(error)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.warning == error.warning
    np.testing.assert_array_equal(again.reached["H_c"], reached["H_c"])


def test_a_march_that_goes_through_returns_all_its_rows():
    march = ehl.transient(CONTACT, duration=2, step=0.05)
    assert len(march) == 41 and march["T"][-1] == pytest.approx(2)


def test_scenes_and_the_command_line_say_that_a_march_stopped(program, tmp_path):
    error, text = stopped(), scene("")
    outcome = ehl.run(text)
    assert not outcome.converged and not outcome.passed
    assert any(str(error) in warning for warning in outcome.warnings)
    (table,) = outcome.tables.values()
    assert len(table) == len(error.reached)
    (tmp_path / "jump.ron").write_text(text)
    program("run", tmp_path / "jump.ron", "--out", tmp_path / "out", code=1)
    told = json.loads(next((tmp_path / "out").glob("*.json")).read_text())
    assert (told["converged"], told["passed"]) == (False, False) and str(error) in told["warning"]
    (said,) = [warning for warning in told["warnings"] if warning["kind"] == "march_stopped"]
    assert said | {"text": str(error)} == error.warning | {"part": "fixed"}


def test_a_model_trained_from_a_march_that_stopped_says_so(program, tmp_path):
    (tmp_path / "jump.ron").write_text(scene(", reduced: (loss: 1e-4)"))
    said = program("train", tmp_path / "jump.ron", "--out", tmp_path / "jump.rom", stream="stderr")
    assert "the march could not take the step" in said


def test_what_a_reader_must_know_is_a_warning(in_time_training, program, tmp_path):
    (tmp_path / "breathes.ron").write_text(in_time_training)
    program("train", tmp_path / "breathes.ron", "--out", tmp_path / "breathes.rom")
    swing = ([0.0, 0.5, 1.0], [1.0, 1.5, 1.0])
    with pytest.warns(UserWarning, match="load"):
        march = ehl.transient(CONTACT, duration=1, step=0.01, load=swing, model=tmp_path / "breathes.rom")
    assert len(march) == 101


def test_a_coarse_step_is_warned_of_and_a_tolerance_chooses_the_steps():
    time = np.linspace(0, 2, 81)
    swing = (time, 1 + 0.15 * np.sin(2 * np.pi * time / 0.3))
    with pytest.warns(UserWarning, match="the time-step error of H_c is about"):
        coarse = ehl.transient(CONTACT, duration=2, step=0.05, load=swing)
    assert coarse["step_error"][0] > 0.03 and len(set(coarse["step_error"])) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fine = ehl.transient(CONTACT, duration=2, tolerance=0.01, load=swing)
    assert fine["step_error"][0] <= 0.01 and len(fine) > len(coarse)
    shortest = ehl.transient(CONTACT, duration=2, step=0.0025, load=swing)
    true = np.interp(fine["T"], shortest["T"], shortest["H_c"])
    assert np.max(np.abs(fine["H_c"] / true - 1)) < 0.02
    for given in ({}, {"step": 0.1, "tolerance": 0.01}):
        with pytest.raises(ehl.EhlError, match="either step= or tolerance="):
            ehl.transient(CONTACT, duration=1, **given)


def test_circular_contacts_are_marched_in_full():
    ball = ehl.Contact.moes(20, 6, contact="point", dx=0.08, dy=0.1)
    times = np.linspace(0, 2, 201)
    load = (times, 1 + 0.1 * np.sin(2 * np.pi * times / 2))
    march = ehl.transient(ball, duration=2, step=0.05, load=load)
    assert len(march) == 41 and march["T"][-1] == pytest.approx(2)
    # Hertz: the central pressure follows the load to the power of a third, up to the delay of the film.
    assert march["P_c"].max() / march["P_c"][0] == pytest.approx(1.1 ** (1 / 3), abs=0.02)
    assert np.ptp(march["H_c"]) > 0.01 * march["H_c"][0]
    steady = ehl.transient(ball, duration=0.5, step=0.05)
    np.testing.assert_allclose(steady["H_c"], march["H_c"][0], rtol=1e-5)
    with pytest.raises(ehl.EhlError, match="constant radius"):
        ehl.transient(ball, duration=2, step=0.05, radius=load)
    with pytest.raises(ehl.EhlError, match="line contacts only"):
        ehl.transient(ehl.Contact.moes(20, 6, contact="point", method="reduced"), duration=2, step=0.05)
