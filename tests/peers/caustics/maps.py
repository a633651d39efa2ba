"""Caustics kept on the surfaces: the flux that last came by glass or a mirror, in equal parts of triangles, and pictures that read it.

Every path has one way to be found. Light that reaches a diffuse surface straight from a lamp is sampled at camera paths' diffuse vertices; light
from another diffuse surface is followed by them; light that last left a mirror or glass comes from the map alone. So caustics are exact but
for the size of a part, whatever is between them and the eye.
"""

from pathlib import Path

import drjit
import mitsuba
import numpy
from cornell_mitsuba import bsdf, write_ply

mitsuba.set_variant("llvm_ad_rgb")

from description import Mesh, Scene  # noqa: E402
from lamps import Lamps  # noqa: E402

Bool, Float, UInt32, Colour = mitsuba.Bool, mitsuba.Float, mitsuba.UInt32, mitsuba.Color3f
# The depth beyond which Mitsuba lets light paths end by chance.
ROULETTE = 5


class Parts:
    """Triangles divided into parts with sides of about `size` metres."""

    def __init__(self, scene: mitsuba.Scene, meshes: list[Mesh], size: float) -> None:
        sides, areas, triangles = [], [], 0
        numbers = numpy.array(drjit.reinterpret_array(UInt32, scene.shapes_dr()))
        firsts = numpy.zeros(int(numbers.max()) + 1, "u4")
        for shape, number in zip(scene.shapes(), numbers, strict=True):
            mesh = meshes[int(shape.id().rpartition(" ")[2])]
            firsts[number] = triangles
            a, b, c = (mesh.points[mesh.triangles[:, k]].astype("f8") for k in range(3))
            area = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
            longest = numpy.max([numpy.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c)], axis=0)
            sides.append(numpy.maximum(1, numpy.ceil(longest / size)).astype("u4"))
            areas.append(area)
            triangles += len(area)
        self._sides = numpy.concatenate(sides)
        counts = 2 * self._sides.astype("i8") ** 2
        self._starts = numpy.concatenate([[0], numpy.cumsum(counts)]).astype("u4")
        self.count = int(self._starts[-1])
        # A part's area; half of the slots of a triangle stay empty.
        self.areas = numpy.repeat(numpy.concatenate(areas) / self._sides.astype("f8") ** 2, counts)
        self._tables = UInt32(firsts), UInt32(self._sides), UInt32(self._starts[:-1])

    def of(self, si: mitsuba.SurfaceInteraction3f, barycentric: mitsuba.Point2f) -> UInt32:
        """The part of a hit."""
        firsts, sides, starts = self._tables
        triangle = drjit.gather(UInt32, firsts, drjit.reinterpret_array(UInt32, si.shape)) + si.prim_index
        side = drjit.gather(UInt32, sides, triangle)
        u, v = (drjit.clip(value, 0.0, 0.999999) * side for value in (barycentric.x, barycentric.y))
        row, column = UInt32(u), UInt32(v)
        upper = (u - row) + (v - column) > 1.0
        return drjit.gather(UInt32, starts, triangle) + 2 * (row * side + column) + drjit.select(upper, 1, 0)


class World:
    """A scene without its lamps, which are apart."""

    def __init__(self, scene: Scene, folder: str, size: float) -> None:
        parts = {"type": "scene"}
        for number, mesh in enumerate(scene.meshes):
            file = f"{folder}/{number}.ply"
            write_ply(Path(file), mesh, mesh.normals)
            parts[f"mesh {number}"] = {"type": "ply", "filename": file, "face_normals": mesh.normals is None, "id": f"mesh {number}"}
            parts[f"mesh {number}"]["surface"] = bsdf(mesh.surface)
        self.scene = mitsuba.load_dict(parts, parallel=False, optimize=False)
        self.parts = Parts(self.scene, list(scene.meshes), size)
        box = self.scene.bbox()
        low, high = numpy.array(box.min).ravel(), numpy.array(box.max).ravel()
        self.lamps = Lamps(list(scene.lights), 0.5 * (low + high), float(numpy.linalg.norm(high - low)) / 2.0)
        self.bounces = scene.bounces

    def hit(self, ray: mitsuba.Ray3f, active: Bool) -> tuple[mitsuba.SurfaceInteraction3f, mitsuba.Point2f]:
        """What a ray meets, and where in the triangle."""
        found = self.scene.ray_intersect_preliminary(ray, coherent=False, active=active)
        return found.compute_surface_interaction(ray, mitsuba.RayFlags.All, active), found.prim_uv


