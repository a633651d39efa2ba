# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's files may ask for and Gonio shows otherwise: one table, for the report's lines and for docs/unsupported.md."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Limit:
    """`what` is asked for, and `instead` is what the picture shows."""

    what: str
    instead: str
    severity: str = "WARNING"
    # Whether a line of the report tells it; else it is a small difference that the page alone names.
    is_told: bool = True

    def line(self, subject: str = "") -> str:
        """The report's words; `subject` says more exactly what was asked for."""
        return f"{subject or self.what}: not supported; {self.instead}"


def _quietly(what, instead):
    return Limit(what, instead, severity="INFO")


def _untold(what, instead):
    return Limit(what, instead, is_told=False)


OBJECTS = {
    "kind of object": Limit("Grease pencil", "left out"),
    "volume colours": Limit("Colours of volumes that vary from place to place, over more than 2²² points", "the mean colour; the density varies"),
    "volume size": Limit(
        "Densities of volume objects that are no multiple of one grid, over more than 2²⁵ voxels", "a multiple of that grid; they do not shine"
    ),
    "volume asks": Limit("Volume shaders that ask for more than grids, places, pictures and their object", "0 in its place"),
    "volume placements": Limit(
        "More than 64 placements of a mesh whose volume varies", "those beyond are even, as dense as the first is in the mean of its box"
    ),
    "mesh volumes": _untold(
        "Volumes of meshes that vary: what is finer than a 128th of the longest edge, forms that change while the shutter is open, what displacement pushes out "
        "of the box",
        "smooth between points; they keep the form of the frame; clear there",
    ),
    "volume visibility": _untold(
        "Ray visibility of objects that hold volumes, for rays that start inside", "they go through the volume as others do, and do not see its end"
    ),
    "volume groups": _untold("Light groups of what worlds' haze sends", "among the lights of no group"),
    "open volumes": _untold(
        "Volumes of meshes that are open, or whose normals look inwards, before nothing",
        "endless, as deep as they look, but for their light; Cycles leaves them off rays that meet nothing",
    ),
    "volume extent": _untold(
        "Emission of volume objects where their grids hold nothing", "it ends a voxel beyond what they hold; in Cycles with blocks of 8³ voxels"
    ),
    "temperatures": _untold(
        "Temperatures between voxels: since 5.0 Cycles mixes the light of voxels",
        "temperatures are mixed; less light in coarse fire, 9 % over 12 voxels",
    ),
    "volume settings": _untold(
        "Precision, clipping and step size of volume objects, cubic interpolation",
        "full precision, trilinear and without steps",
    ),
    "curve types": _untold("Hair curves of the types Poly, Bézier and NURBS", "drawn through their points, as in Cycles"),
    "shadowless lamps": _untold(
        "Light of lamps without shadows that scattered rays would find behind what stands in between",
        "that part is blocked, as in Cycles: little on matt surfaces, up to two fifths on glossy ones",
    ),
    "within a lamp": _untold(
        "Light of lamps with *Soft Falloff* off within their own ball", "none: they shine outwards alone; Cycles lights what is in there"
    ),
    "catcher's lamp": _quietly("Lamps whose light shadow catchers leave out of account", "it counts as all others"),
    "adaptive subdivision": _untold(
        "Dicing camera and offscreen scale of adaptive subdivision", "the camera that renders; four times the length beside its picture"
    ),
    "culling": Limit("Culling of objects by camera or distance", "nothing is culled"),
    "shadow caustics": _quietly("Marks of shadow caustics on objects and lights", "light paths bring all caustics, where *Caustics* is on"),
    "shadow terminator": _quietly("Shading offset of the shadow terminator", "left out; the geometry offset is followed"),
}

