"""Valid and invalid requests in random order: no panic, no hang, and every value belongs to its own request.

A few hundred sequences, 20,000 with EHL_LONG=1 in the environment.
"""

import copy
import multiprocessing
import os
import pickle
import random
import signal
import warnings

import numpy as np
import pytest

import ehl_explorer as ehl

SEQUENCES = 20_000 if os.environ.get("EHL_LONG") == "1" else 300
#: Number of solved contacts that are stored.
KEPT = 2_000
#: Time limit of one sequence [s].
PATIENCE = 120

MODELS = {
    "line": lambda: ehl.Model.embedded("line"),
    "point": lambda: ehl.Model.embedded("point"),
    "sheared": lambda: ehl.Model.embedded("line_shear"),
}
WRONG = [
    float("nan"), float("inf"), -float("inf"), -1, 0, 1e300, "", "many", "12 kg", "NaN", "\0", "ü" * 300, None, True, [],
    [1.0, 2.0], [float("nan")] * 3, {}, object(), b"\xff", 10**400, "1e-400",
]
WORDS = [
    "moes_m", "moes_l", "radius", "radius_y", "speed", "load", "modulus", "e1", "nu1", "viscosity", "alpha", "srr", "npr",
    "contact", "method", "rom", "grid", "dx", "dy", "domain", "cavitation", "supply_film", "lubricant", "density", "shear",
    "shear_stress", "limiting_stress", "roughness", "asperities", "heat", "body1", "oil", "temperature", "colour", "", "moes-m", "M",
]


def line(rng):
    return dict(moes_m=round(rng.uniform(8, 150), 1), moes_l=round(rng.uniform(4, 14), 1))


def sensible(rng):
    """Returns the keywords of a valid contact, with its method."""
    kind = rng.randrange(8)
    given = line(rng)
    if kind == 0:
        given |= dict(radius=0.01, modulus=2.31e11, srr=round(rng.uniform(-0.3, 0.3), 2))
    elif kind == 1:
        given |= dict(contact="point", moes_m=rng.choice([60, 200, 400]))
    elif kind == 2:
        given |= dict(method="full", dx=0.05, cavitation=rng.choice(["penalty", "complementarity", "mass-conserving"]))
    elif kind == 3:
        given |= dict(method="full", dx=0.05, srr=0.1, shear="eyring", shear_stress="6 MPa")
    elif kind == 4:
        given = dict(
            radius="12 mm", speed=f"{rng.randint(1, 5)} m/s", load=f"{rng.randint(100, 500)} N/mm", modulus="231 GPa",
            oil=f"ISO VG {rng.choice([32, 68, 100])}", temperature="60 °C",
        )
    elif kind == 5:
        given |= dict(moes_m=rng.choice([1500, 3000]), moes_l=rng.choice([2, 20]), dx=0.05, method="full")
    given.setdefault("method", "reduced")
    return given


def senseless(rng):
    """Returns keywords of which some are invalid."""
    given = sensible(rng)
    for _ in range(rng.randint(1, 3)):
        given[rng.choice(WORDS)] = rng.choice(WRONG)
    return given


def refused_or(call):
    """Returns the result of a call, or the message of its refusal. No other outcome is allowed."""
    try:
        return call(), None
    except (ehl.EhlError, TypeError) as error:
        sentence = str(error)
        assert sentence and "panick" not in sentence and "unwrap" not in sentence, sentence
        return None, sentence


def number(value):
    return np.nan if value is None else float(value)


def of_its_own_request(contact, result):
    """Asserts that a result belongs to this contact."""
    quantities, si = contact.quantities(), result["si"]
    u1, u2 = si["u1"], si["u2"]
    names = set(si) - {"u1", "u2"}
    assert {name: si[name] for name in names} == {name: quantities[name] for name in names}
    speed = quantities["speed"]
    assert abs(u1 + u2 - 2 * speed) < 1e-12 * speed and abs(u2 - u1 - quantities["srr"] * speed) < 1e-12 * speed
    moes = result["moes"]
    assert (moes["M"], moes["L"]) == (contact.m, contact.l) and result["contact"] == contact.contact
    assert result["hertz.p_h_pa"] == contact.hertz_pressure
    if result.converged:
        assert result.pressure.shape == result.film.shape and np.isfinite(result.film).all()
        assert result.H_c == result["H_c"] and result.H_min <= result.H_c * (1 + 1e-12)
        bound = result.to_dict().get("reduced", {}).get("h_c_error_bound")
        assert bound is None or bound > 0
        # The central film thickness agrees with the field.
        axis = result.film if result.film.ndim == 1 else result.film[:, -1]
        assert abs(np.interp(0, result.x, axis) / result.H_c - 1) < 0.05
    else:
        assert result.H_c is None and result.warnings


