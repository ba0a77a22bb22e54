"""Python and the command line use the same engine: their numbers are bitwise equal."""

import csv
import io

import numpy as np
import pytest

import ehl_explorer as ehl

SI = dict(radius=0.0225, speed=5.0365, load=646110.0, modulus=2.878e11, viscosity=0.004, alpha=2.2e-8)

CONTACTS = [
    (dict(moes_m=40, moes_l=10), "full"),
    (dict(moes_m=40, moes_l=10), "reduced"),
    (SI, "full"),
    (dict(moes_m=30, moes_l=8, grid="graded", srr=0.1), "full"),
    (dict(moes_m=200, moes_l=10, contact="point"), "reduced"),
    (dict(moes_m=100, moes_l=5, contact="point", radius_y=0.02), "reduced"),
    (dict(lubricant="squalane-pip", contact="line", radius=12.7e-3, speed=0.5, load=1e5, modulus=123.9e9, srr=0.3), "reduced"),
    (dict(moes_m=20, moes_l=5, cavitation="complementarity"), "full"),
    (dict(moes_m=20, moes_l=5, heat=True, srr=0.2), "full"),
    (dict(moes_m=1000, moes_l=30), "reduced"),
    (dict(moes_m=20, moes_l=5, e1=210e9, nu1=0.3, e2=310e9, nu2=0.27, shear="eyring", shear_stress=5e6, srr=-0.1), "full"),
]


def options(given):
    words = []
    for name, value in given.items():
        name = name.replace("_", "-")
        words.append(f"--{name}" if value is True else f"--{name}={value!r}" if not isinstance(value, str) else f"--{name}={value}")
    return words


def without_clock(values):
    return {name: value for name, value in values.items() if name != "wall_s"}


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return np.nan


TEXTS = ["status", "reason", "warning"]


def table(text):
    titles, *rows = csv.reader(io.StringIO(text))
    columns = dict(zip(titles, zip(*rows)))
    return {name: list(cells) if name in TEXTS else np.array([*map(number, cells)]) for name, cells in columns.items()}


def same_table(array, text):
    expected = table(text)
    assert list(array.dtype.names) == list(expected)
    for name, column in expected.items():
        if "wall_s" not in name:
            np.testing.assert_array_equal(array[name], column, err_msg=name)


@pytest.mark.parametrize("given, method", CONTACTS)
def test_solve(given, method, solve_json):
    result = ehl.solve(ehl.Contact(**given), method=method)
    assert without_clock(result.to_dict()) == without_clock(solve_json(*options(given), f"--method={method}"))


@pytest.mark.parametrize("given, method", [CONTACTS[0], CONTACTS[1], CONTACTS[4]])
def test_fields(given, method, program, tmp_path):
    program("solve", *options(given), f"--method={method}", "--profiles", tmp_path / "fields.csv")
    expected = table((tmp_path / "fields.csv").read_text())
    result = ehl.solve(ehl.Contact(**given), method=method)
    x, y = np.broadcast_arrays(result.x[:, None], result.y[None, :])
    for own, name in [(x, "X"), (y, "Y"), (result.pressure, "P"), (result.film, "H")]:
        np.testing.assert_array_equal(own.reshape(-1), expected[name], err_msg=name)


@pytest.mark.parametrize("method", ["full", "reduced"])
def test_sweep(method, program):
    varied = ["moes-m=10:160:5:log", "moes-l=5:15:3"]
    text = program("sweep", *varied, f"--method={method}", "--moes-m=1", "--moes-l=1")
    same_table(ehl.sweep(ehl.Contact.moes(1, 1), *varied, method=method), text)


def run(program, scene, folder):
    (folder / "scene.ron").write_text(scene)
    program("run", folder / "scene.ron", "--out", folder / "out")
    return {path.name.split(".")[1]: path.read_text() for path in (folder / "out").glob("*.csv")}


@pytest.mark.parametrize("contact, compare", [("Line", 3), ("Point", 0)])
def test_random_test(contact, compare, program, tmp_path):
    scene = f"""Scene(version: 1, title: "t", contact: {contact}, grid: Usual, study: RandomTest(
        range: (axes: {{M: (20.0, 100.0), L: (5.0, 15.0)}}, limits: {{HertzPressure: (0.0, 2e9)}}),
        tests: 40, seed: 7, method: Reduced(model: Embedded), compare: {compare}))"""
    tables = run(program, scene, tmp_path)
    tested = ehl.random_test(
        (20, 100), (5, 15), tests=40, seed=7, max_hertz_pressure=2e9, contact=contact.lower(), compare=compare
    )
    same_table(tested, tables["random"])


def test_transient(program, tmp_path):
    times, loads = [0.0, 0.25, 0.5, 0.75, 1.0], [1.0, 1.1, 1.0, 0.9, 1.0]
    scene = f"""Scene(version: 1, title: "t", at: Si(radius: 0.0225, speed: 5.0365, load: 646110.0, modulus: 2.878e11,
        viscosity: 0.004, alpha: 2.2e-8), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(
        inputs: (load: Sampled(times: {times}, values: {loads})), duration: 1.0, time_step: Fixed(0.05)))"""
    contact = ehl.Contact(**SI, dx=0.02)
    march = ehl.transient(contact, duration=1, step=0.05, load=(times, loads))
    tables = run(program, scene, tmp_path)
    same_table(march, tables["transient_fixed"])
    outcome = ehl.run(tmp_path / "scene.ron")
    same_table(outcome.tables["transient_fixed"], tables["transient_fixed"])


