"""Each volume shader, in balls over a lit floor."""

import bpy
from scenes_media import inside, medium, scattered, shaded
from stage import blank, lit_floor, node, rows_of_balls


def balls(*covers: bpy.types.Material, bounces: int = 2) -> None:
    """Balls of media beside each other."""
    scattered(bounces)
    lit_floor()
    rows_of_balls(list(covers), len(covers))


def absorption() -> None:
    balls(medium("VolumeAbsorption", Color=(0.9, 0.5, 0.2), Density=2.0), medium("VolumeAbsorption", Color=(0.1, 0.5, 0.8), Density=0.8))


def phases(phase: str, *values: dict, kind: str = "VolumeScatter", **common) -> None:
    """Balls that scatter by one function with other numbers each."""
    balls(*(medium(kind, phase=phase, **common, **each) for each in values))


SCATTERED = {"Color": (0.9, 0.7, 0.5), "Density": 2.0}


def scatter_henyey_greenstein() -> None:
    phases("HENYEY_GREENSTEIN", {"Anisotropy": 0.0}, {"Anisotropy": 0.8}, {"Anisotropy": -0.6}, **SCATTERED)


def scatter_rayleigh() -> None:
    phases("RAYLEIGH", {"Density": 1.0}, {"Density": 5.0}, Color=(0.5, 0.7, 0.95))


def scatter_draine() -> None:
    # Small anisotropy with large alpha is left out: Cycles' inversion loses all digits there.
    phases("DRAINE", {"Anisotropy": 0.5, "Alpha": 0.5}, {"Anisotropy": 0.7, "Alpha": 20.0}, {"Anisotropy": -0.3, "Alpha": 1.0}, **SCATTERED)


def scatter_fournier_forand() -> None:
    numbers = [{"IOR": ior, "Backscatter": back} for ior, back in ((1.33, 0.1), (1.1, 0.02), (1.5, 0.3))]
    phases("FOURNIER_FORAND", *numbers, **SCATTERED)


def scatter_mie() -> None:
    # By the exact function Cycles has up to 4 % too much light after three scatterings under a sky; its share lit by lamps once is right.
    phases("MIE", {"Diameter": 3.0}, {"Diameter": 20.0}, {"Diameter": 50.0}, **SCATTERED)


def coefficients() -> None:
    """Numbers beyond what colours reach, two phase functions, and one that shines."""
    taken = {"Absorption_Coefficients": (0.2, 1.0, 2.5), "Scatter_Coefficients": (3.0, 1.5, 0.5)}
    shining = {"Emission_Coefficients": (0.3, 0.15, 0.05), "Absorption_Coefficients": (0.5, 0.5, 0.5)}
    balls(
        medium("VolumeCoefficients", Anisotropy=0.6, **taken),
        medium("VolumeCoefficients", phase="DRAINE", Anisotropy=0.4, Alpha=3.0, **taken),
        medium("VolumeCoefficients", **shining),
    )


def principled_volume() -> None:
    """Tinted smoke, what absorbs a colour of its own, and what shines by itself and as a black body."""
    balls(
        medium("VolumePrincipled", Color=(0.8, 0.5, 0.3), Density=2.0, Anisotropy=0.4),
        medium("VolumePrincipled", Color=(0.3, 0.5, 0.6), Density=2.0, Absorption_Color=(0.9, 0.3, 0.1)),
        medium("VolumePrincipled", Color=(0.4, 0.4, 0.4), Density=1.0, Emission_Strength=0.3, Emission_Color=(0.3, 0.6, 1.0)),
        medium("VolumePrincipled", Density=0.5, Blackbody_Intensity=1.0, Temperature=1700.0, Blackbody_Tint=(1.0, 0.9, 0.8)),
    )


def emission() -> None:
    """What shines and takes nothing."""
    balls(medium("Emission", Color=(1.0, 0.6, 0.3), Strength=0.4), medium("Emission", Color=(0.3, 0.6, 1.0), Strength=2.0))


def together(kind: str, first: tuple, second: tuple, **values) -> bpy.types.Material:
    """Two shaders, (kind, inputs) each, added or mixed."""
    made, tree = blank(kind)
    ends = [node(tree, f"ShaderNode{name}", **inputs).outputs[0] for name, inputs in (first, second)]
    joined = node(tree, f"ShaderNode{kind}", **values)
    for end, sockets in zip(ends, [each for each in joined.inputs if each.type == "SHADER"], strict=True):
        tree.links.new(end, sockets)
    inside(tree, joined)
    return made


HAZE = ("VolumeScatter", {"Color": (0.9, 0.6, 0.3), "Density": 2.0, "Anisotropy": 0.3})
DYE = ("VolumeAbsorption", {"Color": (0.3, 0.5, 0.9), "Density": 1.5})
GLOW = ("Emission", {"Color": (0.3, 1.0, 0.5), "Strength": 0.3})


def added() -> None:
    balls(together("AddShader", HAZE, DYE), together("AddShader", HAZE, GLOW), together("AddShader", DYE, GLOW))


def mixed() -> None:
    balls(*(together("MixShader", HAZE, other, Fac=share) for other, share in ((DYE, 0.3), (GLOW, 0.7), (DYE, 0.9))))


def varied() -> None:
    """Fog in meshes by coordinates and noise: a gradient, layers, clouds."""
    covers = []
    for kind in ("gradient", "noise", "position"):
        made, tree, shader = shaded("VolumePrincipled", Color=(0.8, 0.7, 0.6), Anisotropy=0.3)
        place = node(tree, "ShaderNodeTexCoord")
        if kind == "gradient":
            apart = node(tree, "ShaderNodeSeparateXYZ", Vector=place.outputs["Generated"])
            value = apart.outputs["Z"]
        elif kind == "noise":
            value = node(tree, "ShaderNodeTexNoise", Vector=place.outputs["Object"], Scale=4.0, Detail=1.0).outputs[0]
        else:
            where = node(tree, "ShaderNodeNewGeometry").outputs["Position"]
            value = node(tree, "ShaderNodeTexWave", Vector=where, Scale=1.5).outputs[1]
        scaled = node(tree, "ShaderNodeMath", operation="MULTIPLY")
        tree.links.new(value, scaled.inputs[0])
        scaled.inputs[1].default_value = 4.0
        tree.links.new(scaled.outputs[0], shader.inputs["Density"])
        covers.append(made)
    balls(*covers)
