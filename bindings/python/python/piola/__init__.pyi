from collections.abc import Mapping, Sequence
from typing import Any, Literal, Optional, Union, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from piola.errors import (
    BodyError as BodyError,
    ContractError as ContractError,
    DeclarationError as DeclarationError,
    DomainError as DomainError,
    Error as Error,
    FitError as FitError,
    MaterialError as MaterialError,
    StepError as StepError,
)
from piola.results import (
    Curve as Curve,
    Fit as Fit,
    Moduli as Moduli,
    Stability as Stability,
    Status as Status,
    Walk as Walk,
)

_Array = Union[NDArray[np.float64], NDArray[np.float32]]
_Pair = tuple[Optional[_Array], Optional[_Array]]
_Filter = Optional[Literal["clamp", "absolute"]]
_Flags = Optional[NDArray[np.uint8]]
_Measure = Literal["second_piola", "kirchhoff", "cauchy", "jaumann", "green_naghdi"]
_Mode = Literal["uniaxial", "equibiaxial", "pure_shear", "simple_shear", "volumetric"]

@final
class Parameter:
    @property
    def name(self) -> str: ...
    @property
    def doc(self) -> str: ...
    @property
    def unit(self) -> Optional[str]: ...
    @property
    def is_list(self) -> bool: ...
    @property
    def typical(self) -> Optional[list[float]]: ...

@final
class Description:
    @property
    def name(self) -> str: ...
    @property
    def summary(self) -> str: ...
    @property
    def formula(self) -> str: ...
    @property
    def parameters(self) -> list[Parameter]: ...
    @property
    def domain(self) -> str: ...
    @property
    def admissible(self) -> list[str]: ...
    @property
    def extends(self) -> bool: ...
    @property
    def moduli(self) -> list[str]: ...

@final
class Material:
    def __new__(cls, name: str, /, *, extend: Optional[float] = None, **parameters: ArrayLike) -> Material: ...
    @staticmethod
    def typical(name: str, /, *, extend: Optional[float] = None) -> Material: ...
    @staticmethod
    def matching(name: str, /, *, young: float, poisson: float, extend: Optional[float] = None) -> Material: ...
    def changed(self, **parameters: ArrayLike) -> Material: ...
    def emit(
        self,
        target: str,
        *,
        precision: Optional[str] = None,
        name: Optional[str] = None,
        functions: Optional[Sequence[str]] = None,
    ) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> Description: ...
    @property
    def parameters(self) -> dict[str, Union[float, list[float], NDArray[np.float64]]]: ...
    @property
    def extend(self) -> Optional[float]: ...
    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def moduli(self) -> Moduli: ...
    def energy(
        self,
        F: ArrayLike,
        /,
        *,
        trailing: Optional[bool] = None,
        out: Optional[_Array] = None,
        status: _Flags = None,
        threads: Optional[bool] = None,
    ) -> _Array: ...
    def stress(
        self,
        F: ArrayLike,
        /,
        *,
        trailing: Optional[bool] = None,
        out: Optional[_Array] = None,
        status: _Flags = None,
        threads: Optional[bool] = None,
    ) -> _Array: ...
    def tangent(
        self,
        F: ArrayLike,
        /,
        *,
        filter: _Filter = None,
        trailing: Optional[bool] = None,
        out: Optional[_Pair] = None,
        status: _Flags = None,
        threads: Optional[bool] = None,
    ) -> tuple[_Array, _Array]: ...
    def evaluate(
        self,
        F: ArrayLike,
        /,
        *,
        filter: _Filter = None,
        trailing: Optional[bool] = None,
        out: Optional[tuple[Optional[_Array], Optional[_Array], Optional[_Array]]] = None,
        status: _Flags = None,
        threads: Optional[bool] = None,
    ) -> tuple[_Array, _Array, _Array]: ...
    def measured(
        self,
        F: ArrayLike,
        measure: _Measure,
        /,
        *,
        tangent: bool = True,
        trailing: Optional[bool] = None,
        out: Any = None,
        status: _Flags = None,
        threads: Optional[bool] = None,
    ) -> Any: ...
    def stress_by_parameters(self, F: ArrayLike, /) -> dict[str, _Array]: ...
    def curve(self, mode: _Mode, controls: ArrayLike, /, *, incompressible: bool = False) -> Curve: ...
    def fit(
        self,
        data: Mapping[str, ArrayLike],
        /,
        *,
        incompressible: bool = True,
        relative: bool = True,
        floor: float = 0.0,
        cycle: Optional[int] = None,
        held: Sequence[str] = (),
        restarts: int = 20,
        seed: int = 1,
    ) -> Fit: ...
    def stability(self, *, smallest: float = 0.3, largest: float = 3.0, resolution: int = 41) -> Stability: ...
    def contract(self) -> list[tuple[str, int, float]]: ...