class Session:
    """Results so far, by contact. The same request must have the same result, independent of requests in between."""

    def __init__(self, rng):
        self.rng, self.solved, self.models = rng, {}, {}

    def contact(self):
        if self.solved and self.rng.random() < 0.3:
            return self.rng.choice(list(self.solved))
        return ehl.Contact(**sensible(self.rng))

    def solve(self, contact):
        result = ehl.solve(contact)
        of_its_own_request(contact, result)
        former = self.solved.setdefault(contact, result)
        assert former == result, (contact, former, result)
        if len(self.solved) > KEPT:
            del self.solved[next(iter(self.solved))]
        return result

    def wrong(self):
        given = senseless(self.rng)
        contact, _ = refused_or(lambda: ehl.Contact(**given))
        if contact is not None and contact.m < 500 and "dx" not in given and "dy" not in given:
            assert contact == ehl.Contact(**given) == copy.copy(contact)
            if contact_method(contact) == "reduced" and contact.contact == "line" and given.get("rom") is None:
                self.solve(contact)
        refused_or(lambda: ehl.solve(ehl.Contact.moes(40, 10), method=self.rng.choice(["halved", 3, None, "reduced"])))
        refused_or(lambda: ehl.Model.load(self.rng.choice(["no.rom", "/", "", 3])))
        refused_or(lambda: ehl.Model.embedded(self.rng.choice(["cube", "line", 1])))

    def one(self):
        self.solve(self.contact())

    def replaced(self):
        contact = self.contact()
        word, value = self.rng.choice([("srr", 0.05), ("moes_m", 33.3), ("load", 2e5), ("srr", None), ("load", -1)])
        other, _ = refused_or(lambda: contact.replace(**{word: value}))
        if other is not None:
            self.solve(other)
            self.solve(contact)

    def model(self):
        name = self.rng.choice(list(MODELS))
        model = self.models.setdefault(name, MODELS[name]())
        contact = ehl.Contact(**line(self.rng), contact="point" if name == "point" else "line")
        result, _ = refused_or(lambda: ehl.solve(contact, model=model))
        again, _ = refused_or(lambda: ehl.solve(contact, model=pickle.loads(pickle.dumps(model))))
        assert result == again

    def many(self):
        contact = ehl.Contact(**line(self.rng), **self.rng.choice([dict(method="full", dx=0.05), dict(method="reduced")]))
        ms = [self.rng.choice([round(self.rng.uniform(8, 150), 1), float("nan"), -3.0, 0.0]) for _ in range(3)]
        rows, _ = refused_or(lambda: ehl.solve_many(contact, moes_m=ms))
        if rows is None:
            return
        for m, row in zip(ms, rows):
            own, why = refused_or(lambda: contact.replace(moes_m=m))
            if own is None:
                assert (row["status"], row["reason"], row["converged"]) == ("refused", why, 0) and np.isnan(row["H_c"])
                continue
            result = self.solve(own)
            if result["method"] == contact_method(own):
                assert np.array_equal(row["H_c"], number(result.H_c), equal_nan=True) and row["moes.M"] == own.m
                assert row["warning"] == "; ".join(result.warnings), own

    def sweep(self):
        contact = ehl.Contact(**line(self.rng), **self.rng.choice([dict(method="full", dx=0.05), dict(method="reduced")]))
        ms = sorted(self.rng.choice([round(self.rng.uniform(8, 150), 1)] * 4 + [-3.0, 0.0]) for _ in range(3))
        rows, _ = refused_or(lambda: ehl.sweep(contact, ("moes_m", ms)))
        for m, row in zip(ms, rows if rows is not None else []):
            own, why = refused_or(lambda: contact.replace(moes_m=m))
            if own is None:
                assert (row["status"], row["reason"], row["converged"]) == ("refused", why, 0) and np.isnan(row["H_c"])
                continue
            result = self.solve(own)
            # Each contact starts from its neighbour, which may change the last digits.
            if row["converged"] and result["method"] == contact_method(contact):
                assert abs(row["H_c"] / result.H_c - 1) < 1e-6, (contact, m)

    def march(self):
        contact = ehl.Contact(**line(self.rng), **self.rng.choice([dict(dx=0.05), dict(method="reduced")]))
        step, high = self.rng.choice([0.1, 0.05, -1, float("nan")]), self.rng.choice([1.1, 3.0, float("nan"), -1])
        try:
            found = ehl.transient(contact, duration=0.2, step=step, load=([0, 0.1, 0.2], [1, high, 1]))
            assert found["T"][-1] >= 0.2 - 1e-9
        except ehl.MarchStopped as stopped:
            assert (stopped.reached["T"] < 0.2).all() and stopped.warning["reached"] < 0.2
        except ehl.EhlError as error:
            assert str(error)

    def text(self):
        scene = 'Scene(version: 1, title: "t", at: Moes(m: 40.0, l: 10.0), study: Point(methods: [Reduced(model: Embedded)]))'
        cut = self.rng.randrange(len(scene))
        text = self.rng.choice([scene, scene[:cut] + "(" + scene[cut + 1 :], scene.replace("40.0", "-40.0")])
        outcome, _ = refused_or(lambda: ehl.run(text))
        assert outcome is None or outcome.value("H_c") == self.solve(ehl.Contact.moes(40, 10, method="reduced")).H_c

    STEPS = [wrong, wrong, one, one, one, replaced, model, many, sweep, march, text]


def contact_method(contact):
    """Returns the method that a contact states."""
    return "reduced" if "method='reduced'" in repr(contact) else "full"


def too_long(*_):
    raise TimeoutError("a sequence hangs")


def test_values_belong_to_their_requests_in_any_order():
    rng = random.Random(57)
    session = Session(rng)
    known = hasattr(signal, "SIGALRM")
    former = signal.signal(signal.SIGALRM, too_long) if known else None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _ in range(SEQUENCES):
                if known:
                    signal.alarm(PATIENCE)
                for _ in range(rng.randint(1, 6)):
                    rng.choice(Session.STEPS)(session)
    finally:
        if known:
            signal.alarm(0)
            signal.signal(signal.SIGALRM, former)
    # A new process gives the same results, in another order.
    contacts = rng.sample(list(session.solved), min(len(session.solved), 60))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        fresh = pool.map_async(ehl.solve, contacts).get(timeout=600)
    assert [session.solved[contact] for contact in contacts] == fresh
