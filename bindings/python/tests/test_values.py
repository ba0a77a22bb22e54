"""Contacts, models and results as values: comparison, copies with changes, pickling."""

import copy
import pickle

import numpy as np
import pytest

import ehl_explorer as ehl

SI = dict(radius=0.0225, speed=5.0365, load=646110.0, modulus=2.878e11, viscosity=0.004, alpha=2.2e-8)
CONTACTS = [
    ehl.Contact.moes(40, 10),
    ehl.Contact.si(**SI, srr=-0.0),
    ehl.Contact.engineering(
        radius="12 mm", speed="3 m/s", load="300 N/mm", modulus="231 GPa", oil="ISO VG 68", temperature="60 °C", srr="5 %"
    ),
    ehl.Contact(moes_m=100, moes_l=5, contact="point", grid="graded"),
    ehl.Contact(moes_m=20, moes_l=5, heat=True, srr=0.2, oil_thermal=[2000, 0.14, 870], domain=(-4, 2)),
]


def through_pickle(value):
    return [pickle.loads(pickle.dumps(value, protocol)) for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)]


@pytest.mark.parametrize("contact", CONTACTS, ids=repr)
def test_contacts_are_equal_to_their_copies_only(contact):
    for same in [*through_pickle(contact), copy.copy(contact), copy.deepcopy(contact), contact.replace()]:
        assert same == contact and hash(same) == hash(contact) and repr(same) == repr(contact)
        assert same.quantities() == contact.quantities()
    assert [contact == other for other in CONTACTS].count(True) == 1
    assert contact != "a contact" and contact != contact.replace(srr=0.07)


def test_equal_contacts_may_be_written_differently():
    metres, words = ehl.Contact.si(**SI), ehl.Contact(**{**SI, "radius": "22.5 mm"})
    assert metres == words and hash(metres) == hash(words)
    assert metres == ehl.Contact.si(**SI, srr=-0.0) == ehl.Contact.si(**SI, contact="line")
    assert len({metres, words, ehl.Contact.moes(40, 10)}) == 2


def test_a_contact_is_copied_with_changes():
    contact = ehl.Contact.si(**SI)
    heavier = contact.replace(load=7e5, srr="10 %")
    assert heavier == ehl.Contact.si(**{**SI, "load": 7e5}, srr=0.1)
    assert contact == ehl.Contact.si(**SI), "it never changes itself"
    assert heavier.replace(load=SI["load"], srr=None) == contact
    moes = ehl.Contact.moes(40, 10).replace(load=2e5)
    assert (moes.quantities()["load"], round(moes.m, 9), round(moes.l, 9)) == (2e5, 40, 10)
    for changes, part in [(dict(colour="red"), "colour= is no keyword"), (dict(load=-1), "load="), (dict(load=None), "load=")]:
        with pytest.raises(ehl.EhlError, match=part):
            contact.replace(**changes)
    with pytest.raises(TypeError, match="load= must be a number"):
        contact.replace(load=object())


def test_a_contact_keeps_no_hold_on_what_it_was_made_of():
    constants, load = [2000.0, 0.14, 870.0], np.array(2e5)
    contact = ehl.Contact.moes(20, 5, heat=True, oil_thermal=constants, load=load)
    same = ehl.Contact.moes(20, 5, heat=True, oil_thermal="2000,0.14,870", load=2e5)
    constants[0], load[()] = 1.0, 1.0
    assert contact == same == contact.replace() == through_pickle(contact)[0]


@pytest.mark.parametrize(
    "contact, method",
    [
        (CONTACTS[0], "full"),
        (CONTACTS[0], "reduced"),
        (CONTACTS[4], "full"),
        (ehl.Contact.moes(20, 5, cavitation="mass-conserving", supply_film=2e-7), "full"),
        (ehl.Contact.moes(200, 10, contact="point"), "reduced"),
    ],
    ids=repr,
)
def test_results_keep_everything_in_a_pickle(contact, method):
    result = ehl.solve(contact, method=method)
    for same in [*through_pickle(result), copy.copy(result), copy.deepcopy(result)]:
        assert same == result and repr(same) == repr(result) and hash(same) == hash(result)
        assert same.to_dict() == result.to_dict() and same.warnings == result.warnings
        for name in ["x", "y", "pressure", "film"]:
            np.testing.assert_array_equal(getattr(same, name), getattr(result, name))
        assert list(same.fields) == list(result.fields)
    assert result == ehl.solve(contact, method=method), "the same request, the same answer"
    other = ehl.solve(contact.replace(srr=0.03), method=method)
    assert result != other and result != 1 and len({result, other}) == 2


def test_a_result_without_fields_is_pickled_too():
    result = ehl.solve(ehl.Contact.moes(40, 10, lubricant="squalane-pip", srr=0.3, radius=0.0127, dx=0.1))
    (same,) = through_pickle(result)[-1:]
    assert same == result and same.converged == result.converged


def test_models_are_equal_by_their_files(small_training, tmp_path):
    embedded = ehl.Model.embedded("line")
    assert embedded == ehl.Model.embedded("line") != ehl.Model.embedded("point")
    assert len(pickle.dumps(embedded)) < 200, "a model of the program is known by its name"
    trained = ehl.Model.train(small_training)
    trained.save(tmp_path / "own.rom")
    contact = ehl.Contact.moes(40, 10)
    for model in [embedded, trained, ehl.Model.load(tmp_path / "own.rom")]:
        for same in [*through_pickle(model)[-1:], copy.copy(model), copy.deepcopy(model)]:
            assert same == model and hash(same) == hash(model) and str(same) == str(model)
            # A file has fewer digits than a model that was just trained.
            assert abs(ehl.solve(contact, model=same).H_c / ehl.solve(contact, model=model).H_c - 1) < 1e-10
    assert trained == ehl.Model.load(tmp_path / "own.rom") != embedded
