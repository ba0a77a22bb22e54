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

SCENE = """Scene(version: 1, title: "balls", contact: Point,
    grid: Plane(dx: 0.04, dy: 0.1, domain: (-3.0, 1.5, -1.5)),
    study: RandomTest(range: Box(radius: (10e-3, 12e-3), speed: (1.0, 3.0), load: (20.0, 60.0), alpha: (8e-9, 11e-9),
    modulus: 231e9, viscosity: 0.01), tests: 80, seed: 3, method: Full))"""


def planned(folder, name):
    (folder / "balls.ron").write_text(SCENE)
    (folder / "campaign.ron").write_text('(version: 1, scene: "balls.ron", shard: Pieces(5))')
    command = [PROGRAM, "campaign", "plan", folder / "campaign.ron", "--out", folder / name]
    subprocess.run(command, check=True, capture_output=True)
    return folder / name


def test_a_lost_worker_changes_no_byte_and_a_gap_is_a_sentence(tmp_path):
    one, many = planned(tmp_path, "one"), planned(tmp_path, "many")
    subprocess.run([PROGRAM, "campaign", "run", one, "--on", "local", "--workers", "1"], check=True, capture_output=True)
    with pytest.raises(campaign.CampaignError, match="16 of 16 shards are missing"):
        campaign._call(PROGRAM, "merge", many)
    with pytest.raises(campaign.CampaignError, match="cannot start no-such-program"):
        campaign._call("no-such-program", "merge", many)
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        seen = []

        def kill():
            while len(seen) < 2:
                time.sleep(0.01)
            os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)

        killer = threading.Thread(target=kill, daemon=True)
        killer.start()
        outcome = campaign.run(many, client, PROGRAM, progress=lambda done, total: seen.append(done))
        killer.join()
    assert outcome["title"] == "balls" and outcome["wall_s"] is None
    names = sorted(path.name for path in (one / "result").iterdir())
    assert filecmp.cmpfiles(one / "result", many / "result", names, shallow=False)[0] == names
