"""Reduced models: loading, training, saving, description."""

import re

import numpy as np
import pytest

import ehl_explorer as ehl

from conftest import ROOT


def test_a_model_is_the_same_in_memory_in_a_file_and_in_the_program(tmp_path):
    model = ehl.Model.embedded("line")
    model.save(tmp_path / "line.rom")
    contact = ehl.Contact.moes(40, 10)
    own = ehl.solve(contact, method="reduced").H_c
    for given in [model, ehl.Model.load(tmp_path / "line.rom"), tmp_path / "line.rom", str(tmp_path / "line.rom")]:
        assert ehl.solve(contact, model=given).H_c == own
    assert model.contact == "line" and model.domain["m"][0] < 40 < model.domain["m"][1]
    assert str(model).startswith(model.title)


def test_arrays_are_those_of_info(program, tmp_path):
    model = ehl.Model.embedded("line")
    model.save(tmp_path / "line.rom")
    program("info", tmp_path / "line.rom", "--arrays", tmp_path / "line.npz")
    own = model.arrays()
    with np.load(tmp_path / "line.npz") as arrays:
        assert sorted(arrays) == sorted(own)
        for name in arrays:
            np.testing.assert_array_equal(arrays[name], own[name])


def test_training_tells_how_far_it_is_and_gives_the_model_of_the_command_line(small_training, program, tmp_path):
    told = []
    model = ehl.Model.train(small_training, progress=lambda *news: told.append(news))
    assert told and all(done <= total for _, done, total in told if total)
    (tmp_path / "scene.ron").write_text(small_training)
    program("train", tmp_path / "scene.ron", "--out", tmp_path / "own.rom")
    # A file stores fewer digits than the model has.
    model.save(tmp_path / "saved.rom")
    contact = ehl.Contact.moes(40, 10)
    saved, own = (ehl.solve(contact, model=tmp_path / name).H_c for name in ["saved.rom", "own.rom"])
    assert saved == own and abs(ehl.solve(contact, model=model).H_c / own - 1) < 1e-10


def test_the_model_with_heat_is_one_of_the_program():
    model = ehl.Model.embedded("line_heat")
    options = dict(modulus=231e9, viscosity=0.01, alpha=1.4520113272322256e-8, lubricant="mineral-oil", srr=0.2, heat=True)
    contact = ehl.Contact.si(3e-3, 2.0, 2e5, **options)
    found = ehl.solve(contact, method="reduced")
    assert found.H_c == ehl.solve(contact, model=model).H_c
    assert abs(found.H_c / ehl.solve(contact).H_c - 1) < 3e-3


def test_every_model_of_the_manual_is_one_of_the_program():
    page = (ROOT / "assets" / "manual" / "models.md").read_text()
    named = set(re.findall(r"`((?:line|point|ellipse)\w*)`", page)) - {"line_in_time", "point_in_time"}
    with pytest.raises(ehl.EhlError, match="no model `cube`; accepted are ") as refused:
        ehl.Model.embedded("cube")
    assert named == set(str(refused.value).split("accepted are ")[1].split(", "))
    for name in named:
        assert ehl.Model.embedded(name).contact == name.split("_")[0].replace("ellipse", "point"), name
