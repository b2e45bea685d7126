# SPDX-License-Identifier: LGPL-3.0-or-later
import os
from typing import Any, Iterable, Literal, Sequence, Union, final

import numpy
import numpy.typing

__version__: str
status_names: tuple[str, ...]

_Path = Union[str, os.PathLike[str]]
_Points = numpy.typing.NDArray[numpy.float64]
_Indices = numpy.typing.NDArray[numpy.integer[Any]]
_Touch = Literal["pass", "stop"]
_Sweep = Literal["three_segments", "triangle", "faces"]
_Search = Literal["exact", "dichotomic", "dichotomic_segment", "exhaustive"]
_Duplicates = Literal["refuse", "merge", "keep"]

def build_features() -> dict[str, bool]: ...

@final
class Motions:
    @property
    def status(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def cell(self) -> numpy.typing.NDArray[numpy.int32]: ...
    @property
    def cells(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    @property
    def contacts(self) -> numpy.typing.NDArray[numpy.void]: ...
    @property
    def counts(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...

@final
class Locations:
    @property
    def status(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def cell(self) -> numpy.typing.NDArray[numpy.int32]: ...
    @property
    def dimension(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def sides(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    def __len__(self) -> int: ...

@final
class WallMoves:
    @property
    def point(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    @property
    def end(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def position(self) -> _Points: ...
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def cell(self) -> numpy.typing.NDArray[numpy.int32]: ...
    @property
    def contacts(self) -> numpy.typing.NDArray[numpy.void]: ...
    @property
    def hits(self) -> numpy.typing.NDArray[numpy.void]: ...
    @property
    def rounds(self) -> int: ...
    @property
    def counts(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...

@final
class Environment:
    def __init__(
        self,
        points: _Points,
        cells: _Indices,
        *,
        split: bool = True,
        simplicial: bool = False,
        duplicates: _Duplicates = "refuse",
    ) -> None: ...
    @staticmethod
    def load(path: _Path, *, duplicates: _Duplicates = "refuse") -> Environment: ...
    @staticmethod
    def import_mesh(
        path: _Path,
        *,
        obstacles: Sequence[_Path] = [],
        split: bool = True,
        simplicial: bool = False,
        duplicates: _Duplicates = "refuse",
        mesher: Literal["tetgen", "mesh3"] = "tetgen",
        quality: Union[float, None] = None,
        cell_size: float = 0.0,
        distance: float = 0.0,
        keep_obstacles: bool = False,
        tissue: float = 0.0,
    ) -> Environment: ...
    @staticmethod
    def generate(
        kind: str, *, simplicial: bool = False, **kwargs: Union[float, bool, Sequence[float]]
    ) -> Environment: ...
    @property
    def dimension(self) -> int: ...
    @property
    def cell_count(self) -> int: ...
    @property
    def points(self) -> _Points: ...
    @property
    def certificate(self) -> dict[str, Any]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def save(self, path: _Path) -> None: ...
    def locate(self, points: _Points, *, threads: int = 0) -> Locations: ...
    def walk(
        self,
        starts: _Points,
        targets: _Points,
        *,
        touch: _Touch = "pass",
        kernel: Literal["exact", "lazy", "double", "float"] = "exact",
        threads: int = 0,
    ) -> Motions: ...
    def sweep(
        self,
        p: _Points,
        targets: _Points,
        q: _Points,
        *,
        sweep: _Sweep = "triangle",
        touch: _Touch = "pass",
        search: _Search = "exact",
        search_cells: Literal["flooded", "traversed"] = "flooded",
        tolerance: float = ...,
        search_limit: Literal["below", "none"] = "below",
        threads: int = 0,
    ) -> Motions: ...
    def reshape(
        self,
        points: Union[_Indices, Sequence[int]],
        targets: _Points,
        *,
        bodies: Iterable[Body] = (),
        particles: Iterable[Particles] = (),
        at_contact: Literal["stop", "hold", "push", "ask"] = "stop",
        most_rounds: int = 8,
        most_pushes: int = 16,
        sweep: _Sweep = "triangle",
        most_contacts: int = 4,
    ) -> WallMoves: ...

@final
class Particles:
    def __init__(self, environment: Environment, points: _Points, *, threads: int = 0) -> None: ...
    @property
    def positions(self) -> _Points: ...
    @property
    def cells(self) -> numpy.typing.NDArray[numpy.int32]: ...
    def move(
        self, targets: _Points, *, at_contact: Literal["stay", "stop"] = "stay", threads: int = 0
    ) -> Motions: ...
    def locate_again(self, *, threads: int = 0) -> None: ...
    def __len__(self) -> int: ...

@final
class Body:
    def __init__(
        self,
        environment: Environment,
        points: _Points,
        edges: Union[_Indices, None] = None,
        faces: Union[_Indices, None] = None,
    ) -> None: ...
    @staticmethod
    def read(environment: Environment, path: _Path) -> Body: ...
    @property
    def positions(self) -> _Points: ...
    @property
    def edges(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    @property
    def faces(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    @property
    def counts(self) -> dict[str, Any]: ...
    def step(
        self,
        targets: _Points,
        *,
        sweep: _Sweep = "triangle",
        touch: _Touch = "pass",
        search: _Search = "exact",
        tolerance: float = ...,
        policy: Literal["slide", "reject"] = "slide",
        edges: Literal["swept", "at_target"] = "swept",
        report: Literal["contacts", "blocked"] = "contacts",
        clearance: bool = True,
        most_contacts: int = 4,
        threads: int = 1,
    ) -> numpy.typing.NDArray[numpy.void]: ...
    def neighbours(self, vertex: int) -> numpy.typing.NDArray[numpy.uint32]: ...
    def move_vertex(
        self,
        vertex: int,
        target: Sequence[float],
        *,
        sweep: _Sweep = "triangle",
        touch: _Touch = "pass",
        search: _Search = "exact",
        tolerance: float = ...,
    ) -> numpy.typing.NDArray[numpy.void]: ...
    def register_again(self) -> None: ...
    def validate(self) -> None: ...
    def __len__(self) -> int: ...
