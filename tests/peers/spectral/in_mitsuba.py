"""A room in a spectral variant of Mitsuba 3: run by a Python that has `mitsuba`.

    python in_mitsuba.py VARIANT ROOM SPECTRA.json THREADS

Answers in lines of JSON: first with its version and its own XYZ of the lamp, then, for each line `{"samples": ..., "seed": ..., "file": ...}`,
with what the picture cost. Pictures are XYZ (height, width, 3) with Y in cd/m².
"""

import json
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "validate")]

# What the renderer prints must not come between the answers.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)

import drjit  # noqa: E402
import mitsuba  # noqa: E402
import numpy  # noqa: E402
from coloured_rooms import (  # noqa: E402
    BOUNCES,
    HEIGHT,
    LAMP_CENTRE,
    LAMP_DEPTH,
    LAMP_WIDTH,
    ROOMS,
    WIDTH,
    Gloss,
    Metal,
    Room,
    Surface,
    camera_matrix,
)
from cornell import Colour, Diffuse, Glass  # noqa: E402
from cornell_mitsuba import write_ply  # noqa: E402
from processor import processor_seconds  # noqa: E402

# Mitsuba's Y is the integral of radiance and the observer over this (MI_CIE_Y_NORMALIZATION); a cd/m² is K_m times that integral.
Y_NORMALIZATION, EFFICACY = 106.7502593994140625, 683.002


class Spectra:
    """The spectra told, as Mitsuba's plugins."""

    def __init__(self, file: Path) -> None:
        told = json.loads(file.read_text())
        self._nm, self._reflectances = told["nm"], told["reflectances"]
        self._lamp = EFFICACY * Y_NORMALIZATION * numpy.array(told["lamp"])
        self.lamp = self._plugin(self._lamp)

    def lamp_xyz(self) -> list[float]:
        """The lamp's XYZ by Mitsuba's table of the observer, which has steps of 5 nm."""
        steps = numpy.arange(self._nm[0], self._nm[-1] + 0.05, 0.1)
        observer = numpy.array([list(mitsuba.cie1931_xyz(float(nm))) for nm in steps])
        power = numpy.interp(steps, self._nm, self._lamp) / Y_NORMALIZATION
        return [float(numpy.trapezoid(column * power, steps)) for column in observer.T]

    def reflectance(self, colour: Colour) -> dict[str, Any]:
        """What a colour means."""
        return self._plugin(self._reflectances[repr(colour)])

    def _plugin(self, values: Any) -> dict[str, Any]:
        nm, powers = (", ".join(repr(float(value)) for value in row) for row in (self._nm, values))
        return {"type": "irregular", "wavelengths": nm, "values": powers}


def main(variant: str, name: str, spectra: Path, threads: int) -> None:
    """Lays out the room, then renders for as long as it is asked to."""
    mitsuba.set_variant("scalar_spectral")
    told = Spectra(spectra)
    lamp_xyz = told.lamp_xyz()
    mitsuba.set_variant(variant)
    drjit.set_thread_count(threads)
    with tempfile.TemporaryDirectory() as folder:
        scene = mitsuba.load_dict(laid_out(ROOMS[name](), told, Path(folder)))
    llvm = f", LLVM {drjit.detail.llvm_version()}" if variant.startswith("llvm") else ""
    answer(version=f"Mitsuba {mitsuba.__version__} {variant}{llvm}", lamp_xyz=lamp_xyz)
    for line in sys.stdin:
        asked = json.loads(line)
        before = processor_seconds()
        picture = numpy.array(mitsuba.render(scene, spp=asked["samples"], seed=asked["seed"]))
        used = processor_seconds() - before
        numpy.save(asked["file"], picture[:, :, :3].astype("f8"))
        answer(processor=used)


def answer(**values: Any) -> None:
    """A line for who asked."""
    answers.write(json.dumps(values) + "\n")
    answers.flush()


def laid_out(room: Room, spectra: Spectra, folder: Path) -> dict[str, Any]:
    """The room as Mitsuba's dictionary."""
    parts: dict[str, Any] = {"type": "scene", "integrator": {"type": "path", "max_depth": BOUNCES + 2, "rr_depth": 8}}
    parts |= {"camera": camera(room), "lamp": lamp(room, spectra)}
    for number, part in enumerate(room.parts):
        file = folder / f"{number}.ply"
        write_ply(file, part)
        parts[f"mesh {number}"] = {"type": "ply", "filename": str(file), "face_normals": True, "surface": bsdf(part.surface, spectra)}
    return parts


def bsdf(surface: Surface, spectra: Spectra) -> dict[str, Any]:
    """A surface, outer side and inner side alike unless light passes."""
    inner: dict[str, Any]
    match surface:
        case Diffuse(colour):
            inner = {"type": "diffuse", "reflectance": spectra.reflectance(colour)}
        case Glass(ior):
            return {"type": "dielectric", "int_ior": ior, "ext_ior": 1.0}
        case Gloss(colour, roughness):
            inner = {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": roughness**2}
            inner |= {"specular_reflectance": spectra.reflectance(colour)}
        case Metal(colour, roughness):
            inner = {"type": "principled", "base_color": spectra.reflectance(colour), "metallic": 1.0, "roughness": roughness}
        case _:
            raise NotImplementedError(surface)
    return {"type": "twosided", "bsdf": inner}


def lamp(room: Room, spectra: Spectra) -> dict[str, Any]:
    """The sky, or the rectangle with the ceiling's reflectance; Mitsuba's spans -1 to 1 and shines along its local +z."""
    if room.ceiling is None:
        return {"type": "constant", "radiance": spectra.lamp}
    x, y, z = LAMP_CENTRE
    place = mitsuba.ScalarTransform4f().look_at(origin=[x, y, z], target=[x, 0.0, z], up=[0.0, 0.0, 1.0])
    size = mitsuba.ScalarTransform4f().scale([0.5 * LAMP_WIDTH, 0.5 * LAMP_DEPTH, 1.0])
    ceiling = {"type": "diffuse", "reflectance": spectra.reflectance(room.ceiling)}
    return {"type": "rectangle", "to_world": place @ size, "emitter": {"type": "area", "radiance": spectra.lamp}, "surface": ceiling}


def camera(room: Room) -> dict[str, Any]:
    """A pinhole with a box filter one pixel wide; Mitsuba's looks along +z, with x to the left."""
    film = {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "rfilter": {"type": "box"}, "pixel_format": "xyz"}
    return {
        "type": "perspective",
        "fov": room.fov,
        "fov_axis": "y",
        "near_clip": 0.01,
        "to_world": mitsuba.ScalarTransform4f(camera_matrix(room) @ numpy.diag([-1.0, 1.0, -1.0, 1.0])),
        "sampler": {"type": "multijitter"},
        "film": film | {"component_format": "float32"},
    }


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]), int(sys.argv[4]))
