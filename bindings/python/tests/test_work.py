"""Long computations: progress, Ctrl-C, threads, and the overhead of Python."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import ehl_explorer as ehl


def test_progress_is_told_and_what_it_raises_comes_back(small_training):
    class Enough(Exception):
        pass

    def stop(stage, done, total):
        raise Enough(stage)

    with pytest.raises(Enough):
        ehl.Model.train(small_training, progress=stop)


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_stops_long_work():
    # A background process of a shell ignores the signal unless it asks for it.
    script = """
import signal
import ehl_explorer as ehl
signal.signal(signal.SIGINT, signal.default_int_handler)
print("begun", flush=True)
try:
    ehl.sweep(ehl.Contact.moes(40, 10, contact="point"), "moes-m=100:1000:2000")
except KeyboardInterrupt:
    print("stopped", flush=True)
"""
    work = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert work.stdout.readline() == "begun\n"
    time.sleep(1.0)
    work.send_signal(signal.SIGINT)
    begun = time.monotonic()
    assert work.communicate(timeout=60)[0] == "stopped\n"
    assert time.monotonic() - begun < 20


def test_other_threads_run_meanwhile():
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    ehl.solve_many(ehl.Contact.moes(40, 10), moes_m=np.linspace(20, 100, 4000), method="reduced")
    stop.set()
    thread.join()
    assert counted[0] > 5


def test_threads_may_solve_at_once():
    contacts = [ehl.Contact.moes(m, 10) for m in np.linspace(20, 100, 16)]
    alone = [ehl.solve(contact, method="reduced").H_c for contact in contacts]
    together = [None] * len(contacts)

    def solve(k):
        together[k] = ehl.solve(contacts[k], method="reduced").H_c

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(len(contacts))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


def test_many_are_each_solved_as_one_alone():
    contact = ehl.Contact.moes(40, 10)
    ms, ls = np.linspace(20, 90, 30)[:, None], np.array([6.0, 12.0])
    many = ehl.solve_many(contact, moes_m=ms, moes_l=ls, method="reduced")
    assert many.shape == (30, 2) and many["converged"].all() and many["reduced.trained"].all()
    for (i, j), h_c in np.ndenumerate(many["H_c"]):
        assert h_c == ehl.solve(ehl.Contact.moes(ms[i, 0], ls[j]), method="reduced").H_c
    again = ehl.solve_many(contact, moes_m=ms[::-1], moes_l=ls, method="reduced")
    np.testing.assert_array_equal(again["H_c"][::-1], many["H_c"])


def test_a_contact_that_makes_no_sense_refuses_its_own_row_only():
    contact = ehl.Contact.moes(40, 10)
    ms = np.array([[40.0, float("nan")], [-1.0, 60.0]])
    rows = ehl.solve_many(contact, moes_m=ms, method="reduced")
    assert rows["status"].tolist() == [["converged", "refused"], ["refused", "converged"]]
    assert rows["converged"].tolist() == [[1, 0], [0, 1]]
    for (i, j), m in np.ndenumerate(ms):
        row = rows[i, j]
        if row["status"] == "converged":
            assert row["H_c"] == ehl.solve(contact.replace(moes_m=m), method="reduced").H_c and row["reason"] == ""
            continue
        assert all(np.isnan(row[name]) for name in ["H_c", "moes.M", "reduced.trained", "wall_s"])
        with pytest.raises(ehl.EhlError) as refused:
            contact.replace(moes_m=m)
        assert row["reason"] == row["warning"] == str(refused.value)


def test_a_contact_of_many_that_does_not_converge_says_so():
    contact = ehl.Contact.moes(1, 1, dx=0.02)
    ms, ls = [40.0, 1e5], [10.0, 60.0]
    rows = ehl.solve_many(contact, moes_m=ms, moes_l=ls)
    for row, m, l in zip(rows, ms, ls):
        alone = ehl.solve(contact.replace(moes_m=m, moes_l=l))
        assert row["status"] == ("converged" if alone.converged else "not converged")
        assert bool(row["reason"]) != alone.converged and row["warning"] == "; ".join(alone.warnings)


def test_a_scalar_varied_gives_one_row():
    assert ehl.solve_many(ehl.Contact.moes(40, 10), moes_m=50, method="reduced").shape == ()


def ratio(measure, rust, bar, rounds):
    """Returns the ratio of the shortest times of two functions, measured in turns. Other load on the machine only adds
    to a time, so that the shortest ones approach the true ones. Measuring ends early once the ratio is below `bar`."""
    least = [np.inf, np.inf]
    for done in range(1, rounds + 1):
        least = [min(least[0], measure()), min(least[1], rust())]
        if done >= 5 and least[0] / least[1] < bar:
            break
    return least[0] / least[1]


def test_a_reduced_solve_through_python_costs_little_more():
    from ehl_explorer import _native

    contact, runs = ehl.Contact.moes(40, 10), 10
    ehl.solve(contact, method="reduced")

    def python():
        begun = time.perf_counter()
        for _ in range(runs):
            ehl.solve(contact, method="reduced")
        return time.perf_counter() - begun

    share = ratio(python, lambda: _native.measure(contact, runs, "reduced"), bar=1.2, rounds=300)
    print(f"a reduced solve through Python takes {share:.3f} of the Rust call")
    assert share < 1.2


def test_many_through_python_are_as_quick_as_threads_of_rust():
    from ehl_explorer import _native

    contact, runs, cores = ehl.Contact.moes(40, 10), 4_000, len(os.sched_getaffinity(0))
    # With 100,000 solves the ratio is the same, but the test takes longer.
    ms = np.full(runs, 40.0)
    ehl.solve_many(contact, moes_m=ms[:1000], method="reduced")

    def python():
        begun = time.perf_counter()
        ehl.solve_many(contact, moes_m=ms, method="reduced")
        return time.perf_counter() - begun

    share = ratio(python, lambda: _native.measure(contact, runs, "reduced", None, cores), bar=1 / 0.9, rounds=60)
    print(f"many through Python take {share:.3f} of as many threads of Rust")
    assert share < 1 / 0.9
