"""Six contacts by Python, campaigns, marches and units: numbers, trained range and warnings as on the command line."""

import json
import warnings

import numpy as np
import pytest

import ehl_explorer as ehl
from conftest import ROOT
from test_command_line import options, table, without_clock

SIX = json.loads((ROOT / "tests" / "data" / "six_contacts.json").read_text())
NAMES = ["H_c", "H_min", "traction", "reduced.trained", "reduced.h_c_error_bound", "hertz.p_h_pa"]


@pytest.fixture(params=SIX, ids=[stated["name"] for stated in SIX])
def stated(request):
    return request.param


def words(stated):
    return {name.replace("-", "_"): value for name, value in stated["options"].items()}


def contact(stated):
    return ehl.Contact(**words(stated))


def solved(given, solve_json):
    plain = {name: ",".join(map(repr, value)) if isinstance(value, list) else value for name, value in given.items()}
    return without_clock(solve_json(*options(plain), "--method", "reduced"))


@pytest.fixture
def wanted(stated, solve_json):
    return solved(words(stated), solve_json)


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
    assert point.warnings == [f"reduced: {warning['text']}" for warning in wanted.get("warnings", [])]
    given = stated["options"]
    lines = f"{';'.join(given)}\n{';'.join(map(cell, given.values()))}\n"
    cases = ehl.run(f'Scene(version: 1, title: "six", study: LoadCases(cases: Text({json.dumps(lines)}), {methods}))')
    (row,) = cases.tables["load_cases"]
    same_row(by_reduced(row), wanted)
    kinds = [warning["kind"] for warning in wanted.get("warnings", [])]
    assert [warning["kind"] for warning in cases.object.get("warnings", [])] == kinds


def by_reduced(row):
    """Returns the row of a contact by one method, with the names of `solve`."""
    numbers = {name: row[name if name == "hertz.p_h_pa" else f"reduced.{name}"] for name in NAMES}
    return numbers | {"warning": row["warning"]}


def test_campaigns_are_the_same(solve_json, program, tmp_path):
    titles = list(dict.fromkeys(title for stated in SIX for title in stated["options"]))
    lines = [[cell(stated["options"].get(title, "")) for title in titles] for stated in SIX]
    (tmp_path / "six.csv").write_text("".join(";".join(line) + "\n" for line in [titles, *lines]))
    study = 'LoadCases(cases: File("six.csv"), methods: [Reduced(model: Embedded)])'
    (tmp_path / "scene.ron").write_text(f'Scene(version: 1, title: "six", study: {study})')
    (tmp_path / "campaign.ron").write_text('(version: 1, scene: "scene.ron", shard: Pieces(2))')
    program("campaign", "plan", tmp_path / "campaign.ron", "--out", tmp_path / "out")
    program("campaign", "run", tmp_path / "out", "--on", "local", "--workers", "1")
    result = tmp_path / "out" / "result"
    columns = table((result / "scene.load_cases.csv").read_text())
    kinds = set()
    for k, stated in enumerate(SIX):
        wanted = solved(words(stated), solve_json)
        same_row(by_reduced({name: column[k] for name, column in columns.items()}), wanted)
        assert bool(columns["reduced.reduced.trained"][k]) == stated["trained"]
        kinds |= {warning["kind"] for warning in wanted.get("warnings", [])}
    outcome = json.loads((result / "scene.json").read_text())
    assert {warning["kind"] for warning in outcome["warnings"]} == kinds


# Same grid in every interface, fine enough for the contact outside the trained range.
GRID = dict(grid="graded")
GRID_OF_SCENES = "grid: Graded"


def march_scene(stated, more=""):
    study = f"Transient(duration: 0.5, time_step: Fixed(0.1){more})"
    return f'Scene(version: 1, title: "six", {stated["scene"]}, {GRID_OF_SCENES}, study: {study})'