def test_scenes(program, tmp_path):
    from conftest import ROOT

    path = ROOT / "scenes" / "line" / "first_look.ron"
    outcome = ehl.run(path)
    assert outcome.passed and outcome.expectations
    assert outcome.value("H_c_error") < 1e-3
    short = path.read_text().replace("AtMost(1e-3)", "AtMost(1e-30)")
    assert not ehl.run(short).passed


def test_engineering_inputs_are_those_of_a_table_of_load_cases(program, tmp_path):
    (tmp_path / "cases.csv").write_text(
        "contact;radius;speed;load;modulus;oil;temperature;srr\n"
        "line;12 mm;3 m/s;300 N/mm;231 GPa;ISO VG 68;60 °C;5 %\n"
        "point;10 mm;2 m/s;20 N;231 GPa;ISO VG 32;40 °C;0\n",
        encoding="utf-8",
    )
    expected = table(program("cases", tmp_path / "cases.csv", "--method=reduced"))
    for k, given in enumerate(
        [
            dict(contact="line", radius="12 mm", speed="3 m/s", load="300 N/mm", srr="5 %", oil="ISO VG 68", temperature="60 °C"),
            dict(contact="point", radius="10 mm", speed=2.0, load=20, srr=0, oil="ISO VG 32", temperature=40),
        ]
    ):
        result = ehl.solve(ehl.Contact.engineering(modulus="231 GPa", **given), method="reduced")
        for name in ["H_c", "H_min", "h_c_m", "traction"]:
            (column,) = [column for title, column in expected.items() if title.endswith(f".{name}")]
            assert result[name] == column[k], name


def test_bodies_heat_shear_inlet_film_and_grid_are_the_same_in_tables_keywords_and_flags(program, solve_json, tmp_path):
    shared = dict(contact="line", radius="10 mm", speed="2 m/s", load="300 N/mm", viscosity="20 mPa·s", alpha="18 1/GPa")
    bodies = dict(e1="210 GPa", nu1="0.3", e2="310 GPa", nu2="0.27")
    warm = dict(heat="yes", srr="30 %", inlet_temperature="60 °C", body2="glass", shear="eyring", shear_stress="6 MPa")
    starved = dict(cavitation="mass-conserving", supply_film="0.2 µm", dx="0.01")
    si = {"--radius": 0.01, "--speed": 2, "--load": 3e5, "--viscosity": 0.02, "--alpha": 1.8e-8}
    si |= {"--e1": 210e9, "--nu1": 0.3, "--e2": 310e9, "--nu2": 0.27}
    for own, flags in [
        (
            warm | dict(grid="graded", domain="-10,2"),
            ["--heat", "--srr=0.3", "--inlet-temperature=333.15", "--body2=glass", "--shear=eyring", "--shear-stress=6e6"]
            + ["--grid=graded", "--domain=-10,2"],
        ),
        (starved, ["--cavitation=mass-conserving", "--supply-film=2e-7", "--dx=0.01"]),
    ]:
        given = shared | bodies | own
        titles, cells = ";".join(given).replace("_", "-"), ";".join(given.values())
        (tmp_path / "cases.csv").write_text(f"{titles}\n{cells}\n", encoding="utf-8")
        expected = table(program("cases", tmp_path / "cases.csv"))
        solved = solve_json(*(f"{flag}={value!r}" for flag, value in si.items()), *flags)
        for contact in [ehl.Contact.engineering(**given), ehl.Contact(**given)]:
            result = ehl.solve(contact)
            assert without_clock(result.to_dict()) == without_clock(solved)
            for name in ["H_c", "H_min", "h_c_m", "traction"]:
                (column,) = [column for title, column in expected.items() if title.endswith(f".{name}")]
                assert result[name] == column[0], name


FZG = (
    "Gear(teeth: (16, 24), module_m: 0.0045, shifts: (0.1817, 0.1715), face_width_m: 0.014, pinion_rpm: 1500, "
    "torque_n_m: 200)"
)


def test_a_machine_states_the_contact_as_the_flag_does(solve_json):
    steel = dict(e1=206e9, nu1=0.3, e2=206e9, nu2=0.3, viscosity=0.02, alpha=2e-8, dx=0.02)
    gear = ehl.solve(ehl.Contact(machine=FZG, **steel))
    # Published for the FZG type C gear at the pitch point.
    assert abs(gear["hertz.p_h_pa"] / 1347.3e6 - 1) < 2e-4
    assert abs(gear["hertz.a_m"] / 199.57e-6 - 1) < 2e-4
    flags = solve_json(f"--machine={FZG}", *(f"--{name}={value!r}" for name, value in steel.items()))
    assert without_clock(gear.to_dict()) == without_clock(flags)
    with pytest.raises(ehl.EhlError, match="machine= determines radius="):
        ehl.solve(ehl.Contact(machine=FZG, radius=0.01, **steel))