SCENES = {
    "motion blur": _untold(
        "Motion blur of faces that change without a velocity attribute, of widths of hair and points, of lenses that zoom, of worlds, and in "
        "the viewport",
        "these stand still at the frame",
    ),
    "bake": _untold("Bakes of the kind Shadow", "refused by name"),
    "bake denoising": Limit("Denoising of bakes where Blender's Python has no package pyoidn", "the bake keeps its noise"),
    "spherical stereo": _untold("Spherical stereo of panoramas", "each eye's picture is seen from where it stands"),
    "freestyle": Limit("Freestyle lines", "left out"),
    "fast gi": Limit("Fast GI Approximation", "light is followed to the last bounce"),
    "filter glossy": _quietly("Filter Glossy other than 1", "reflections stay as sharp as they are"),
    "noise": _untold(
        "Cycles' settings of noise and speed alone: light tree, how path guiding learns, sampling pattern, light threshold, least bounces, tiles, devices",
        "Gonio's own ways",
    ),
    "pass": Limit("The Shadow pass of EEVEE, which Cycles has no more", "absent"),
    "catcher's passes": _untold("Illuminance and light passes where shadow catchers are", "empty there"),
    "panorama": Limit("Panoramas beyond equirectangular and fisheye ones", "an equirectangular one"),
    "kind of camera": Limit("Cameras of custom types", "a perspective one"),
    "tone map in animations": _untold(
        "*Tone Map in Gonio* in animations: an eye that adapts over the frames", "each frame by itself; *Fixed Exposure* for all alike"
    ),
    "frame": _quietly("Resolution, border and pixel aspect that change while an animation is rendered", "those of its start, as in Cycles"),
    "working space": _untold(
        "Working spaces ACEScg and Rec.2020",
        "colours come in and go out by the configuration's matrix, light is reckoned in linear Rec.709; saturated colours under coloured light "
        "differ from Cycles",
    ),
    "views by wavelength": _quietly("*Render by Wavelength* of stereoscopic scenes", "the view of the scene's camera alone"),
    "quick denoiser": _untold(
        "The viewport's quick denoiser in false colour and in final renders", "the picture as it is; *Denoise* of *Sampling*"
    ),
}

LIGHTS = {
    "textured lamp": Limit(
        "Textures and other values that vary over suns, discs, lamps in photometric units or with an IES texture",
        "it shines evenly with their mean",
    ),
    "light falloff": Limit("Light falloffs of suns, several in one lamp, or with smoothing that varies", "suns stay even, the first one counts, unsmoothed"),
    "lamp's light path": Limit("Light Path in lamps: kinds of rays", "every ray counts as one of no kind, as those that light the scene"),
    "lamp's attribute": Limit("Attribute nodes in lamps: those of objects, instancers and view layers", "the value 0"),
    "lamp's tangent": Limit("Tangents in lamps and worlds", "directions around the lamp's axis, 0 in worlds; Cycles' Geometry node makes both dark"),
    "aslant": Limit(
        "Area lamps that ask where they are seen from: Incoming, Reflection, Fresnel, Layer Weight", "all of their light is as seen straight on"
    ),
    "lamp bounces": Limit("Most bounces of one light", "the scene's number"),
    "ies elsewhere": Limit(
        "IES textures in worlds, of types A and B on surfaces, with a vector or more than one a lamp", "even light of the strength"
    ),
    "shining meshes": _untold("Photometric units of meshes that shine", "emission in W/m², times 177.83 lm/W"),
    "catcher's groups": _untold("Light groups of shadow catchers", "without what the catcher leaves out"),
}

WORLDS = {
    "world volume": Limit("Volume shaders of worlds that are no volume's", "the air stays clear"),
    "uneven air": _quietly(
        "Volumes of worlds that vary: what is finer than 2²¹ points about the scene, or than 2048 along one axis; what is further off than half the "
        "size of the scene, twice its size where the volume varies along two axes, eight times along one",
        "smooth between points; the value of the nearest point for one and a half times as much, then clear air; 10 km along axes that do not count",
    ),
    "world's light path": Limit("Light Path in worlds: all but camera rays", "the others are not told apart, and count as 0"),
    "world aov": Limit("Shader AOVs of worlds", "their passes show surfaces alone"),
    "sun behind nodes": Limit("Sky Texture: the sun's disc where other nodes change the sky", "the disc is left out"),
    "sky elsewhere": Limit("Sky Texture on lamps", "an even sky of its usual brightness"),
    "limb": _untold("Sky Texture: darkening towards the disc's limb, reddening from its top to its foot", "an even disc as bright"),
    "skies": _untold(
        "Sky Texture in worlds: pictures of 512 rows; atmospheres drawn anew", "within 1 % of Cycles in the median of the picture"
    ),
    "twilight": _untold("Twilight in the *Daylight* panel", "no light while the sun is down"),
}