def marched(contact):
    """Returns the rows of a march at constant load, and its warnings, preceded by the reason if it stopped."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            rows, stopped = ehl.transient(contact, duration=0.5, step=0.1), []
        except ehl.MarchStopped as error:
            rows, stopped = error.reached, [str(error)]
            assert error.warning["kind"] == "march_stopped" and error.warning["text"] == str(error)
    return rows, stopped + [str(warning.message) for warning in said]


def by_scene(outcome, name):
    """Returns the same for a named march of a scene."""
    said = [warning["text"] for warning in outcome.object.get("warnings", []) if warning.get("part") == name]
    assert all(text.startswith(f"{name}: ") for text in said)
    return outcome.tables[f"transient_{name.replace('.', '_')}"], [text[len(name) + 2 :] for text in said]


def same_march(one, other):
    for name in one[0].dtype.names:
        np.testing.assert_array_equal(one[0][name], other[0][name], err_msg=name)
    assert one[1] == other[1]


IN_TIME = [stated for stated in SIX if "not in time" not in stated]


@pytest.mark.parametrize("stated", IN_TIME, ids=lambda stated: stated["name"])
def test_marches_are_the_same_and_stay_at_the_steady_contact(stated, program, tmp_path):
    own = contact(stated).replace(**GRID)
    march = marched(own)
    steady = ehl.solve(own, method="full")
    # Steps are solved to 1e-6 with quadratic convergence, and the steady contact to 1e-10.
    bar = max(1e-8, float(march[0]["step_error"][0]))
    for name in ["H_c", "H_min", "P_c", "P_max"]:
        assert abs(march[0][name][-1] / steady[name] - 1) < bar, name
    # The warning about the grid is shorter for a march; all others are the same.
    grid = "H_c is off by about"
    assert [text for text in march[1] if grid not in text] == [text for text in steady.warnings if grid not in text]
    assert any(grid in text for text in march[1]) == any(grid in text for text in steady.warnings)

    scene = march_scene(stated)
    outcome = ehl.run(scene)
    same_march(by_scene(outcome, "fixed"), march)
    (tmp_path / "march.ron").write_text(scene)
    told = json.loads(program("run", tmp_path / "march.ron", "--json"))
    assert told.get("warnings") == outcome.object.get("warnings")
    clock = ("_s", "_s_median", "_s_p99")
    kept = [[value for value in by["values"] if not value["name"].endswith(clock)] for by in (told, outcome.object)]
    assert kept[0] == kept[1]


@pytest.mark.parametrize("stated", IN_TIME, ids=lambda stated: stated["name"])
def test_marches_by_the_model_are_the_same(stated, program, tmp_path):
    by_model = contact(stated).replace(method="reduced")
    scene = march_scene(stated, ", reduced: (model: Embedded)")
    if stated["name"] == "starved":
        why = "transient models cover cavitation by the penalty and by complementarity, not mass-conserving cavitation"
        refused_alike(lambda: marched(by_model), "cavitation=", scene, "`cavitation`", why, program, tmp_path)
        return
    outcome = ehl.run(scene)
    march = marched(by_model)
    same_march(by_scene(outcome, "fixed.rnsa"), march)
    assert bool(outcome.value("fixed.rnsa.trained")) == stated["trained"]
    outside = [text for text in march[1] if "lies outside the trained range" in text]
    assert bool(outside) != stated["trained"], march[1]


def refused_alike(call, keyword, scene, field, why, program, tmp_path):
    """Python, scenes and the command line refuse with the same reason, each with its own names of fields."""
    (tmp_path / "march.ron").write_text(scene)
    for call, word in [
        (call, keyword),
        (lambda: ehl.run(scene), field),
        (lambda: pytest.fail(program("run", tmp_path / "march.ron", code=2)), field),
    ]:
        with pytest.raises((ehl.EhlError, pytest.fail.Exception)) as refused:
            call()
        sentence = str(refused.value)
        assert why in sentence and f"{word} must be " in sentence, sentence


@pytest.mark.parametrize("stated", [s for s in SIX if "not in time" in s], ids=lambda stated: stated["name"])
@pytest.mark.parametrize("method", ["full", "reduced"])
def test_contacts_that_cannot_be_marched_are_refused_alike(stated, method, program, tmp_path):
    reason = stated["not in time"]
    own = contact(stated).replace(method=method)
    scene = march_scene(stated, ", reduced: (model: Embedded)" if method == "reduced" else "")
    if method in reason.get("marched by", []):
        same_march(by_scene(ehl.run(scene), "fixed"), marched(own.replace(**GRID)))
        return
    refused_alike(lambda: marched(own), reason["keyword"], scene, reason["field"], reason["why"], program, tmp_path)


@pytest.mark.parametrize("stated", [stated for stated in SIX if "unit" in stated], ids=lambda stated: stated["name"])
def test_units_are_the_same_where_a_model_has_the_contact(stated, solve_json, program, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    from fmu_unit import Unit

    # Quantities without a variable have the values of the training.
    lacking = [name.replace("-", "_") for name in stated.get("unit lacks", [])]
    given = {name: value for name, value in words(stated).items() if name not in lacking}
    wanted = solved(given, solve_json)
    path = tmp_path / "contact.fmu"
    program("export", "fmu", ROOT / "assets" / f"{stated['unit']}.rom", "--out", path)
    fmpy.extract(path, unzipdir=path.with_suffix(""))
    unit = Unit(path)
    given = ehl.Contact(**given).quantities()
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
    said = wanted.get("warning")
    assert unit.said == ([f"at time 0: {said}"] if said else [])
    unit.end()


def test_units_have_no_variable_of_a_supplied_film(program, tmp_path):
    """Units do not support starved contacts: their inlet is fully flooded. A contact outside the trained range is
    discarded with the quantity and the range."""
    fmpy = pytest.importorskip("fmpy")
    from fmu_unit import Unit

    path = tmp_path / "contact.fmu"
    program("export", "fmu", ROOT / "assets" / "line_shear.rom", "--out", path)
    fmpy.extract(path, unzipdir=path.with_suffix(""))
    unit = Unit(path)
    assert not any("supply" in name or "film" in name for name in unit.references)
    given = ehl.Contact(moes_m=40, moes_l=10, srr=0.6).quantities()
    unit.set(**{name: value for name, value in given.items() if name in unit.references})
    with pytest.raises(fmpy.fmi1.FMICallException):
        unit.start()
    assert "lies outside the trained range" in unit.said[-1], unit.said
    unit.end()
