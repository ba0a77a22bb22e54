"""The tutorial runs, and everything public is documented."""

import pathlib
import subprocess
import sys

import pytest

import ehl_explorer as ehl

HERE = pathlib.Path(__file__).resolve().parents[1]


def test_the_tutorial_runs(tmp_path):
    done = subprocess.run(
        [sys.executable, HERE / "tutorial.py"],
        cwd=tmp_path,
        env={"MPLBACKEND": "agg", "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", [name for name in ehl.__all__ if not name.startswith("__")])
def test_everything_is_documented_and_has_a_type(name):
    assert getattr(ehl, name).__doc__
    stub = (pathlib.Path(ehl.__file__).parent / "__init__.pyi").read_text()
    assert f"def {name}(" in stub or f"class {name}" in stub


def test_the_stub_knows_every_method():
    stub = (pathlib.Path(ehl.__file__).parent / "__init__.pyi").read_text()
    for owner in [ehl.Contact, ehl.Model, ehl.Result]:
        for name in dir(owner):
            if not name.startswith("_"):
                assert f"def {name}(" in stub, f"{owner.__name__}.{name}"
                assert getattr(owner, name).__doc__, f"{owner.__name__}.{name}"
