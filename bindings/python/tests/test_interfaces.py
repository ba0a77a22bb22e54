"""Six contacts through Python and units: the numbers, the trust and the warnings of the command line."""

import json

import numpy as np
import pytest

import ehl_explorer as ehl
from conftest import ROOT
from test_command_line import options, without_clock

SIX = json.loads((ROOT / "tests" / "data" / "six_contacts.json").read_text())
NAMES = ["H_c", "H_min", "traction", "reduced.trained", "reduced.h_c_error_bound", "hertz.p_h_pa"]


@pytest.fixture(params=SIX, ids=[stated["name"] for stated in SIX])
def stated(request):
    return request.param


def words(stated):
    return {name.replace("-", "_"): value for name, value in stated["options"].items()}


def contact(stated):
    return ehl.Contact(**words(stated))


@pytest.fixture
def wanted(stated, solve_json):
    plain = {name: ",".join(map(repr, value)) if isinstance(value, list) else value for name, value in words(stated).items()}
    return without_clock(solve_json(*options(plain), "--method", "reduced"))


def number(values, name):
    for part in name.split("."):
        values = values.get(part, {}) if isinstance(values, dict) else {}
    return np.nan if values == {} else float(values)


def same_row(row, wanted):
    for name in NAMES:
        np.testing.assert_equal(float(row[name]), number(wanted, name), err_msg=name)
    assert row["warning"] == wanted.get("warning", "")


def test_solve_is_the_same(stated, wanted):
    result = ehl.solve(contact(stated), method="reduced")
    assert without_clock(result.to_dict()) == wanted
    assert bool(result.trained) == stated["trained"]
    assert result.warnings == [warning["text"] for warning in wanted.get("warnings", [])]


def test_rows_of_many_and_of_a_sweep_are_the_same(stated, wanted):
    srr = [stated["options"].get("srr", 0.0)]
    same_row(ehl.solve_many(contact(stated), srr=srr, method="reduced")[0], wanted)
    same_row(ehl.sweep(contact(stated), ("srr", srr), method="reduced")[0], wanted)


def cell(value):
    return "yes" if value is True else ",".join(map(repr, value)) if isinstance(value, list) else str(value)


def test_scenes_are_the_same(stated, wanted):
    methods = "methods: [Reduced(model: Embedded)]"
    point = ehl.run(f'Scene(version: 1, title: "six", {stated["scene"]}, study: Point({methods}))')
    for name in NAMES:
        if not np.isnan(number(wanted, name)):
            assert point.value(name) == number(wanted, name), name
    said = [f"reduced: {warning['text']}" for warning in wanted.get("warnings", [])]
    assert point.warnings == ["; ".join(said)] * bool(said)
    given = stated["options"]
    table = f"{';'.join(given)}\n{';'.join(map(cell, given.values()))}\n"
    cases = ehl.run(f'Scene(version: 1, title: "six", study: LoadCases(cases: Text({json.dumps(table)}), {methods}))')
    (row,) = cases.tables["load_cases"]
    tagged = {name: row[name if name == "hertz.p_h_pa" else f"reduced.{name}"] for name in NAMES}
    same_row(tagged | {"warning": row["warning"]}, wanted)


@pytest.mark.parametrize("stated", [stated for stated in SIX if "unit" in stated], ids=lambda stated: stated["name"])
def test_units_are_the_same_where_a_model_has_the_contact(stated, wanted, program, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    from test_fmu import Unit

    path = tmp_path / "contact.fmu"
    program("export", "fmu", ROOT / "assets" / f"{stated['unit']}.rom", "--out", path)
    fmpy.extract(path, unzipdir=path.with_suffix(""))
    unit = Unit(path)
    given = contact(stated).quantities()
    given["radius_ratio"] = given.pop("radius_y", given["radius"]) / given["radius"]
    unit.set(**{name: value for name, value in given.items() if name in unit.references})
    if not stated["trained"]:
        with pytest.raises(fmpy.fmi1.FMICallException):
            unit.start()
        assert unit.said[-1] in wanted["warning"], unit.said
        unit.end()
        return
    unit.start()
    unit.step()
    film, friction = unit.get("h_c_m", "traction")
    np.testing.assert_allclose([film, friction], [wanted["h_c_m"], wanted["traction"]], rtol=1e-12)
    trained, full = unit.truths()
    assert (bool(trained), bool(full)) == (True, False)
    unit.end()
