"""Exported arrays of a model, compared with the singular value decomposition of its snapshots by numpy."""

import numpy as np
import pytest

import ehl_explorer as ehl
from conftest import ROOT

LOSS = 1e-6  # Loss of information of both bases in the scene `small_training`.


@pytest.fixture(scope="module")
def model(small_training):
    return ehl.Model.train(small_training)


@pytest.fixture(scope="module")
def arrays(model):
    return {name.removeprefix("window_1_"): values for name, values in (model.arrays() | model.snapshots(iterates=True)).items()}


KINDS = [("pressure", "weights"), ("deformation", "deformation_weights")]


@pytest.mark.parametrize("kind, weights", KINDS)
def test_a_basis_is_the_singular_value_decomposition_of_the_snapshots(kind, weights, arrays):
    fields, weights, modes = arrays[f"snapshot_{kind}s"], arrays[weights], arrays[f"{kind}_modes"]
    assert fields.shape == (len(weights), len(arrays["snapshots"])) and modes.shape[0] == len(weights)
    left, values, _ = np.linalg.svd(np.sqrt(weights)[:, None] * fields, full_matrices=False)
    known = arrays[f"{kind}_singular_values"]
    np.testing.assert_allclose(known, values, rtol=1e-6, atol=1e-12 * values[0])

    lost = 1 - np.cumsum(values) / values.sum()
    assert modes.shape[1] == np.argmax(lost <= LOSS) + 1, "as many modes as the loss of information asks for"
    np.testing.assert_allclose(modes.T @ (weights[:, None] * modes), np.eye(modes.shape[1]), atol=1e-9)

    # Same space: each mode equals its singular vector up to the sign.
    shared = np.abs(np.sum(np.sqrt(weights)[:, None] * modes * left[:, : modes.shape[1]], axis=0))
    np.testing.assert_allclose(shared, 1, atol=1e-6)
    missed = fields - modes @ (modes.T @ (weights[:, None] * fields))
    error = np.sqrt(np.sum(weights[:, None] * missed**2))
    np.testing.assert_allclose(error, np.sqrt(np.sum(values[modes.shape[1] :] ** 2)), rtol=1e-5)


def test_snapshots_are_the_full_solutions_of_their_contacts(model, arrays):
    names = ["moes_m", "moes_l", "radius", "speed", "load", "modulus", "viscosity", "alpha"]
    row = dict(zip(names, arrays["snapshots"][3]))
    contact = ehl.Contact(**{name: row[name] for name in names[2:]}, dx=0.02)
    solved = ehl.solve(contact)
    # The first node of a line contact lies outside the inlet.
    np.testing.assert_allclose(arrays["xi"][1:], solved.x, atol=1e-12)
    assert arrays["xi"][0] < solved.x[0] and not arrays["snapshot_pressures"][0].any()
    np.testing.assert_allclose(arrays["snapshot_pressures"][1:, 3], solved.pressure, atol=1e-9)
    np.testing.assert_allclose(arrays["snapshot_films"][1:, 3], solved.film, atol=1e-9)
    np.testing.assert_allclose(arrays["snapshots"][3][-1], solved.H_c, rtol=1e-4)
    gap = arrays["snapshot_films"] - arrays["snapshot_deformations"] - arrays["xi"][:, None] ** 2 / 2
    np.testing.assert_allclose(gap, gap[:1].repeat(len(gap), axis=0), atol=1e-9, err_msg="H = H_0 + X²/2 + K P")


def test_iterates_lead_to_the_snapshots(arrays):
    iterates, contacts = arrays["iterate_pressures"], arrays["iterate_snapshots"]
    assert iterates.shape == (len(arrays["xi"]), len(contacts)) and np.all(np.diff(contacts) >= 0)
    for k, pressure in enumerate(arrays["snapshot_pressures"].T):
        own = iterates[:, contacts == k]
        assert own.shape[1] >= 3
        np.testing.assert_array_equal(own[:, -1], pressure)
        distances = np.linalg.norm(own - pressure[:, None], axis=0)
        assert distances[-2] < 1e-3 * distances[0]


def test_the_command_line_writes_the_same_arrays(model, program, tmp_path):
    model.save(tmp_path / "own.rom")
    program("info", tmp_path / "own.rom", "--arrays", tmp_path / "own.npz", "--snapshots", "--iterates")
    read = ehl.Model.load(tmp_path / "own.rom")
    own = read.arrays() | read.snapshots(iterates=True)
    with np.load(tmp_path / "own.npz") as written:
        assert sorted(written) == sorted(own)
        for name in written:
            np.testing.assert_array_equal(written[name], own[name], err_msg=name)
    assert "--arrays" in program("info", tmp_path / "own.rom", "--snapshots", code=2)
    transient = ROOT / "assets" / "line_in_time.rom"
    told = program("info", transient, "--arrays", tmp_path / "transient.npz", "--snapshots", code=2)
    assert "a transient model was trained from the steps of marches" in told and not (tmp_path / "transient.npz").exists()


def test_snapshots_of_a_model_of_the_program_have_its_singular_values():
    model = ehl.Model.embedded("line")
    arrays = model.arrays() | model.snapshots(1)
    fields, weights = arrays["window_1_snapshot_pressures"], arrays["window_1_weights"]
    values = np.linalg.svd(np.sqrt(weights)[:, None] * fields, compute_uv=False)
    known = arrays["window_1_pressure_singular_values"]
    assert len(known) == len(values) == len(arrays["window_1_snapshots"])
    np.testing.assert_allclose(known[:20], values[:20], rtol=3e-6)


def test_what_a_model_does_not_have_is_refused(model):
    for window in [0, 2]:
        with pytest.raises(ehl.EhlError, match=f"no window {window}; accepted are 1 to 1"):
            model.snapshots(window)


@pytest.mark.parametrize("contact, digits", [("line", 1e-6), ("point", 1e-2)])
def test_models_of_the_program_are_orthonormal_under_the_exported_weights(contact, digits):
    """Up to the digits that a file stores of modes with small singular values."""
    arrays = ehl.Model.embedded(contact).arrays()
    windows = sorted(name.removesuffix("_xi") for name in arrays if name.endswith("_xi"))
    for window in [windows[0], windows[-1]]:
        for kind, weights in KINDS:
            modes, weights = arrays[f"{window}_{kind}_modes"], arrays[f"{window}_{weights}"]
            np.testing.assert_allclose(modes.T @ (weights[:, None] * modes), np.eye(modes.shape[1]), atol=digits)
