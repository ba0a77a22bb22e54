"""Model files, read with only numpy and pcodec."""

import importlib.util

import numpy as np
import pytest
from conftest import ROOT

pytest.importorskip("pcodec", reason="pcodec is not installed: pip install pcodec")
MODELS = sorted((ROOT / "assets").glob("*.rom"))


@pytest.fixture(scope="module")
def reader():
    path = ROOT / "bindings" / "python" / "examples" / "read_model.py"
    spec = importlib.util.spec_from_file_location("read_model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_every_array_decodes_and_modes_are_those_of_the_program(reader, path, program, tmp_path):
    directory, array = reader.open_model(path)
    for name, entry in directory["arrays"].items():
        if "factors" not in name or name.startswith("windows/1/"):
            assert list(array(name).shape) == entry["shape"]
    program("info", path, "--arrays", tmp_path / "own.npz")
    windows = directory["model"]["windows"]
    with np.load(tmp_path / "own.npz") as own:
        for k in {0, len(windows) - 1}:
            steady = directory["kind"] == "steady"
            name = f"window_{k + 1}_pressure_modes" if steady else f"local_{k}_pressure_modes" if k else "pressure_modes"
            np.testing.assert_allclose(reader.pressure_modes(directory, array, k), own[name], rtol=0, atol=1e-12)
            np.testing.assert_array_equal(array(f"windows/{k}/singular_values"), own[name.replace("modes", "singular_values")])


def test_there_are_fifteen_models_and_other_files_are_refused(reader, tmp_path):
    assert len(MODELS) == 15
    (tmp_path / "other.rom").write_bytes(bytes(100))
    with pytest.raises(ValueError, match="no model file"):
        reader.open_model(tmp_path / "other.rom")
