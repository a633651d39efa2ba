import datetime
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from types import TracebackType
from typing import Any, Self, final

from typing_extensions import disjoint_base

from .arrays import Numbers
from .scene import Scene as PublicScene

__all__ = [
    "Daylight",
    "artist_sky",
    "daylight",
    "read_weather",
    "sky_formula",
    "sky_table",
    "Cancelled",
    "Error",
    "FormatError",
    "SceneError",
    "SettingError",
    "UnsupportedError",
    "AnnualGlareReading",
    "AnnualReading",
    "annual",
    "annual_glare",
    "Array",
    "Film",
    "Coverage",
    "Glare",
    "GlareSource",
    "GridReading",
    "IlluminationMaps",
    "SurfaceMap",
    "illumination_map",
    "Measurements",
    "Picture",
    "RayCaster",
    "RayHits",
    "Reading",
    "compute",
    "dim",
    "false_colour",
    "glare",
    "measure",
    "merge",
    "road",
    "MeasuredBsdf",
    "Pass",
    "Progress",
    "Render",
    "Tile",
    "Scene",
    "_setting_error",
    "_main",
    "_files_of_stage",
    "_scene",
    "_view_scene",
    "load_usd",
    "blackbody_rgb",
    "goniogram_figures",
    "goniometer",
    "LuminaireReading",
    "sample_bsdf",
    "SampleReading",
    "SpectralPicture",
    "read_goniogram",
    "ugr_table",
    "colour_reflectance",
    "glass",
    "illuminant",
    "metal",
    "read_glass",
    "read_metal",
    "read_spectrum",
    "spectral_picture",
    "spectrum_figures",
    "sunlight",
    "view_out",
    "__version__",
    "simd_level",
    "surface_parameters",
]
__version__: str
simd_level: str
# Numbers that each parameter of surfaces takes.
surface_parameters: dict[str, int]

class Error(Exception):
    origin: str | None
    path: str | None
    line: int | None
    hint: str | None

class SceneError(Error): ...
class FormatError(Error): ...
class SettingError(Error): ...
class UnsupportedError(Error): ...
class Cancelled(Error): ...

@final
class Pass:
    @property
    def shape(self) -> tuple[int, int, int]: ...
    @property
    def channels(self) -> list[str]: ...
    def tobytes(self) -> bytes: ...
    if sys.version_info >= (3, 12):
        def __buffer__(self, flags: int, /) -> memoryview: ...

@final
class Array:
    @property
    def shape(self) -> list[int]: ...
    if sys.version_info >= (3, 12):
        def __buffer__(self, flags: int, /) -> memoryview: ...

@final
class MeasuredBsdf:
    @staticmethod
    def from_file(path: str | PathLike[str]) -> MeasuredBsdf: ...
    @staticmethod
    def from_bytes(data: bytes, name: str = "bytes") -> MeasuredBsdf: ...
    @staticmethod
    def from_table(
        axes: Mapping[str, Sequence[float] | Numbers],
        values: Numbers,
        *,
        side: str = "reflection-front",
        periods: Mapping[str, float] | None = None,
        nearest: Sequence[str] | None = None,
        wavelengths: Sequence[float] | None = None,
        xyz: bool = False,
        reciprocal: bool = False,
        bilateral: bool = False,
    ) -> MeasuredBsdf: ...
    @property
    def channels(self) -> list[str]: ...
    @property
    def isotropic(self) -> bool: ...
    @property
    def sides(self) -> list[str]: ...
    def eval(self, wi: Numbers, wo: Numbers, *, rgb: bool = False) -> Array: ...
    def pdf(self, wi: Numbers, wo: Numbers) -> Array: ...
    def sample(self, wo: Numbers, u: Numbers) -> tuple[Array, Array]: ...
    def fit(self) -> dict[str, Any]: ...
    def write(self, path: str | PathLike[str], *, title: str = "", text: bool = False, theta: int | None = None, phi: int | None = None) -> None: ...

@final
class Reading:
    @property
    def value(self) -> float: ...
    @property
    def standard_error(self) -> float: ...
    @property
    def coverage(self) -> Coverage | None: ...
    @property
    def small_sources(self) -> int | None: ...
    @property
    def as_in_tables(self) -> Reading | None: ...
    @property
    def colour(self) -> dict[str, Any] | None: ...
    def __float__(self) -> float: ...