@drjit.syntax
def photons(world: World, count: int, seed: int) -> tuple[numpy.ndarray, int]:
    """Flux of the caustics in every part, (parts, 3), of so many light paths."""
    sampler = mitsuba.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    ray, flux = world.lamps.ray(sampler.next_1d(), sampler.next_2d(), sampler.next_2d())
    flux = Colour(flux / count)
    sums = drjit.zeros(Float, 3 * world.parts.count)
    active, specular, depth = Bool(True), Bool(False), UInt32(0)
    context = mitsuba.BSDFContext(mitsuba.TransportMode.Importance)
    while active:
        si, barycentric = world.hit(ray, active)
        active &= si.is_valid()
        surface = si.bsdf(ray)
        smooth = mitsuba.has_flag(surface.flags(), mitsuba.BSDFFlags.Delta)
        part = world.parts.of(si, barycentric)
        kept = active & specular & ~smooth
        for k in range(3):
            drjit.scatter_add(sums, flux[k], 3 * part + k, kept)
        sample, weight = surface.sample(context, si, sampler.next_1d(active), sampler.next_2d(active), active)
        out = si.to_world(sample.wo)
        # What interpolated normals do to particles (Veach 1997, 5.3.2).
        turn = abs((drjit.dot(si.n, out) * si.wi.z) / (drjit.dot(si.n, si.to_world(si.wi)) * sample.wo.z))
        flux *= weight * drjit.select(smooth & drjit.isfinite(turn), turn, 1.0)
        specular = Bool(smooth)
        ray = si.spawn_ray(out)
        depth += 1
        # Roulette by what is left.
        stays = drjit.select(depth > 3, drjit.minimum(drjit.max(weight), 0.95), 1.0)
        active &= (depth <= world.bounces) & (drjit.max(flux) > 0.0) & (sampler.next_1d(active) < stays)
        flux *= drjit.select(depth > 3, 1.0 / stays, 1.0)
    return numpy.array(sums).reshape(-1, 3).astype("f8")


@drjit.syntax
def picture(
    world: World, camera: mitsuba.Sensor, irradiance: mitsuba.Float, size: tuple[int, int], samples: int, seed: int
) -> numpy.ndarray:
    """Radiance (height, width, 3) by the map."""
    width, height = size
    count = width * height * samples
    sampler = mitsuba.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    pixel = drjit.arange(UInt32, count) // samples
    x, y = Float(pixel % width), Float(pixel // width)
    jitter = sampler.next_2d()
    place = mitsuba.Point2f((x + jitter.x) / width, (y + jitter.y) / height)
    ray, _ = camera.sample_ray(0.0, 0.5, place, mitsuba.Point2f(0.5))
    throughput, radiance = Colour(1.0), Colour(0.0)
    active, diffused, depth = Bool(True), Bool(False), UInt32(0)
    context = mitsuba.BSDFContext()
    while active:
        si, barycentric = world.hit(ray, active)
        distance = drjit.select(si.is_valid(), si.t, drjit.inf)
        radiance += drjit.select(active & ~diffused, throughput * world.lamps.seen(ray, distance), 0.0)
        active &= si.is_valid()
        surface = si.bsdf(ray)
        smooth = mitsuba.has_flag(surface.flags(), mitsuba.BSDFFlags.Delta)
        # After a diffuse surface light by way of mirrors and glass is in the map already.
        active &= ~(diffused & smooth)
        matte = active & ~smooth
        part = world.parts.of(si, barycentric)
        stored = Colour(*(drjit.gather(Float, irradiance, 3 * part + k, matte) for k in range(3)))
        albedo = surface.eval_diffuse_reflectance(si, matte)
        radiance += drjit.select(matte, throughput * albedo * stored * drjit.inv_pi, 0.0)
        toward, away, weight = world.lamps.lit(si.p, sampler.next_1d(active), sampler.next_2d(active))
        # Both sides of a diffuse surface are alike.
        same = si.wi.z * si.to_local(toward).z
        lit = matte & (same > 0.0) & (drjit.max(weight) > 0.0)
        shadow = si.spawn_ray(toward)
        shadow.maxt = drjit.minimum(away * 0.9999, 1e5)
        lit &= ~world.scene.ray_test(shadow, coherent=False, active=lit)
        cosine = abs(si.to_local(toward).z)
        radiance += drjit.select(lit & (depth < world.bounces + 1), throughput * albedo * weight * cosine * drjit.inv_pi, 0.0)
        sample, share = surface.sample(context, si, sampler.next_1d(active), sampler.next_2d(active), active)
        throughput *= share
        diffused |= matte
        ray = si.spawn_ray(si.to_world(sample.wo))
        depth += 1
        stays = drjit.select(depth > 4, drjit.minimum(drjit.max(share), 0.95), 1.0)
        active &= (depth <= world.bounces) & (drjit.max(throughput) > 0.0) & (sampler.next_1d(active) < stays)
        throughput *= drjit.select(depth > 4, 1.0 / stays, 1.0)
    sums = [numpy.array(drjit.block_sum(radiance[k], samples)) for k in range(3)]
    return numpy.stack(sums, axis=1).reshape(height, width, 3).astype("f8") / samples


@drjit.syntax
def walked(world: World, count: int) -> int:
    """Segments of so many light paths under the rules of Mitsuba's `ptracer`."""
    sampler = mitsuba.load_dict({"type": "independent"})
    sampler.seed(0, count)
    ray, flux = world.lamps.ray(sampler.next_1d(), sampler.next_2d(), sampler.next_2d())
    throughput, active, depth, segments = Colour(1.0), Bool(True), UInt32(1), UInt32(0)
    del flux
    context = mitsuba.BSDFContext(mitsuba.TransportMode.Importance)
    while active:
        si, place = world.hit(ray, active)
        segments[active] += 1
        active &= si.is_valid()
        sample, weight = si.bsdf(ray).sample(context, si, sampler.next_1d(active), sampler.next_2d(active), active)
        throughput *= weight
        ray = si.spawn_ray(si.to_world(sample.wo))
        depth += 1
        active &= (depth < world.bounces + 2) & (drjit.max(throughput) > 0.0)
        stays = drjit.select(depth > ROULETTE, drjit.minimum(drjit.max(throughput), 0.95), 1.0)
        active &= sampler.next_1d(active) < stays
        throughput /= stays
    return int(drjit.sum(mitsuba.UInt64(segments))[0])
