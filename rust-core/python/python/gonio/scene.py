"""Scenes with the short ways to build them: keywords in place of descriptions."""

from __future__ import annotations

from array import array
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Unpack

from . import _gonio
from .description import camera, columns, material, measurand, numbers
from .light import Photometry, light

if TYPE_CHECKING:
    from typing_extensions import Buffer

# Rows of a 4×4 matrix for column vectors: the translation is in the last column.
Matrix = Sequence[Sequence[float]]


class Scene(_gonio.Scene):
    """What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².

    `put_material` and the like add or replace elements by their descriptions, which are those of `to_dict`; `add_material` and the like describe
    the common ones by keywords.
    """

    def add_mesh(
        self,
        points: Buffer,
        triangles: Buffer,
        *,
        corners: Buffer | None = None,
        faces: Buffer | None = None,
        normals: Buffer | None = None,
        uvs: Buffer | None = None,
        primvars: Mapping[str, Buffer] | None = None,
        slots: Buffer | None = None,
        motion: Buffer | None = None,
        motion_normals: Buffer | None = None,
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

    def add_material(self, name: str = "material", **parameters: float | bool | Sequence[float]) -> int:
        """Adds a material: keyword arguments are surface parameters by their OpenPBR names, numbers or triples; gives its number."""
        return self.put_material(material(name, parameters))

    def add_curves(
        self,
        points: Buffer,
        counts: Buffer,
        widths: float | Buffer | tuple[Buffer, str],
        *,
        type: str = "linear",
        basis: str = "bezier",
        wrap: str = "nonperiodic",
        shape: str = "round",
        motion: Buffer | None = None,
        primvars: Mapping[str, Buffer | tuple[Buffer, str]] | None = None,
        name: str = "curves",
    ) -> int:
        """Adds curves; gives their number. The arguments are those of `put_curves`."""
        return self.put_curves(
            points, counts, widths, type=type, basis=basis, wrap=wrap, shape=shape, motion=motion, primvars=primvars, name=name
        )

    def add_points(
        self,
        points: Buffer,
        widths: float | Buffer | tuple[Buffer, str],
        *,
        normals: Buffer | None = None,
        shape: str = "sphere",
        motion: Buffer | None = None,
        primvars: Mapping[str, Buffer | tuple[Buffer, str]] | None = None,
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
        distant light: lux on a facing surface); flat ones shine along local −z.

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
        semicylindrical (`normal` is the axis), daylight-factor, luminance (towards `facing`), or ugr (of the luminaires, along `facing`,
        upright along `normal`).
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
        quantity: str = "illuminance",
        name: str = "grid",
    ) -> int:
        """Adds a calculation grid over a parallelogram (`corner` and two `edges`, metres) or over mesh number `mesh` placed by `transform`, shown
        or not; gives its number. spacing: metres from point to point, 0 as EN 12464-1 has it; margin: metres left out along the edges; height:
        metres above the area; the rest as a meter's.
        """
        area: dict[str, object]
        if edges is not None and mesh is None:
            area = {"Rectangle": {"corner": numbers("corner", corner, 3), "edges": [numbers("edges", edge, 3) for edge in edges]}}
        elif mesh is not None and edges is None:
            area = {"Mesh": {"mesh": mesh, "transform": columns(transform)}}
        else:
            raise ValueError("a grid wants either edges or a mesh")
        sizes = {"spacing": spacing, "margin": margin, "height": height}
        faced = {"facing": numbers("facing", facing, 3), "measurand": measurand(quantity)}
        return self.put_grid({"origin": name, "area": area, **sizes, **faced})


def _numbers(matrix: Matrix | None) -> list[float]:
    """The numbers of a 4×4 matrix, row by row."""
    x, y, z, origin = columns(matrix)["columns"]
    rows = [*zip(x, y, z, origin, strict=True), (0.0, 0.0, 0.0, 1.0)]
    return [value for row in rows for value in row]