@final
class GridReading:
    @property
    def name(self) -> str: ...
    @property
    def quantity(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def spacing(self) -> tuple[float, float]: ...
    @property
    def area(self) -> float: ...
    @property
    def average(self) -> Reading: ...
    @property
    def min(self) -> Reading: ...
    @property
    def max(self) -> Reading: ...
    @property
    def coverage(self) -> list[Coverage]: ...
    @property
    def colours(self) -> list[dict[str, Any]]: ...
    @property
    def as_in_tables(self) -> Array: ...
    @property
    def rating_note(self) -> str | None: ...
    @property
    def coverage_note(self) -> str | None: ...
    @property
    def facings(self) -> Array | None: ...
    @property
    def eye_values(self) -> Array | None: ...
    @property
    def eye_standard_errors(self) -> Array | None: ...
    @property
    def leasts(self) -> Array | None: ...
    @property
    def least_standard_errors(self) -> Array | None: ...
    def reaching(self, target: float) -> dict[str, dict[str, Any]]: ...
    @property
    def uniformity(self) -> float: ...
    @property
    def diversity(self) -> float: ...
    @property
    def values(self) -> Array: ...
    @property
    def standard_errors(self) -> Array: ...
    @property
    def positions(self) -> Array: ...
    def picture(
        self,
        *,
        max: float | None = None,
        steps: int = 10,
        log: float | None = None,
        contours: bool = True,
        legend: bool = True,
    ) -> Picture: ...

@final
class Measurements:
    @property
    def meters(self) -> list[Reading]: ...
    @property
    def grids(self) -> list[GridReading]: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    def csv(self) -> str: ...

def dim(
    scene: Scene,
    targets: Sequence[str],
    *,
    watts: Mapping[str, float] | None = None,
    fixed: Mapping[str, float] | None = None,
    min_level: float = 0.0,
    near: Mapping[str, float] | str | None = None,
    errors: float = 0.0,
    samples: int = 4096,
    max_bounces: int | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> dict[str, Any]: ...
def road(path: str | PathLike[str], *, cancelled: Callable[[], bool] | None = None) -> dict[str, Any]: ...
def measure(
    scene: Scene,
    *,
    samples: int = 4096,
    max_bounces: int | None = None,
    previous: Render | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Measurements: ...

@final
class AnnualReading:
    @property
    def name(self) -> str: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def positions(self) -> Array: ...
    @property
    def figures(self) -> dict[str, Any]: ...
    def plan(self, figure: str) -> Array: ...
    @property
    def total(self) -> Array: ...
    @property
    def direct(self) -> Array: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...

def annual(
    scene: Scene,
    weather: bytes,
    *,
    samples: int = 8192,
    division: int = 2,
    schedule: Sequence[float] | None = None,
    groups: Mapping[str, str | Sequence[str]] | None = None,
    blinds: float | Mapping[str, float] | None = None,
    closed: Scene | Mapping[str, Scene] | None = None,
    closed_hours: Sequence[float] | Mapping[str, Sequence[float]] | None = None,
    sky: str = "perez",
    sun_position: str = "true",
    ground: float = 0.2,
    dew_point: float | None = None,
    up: str = "Z",
    north: float = 0.0,
    lighting: Mapping[str, float | str] | None = None,
    checkpoint: str | PathLike[str] | None = None,
    resume: bool = False,
    part: tuple[int, int] | None = None,
    merge: Sequence[str | PathLike[str]] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> list[AnnualReading]: ...

@final
class AnnualGlareReading:
    @property
    def position(self) -> list[float]: ...
    @property
    def facing(self) -> list[float]: ...
    @property
    def figures(self) -> dict[str, float]: ...
    @property
    def standard_errors(self) -> dict[str, float] | None: ...
    @property
    def en17037(self) -> str: ...
    @property
    def closed_hours(self) -> list[float]: ...
    @property
    def values(self) -> Array: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...

def annual_glare(
    scene: Scene,
    weather: bytes,
    eyes: Sequence[tuple[Sequence[float], Sequence[float]]],
    *,
    samples: int = 8192,
    division: int = 4,
    schedule: Sequence[float] | None = None,
    groups: Mapping[str, str | Sequence[str]] | None = None,
    blinds: float | Mapping[str, float] | None = None,
    closed: Scene | Mapping[str, Scene] | None = None,
    closed_hours: Sequence[float] | Mapping[str, Sequence[float]] | None = None,
    surfaces: bool = False,
    sky: str = "perez",
    sun_position: str = "true",
    ground: float = 0.2,
    dew_point: float | None = None,
    up: str = "Z",
    north: float = 0.0,
    cancelled: Callable[[], bool] | None = None,
) -> list[AnnualGlareReading]: ...

@final
class LuminaireReading:
    @property
    def c(self) -> Array: ...
    @property
    def gamma(self) -> Array: ...
    @property
    def intensities(self) -> Array: ...
    @property
    def standard_errors(self) -> Array: ...
    @property
    def tristimulus(self) -> Array: ...
    @property
    def colour_temperatures(self) -> Array: ...
    @property
    def emitted(self) -> Reading: ...
    @property
    def flux(self) -> Reading: ...
    @property
    def flux_up(self) -> Reading: ...
    @property
    def absorbed(self) -> Reading: ...
    @property
    def cut_off(self) -> Reading: ...
    @property
    def light_output_ratio(self) -> Reading | None: ...
    @property
    def peak(self) -> Reading: ...
    @property
    def peak_direction(self) -> tuple[float, float]: ...
    @property
    def opening(self) -> tuple[list[float], list[float]]: ...
    @property
    def opening_parts(self) -> list[tuple[list[float], list[float]]]: ...
    @property
    def opening_area(self) -> float: ...
    @property
    def round(self) -> bool: ...
    @property
    def body(self) -> tuple[list[float], list[float]]: ...
    @property
    def screen(self) -> Array | None: ...
    @property
    def screen_errors(self) -> Array | None: ...
    @property
    def rays(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def converged(self) -> bool: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    def csv(self) -> str: ...
    def write(
        self,
        path: str | PathLike[str],
        *,
        symmetry: str | None = None,
        name: str | None = None,
        manufacturer: str = "",
        watts: float | None = None,
        date: str = "",
    ) -> list[tuple[str, str]]: ...

def goniometer(
    source: Scene | str | PathLike[str],
    luminaire: str | None = None,
    *,
    frame: float | None = None,
    down: Sequence[float] = ...,
    c0: Sequence[float] = ...,
    c_step: float = 15.0,
    g_step: float = 5.0,
    gammas: Sequence[float] | Numbers | None = None,
    error: float = 0.01,
    rays: int = 200_000_000,
    time_limit: float | None = None,
    symmetry: str = "auto",
    screen: Sequence[float] | None = None,
    seed: int = 0,
    threads: int = 0,
    progress: Callable[[int, int, float | None, float], bool | None] | None = None,
) -> LuminaireReading: ...

@final
class SurfaceMap:
    @property
    def name(self) -> str: ...
    @property
    def placement(self) -> int: ...
    @property
    def instances(self) -> int: ...
    @property
    def area(self) -> float: ...
    @property
    def size(self) -> tuple[int, int] | None: ...
    def flux(self, side: str = "front") -> float: ...
    def direct_flux(self, side: str = "front") -> float: ...
    def flux_error(self, side: str = "front") -> float: ...
    def mean(self, side: str = "front") -> float: ...
    def illuminance(self, side: str = "front") -> Array: ...
    def direct(self, side: str = "front") -> Array: ...
    def standard_errors(self, side: str = "front") -> Array: ...
    def colours(self, side: str = "front") -> Array | None: ...
    def figure(self, figure: str, side: str = "front") -> Array: ...
    def figure_errors(self, figure: str, side: str = "front") -> Array: ...
    def colour(self, side: str = "front") -> dict[str, Any] | None: ...
    @property
    def corners(self) -> Array | None: ...
    def at_corners(self, side: str = "front", *, quantity: str = "illuminance") -> Array: ...
    def of_triangles(self, side: str = "front", *, quantity: str = "illuminance") -> Array: ...
    def write(self, path: str | PathLike[str]) -> None: ...

@final
class IlluminationMaps:
    @property
    def surfaces(self) -> list[SurfaceMap]: ...
    @property
    def paths(self) -> int: ...
    @property
    def error(self) -> float: ...
    @property
    def emitted(self) -> float: ...
    @property
    def cut_off(self) -> float: ...
    @property
    def memory(self) -> int: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    def view(
        self,
        scene: Scene,
        *,
        quantity: str = "illuminance",
        side: int = 2,
        smooth: bool = False,
    ) -> Array: ...

def illumination_map(
    scene: Scene,
    *,
    prims: Sequence[str] | None = None,
    uv: str | None = None,
    texel: float | None = None,
    resolution: tuple[int, int] | None = None,
    error: float = 0.05,
    paths: int = 16777216,
    time_limit: float = 0.0,
    colours: bool = False,
    figures: bool = False,
    memory: int = 1073741824,
    max_bounces: int | None = None,
    previous: Render | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> IlluminationMaps: ...

@final
class SpectralPicture:
    @property
    def wavelengths_nm(self) -> Array: ...
    @property
    def radiance(self) -> Pass: ...
    @property
    def color(self) -> Pass: ...
    @property
    def names(self) -> list[str]: ...
    def layer(self, name: str) -> Pass: ...
    def light_figure(self, name: str) -> Pass: ...
    def relit(self, groups: Sequence[tuple[str, float, tuple[Sequence[float], Sequence[float]] | dict[str, Any] | None]]) -> SpectralPicture: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    def write(self, path: str | PathLike[str]) -> None: ...

@final
class SampleReading:
    def shares(self, side: str) -> Array: ...
    def standard_errors(self, side: str) -> Array: ...
    def totals(self, side: str) -> Array: ...
    def lost(self, side: str) -> Array: ...
    def bsdf(self) -> MeasuredBsdf: ...
    def write(self, path: str | PathLike[str], *, name: str = "sample") -> None: ...
    @property
    def window(self) -> tuple[list[float], list[float]]: ...
    @property
    def rays(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def error(self) -> float: ...
    @property
    def converged(self) -> bool: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...

def sample_bsdf(
    source: Scene | str | PathLike[str],
    *,
    prim: str | None = None,
    frame: float | None = None,
    front: Sequence[float] = ...,
    up: Sequence[float] = ...,
    window: tuple[Sequence[float], Sequence[float]] | None = None,
    repeat: int = 0,
    basis: str = "full",
    sides: str = "both",
    colour: bool = False,
    error: float = 0.03,
    rays: int = 1 << 20,
    time_limit: float | None = None,
    seed: int = 0,
    threads: int = 0,
    progress: Callable[[int, int, float | None, float], bool | None] | None = None,
) -> SampleReading: ...

@final
class Picture:
    @property
    def size(self) -> tuple[int, int]: ...
    def legend(self, height: int) -> Picture: ...
    def tobytes(self) -> bytes: ...
    def _repr_png_(self) -> bytes: ...
    def write(self, path: str | PathLike[str]) -> None: ...

def compute(operation: str | Mapping[str, Any], inputs: Sequence[Numbers]) -> Array | None: ...
def false_colour(
    values: Numbers,
    *,
    max: float | None = None,
    steps: int = 10,
    log: float | None = None,
    unit: str = "",
    contours: bool = False,
    smoothing: int = 3,
    legend: bool = True,
) -> Picture: ...

@final
class Coverage:
    @property
    def sources(self) -> int: ...
    @property
    def left_out(self) -> int: ...
    @property
    def high(self) -> int: ...
    @property
    def aside(self) -> int: ...
    @property
    def below(self) -> int: ...
    @property
    def large(self) -> int: ...
    @property
    def covered(self) -> int: ...
    @property
    def share_left_out(self) -> float: ...
    @property
    def note(self) -> str | None: ...

@final
class GlareSource:
    @property
    def luminance(self) -> float: ...
    @property
    def solid_angle(self) -> float: ...
    @property
    def direction(self) -> tuple[float, float, float]: ...
    @property
    def position_index(self) -> float: ...
    @property
    def cie_position_index(self) -> float | None: ...
    @property
    def illuminance(self) -> float: ...

@final
class Glare:
    @property
    def ugr(self) -> float | None: ...
    @property
    def coverage(self) -> Coverage: ...
    @property
    def dgp(self) -> float | None: ...
    @property
    def dgp_low_light(self) -> float | None: ...
    @property
    def eye_illuminance(self) -> float | None: ...
    @property
    def seen_illuminance(self) -> float: ...
    @property
    def share_seen(self) -> float: ...
    @property
    def background_luminance(self) -> float: ...
    @property
    def threshold(self) -> float: ...
    @property
    def sources(self) -> list[GlareSource]: ...

def glare(
    luminance: Numbers,
    *,
    projection: str,
    fov: float | None = None,
    threshold: float = 2000.0,
    radius: float = 0.2,
    peak: float | None = ...,
    illuminance: float | None = None,
) -> Glare: ...

@final
class Film:
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def samples(self) -> int: ...
    @property
    def mean_samples(self) -> float: ...
    @property
    def passes(self) -> list[str]: ...
    def __getitem__(self, name: str, /) -> Pass: ...
    def read(self, name: str, *, scale: float = 1.0, bottom_up: bool = False) -> Pass: ...
    def with_pass(self, name: str, values: Numbers) -> Film: ...
    def edge_aware(self) -> Film: ...
    def tone_mapped(
        self, tonemap: str = "photographic", exposure: float = 0.0, *, white: float = 6.0, adapted: float | None = None
    ) -> Film: ...
    def picture(
        self,
        tonemap: str = "photographic",
        exposure: float = 0.0,
        *,
        white: float = 6.0,
        adapted: float | None = None,
        over_black: bool = False,
    ) -> Picture: ...
    def _repr_png_(self) -> bytes | None: ...
    def write_exr(self, path: str | PathLike[str], half: bool = False) -> None: ...
    def write_deep_exr(self, path: str | PathLike[str]) -> None: ...
    def matte_notes(self, prefix: str = "") -> dict[str, str]: ...
    def view_notes(self) -> dict[str, str]: ...
    def log_average(self) -> float: ...
    def write_picture(
        self,
        path: str | PathLike[str],
        tonemap: str = "photographic",
        exposure: float = 0.0,
        *,
        white: float = 6.0,
        adapted: float | None = None,
        space: str = "srgb",
    ) -> None: ...

@final
class Tile:
    @property
    def x(self) -> int: ...
    @property
    def y(self) -> int: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def samples(self) -> int: ...

@final
class Progress:
    @property
    def fraction(self) -> float: ...
    @property
    def samples(self) -> int: ...
    @property
    def elapsed(self) -> float: ...
    @property
    def remaining(self) -> float | None: ...
    @property
    def rays(self) -> int: ...

@final
class RayCaster:
    def __new__(cls, scene: Scene, *, uv: str = "st") -> Self: ...
    def first_hits(self, origins: Numbers, directions: Numbers, *, max_distance: float | None = None) -> RayHits: ...

@final
class RayHits:
    @property
    def hit(self) -> Array: ...
    @property
    def distance(self) -> Array: ...
    @property
    def position(self) -> Array: ...
    @property
    def normal(self) -> Array: ...
    @property
    def geometric_normal(self) -> Array: ...
    @property
    def uv(self) -> Array: ...
    @property
    def instance(self) -> Array: ...
    @property
    def placement(self) -> Array: ...
    @property
    def material(self) -> Array: ...
    @property
    def triangle(self) -> Array: ...
    def __len__(self) -> int: ...

@final
class Render:
    def __new__(
        cls,
        scene: Scene,
        previous: Render | None = None,
        *,
        cancelled: Callable[[], bool] | None = None,
        resume: str | PathLike[str] | None = None,
    ) -> Render: ...
    @staticmethod
    def bake(
        scene: Scene,
        *,
        instance: int,
        triangles: Numbers,
        places: Numbers,
        steps: Numbers | None = None,
        placement: int = 0,
        view: str = "above",
        previous: Render | None = None,
        cancelled: Callable[[], bool] | None = None,
    ) -> Render: ...
    def __enter__(self) -> Render: ...
    def __exit__(self, *_exception: type[BaseException] | BaseException | TracebackType | None) -> None: ...
    def __iter__(self) -> Iterator[Tile]: ...
    def __next__(self) -> Tile: ...
    def wait(self, timeout: float | None = None) -> bool: ...
    def cancel(self) -> None: ...
    @property
    def progress(self) -> Progress: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    @property
    def guiding(self) -> str | None: ...
    @property
    def texture_statistics(self) -> dict[str, Any] | None: ...
    def film(self) -> Film: ...
    def checkpoint(self, path: str | PathLike[str]) -> None: ...

@disjoint_base
class Scene:
    def __new__(cls) -> Self: ...
    def put_mesh(
        self,
        points: Numbers,
        triangles: Numbers,
        *,
        corners: Numbers | None = None,
        faces: Numbers | None = None,
        normals: Numbers | None = None,
        uvs: Numbers | None = None,
        primvars: Mapping[str, Numbers] | None = None,
        slots: Numbers | None = None,
        motion: Numbers | None = None,
        motion_normals: Numbers | None = None,
        name: str = "mesh",
        index: int | None = None,
        ahead: bool = False,
    ) -> int: ...
    def set_dicing(
        self, mesh: int, *, pixels: float = 1.0, length: float = 0.0, levels: int = 12, smooth: bool = True
    ) -> None: ...
    def put_curves(
        self,
        points: Numbers,
        counts: Numbers,
        widths: float | Numbers | tuple[Numbers, str],
        *,
        type: str = "linear",
        basis: str = "bezier",
        wrap: str = "nonperiodic",
        shape: str = "round",
        motion: Numbers | None = None,
        primvars: Mapping[str, Numbers | tuple[Numbers, str]] | None = None,
        name: str = "curves",
        index: int | None = None,
    ) -> int: ...
    def put_points(
        self,
        points: Numbers,
        widths: float | Numbers | tuple[Numbers, str],
        *,
        normals: Numbers | None = None,
        shape: str = "sphere",
        motion: Numbers | None = None,
        primvars: Mapping[str, Numbers | tuple[Numbers, str]] | None = None,
        name: str = "points",
        index: int | None = None,
    ) -> int: ...
    def put_instances(
        self,
        mesh: int | None,
        materials: Sequence[int],
        transforms: Numbers,
        *,
        curves: int | None = None,
        points: int | None = None,
        motion: Numbers | None = None,
        name: str = "instances",
        visibility: Mapping[str, bool] | None = None,
        primvars: Mapping[str, Numbers] | None = None,
        pass_index: int = 0,
        light_group: str = "",
        linking: Mapping[str, Any] | None = None,
        asset: str = "",
        shadow_terminator: float = 0.0,
        index: int | None = None,
    ) -> int: ...
    def link(
        self,
        *,
        light: int | None = None,
        instances: int | None = None,
        receivers: Sequence[int] | None = None,
        receivers_except: Sequence[int] | None = None,
        blockers: Sequence[int] | None = None,
        blockers_except: Sequence[int] | None = None,
    ) -> None: ...
    def put_material(self, description: Mapping[str, Any], index: int | None = None) -> int: ...
    def put_light(self, description: Mapping[str, Any], index: int | None = None) -> int: ...
    def put_camera(self, description: Mapping[str, Any], index: int | None = None, *, fixed_aperture: bool = True) -> int: ...
    def put_texture(
        self,
        description: Mapping[str, Any],
        index: int | None = None,
        *,
        data: tuple[str, bytes | Mapping[int, bytes]] | None = None,
        pixels: Numbers | None = None,
    ) -> int: ...
    def put_mesh_file(self, path: str | PathLike[str], index: int | None = None) -> tuple[int, list[str]]: ...
    def put_measured(self, measured: MeasuredBsdf, *, name: str = "measured", index: int | None = None) -> int: ...
    def put_meter(self, description: Mapping[str, Any], index: int | None = None) -> int: ...
    def put_grid(self, description: Mapping[str, Any], index: int | None = None) -> int: ...
    def put_field(
        self,
        description: Mapping[str, Any],
        index: int | None = None,
        *,
        density: Numbers | tuple[str | PathLike[str], str],
        heat: Numbers | tuple[str | PathLike[str], str] | None = None,
        taken: Numbers | None = None,
        sent: Numbers | None = None,
    ) -> int: ...
    def put_flow(
        self,
        field: int,
        to_world: Mapping[str, Any],
        flow: tuple[str | PathLike[str], Sequence[str], float] | tuple[Numbers, Sequence[float]],
        rests: float,
    ) -> None: ...
    def field_places(self, field: int, to_world: Mapping[str, Any], keys: Sequence[Mapping[str, Any]]) -> list[list[list[float]]]: ...
    def put_field_box(self, field: int, index: int | None = None) -> tuple[int, list[list[float]]]: ...
    def put_atmosphere(self, description: Mapping[str, Any]) -> None: ...
    def truncate(self, kind: str, n: int) -> None: ...
    def add_daylight(self, daylight: Daylight, *, up: str = "Z", north: float = 0.0, rows: int = 512) -> None: ...
    def set(
        self,
        *,
        camera: int | None = ...,
        width: int | None = ...,
        height: int | None = ...,
        pixel_aspect: float | None = ...,
        crop: tuple[int, int, int, int] | None = ...,
        samples: int | None = ...,
        sample_range: tuple[int, int] | None = ...,
        reflective_caustics: bool = ...,
        refractive_caustics: bool = ...,
        clear_roughness: float | None = ...,
        tile_range: tuple[int, int] | None = ...,
        noise_threshold: float | None = ...,
        min_samples: int | None = ...,
        noise_white: float | None = ...,
        seed: int | None = ...,
        threads: int | None = ...,
        integrator: str | None = ...,
        caustics: str | None = ...,
        guiding: str | None = ...,
        spectral: bool | None = ...,
        max_bounces: int | None = ...,
        light_samples: int | None = ...,
        max_diffuse_bounces: int | None = ...,
        max_glossy_bounces: int | None = ...,
        max_transmission_bounces: int | None = ...,
        max_transparent_bounces: int | None = ...,
        max_volume_bounces: int | None = ...,
        antialiasing: str | int | None = ...,
        filter: str | None = ...,
        filter_width: float | None = ...,
        clamp_direct: float | None = ...,
        clamp_indirect: float | None = ...,
        motion_blur: bool | None = ...,
        shutter: tuple[float, float] | None = ...,
        shutter_curve: Sequence[float] | None = ...,
        row_exposure: float | None = ...,
        motion_interpolation: str | None = ...,
        film_transparent: bool | None = ...,
        mist: tuple[float, float, float] | None = ...,
        time_limit: float | None = ...,
        texture_memory: int | str | None = ...,
        displacement_memory: int | str | None = ...,
        texture_cache: str | PathLike[str] | None = ...,
        passes: Sequence[str] | None = ...,
        cryptomatte_depth: int | None = ...,
        occlusion_distance: float | None = ...,
        deep_tolerance: float | None = ...,
    ) -> None: ...
    def parts(self, count: int) -> list[dict[str, tuple[int, int]]]: ...
    @property
    def resolution(self) -> tuple[int, int]: ...
    @property
    def light_groups(self) -> list[str]: ...
    @property
    def diagnostics(self) -> list[tuple[str, str]]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def save(self, path: str | PathLike[str], *, images: bool = False) -> None: ...
    @staticmethod
    def _of_bundle(bytes: bytes, cameras_have_shape: bool, diagnostics: Sequence[tuple[str, str]]) -> PublicScene: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> PublicScene: ...

@final
class Daylight:
    @property
    def azimuth(self) -> float: ...
    @property
    def elevation(self) -> float: ...
    @property
    def sun_direction(self) -> tuple[float, float, float]: ...
    @property
    def sunrise(self) -> float | None: ...
    @property
    def transit(self) -> float | None: ...
    @property
    def sunset(self) -> float | None: ...
    @property
    def direct_illuminance(self) -> float: ...
    @property
    def diffuse_illuminance(self) -> float: ...
    @property
    def global_illuminance(self) -> float: ...
    @property
    def irradiances(self) -> tuple[float, float]: ...
    @property
    def zenith_luminance(self) -> float: ...
    @property
    def sun_luminance(self) -> float: ...
    @property
    def sun_irradiance(self) -> list[float]: ...
    @property
    def sky_spectra(self) -> dict[str, Any] | None: ...
    @property
    def sun_spectra(self) -> dict[str, Any] | None: ...
    def luminance(self, direction: Sequence[float]) -> float: ...
    def image(self, rows: int = 512) -> Pass: ...

def daylight(
    latitude: float,
    longitude: float,
    time: str | datetime.datetime,
    *,
    elevation: float = 0.0,
    pressure: float | None = None,
    temperature: float | None = None,
    sky: str = "perez",
    turbidity: float = 3.0,
    direct_normal: float | None = None,
    diffuse_horizontal: float | None = None,
    dew_point: float | None = None,
    ground: float = 0.0,
    coloured: bool = True,
) -> Daylight: ...
def artist_sky(
    model: str,
    elevation: float,
    *,
    turbidity: float = 2.2,
    ground: float = 0.0,
    altitude: float = 0.0,
    air: float = 1.0,
    dust: float = 1.0,
    ozone: float = 1.0,
    diameter: float = 0.545,
    rows: int = 512,
) -> tuple[Pass, list[float]]: ...
def sky_table(
    model: str,
    elevation: float,
    *,
    altitude: float = 0.0,
    air: float = 1.0,
    dust: float = 1.0,
    ozone: float = 1.0,
    diameter: float = 0.545,
) -> tuple[Pass, list[list[float]]]: ...
def sky_formula(model: str, elevation: float, *, turbidity: float = 2.2, ground: float = 0.0) -> list[tuple[list[float], float]]: ...
def read_weather(data: bytes, name: str) -> dict[str, Any]: ...
def blackbody_rgb(kelvin: float) -> list[float]: ...
def goniogram_figures(data: bytes, name: str, *, lamp_set: int | None = None, tilt: float = 0.0) -> dict[str, Any]: ...
def read_goniogram(
    data: bytes, name: str, *, lamp_set: int | None = None, tilt: float = 0.0
) -> tuple[dict[str, Any], list[str]]: ...
def ugr_table(
    data: bytes, name: str, *, spacing: float = 0.25, lamp_set: int | None = None, tilt: float = 0.0
) -> dict[str, Any]: ...
def colour_reflectance(colour: tuple[float, float, float], wavelengths_nm: Sequence[float]) -> list[float]: ...
def glass(name: str) -> dict[str, Any]: ...
def illuminant(name: str) -> dict[str, Any]: ...
def metal(name: str) -> dict[str, Any]: ...
def read_glass(data: bytes, name: str) -> dict[str, Any]: ...
def read_metal(data: bytes, name: str) -> dict[str, Any]: ...
def read_spectrum(data: bytes, name: str) -> dict[str, Any]: ...
def spectral_picture(
    scene: Scene, *, band: float = 5.0, cancelled: Callable[[], bool] | None = None
) -> SpectralPicture: ...
def spectrum_figures(wavelengths_nm: Sequence[float], power: Sequence[float]) -> dict[str, Any]: ...
def sunlight(
    scene: Scene,
    latitude: float,
    longitude: float,
    time: str,
    points: Sequence[tuple[Sequence[float], Sequence[float]]],
    *,
    up: str = "Z",
    north: float = 0.0,
    elevation: float = 0.0,
    least_elevation: float = 0.0,
    step: float = 1.0,
    cancelled: Callable[[], bool] | None = None,
) -> dict[str, Any]: ...
def view_out(
    scene: Scene,
    points: Sequence[Sequence[float]],
    *,
    up: str = "Z",
    ground: Sequence[str] = ...,
    openings: Sequence[str] = ...,
    field: float = 60.0,
    step: float = 0.5,
    nearest: float = 1.0,
    horizon: float = 0.0,
    cancelled: Callable[[], bool] | None = None,
) -> dict[str, Any]: ...
def merge(paths: Sequence[str | PathLike[str]]) -> Film: ...
def load_usd(
    path: str | PathLike[str],
    *,
    frame: float | None = None,
    camera: str | None = None,
    render_settings: str | None = None,
    render_pass: str | None = None,
    purposes: Sequence[str] | None = None,
    complexity: str = "high",
    camera_light: bool = True,
    strict: bool = False,
    motion_vectors: bool = False,
    hide_lights: bool = False,
    haze: float | None = None,
) -> PublicScene: ...
def _files_of_stage(path: str | PathLike[str]) -> list[str]: ...
def _scene(arguments: Sequence[str], folder: str | PathLike[str], frame: float | None) -> PublicScene: ...
def _view_scene(arguments: Sequence[str], folder: str | PathLike[str], frame: float | None) -> tuple[PublicScene, str]: ...
def _setting_error(name: str, problem: str) -> SettingError: ...
def _main(arguments: Sequence[str]) -> int: ...