MATERIALS = {
    "volume shader": Limit("Shaders of volume objects that are no volume's", "Principled Volume as it is made"),
    "varying phase": Limit("Numbers of phase functions of volumes that vary from place to place", "the value of their socket"),
    "volume": Limit("Volume shaders of meshes that are no volume's", "the inside stays empty; without a surface, rays pass"),
    "phase": Limit("Sums of volumes of several phase functions in one shader", "Henyey and Greenstein's of the same mean cosine"),
    "camera in volume": _untold(
        "Volumes whose surface goes through a lens or a parallel view; volumes around baked surfaces",
        "what the middle of the lens stands in counts for all of it; the texels' surroundings are clear",
    ),
    "volume as surface": Limit("Volume shaders in a Surface socket", "black, as in Cycles"),
    "bump correction": _quietly("Bump Map Correction that is switched off", "it stays on"),
    "closure": Limit("Other shaders that are named in the report", "a diffuse surface of its colour"),
    "absent": Limit("Shader to RGB, Specular BSDF, Squeeze Value and UV Along Stroke", "as if nothing were linked, as in Cycles"),
    "blurred bevel": _untold("Bevel in blurred reflections of glossy surfaces", "edges are rounded there too"),
    "distribution": Limit("Distributions of microfacets beyond GGX, Beckmann and Ashikhmin-Shirley", "GGX"),
    "varying thin wall": Limit("Thin Wall that varies", "the surface is solid"),
    "thin walls": _untold(
        "Thin walls as Cycles has them, by the mean of both polarisations",
        "each polarisation by itself, as panes are; up to 3 % apart near 75°",
    ),
    "instancer's attribute": Limit(
        "Attributes of instances whose IDs stand twice", "the instancer's property, else the object's own, else 0"
    ),
    "nodes in a row": Limit("More than 1000 nodes in a row", "the value before them is 0"),
    "repeat": Limit("Repeat zones of more than 512 turns, or whose number varies", "512 turns; none"),
    "many closures": Limit("More than 64 shaders in one material", "the rest is left out"),
    "mixed as light": _untold(
        "Image textures of sRGB's bytes whose colour and alpha are both in use, or of 16 bits, between texels",
        "mixed as light; Cycles mixes the codes",
    ),
    "painted tiles": _untold("Image tiles that were painted and never saved", "not seen"),
    "node": Limit("Other nodes, named in the report", "their main input is passed on; without one, the value of their socket is used"),
}

LIMITS = {**OBJECTS, **SCENES, **LIGHTS, **WORLDS, **MATERIALS}

# Nodes, or one of their outputs, that have a value of their own in the place of theirs.
# bl_idname, or bl_idname and the output's identifier -> the names that the page has for them, and the value.
STAND_INS = {
    "ShaderNodeTexMusgrave": ("Musgrave Texture", 0.5),
    "ShaderNodeTexPointDensity": ("Point Density", 0.0),
    "ShaderNodeCameraData": ("Camera Data in worlds and lamps", 1.0),
    ("ShaderNodeTexCoord", "Window"): ("Texture Coordinate: Window in lamps and panoramas, and in worlds without perspective", 0.5),
    ("ShaderNodeTexCoord", "Camera"): ("Texture Coordinate: Camera in lamps", 0.5),
}


def rows() -> list[tuple[str, str]]:
    """The rows of the page's table of Blender: what, and what happens instead."""
    found = [(limit.what, limit.instead) for limit in LIMITS.values()]
    by_value: dict[float, list[str]] = {}
    for name, value in STAND_INS.values():
        by_value.setdefault(value, []).append(name)
    return found + [(", ".join(names), f"the value {value:g}") for value, names in by_value.items()]


def page() -> str:
    """The page's part on Blender, below its heading."""
    table = "\n".join(f"| {what} | {instead} |" for what, instead in rows())
    return f"| what | what happens instead |\n| --- | --- |\n{table}\n"
