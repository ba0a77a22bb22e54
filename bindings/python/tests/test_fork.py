"""Processes forked after parallel work: a child has none of its parent's threads and must not wait for them."""

import multiprocessing
import sys

import pytest

import ehl_explorer as ehl

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="this system does not fork")

BALL = ehl.Contact.moes(100, 5, contact="point")


def solved_in_a_child(answers):
    full = ehl.solve(BALL)
    reduced = ehl.solve(BALL, method="reduced", model=ehl.Model.embedded("point"))
    many = ehl.solve_many(ehl.Contact.moes(40, 10), moes_m=[30.0, 40.0, 50.0], method="reduced")
    answers.put((full.h_c_m, reduced.h_c_m, len(many)))


def test_a_forked_child_solves_after_its_parent_has_solved_in_parallel():
    model = ehl.Model.embedded("point")
    full, reduced = ehl.solve(BALL), ehl.solve(BALL, method="reduced", model=model)
    context = multiprocessing.get_context("fork")
    answers = context.Queue()
    child = context.Process(target=solved_in_a_child, args=(answers,))
    child.start()
    try:
        assert answers.get(timeout=30) == (full.h_c_m, reduced.h_c_m, 3)
    finally:
        child.kill()
        child.join()
