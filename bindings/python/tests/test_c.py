"""Library for C: its header is up to date, and the example compiles, runs, and prints the expected output."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT

PACKAGE = ROOT / "bindings" / "c"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()


def test_the_header_is_that_of_the_library():
    command = ["cargo", "run", "-q", "--manifest-path", PACKAGE / "header" / "Cargo.toml", "--target-dir", TARGET]
    done = subprocess.run([*command, "--", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(shutil.which("cc") is None or sys.platform == "win32", reason="no compiler of C")
def test_the_example_is_compiled_and_solves_a_contact(tmp_path):
    library = TARGET / "release" / ("libehl_contact.dylib" if sys.platform == "darwin" else "libehl_contact.so")
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-I", PACKAGE / "include", PACKAGE / "examples" / "contact.c"]
    compiled = subprocess.run(
        [*command, library, "-lm", f"-Wl,-rpath,{library.parent}", "-o", tmp_path / "contact"], capture_output=True, text=True
    )
    assert compiled.returncode == 0, compiled.stderr
    run = subprocess.run([tmp_path / "contact", ROOT / "assets" / "line.rom"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert run.stdout.count("central film") == 5 and "refused: " in run.stdout and "load" in run.stdout.splitlines()[-1]
    missing = subprocess.run([tmp_path / "contact", "no/such.rom"], capture_output=True, text=True)
    assert missing.returncode == 2 and "no/such.rom" in missing.stderr
