"""Invalid requests are refused as on the command line, with keywords in place of flags."""

import re

import pytest

import ehl_explorer as ehl

WRONG = [
    dict(moes_m=float("nan"), moes_l=10),
    dict(moes_m=float("inf"), moes_l=10),
    dict(moes_m=40, moes_l=10, srr=11),
    dict(moes_m=40),
    dict(radius=0.01, speed=1, load=-5, modulus=2e11, viscosity=0.01, alpha=2e-8),
    dict(radius=0.01),
    dict(moes_m=40, moes_l=10, modulus=-1),
    dict(moes_m=40, moes_l=10, grid="model", dx=0.01),
    dict(moes_m=40, moes_l=10, modulus=2e11, e1=2e11),
    dict(moes_m=40, moes_l=10, e1=2e11),
    dict(moes_m=40, moes_l=10, supply_film=1e-7),
    dict(moes_m=40, moes_l=10, shear="eyring"),
    dict(moes_m=40, moes_l=10, body1="glass"),
    dict(moes_m=40, moes_l=10, radius_y=0.01),
    dict(moes_m=40, moes_l=10, rom="some.rom"),
    dict(moes_m=40, moes_l=10, lubricant="squalane-pip", alpha=2e-8),
]


def in_words_of_python(sentence):
    """Replaces the flags in a message of the command line by keywords."""
    chosen = re.sub(r"--(cavitation|method|grid|shear) ([a-z][a-z-]*)", r'\1="\2"', sentence.replace("--heat", "heat=True"))
    return re.sub(r"--([a-z0-9-]+)", lambda flag: flag[1].replace("-", "_") + "=", chosen)


@pytest.mark.parametrize("given", WRONG)
def test_the_sentence_is_that_of_the_command_line_in_words_of_python(given, program):
    words = [f"--{name.replace('_', '-')}={value}" for name, value in given.items()]
    with pytest.raises(ehl.EhlError) as refused:
        ehl.Contact(**given)
    told = program("solve", *words, code=2).strip().removeprefix("ehl-explorer: ")
    assert str(refused.value) == in_words_of_python(told)
    assert "--" not in str(refused.value)


@pytest.mark.parametrize(
    "given, part",
    [
        (dict(lubricant="butter"), "lubricant=: “butter” is not valid; there is no lubricant of that name; accepted are"),
        (dict(colour="red"), "colour= is no keyword of a contact; accepted are contact, method, rom, machine, radius"),
        (dict(viscosity="many"), "viscosity=: “many” is no number; write it like 12.5 mPa·s"),
        (dict(radius="12 kg"), "radius=: “kg” is no unit of a length; accepted are mm"),
        (dict(contact="cube"), "contact=: “cube” is not valid; accepted are line, point"),
        (dict(body2="wood", heat=True), "body2=: “wood” is not valid; accepted are three numbers, as in 47,460,7850, or one of steel"),
    ],
)
def test_a_value_that_is_none_is_refused_by_its_keyword(given, part):
    with pytest.raises(ehl.EhlError) as refused:
        ehl.Contact(moes_m=40, moes_l=10, **given)
    assert str(refused.value).startswith(part), str(refused.value)


def test_refusals_are_value_errors_with_words():
    contact = ehl.Contact.moes(40, 10)
    for call, part in [
        (lambda: ehl.solve(contact, method="halved"), "accepted are full, reduced"),
        (lambda: ehl.solve(contact, model="no/such.rom"), "no/such.rom"),
        (lambda: ehl.solve_many(contact, load=[1e5], model="no/such.rom"), "no/such.rom"),
        (lambda: ehl.solve_many(contact, colour=[1.0]), "cannot be varied"),
        (lambda: ehl.solve_many(contact), "nothing is varied"),
        (lambda: ehl.sweep(contact, "moes-m=1:2"), "NAME=FROM:TO:N"),
        (lambda: ehl.sweep(contact), "nothing is varied"),
        (lambda: ehl.run("Scene(version: 99)"), "newer program"),
        (lambda: ehl.run("no_such_scene.ron"), "no_such_scene.ron"),
        (lambda: ehl.Model.load("no_such.rom"), "no_such.rom"),
        (lambda: ehl.Model.train("Scene(version: 1, title: \"t\", study: Point(methods: [Full]))"), "no training"),
        (lambda: ehl.Contact.engineering(radius="12 parsnips", speed=1, load=1e5), "parsnips"),
        (lambda: ehl.Contact.engineering(contact="cube"), "cube"),
        (lambda: ehl.random_test((10, 20), (5, 6), tests=0), "study.tests"),
        (lambda: ehl.random_test((10, 20), (5, 6), tests=5, contact="cube"), "accepted are line, point"),
        (lambda: ehl.transient(contact, duration=1, step=-1), "the time step is -1, but must be"),
        (lambda: ehl.transient(contact, duration=-1, step=1), "the duration is -1, but must be"),
        (lambda: ehl.transient(contact.replace(grid="model"), duration=1, step=0.1), "grid= must be uniform or graded"),
        (lambda: contact.replace(limiting_stress=(1, 2)), "the slope of the limiting stress is 2"),
        (lambda: ehl.transient(contact, duration=1, step=0.1, load=([0, 1], [1])), "load"),
    ]:
        with pytest.raises(ValueError, match="(?s).*") as refused:
            call()
        assert part in str(refused.value), str(refused.value)


def test_a_model_of_another_contact_is_refused():
    with pytest.raises(ehl.EhlError, match="line contacts"):
        ehl.solve(ehl.Contact.moes(100, 5, contact="point"), model=ehl.Model.embedded("line"))


def test_a_contact_beyond_the_trained_range_says_so():
    result = ehl.solve(ehl.Contact.moes(1000, 30), method="reduced")
    assert result.warnings and (result.method == "full" or not result.trained)


def test_a_damaged_model_is_refused(tmp_path):
    ehl.Model.embedded().save(tmp_path / "whole.rom")
    whole = (tmp_path / "whole.rom").read_bytes()
    for name, content in [("cut.rom", whole[:-9]), ("foreign.rom", b"PNG"), ("newer.rom", whole[:8] + b"\x63" + whole[9:])]:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(ehl.EhlError, match=name):
            ehl.Model.load(tmp_path / name)
