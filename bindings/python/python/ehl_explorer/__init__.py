"""Elastohydrodynamic contacts: full solutions, reduced models, scenes.

>>> import ehl_explorer as ehl
>>> contact = ehl.Contact.moes(40, 10)
>>> result = ehl.solve(contact, method="reduced")
>>> result.h_c_m, result.pressure.max()

Numbers are in SI units; texts may have a unit. X, P and H are dimensionless as in the dissertation (X = x/a, P = p/p_H,
H = h R/a**2). An invalid request raises :class:`EhlError` with one sentence. If a step of a march fails,
:class:`MarchStopped` is raised with the rows computed so far. Long computations run without Python's global lock, call
``progress(stage, done, total)``, and are stopped by Ctrl-C. Contacts, models and results can be pickled and compared:
``pool.map(ehl.solve, contacts)`` works with forked and spawned processes.
"""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Optional, Union

import numpy as np

from . import _native
from ._native import Contact, EhlError, MarchStopped, Model, Result, __version__, random_test, solve, transient

__all__ = [
    "Contact",
    "EhlError",
    "MarchStopped",
    "Model",
    "Outcome",
    "Result",
    "__version__",
    "random_test",
    "run",
    "solve",
    "solve_many",
    "sweep",
    "transient",
]

if hasattr(os, "register_at_fork"):
    # A forked process has no other threads. None of them must be changing shared data during the fork.
    os.register_at_fork(
        before=lambda: _native._hold(True),
        after_in_parent=lambda: _native._hold(False),
        after_in_child=lambda: _native._hold(False),
    )


def sweep(contact, *varied, method=None, model=None, progress=None):
    """Solves a contact with one or two options varied, each from its neighbour, as ``ehl-explorer sweep`` does.

    Each of ``varied`` is a text as on the command line (``"moes-m=10:160:5:log"``) or a pair of a name and its values
    (``("moes_m", np.geomspace(10, 160, 5))``); the last one varies fastest. Returns a structured array with one row per
    contact: varied options, the contact, its result (NaN if the solve did not converge or was refused), and the texts
    ``status``, ``reason`` and ``warning`` as in :func:`solve_many`. If all contacts are refused, the sweep is refused.
    """
    axes = [axis if isinstance(axis, str) else (axis[0], [float(value) for value in axis[1]]) for axis in varied]
    if not axes:
        raise EhlError('nothing is varied; write sweep(contact, "moes-m=10:160:5:log")')
    return _native.sweep(contact, axes, method, model, progress)


def solve_many(contact, *, method=None, model=None, progress=None, **options):
    """Solves a contact with some of its options varied, on all cores: ``solve_many(contact, load=loads, speed=speeds)``.

    Options are the numeric options of :class:`Contact`; arrays are broadcast against each other. Each contact is solved
    from a cold start, so that results do not depend on order or cores. Returns a structured array of the broadcast
    shape: the contact and its result by the names of :func:`sweep`'s columns. ``converged`` and ``reduced.trained`` are 1
    or 0; values are NaN if a solve did not converge or was refused; ``warning`` is a text. ``status`` is
    ``"converged"``, ``"not converged"`` or ``"refused"``, and ``reason`` explains the latter two. An invalid contact is
    refused in its own row only.
    """
    if not options:
        raise EhlError("nothing is varied; write solve_many(contact, load=[...])")
    arrays = np.broadcast_arrays(*(np.asarray(values, dtype=np.float64) for values in options.values()))
    columns = [(name, np.ascontiguousarray(values).reshape(-1)) for name, values in zip(options, arrays)]
    return _native.solve_many(contact, columns, method, model, progress).reshape(arrays[0].shape)


class Outcome:
    """Outcome of a scene: ``passed``, ``value`` by name, ``expectations``, ``warnings``, and ``tables``.

    ``tables`` are structured arrays by name. Their column ``warning`` contains warnings about single rows. ``labels``
    are the names of rows, if they have names. ``object`` is the object printed by ``run --json``.
    """

    def __init__(self, answer: Mapping[str, Any], tables: Mapping[str, Any]):
        self.object = answer
        self.title = answer["title"]
        self.passed = answer["passed"]
        self.converged = answer["converged"]
        self.expectations = answer["expectations"]
        self.warnings = [warning["text"] for warning in answer.get("warnings", [])]
        self.tables = {name: array for name, (array, _) in tables.items()}
        self.labels = {name: labels for name, (_, labels) in tables.items() if labels}

    def value(self, name: str, method: Optional[str] = None) -> float:
        """Returns the value with this name: of the given method, or else the first one with the name."""
        for value in self.object["values"]:
            if value["name"] == name and method in (None, value.get("method")):
                return value["value"]
        raise KeyError(name)

    def __repr__(self) -> str:
        return f"Outcome({self.title!r}, {'passed' if self.passed else 'fell short'})"


def run(
    scene: Union[str, "os.PathLike[str]"],
    model: Union[Model, str, "os.PathLike[str]", None] = None,
    progress: Optional[Callable[[str, int, int], object]] = None,
) -> Outcome:
    """Runs a scene, given by its text or its file, and checks its expectations.

    ``model`` replaces the embedded models. Paths in a scene are relative to its file's folder.
    """
    return Outcome(*_native.run(scene, model, progress))
