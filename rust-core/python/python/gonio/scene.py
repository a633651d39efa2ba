"""Scenes with the short ways to build them: keywords in place of descriptions."""

from __future__ import annotations

import operator
import os
from array import array
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Unpack

from . import _gonio
from .description import camera, columns, material, measurand, numbers
from .light import Photometry, light
from .medium import Coefficient, flow_of, medium, of_voxels, volume_material
from .texture import Texture, described

if TYPE_CHECKING:
    from .arrays import Matrix, Numbers


class Scene(_gonio.Scene):
    """What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².

    `put_material` and the like add or replace elements by their descriptions, which are those of `to_dict`; `add_material` and the like describe
    the common ones by keywords.
    """

    def add_mesh(
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
    ) -> int:
        """Adds a mesh; gives its number. The arrays are those of `put_mesh`."""
        return self.put_mesh(
            points,
            triangles,
            corners=corners,
            faces=faces,
            normals=normals,
            uvs=uvs,
            primvars=primvars,
            slots=slots,
            motion=motion,
            motion_normals=motion_normals,
            name=name,
        )

    def add_mesh_file(self, path: str | os.PathLike[str]) -> tuple[int, list[str]]:
        """Adds the mesh of an OBJ or PLY file; gives its number and the names of its materials, one a slot: `add_instance` takes as many."""
        return self.put_mesh_file(path)

    def add_texture(
        self,
        image: str | os.PathLike[str] | Numbers,
        *,
        colour_space: str | None = None,
        uv: str = "st",
        wrap: str = "repeat",
        tiles: Sequence[float] = (1.0, 1.0),
        name: str | None = None,
    ) -> Texture:
        """Adds an image: a file's path, or an array (height, width) or (height, width, 1 to 4), rows from the top, of uint8 or uint16, which are
        fractions of their largest, or floats. `colour_space` says what its numbers mean: "sRGB", "lin_rec709", "ACEScg", "raw" for what is no
        colour; files may have "auto", arrays are to name it. `uv` is the primvar that it lies along, `wrap` what is beyond it (repeat, clamp, mirror,
        black), `tiles` how often it is repeated along u and v.
        """
        along = array("d", numbers("tiles", tiles, 2))
        if isinstance(image, (str, os.PathLike)):
            path = os.fspath(image)
            description = {**described(name or path, colour_space or "auto"), "source": {"File": path}}
            number = self.put_texture(description)
        elif colour_space is None:
            raise ValueError('add_texture: an array says nothing of its colours: expected colour_space="sRGB", "lin_rec709", "raw" or another')
        else:
            number = self.put_texture(described(name or "texture", colour_space), pixels=image)
        return Texture(number, uv, wrap, (along[0], along[1]))

    def add_volume(
        self,
        density: Numbers | tuple[str | os.PathLike[str], str],
        *,
        heat: Numbers | tuple[str | os.PathLike[str], str] | None = None,
        scattering: Coefficient = 1.0,
        absorption: Coefficient = 0.0,
        emission: Coefficient = 0.0,
        anisotropy: float = 0.0,
        phase: str = "henyey_greenstein",
        glow: Sequence[Sequence[float]] = (),
        voxel: float | Sequence[float] = 1.0,
        transform: Matrix | None = None,
        motion: Sequence[Matrix] = (),
        velocity: Numbers | str | Sequence[str] | None = None,
        shutter_s: float = 1 / 48,
        rests: float = 0.5,
        name: str = "volume",
        **numbers_of_phase: float,
    ) -> int:
        """Adds smoke, a cloud or fire; gives the number of its field. `density`, an array (nx, ny, nz) or a VDB file and the name of its grid,
        multiplies scattering and absorption, 1/m; `heat`, likewise, the emission, cd/m² a metre, by the factors of `glow`, evenly from no heat to
        the most. An array fills a box from the origin on, `voxel` metres a voxel; `transform` places that, or the file's space. `anisotropy`, `phase`
        and its numbers are those of `gonio.medium.medium`.

        `motion` gives the transform at evenly spaced times over the shutter, and the middle one stands for it where that is left out. `velocity`,
        m/s before the transform, has what is there flow while the shutter is open, `shutter_s` seconds: an array (nx, ny, nz, 3), or the name of the
        file's grid of vectors, or of three for x, y and z. The numbers hold at `rests`, from 0 as it opens to 1.
        """
        if transform is None and motion:
            transform = motion[len(motion) // 2]
        to_world, keys = columns(transform), [columns(key) for key in motion]
        edges = None
        if not isinstance(density, tuple):
            edges = numbers("voxel", [voxel] * 3 if isinstance(voxel, (int, float)) else voxel, 3)
            to_world, keys = of_voxels(to_world, edges), [of_voxels(key, edges) for key in keys]
        described = {"origin": name, "to_world": to_world, "glow": [numbers("glow", factor, 3) for factor in glow]}
        field = self.put_field(described, density=density, heat=heat)
        if velocity is not None:
            self.put_flow(field, to_world, flow_of(density, velocity, shutter_s, edges), rests)
        box, placed = self.put_field_box(field)
        inside = medium(scattering=scattering, absorption=absorption, emission=emission, anisotropy=anisotropy, phase=phase, **numbers_of_phase)
        filled = self.put_material(volume_material(name, {**inside, "field": field}))
        self.add_instance(box, [filled], transform=placed, motion=self.field_places(field, to_world, keys), name=name)
        return field

    def add_material(self, name: str = "material", **parameters: float | bool | Sequence[float] | Texture | str | Mapping[str, Any]) -> int:
        """Adds a material: keyword arguments are surface parameters by their OpenPBR names, numbers, triples or textures; `normal`, a texture of
        tangent-space normals; `metal`, what it is made of: a name such as "gold", a file, or what `gonio.metal` gives;
        `glass`, the same of what refracts: "N-BK7", "water", a file, or what `gonio.glass` gives; `spectrum`, what its emission is of, as lights take it. Gives its number."""
        return self.put_material(material(name, parameters))

    def add_curves(
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
    ) -> int:
        """Adds curves; gives their number. The arguments are those of `put_curves`."""
        return self.put_curves(
            points, counts, widths, type=type, basis=basis, wrap=wrap, shape=shape, motion=motion, primvars=primvars, name=name
        )

    def add_points(
        self,
        points: Numbers,
        widths: float | Numbers | tuple[Numbers, str],
        *,
        normals: Numbers | None = None,
        shape: str = "sphere",
        motion: Numbers | None = None,
        primvars: Mapping[str, Numbers | tuple[Numbers, str]] | None = None,
        name: str = "points",
    ) -> int:
        """Adds points; gives their number. The arguments are those of `put_points`."""
        return self.put_points(points, widths, normals=normals, shape=shape, motion=motion, primvars=primvars, name=name)

    def add_instance(
        self,
        mesh: int | None = None,
        materials: Sequence[int] = (),
        *,
        curves: int | None = None,
        points: int | None = None,
        transform: Matrix | None = None,
        motion: Sequence[Matrix] = (),
        name: str = "instance",
    ) -> None:
        """Places a mesh, or curves or points; transform is a 4×4 matrix for column vectors. `motion` gives it at evenly spaced times over the
        shutter, and the middle one stands for the transform where that is left out."""
        if transform is None and motion:
            transform = motion[len(motion) // 2]
        keys = array("d", [value for key in motion for value in _numbers(key)]) if motion else None
        flat = array("d", _numbers(transform))
        self.put_instances(mesh, [*materials], flat, curves=curves, points=points, motion=keys, name=name)

    def add_light(
        self,
        shape: str,
        radiance: Sequence[float] = (1.0, 1.0, 1.0),
        *,
        transform: Matrix | None = None,
        motion: Sequence[Matrix] = (),
        width: float = 1.0,
        height: float = 1.0,
        radius: float = 0.5,
        length: float = 1.0,
        angle: float = 0.53,
        visible: bool = True,
        name: str = "light",
        **photometry: Unpack[Photometry],
    ) -> int:
        """Adds a light of a shape: "rectangle" (width, height), "disk" (radius), "sphere" (radius), "cylinder" (radius, length), "point",
        "luminaire" (its goniogram's opening, or another), "distant" (angle in degrees), "dome". Radiance in cd/m² (point and luminaire: cd; a
        distant light: lux on a facing surface), negative where the light takes light away; flat ones shine along local −z.

        One of lumens, lamp_lumens, candela, lux (at metres: a pair), nits or watts in place of it lets the radiance tell the colour alone; so
        does a goniogram of a point or a luminaire, whose factors then are cd. The temperature in K multiplies the colour. `motion` gives its
        transform at evenly spaced times over the shutter.
        """
        sizes = {"width": width, "height": height, "radius": radius, "length": length, "angle": angle}
        if transform is None and motion:
            transform = motion[len(motion) // 2]
        described = light(name, shape, radiance, transform, sizes, visible, photometry)
        return self.put_light({**described, "motion": [columns(key) for key in motion]})

    def add_camera(
        self, transform: Matrix | None = None, *, motion: Sequence[Matrix] = (), fov: float = 40.0, name: str = "camera"
    ) -> None:
        """Adds a camera looking along −z of its transform, y up, with a vertical field of view in degrees; makes it the one that renders.
        `motion` gives its transform at evenly spaced times over the shutter."""
        if transform is None and motion:
            transform = motion[len(motion) // 2]
        described = {**camera(name, transform, fov, self.resolution), "motion": [columns(key) for key in motion]}
        self.set(camera=self.put_camera(described, fixed_aperture=False))

    def add_meter(
        self,
        position: Sequence[float],
        *,
        normal: Sequence[float] = (0.0, 0.0, 1.0),
        facing: Sequence[float] = (0.0, 1.0, 0.0),
        quantity: str = "illuminance",
        name: str = "meter",
    ) -> int:
        """Adds a meter at a point in metres; gives its number. quantity: illuminance (of the plane across `normal`), cylindrical or
        semicylindrical (`normal` is the axis), daylight-factor, luminance (towards `facing`), melanopic-edi (of an eye
        that looks along `facing`; lamps want spectra), cct, duv, ra, rf or rg (colour of the light that the plane across
        `normal` gets; the last three want spectra), or ugr (of the luminaires, along `facing`, upright along `normal`).
        """
        vectors = {"position": position, "normal": normal, "facing": facing}
        placed = {key: numbers(key, vector, 3) for key, vector in vectors.items()}
        return self.put_meter({"origin": name, "measurand": measurand(quantity), **placed})

    def add_grid(
        self,
        *,
        corner: Sequence[float] = (0.0, 0.0, 0.0),
        edges: Sequence[Sequence[float]] | None = None,
        mesh: int | None = None,
        transform: Matrix | None = None,
        spacing: float = 0.0,
        margin: float = 0.0,
        height: float = 0.0,
        facing: Sequence[float] = (0.0, 1.0, 0.0),
        eyes: int | Sequence[Sequence[float]] | None = None,
        quantity: str = "illuminance",
        name: str = "grid",
    ) -> int:
        """Adds a calculation grid over a parallelogram (`corner` and two `edges`, metres) or over mesh number `mesh` placed by `transform`, shown
        or not; gives its number. spacing: metres from point to point, 0 as EN 12464-1 has it; margin: metres left out along the edges; height:
        metres above the area (1.2 for eyes of somebody who sits, 1.6 of somebody who stands); eyes: where eyes at the points look, so many ways
        across the area's normal, even around and the first along `facing`, or these directions, for illuminance, melanopic-edi and figures of
        colour; the rest as a meter's.
        """
        area: dict[str, object]
        if edges is not None and mesh is None:
            area = {"Rectangle": {"corner": numbers("corner", corner, 3), "edges": [numbers("edges", edge, 3) for edge in edges]}}
        elif mesh is not None and edges is None:
            area = {"Mesh": {"mesh": mesh, "transform": columns(transform)}}
        else:
            raise ValueError("a grid wants either edges or a mesh")
        sizes = {"spacing": spacing, "margin": margin, "height": height}
        faced = {"facing": numbers("facing", facing, 3), "eyes": _eyes(eyes), "measurand": measurand(quantity)}
        return self.put_grid({"origin": name, "area": area, **sizes, **faced})


def _eyes(eyes: int | Sequence[Sequence[float]] | None) -> dict[str, object] | None:
    """Where eyes look, as descriptions have it."""
    if eyes is None:
        return None
    try:
        return {"Around": operator.index(eyes)}  # type: ignore[arg-type]
    except TypeError:
        return {"Towards": [numbers("eyes", facing, 3) for facing in eyes]}  # type: ignore[union-attr]


def _numbers(matrix: Matrix | None) -> list[float]:
    """The numbers of a 4×4 matrix, row by row."""
    x, y, z, origin = columns(matrix)["columns"]
    rows = [*zip(x, y, z, origin, strict=True), (0.0, 0.0, 0.0, 1.0)]
    return [value for row in rows for value in row]
