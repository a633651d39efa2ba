"""Lamps of one kind for the reference: rays from them, points on them, and whether a ray meets them; they block nothing, as in gonio."""

import math

import drjit
import mitsuba
import numpy
from description import Disk, Light, Rectangle, Sphere, Sun

# Needs a variant of Mitsuba to be set before this module is imported.
Float, UInt32, Vector, Point, Ray = mitsuba.Float, mitsuba.UInt32, mitsuba.Vector3f, mitsuba.Point3f, mitsuba.Ray3f


class Lamps:
    """All lamps of a scene whose bounding sphere is `centre`, `radius`; they have the same kind and size."""

    def __init__(self, lights: list[Light], centre: numpy.ndarray, radius: float) -> None:
        first = self.first = lights[0]
        assert all(type(light) is type(first) for light in lights)
        self.count = len(lights)
        self._centre, self._radius = Point(centre.tolist()), radius
        self._frames = mitsuba.TensorXf(numpy.array([light.matrix[:3] for light in lights], "f4")).array
        self._radiance = Float(numpy.array([light.radiance for light in lights], "f4").ravel())
        match first:
            case Rectangle(_, width, height):
                self.area = width * height
            case Disk(_, size):
                self.area = math.pi * size**2
            case Sphere(_, size):
                self.area = 4.0 * math.pi * size**2
            case Sun(_, angle):
                self.cosine = math.cos(math.radians(angle) / 2.0)
                self.area = 2.0 * math.pi * (1.0 - self.cosine)

    def radiance(self, lamp: UInt32) -> mitsuba.Color3f:
        """In cd/m²."""
        return drjit.gather(mitsuba.Color3f, self._radiance, lamp)

    def chosen(self, number: Float) -> UInt32:
        """A lamp, all alike."""
        return UInt32(drjit.minimum(number * self.count, self.count - 1))

    def axis(self, lamp: UInt32, column: int) -> Vector:
        """A column of its frame; the fourth is its place."""
        return Vector(*(drjit.gather(Float, self._frames, 12 * lamp + 4 * row + column) for row in range(3)))

    def across(self, lamp: UInt32, place: Vector) -> Vector:
        """From its frame to the scene's, for directions."""
        return sum((self.axis(lamp, column) * place[column] for column in range(3)), Vector(0.0))

    def point(self, lamp: UInt32, number: mitsuba.Point2f) -> tuple[Point, Vector]:
        """A point on it and the normal there, all points alike."""
        match self.first:
            case Rectangle(_, width, height):
                place, normal = Vector((number.x - 0.5) * width, (number.y - 0.5) * height, 0.0), Vector(0.0, 0.0, -1.0)
            case Disk(_, size):
                disk = mitsuba.warp.square_to_uniform_disk(number)
                place, normal = Vector(disk.x * size, disk.y * size, 0.0), Vector(0.0, 0.0, -1.0)
            case Sphere(_, size):
                normal = mitsuba.warp.square_to_uniform_sphere(number)
                place = normal * size
        return Point(self.axis(lamp, 3) + self.across(lamp, place)), self.across(lamp, normal)

    def ray(self, number: Float, first: mitsuba.Point2f, second: mitsuba.Point2f) -> tuple[Ray, mitsuba.Color3f]:
        """A ray with its share of the flux if it were the only one."""
        lamp = self.chosen(number)
        if isinstance(self.first, Sun):
            direction = -self._toward_sun(lamp, first)
            disk = mitsuba.warp.square_to_uniform_disk_concentric(second)
            frame = mitsuba.Frame3f(direction)
            origin = self._centre + self._radius * (frame.s * disk.x + frame.t * disk.y - 1.1 * direction)
            return Ray(origin, direction), self.radiance(lamp) * (self.count * self.area * math.pi * self._radius**2)
        place, normal = self.point(lamp, first)
        direction = mitsuba.Frame3f(normal).to_world(mitsuba.warp.square_to_cosine_hemisphere(second))
        return Ray(place + 1e-6 * normal, direction), self.radiance(lamp) * (self.count * self.area * math.pi)

    def lit(self, place: Point, number: Float, second: mitsuba.Point2f) -> tuple[Vector, Float, mitsuba.Color3f]:
        """A direction in which a place may see a lamp, how far it is, and its radiance over the density per solid angle."""
        lamp = self.chosen(number)
        if isinstance(self.first, Sun):
            return self._toward_sun(lamp, second), Float(1e6), self.radiance(lamp) * (self.count * self.area)
        there, normal = self.point(lamp, second)
        distance = drjit.norm(there - place)
        direction = (there - place) / distance
        weight = drjit.maximum(-drjit.dot(normal, direction), 0.0) * self.area * self.count / drjit.square(distance)
        return direction, distance, self.radiance(lamp) * weight

    def seen(self, ray: Ray, distance: Float) -> mitsuba.Color3f:
        """What lamps add to a ray that meets a surface at a distance, or none at infinity."""
        found = mitsuba.Color3f(0.0)
        for number in range(self.count):
            lamp = UInt32(number)
            hit = self._met(lamp, ray, distance)
            found += drjit.select(hit, self.radiance(lamp), 0.0)
        return found

    def _met(self, lamp: UInt32, ray: Ray, distance: Float) -> mitsuba.Bool:
        shining, offset = -self.axis(lamp, 2), self.axis(lamp, 3) - ray.o
        match self.first:
            case Sun():
                return ~drjit.isfinite(distance) & (drjit.dot(ray.d, -shining) > self.cosine)
            case Sphere(_, size):
                along = drjit.dot(offset, ray.d)
                beside = drjit.square(size) - (drjit.squared_norm(offset) - drjit.square(along))
                return (beside > 0.0) & (along > 0.0) & (along < distance)
        along = drjit.dot(offset, shining) / drjit.dot(ray.d, shining)
        local = ray.d * along - offset
        x, y = drjit.dot(local, self.axis(lamp, 0)), drjit.dot(local, self.axis(lamp, 1))
        match self.first:
            case Rectangle(_, width, height):
                within = (abs(x) < width / 2) & (abs(y) < height / 2)
            case Disk(_, size):
                within = drjit.square(x) + drjit.square(y) < size**2
        return within & (along > 1e-5) & (along < distance) & (drjit.dot(ray.d, shining) < 0.0)

    def _toward_sun(self, lamp: UInt32, number: mitsuba.Point2f) -> Vector:
        local = mitsuba.warp.square_to_uniform_cone(number, self.cosine)
        return mitsuba.Frame3f(self.axis(lamp, 2)).to_world(local)
