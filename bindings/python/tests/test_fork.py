"""Forked and spawned processes: a forked child has no threads of its parent and must not wait for them."""

import functools
import multiprocessing
import sys
import threading

import numpy as np
import pytest

import ehl_explorer as ehl

METHODS = [method for method in ["fork", "spawn", "forkserver"] if method in multiprocessing.get_all_start_methods()]
BALL = ehl.Contact.moes(100, 5, contact="point", dx=0.05, dy=0.1)
CONTACTS = [ehl.Contact.moes(m, 10, method="reduced") for m in [20.0, 40.0, 80.0]] + [
    ehl.Contact.moes(40, 10),
    ehl.Contact.moes(20, 5, heat=True, srr=0.2, grid="graded"),
    BALL,
]
forks = pytest.mark.skipif("fork" not in METHODS, reason="this system does not fork")


def in_a_child(method, work, *given):
    """Runs work in a new process; fails if it takes too long."""
    with multiprocessing.get_context(method).Pool(1) as pool:
        return pool.apply_async(work, given).get(timeout=120)


@pytest.mark.parametrize("method", METHODS)
def test_a_pool_solves_contacts_as_the_parent_does(method):
    expected = [ehl.solve(contact) for contact in CONTACTS]
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map_async(ehl.solve, CONTACTS).get(timeout=120) == expected


def everything(model):
    many = ehl.solve_many(ehl.Contact.moes(40, 10), moes_m=np.linspace(20, 80, 300), method="reduced")
    swept = ehl.sweep(ehl.Contact.moes(40, 10, dx=0.05), "moes-m=20:80:3")
    march = ehl.transient(ehl.Contact.moes(40, 10, dx=0.02), duration=0.2, step=0.1)
    ball = ehl.solve(ehl.Contact.moes(100, 5, contact="point"), model=model)
    return many["H_c"].tolist(), swept["H_c"].tolist(), march["H_c"].tolist(), ball.H_c, ehl.solve(BALL).H_c


@forks
@pytest.mark.parametrize("before", ["embedded", "load", "ball", "many", "everything"])
def test_a_forked_child_works_after_its_parent(before, tmp_path):
    model = ehl.Model.embedded("point")
    if before == "load":
        model.save(tmp_path / "point.rom")
        model = ehl.Model.load(tmp_path / "point.rom")
    elif before == "ball":
        ehl.solve(BALL)
    elif before == "many":
        ehl.solve_many(ehl.Contact.moes(40, 10), moes_m=np.linspace(20, 80, 300), method="reduced")
    elif before == "everything":
        everything(model)
    found = in_a_child("fork", everything, model)
    assert found == everything(model)


def trained(scene):
    model = ehl.Model.train(scene)
    return model, sorted(model.arrays())


@forks
def test_a_child_trains_a_model_and_hands_it_over(small_training):
    own = ehl.Model.train(small_training)
    assert in_a_child("fork", trained, small_training) == (own, sorted(own.arrays()))


def test_tasks_bring_a_model_along(tmp_path):
    ehl.Model.embedded("line").save(tmp_path / "line.rom")
    solve = functools.partial(ehl.solve, model=ehl.Model.load(tmp_path / "line.rom"))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map_async(solve, CONTACTS[:3], chunksize=1).get(timeout=120) == [solve(own) for own in CONTACTS[:3]]


def nested():
    return in_a_child("fork", ehl.solve, BALL)


@forks
def test_children_of_children_work_too():
    expected, found = ehl.solve(BALL), []
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    child = context.Process(target=lambda: sender.send(nested()))
    child.start()
    try:
        assert receiver.poll(120)
        found.append(receiver.recv())
    finally:
        child.terminate()
        child.join()
    assert found == [expected]


@forks
def test_a_child_works_that_is_forked_while_other_threads_solve():
    stop = threading.Event()

    def busy(contacts):
        while not stop.is_set():
            for contact in contacts:
                ehl.solve(contact)

    threads = [threading.Thread(target=busy, args=(contacts,)) for contacts in [CONTACTS[:3], CONTACTS[2:4], [BALL]]]
    for thread in threads:
        thread.start()
    try:
        expected = [ehl.solve(contact) for contact in CONTACTS]
        for _ in range(5):
            with multiprocessing.get_context("fork").Pool(2) as pool:
                assert pool.map_async(ehl.solve, CONTACTS).get(timeout=120) == expected
    finally:
        stop.set()
        for thread in threads:
            thread.join()
