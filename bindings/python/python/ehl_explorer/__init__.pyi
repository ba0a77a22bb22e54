"""Type stubs of ehl_explorer. The documentation is in the module itself."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

__version__: str

_Kind = Literal["line", "point"]
_Method = Literal["full", "reduced"]
_Path = Union[str, os.PathLike[str]]
_Model = Union["Model", _Path]
_Progress = Callable[[str, int, int], object]
_Option = Union[float, str, bool, Sequence[float], os.PathLike[str], None]
_Series = tuple[Sequence[float], Sequence[float]]
_Array = npt.NDArray[np.float64]

class EhlError(ValueError): ...

class MarchStopped(EhlError):
    warning: dict[str, Any]
    reached: npt.NDArray[Any]

class Contact:
    def __init__(self, **options: _Option) -> None: ...
    @staticmethod
    def si(
        radius: float,
        speed: float,
        load: float,
        modulus: Optional[float] = None,
        viscosity: Optional[float] = None,
        alpha: Optional[float] = None,
        **options: _Option,
    ) -> Contact: ...
    @staticmethod
    def moes(m: float, l: float, **options: _Option) -> Contact: ...
    @staticmethod
    def engineering(contact: _Kind = "line", **quantities: Union[float, str]) -> Contact: ...
    def replace(self, **changes: _Option) -> Contact: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    @property
    def m(self) -> float: ...
    @property
    def l(self) -> float: ...
    @property
    def hertz_half_width(self) -> float: ...
    @property
    def hertz_pressure(self) -> float: ...
    @property
    def contact(self) -> _Kind: ...
    def quantities(self) -> dict[str, float]: ...

class Model:
    @staticmethod
    def load(path: _Path) -> Model: ...
    @staticmethod
    def embedded(name: str = "line") -> Model: ...
    @staticmethod
    def train(scene: _Path, progress: Optional[_Progress] = None) -> Model: ...
    def save(self, path: _Path) -> None: ...
    @property
    def title(self) -> str: ...
    @property
    def contact(self) -> _Kind: ...
    @property
    def domain(self) -> dict[str, Any]: ...
    def arrays(self) -> dict[str, _Array]: ...
    def snapshots(
        self, window: int = 1, iterates: bool = False, progress: Optional[_Progress] = None
    ) -> dict[str, _Array]: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Result:
    @property
    def x(self) -> _Array: ...
    @property
    def y(self) -> _Array: ...
    @property
    def pressure(self) -> _Array: ...
    @property
    def film(self) -> _Array: ...
    @property
    def fields(self) -> dict[str, _Array]: ...
    @property
    def converged(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def H_c(self) -> Optional[float]: ...
    @property
    def H_min(self) -> Optional[float]: ...
    @property
    def traction(self) -> Optional[float]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def report(
        self,
        path: _Path,
        title: Optional[str] = None,
        author: str = "",
        company: str = "",
        paper: str = "a4",
        units: str = "engineering",
    ) -> None: ...
    def subsurface(self, poisson: float = 0.3) -> dict[str, Any]: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __getattr__(self, name: str) -> Any: ...
    def __getitem__(self, name: str) -> Any: ...

class Outcome:
    object: Mapping[str, Any]
    title: str
    passed: bool
    converged: bool
    expectations: list[dict[str, Any]]
    warnings: list[str]
    tables: dict[str, npt.NDArray[Any]]
    labels: dict[str, list[str]]
    def value(self, name: str, method: Optional[_Method] = None) -> float: ...

def solve(
    contact: Contact,
    method: Optional[_Method] = None,
    model: Optional[_Model] = None,
    progress: Optional[_Progress] = None,
) -> Result: ...
def solve_many(
    contact: Contact,
    *,
    method: Optional[_Method] = None,
    model: Optional[_Model] = None,
    progress: Optional[_Progress] = None,
    **options: npt.ArrayLike,
) -> npt.NDArray[Any]: ...
def sweep(
    contact: Contact,
    *varied: Union[str, tuple[str, npt.ArrayLike]],
    method: Optional[_Method] = None,
    model: Optional[_Model] = None,
    progress: Optional[_Progress] = None,
) -> npt.NDArray[Any]: ...
def random_test(
    m: tuple[float, float],
    l: tuple[float, float],
    tests: int,
    seed: int = 1,
    max_hertz_pressure: float = 3.2e9,
    contact: _Kind = "line",
    method: _Method = "reduced",
    compare: int = 0,
    model: Optional[_Model] = None,
    progress: Optional[_Progress] = None,
) -> npt.NDArray[Any]: ...
def transient(
    contact: Contact,
    duration: float,
    step: Optional[float] = None,
    radius: Optional[_Series] = None,
    speed: Optional[_Series] = None,
    load: Optional[_Series] = None,
    model: Optional[_Path] = None,
    progress: Optional[_Progress] = None,
    tolerance: Optional[float] = None,
) -> npt.NDArray[Any]: ...
def run(scene: _Path, model: Optional[_Model] = None, progress: Optional[_Progress] = None) -> Outcome: ...
