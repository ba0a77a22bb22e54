"""Campaigns of EHL Explorer on a Dask cluster.

    ehl-explorer campaign plan CAMPAIGN.ron --out DIR
    python -m ehl_explorer.campaign DIR --scheduler tcp://ADDRESS:8786

Every shard of the campaign becomes a task. It calls the program on a worker and sends the bytes of the finished shard
back, so that no shared disk is needed. The program must be the same file everywhere; a worker with another build reports
an error. Finished shards are written to the folder immediately, so that the same command continues an interrupted run.
Further rounds (full solutions for comparison, or those that an adaptive training selects) follow automatically.

Requires the package ``distributed``. This package need not be installed on the workers.
"""

import argparse
import asyncio
import json
import logging
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

__all__ = ["CampaignError", "run"]

#: Number of attempts per shard, not counting those whose worker was lost.
ATTEMPTS = 3
#: Time without a scheduler after which the run stops [s].
PATIENCE_S = 15.0


class CampaignError(RuntimeError):
    """Reason why a campaign stopped, in one sentence. Finished shards are kept."""


def _call(program, *arguments):
    """Returns the output of a command of the program; raises :class:`CampaignError` with its message."""
    command = [program, "campaign", *map(str, arguments)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CampaignError(f"cannot start {program}: {error.strerror}; name it with --program") from error
    if done.returncode >= 2 or done.returncode < 0:
        said = done.stderr.strip() or f"it ended with {done.returncode}"
        raise CampaignError(said.removeprefix("ehl-explorer: "))
    return done.stdout


def _replace(path, content):
    """Writes a file as a whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, beside = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise


def _shard(program, files, number):
    """Computes a shard on a worker, in a temporary folder, and returns the bytes of its file."""
    with tempfile.TemporaryDirectory(prefix="ehl-campaign-") as folder:
        for name, content in files.items():
            _replace(Path(folder) / name, content)
        (Path(folder) / "shards").mkdir()
        _call(program, "shard", folder, number)
        return (Path(folder) / "shards" / f"{number:06}.shard").read_bytes()


def _needed(folder):
    """Returns the files that a shard is computed from, by their names in the folder."""
    plain = [path for path in folder.iterdir() if path.is_file() and path.suffix in (".ron", ".rom", ".csv")]
    rounds = sorted((folder / "rounds").glob("*.ron"))
    return {str(path.relative_to(folder)): path.read_bytes() for path in plain + rounds}


def _status(program, folder):
    return json.loads(_call(program, "status", folder, "--json"))


def _compute(folder, client, program, worker_program, progress):
    """Computes the open shards of the current round."""
    status = _status(program, folder)
    total, there = status["shards"], status["done"]
    failures = dict.fromkeys(status["open"], 0)
    waiting, at_work = list(failures), {}
    last_heard = time.monotonic()
    while waiting or at_work:
        if client.status == "running":
            last_heard = time.monotonic()
            if waiting:
                at_work.update(_submit(client, worker_program, folder, waiting))
                waiting = []
        elif client.status == "closed" or time.monotonic() - last_heard > PATIENCE_S:
            raise CampaignError(
                f"lost the scheduler; {there} of {total} shards are in {folder}: repeat the command to continue"
            )
        ended = [future for future in at_work if future.done()]
        for future in ended:
            number = at_work.pop(future)
            if future.status == "finished":
                content = _content(future)
                if content is not None:
                    _keep(folder, number, content)
                    there += 1
                    progress(there, total)
                    continue
            elif future.status == "error":
                failures[number] += 1
                if failures[number] >= ATTEMPTS:
                    reason = future.exception()
                    raise CampaignError(f"shard {number} was given up after {ATTEMPTS} attempts: {reason}")
            # Neither finished nor failed: it was lost with its worker or scheduler. This is not counted as a failure.
            waiting.append(number)
        if not ended:
            time.sleep(0.05)


def _submit(client, program, folder, numbers):
    """Submits tasks for some shards, and returns the shard numbers by futures."""
    # The files are sent again with every attempt, because the workers that had them may be lost.
    files = client.scatter(_needed(folder), broadcast=True)
    return {client.submit(_shard, program, files, number, pure=False): number for number in numbers}


def _content(future):
    """Returns the bytes of a finished shard; ``None`` if they were lost."""
    from distributed import CancelledError

    try:
        return future.result(timeout=PATIENCE_S)
    except (CancelledError, OSError, asyncio.TimeoutError):
        return None


def _keep(folder, number, content):
    try:
        _replace(folder / "shards" / f"{number:06}.shard", content)
    except OSError as refused:
        raise CampaignError(f"cannot store shard {number} in {folder}: {refused.strerror}") from refused


def run(folder, client, program=None, worker_program=None, progress=lambda done, total: None):
    """Computes a planned campaign on a Dask cluster, and merges it.

    Parameters
    ----------
    folder : path
        Folder of the campaign, made by ``ehl-explorer campaign plan``.
    client : distributed.Client
        The cluster.
    program : str, optional
        ``ehl-explorer`` on this machine; by default that of the environment variable ``EHL_EXPLORER``, or on the path.
    worker_program : str, optional
        ``ehl-explorer`` on the workers; by default as on this machine.
    progress : callable, optional
        Called with ``(done, total)`` shards of the rounds so far.

    Returns
    -------
    dict
        The outcome, as in the folder ``result``.

    Raises
    ------
    CampaignError
        With a sentence. Finished shards stay in the folder.
    """
    import cloudpickle

    if __name__ != "__main__":
        # Workers do not need this package.
        cloudpickle.register_pickle_by_value(sys.modules[__name__])
    folder = Path(folder).resolve()
    program = program or os.environ.get("EHL_EXPLORER", "ehl-explorer")
    while True:
        _compute(folder, client, program, worker_program or program, progress)
        _call(program, "merge", folder)
        status = _status(program, folder)
        if status["merged"] and not status["open"]:
            break
    outcome = next((folder / "result").glob("*.json"))
    return json.loads(outcome.read_text(encoding="utf-8"))


def main(arguments=None):
    """Runs the command. Returns its exit code: 0 done, 1 an expectation was not met, 2 the campaign stopped."""
    parser = argparse.ArgumentParser(prog="python -m ehl_explorer.campaign", description=__doc__.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", help="folder of the campaign, made by `ehl-explorer campaign plan`")
    parser.add_argument("--scheduler", required=True, metavar="ADDRESS", help="the Dask scheduler, tcp://HOST:PORT")
    parser.add_argument("--program", help="ehl-explorer on this machine (default: EHL_EXPLORER, or on the path)")
    parser.add_argument("--worker-program", help="ehl-explorer on the workers (default: as on this machine)")
    options = parser.parse_args(arguments)
    try:
        from distributed import CancelledError, Client
    except ImportError:
        print("the package distributed is missing: pip install distributed", file=sys.stderr)
        return 2

    # Log messages of the cluster are hidden; errors are reported in one sentence below.
    for name in ("distributed", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)

    def progress(done, total):
        print(f"{done} of {total} shards are done", file=sys.stderr)

    try:
        with Client(options.scheduler, timeout=PATIENCE_S) as client:
            outcome = run(options.folder, client, options.program, options.worker_program, progress)
    except CampaignError as error:
        print(error, file=sys.stderr)
        return 2
    except (CancelledError, OSError, asyncio.TimeoutError) as error:
        print(f"the scheduler {options.scheduler} cannot be reached: {error}", file=sys.stderr)
        return 2
    return 0 if outcome["passed"] else 1


if __name__ == "__main__":
    sys.exit(main())