@final
class Body:
    def __new__(
        cls,
        points: ArrayLike,
        tets: ArrayLike,
        material: Union[Material, Sequence[Material]],
        density: Union[float, Sequence[float]],
        *,
        parts: Optional[ArrayLike] = None,
    ) -> Body: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def masses(self) -> NDArray[np.float64]: ...
    def energy(self, positions: ArrayLike, /) -> float: ...
    def gradient(self, positions: ArrayLike, /) -> NDArray[np.float64]: ...
    def stiffness(self, positions: ArrayLike, /, *, filter: _Filter = None) -> csr_array: ...
    def stiffness_blocks(
        self, positions: ArrayLike, /, *, filter: _Filter = None
    ) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]: ...

@final
class Simulation:
    @property
    def positions(self) -> NDArray[np.float64]: ...
    @positions.setter
    def positions(self, positions: ArrayLike) -> None: ...
    @property
    def velocities(self) -> NDArray[np.float64]: ...
    @velocities.setter
    def velocities(self, velocities: ArrayLike) -> None: ...
    @property
    def accelerations(self) -> NDArray[np.float64]: ...
    @accelerations.setter
    def accelerations(self, accelerations: ArrayLike) -> None: ...
    @property
    def pins(self) -> list[int]: ...
    @pins.setter
    def pins(self, pins: ArrayLike) -> None: ...
    def __new__(cls, body: Body, *, pins: Optional[ArrayLike] = None, **settings: Any) -> Simulation: ...
    @property
    def settings(self) -> dict[str, Any]: ...
    def set_settings(self, **settings: Any) -> None: ...
    def reactions(self) -> NDArray[np.float64]: ...
    def set_forces(self, forces: ArrayLike, /) -> None: ...
    def prescribe(self, nodes: ArrayLike, positions: ArrayLike, /) -> None: ...
    def energies(self) -> dict[str, Optional[float]]: ...
    def step(self, dt: float, /) -> dict[str, Any]: ...
    def equilibrate(self) -> dict[str, Any]: ...

def declare(
    text: str,
    /,
    *,
    name: Optional[str] = None,
    extend: Optional[float] = None,
    free_rest: bool = False,
    **parameters: ArrayLike,
) -> Material: ...
def catalogue() -> list[str]: ...
def describe(energy: Union[str, Material], /, *, free_rest: bool = False) -> Description: ...
def box_mesh(
    cells: tuple[int, int, int], size: tuple[float, float, float], /
) -> tuple[NDArray[np.float64], NDArray[np.int64]]: ...
def measurements(
    text: str,
    /,
    *,
    strain: Optional[str] = None,
    stress: Optional[str] = None,
    mode: Optional[str] = None,
    unit: Optional[str] = None,
) -> dict[str, NDArray[np.float64]]: ...
def treloar() -> dict[str, NDArray[np.float64]]: ...
def turn_tets(points: ArrayLike, tets: ArrayLike, /) -> NDArray[np.int64]: ...
def num_threads() -> int: ...
def set_num_threads(count: int, /) -> None: ...
