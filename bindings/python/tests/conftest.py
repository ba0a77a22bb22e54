"""Fixtures of the tests: the command-line program, and small scenes."""

import json
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def program():
    """Runs the program with some arguments, and returns its output, or its standard error if it fails."""
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    binary = pathlib.Path(os.environ.get("EHL_EXPLORER", target / "release" / "ehl-explorer"))
    if not binary.exists():
        pytest.fail(f"{binary} is missing; build it with `cargo build --release`")

    def run(*arguments, code=0, stream=None):
        done = subprocess.run([binary, *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return getattr(done, stream or ("stderr" if code else "stdout"))

    return run


@pytest.fixture(scope="session")
def solve_json(program):
    return lambda *arguments: json.loads(program("solve", *arguments, "--json"))


@pytest.fixture(scope="session")
def units(program, tmp_path_factory):
    """Exports units by model, options and version of the standard, each as a file and an unpacked folder."""
    fmpy = pytest.importorskip("fmpy")
    folder = tmp_path_factory.mktemp("units")

    def unit(kind, *words, version="2"):
        path = folder / f"{kind}{''.join(words)}_{version}.fmu"
        if not path.exists():
            program("export", "fmu", ROOT / "assets" / f"{kind}.rom", "--out", path, "--fmi", version, *words)
            fmpy.extract(path, unzipdir=path.with_suffix(""))
        return path

    return unit


@pytest.fixture(scope="session")
def in_time_training():
    """Scene that trains a transient model quickly: a load that oscillates with two periods, on a coarse grid."""
    return """Scene(
        version: 1,
        title: "A load that breathes",
        at: Si(radius: 0.002, speed: 5.0, load: 2e5, modulus: 2.31e11, viscosity: 0.01, alpha: 1e-8),
        grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),
        study: Transient(
            inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)),
            duration: 1.0,
            time_step: Fixed(0.01),
            trainings: [
                (inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 1.0),
                (inputs: (load: Harmonic(amplitude: 0.1, period: 0.3333333333333333)), duration: 1.0),
            ],
            reduced: (loss: 1e-5),
        ),
    )"""


@pytest.fixture(scope="session")
def small_training():
    """Quick training: a narrow range on a coarse grid."""
    return """Scene(
        version: 1,
        title: "A narrow box",
        study: Training(
            title: "A narrow box",
            range: (
                axes: {M: (35.0, 45.0), L: (9.0, 11.0), Alpha: (14.0e-9, 15.5e-9)},
                limits: {HertzPressure: (0.0, 2e9)},
                fixed: {Viscosity: 0.01},
            ),
            lubricant: (viscosity: Roelands, density: DowsonHigginson),
            plan: FarthestPoint(snapshots: 12),
            windows: Given([(m: (35.0, 45.0), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)))]),
            pressure_loss: 1e-6,
            deformation_loss: 1e-6,
            sampling: QDeim,
            rows_per_mode: 2.0,
            seed: 1,
        ),
    )"""
