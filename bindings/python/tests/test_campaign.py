"""A campaign on a Dask cluster of two workers, one of which is killed in the middle."""

import filecmp
import os
import pathlib
import signal
import subprocess
import threading
import time

import pytest

distributed = pytest.importorskip("distributed")
campaign = pytest.importorskip("ehl_explorer.campaign")

ROOT = pathlib.Path(__file__).resolve().parents[3]
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
PROGRAM = os.environ.get("EHL_EXPLORER", str(TARGET / "release" / "ehl-explorer"))

BALLS = """Scene(version: 1, title: "balls", contact: Point,
    grid: Plane(dx: 0.04, dy: 0.1, domain: (-3.0, 1.5, -1.5)),
    study: RandomTest(range: (
        axes: {
            Radius: (10e-3, 12e-3, Linear), Speed: (1.0, 3.0, Linear), Load: (20.0, 60.0, Linear),
            Alpha: (8e-9, 11e-9, Linear),
        },
        fixed: {Modulus: 231e9, Viscosity: 0.01},
    ), tests: 80, seed: 3, method: Full))"""

# Five full solutions in three shards, then one round for each solution that the search adds.
ADAPTIVE = """Scene(version: 1, title: "adaptive", study: Training(title: "t",
    range: (
        axes: {
            Radius: (3e-3, 4e-3, Linear), Speed: (2.0, 4.0, Linear), Load: (2e5, 4e5, Linear),
            Alpha: (8e-9, 12e-9, Linear),
        },
        fixed: {Modulus: 231e9, Viscosity: 0.01},
    ), plan: Adaptive(start: 5, indicator: Correction, tolerances: [1e-7], successes: 16,
    local_sigma: 0.2, local_successes: 0, vicinity: 2, limit: 9),
    windows: Given([(m: (1.0, 500.0), grid: Graded(nodes: 240, domain: (-6.0, 1.9), registered: true))]),
    pressure_loss: 1e-6, deformation_loss: 1e-6, rows_per_mode: 2.0, evidence: 0, seed: 5))"""


def planned(folder, name, scene, pieces):
    (folder / "scene.ron").write_text(scene)
    (folder / "campaign.ron").write_text(f'(version: 1, scene: "scene.ron", shard: Pieces({pieces}))')
    command = [PROGRAM, "campaign", "plan", folder / "campaign.ron", "--out", folder / name]
    subprocess.run(command, check=True, capture_output=True)
    return folder / name


def one_machine(folder):
    subprocess.run(
        [PROGRAM, "campaign", "run", folder, "--on", "local", "--workers", "1"], check=True, capture_output=True
    )


def with_a_worker_lost(folder, after):
    """Computes a campaign on two workers, one of which is killed after this number of shards."""
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        workers = list(client.run(os.getpid).values())
        seen = []

        def kill():
            while len(seen) < after:
                time.sleep(0.01)
            os.kill(workers[0], signal.SIGKILL)

        killer = threading.Thread(target=kill, daemon=True)
        killer.start()
        outcome = campaign.run(folder, client, PROGRAM, progress=lambda done, total: seen.append(total))
        killer.join(timeout=60)
        assert not killer.is_alive() and workers[0] not in client.run(os.getpid).values(), "no worker was lost"
    return outcome, seen


def assert_same_result(one, other):
    names = sorted(path.name for path in (one / "result").iterdir())
    assert names == sorted(path.name for path in (other / "result").iterdir())
    assert filecmp.cmpfiles(one / "result", other / "result", names, shallow=False)[0] == names


def test_a_lost_worker_changes_no_byte_and_a_gap_is_a_sentence(tmp_path):
    one, many = (planned(tmp_path, name, BALLS, 5) for name in ("one", "many"))
    one_machine(one)
    with pytest.raises(campaign.CampaignError, match="16 of 16 shards are missing"):
        campaign._call(PROGRAM, "merge", many)
    with pytest.raises(campaign.CampaignError, match="cannot start no-such-program"):
        campaign._call("no-such-program", "merge", many)
    outcome, _ = with_a_worker_lost(many, 2)
    assert outcome["title"] == "balls" and outcome["wall_s"] is None
    assert_same_result(one, many)


def test_an_adaptive_training_that_loses_a_worker_gives_the_model_of_one_machine(tmp_path):
    one, many = planned(tmp_path, "one", ADAPTIVE, 1), planned(tmp_path, "many", ADAPTIVE, 2)
    one_machine(one)
    # The worker is lost after the first round, which has three shards, and before the last round.
    outcome, seen = with_a_worker_lost(many, 4)
    assert outcome["title"] == "adaptive" and seen[-1] > 4, f"{seen}"
    assert_same_result(one, many)
    subprocess.run([PROGRAM, "train", tmp_path / "scene.ron", "--out", tmp_path / "plain.rom"], check=True)
    assert (many / "result" / "scene.rom").read_bytes() == (tmp_path / "plain.rom").read_bytes()
