"""Materials as people build them, of what grows and lies: wood, marble, skin, terrain by slope."""

import bpy
import numpy
from stage import ball, resolution
from trees import begun, inner, lit, on_stage, sheet


def grain() -> bpy.types.NodeTree:
    """A group: rings around an axis, and fibres along it."""
    made, t, start, end = inner("Grain", {"Vector": "Vector", "Rings": "Float"}, {"Ring": "Float", "Fibre": "Float"})
    place, rings = start.outputs["Vector"], start.outputs["Rings"]
    drift = t.noise(place, 1.5, "Color", Detail=3.0, Roughness=0.6)
    bent = t.vector("MULTIPLY_ADD", t.vector("SUBTRACT", drift, (0.5, 0.5, 0.5)), (0.35, 0.35, 0.1), place)
    wave = t.make(
        "TexWave", "Fac", wave_type="RINGS", rings_direction="Z", wave_profile="SAW", Vector=bent, Scale=rings, Distortion=1.5, Detail=2.0
    )
    fibres = t.noise(t.make("Mapping", Vector=bent, Scale=(30.0, 30.0, 1.2)), 2.0, Detail=4.0, Roughness=0.7, Distortion=0.2)
    t.tree.links.new(wave, end.inputs["Ring"])
    t.tree.links.new(fibres, end.inputs["Fibre"])
    return made


def wood() -> None:
    """Rings and fibres from a group, a tint for each object, pores that lower the varnish."""
    made, t = begun("Wood")
    place = t.place(Scale=(1.0, 1.0, 0.35), Rotation=(1.3, 0.2, 0.0))
    shift = t.make("CombineXYZ", X=t.make("ObjectInfo", "Random"), Y=0.3)
    parts = t.group(grain(), Vector=t.vector("ADD", place, shift), Rings=3.2)
    ring = t.make("FloatCurve", Value=parts.outputs["Ring"])
    colour = t.ramp(ring, (0.0, (0.10, 0.03, 0.01)), (0.35, (0.32, 0.13, 0.045)), (0.8, (0.5, 0.25, 0.1)), (1.0, (0.22, 0.08, 0.03)))
    fibre = t.spread(parts.outputs["Fibre"], 0.3, 0.7)
    colour = t.mix(0.55, colour, t.ramp(fibre, (0.2, (0.25, 0.2, 0.15)), (0.8, (1.0, 1.0, 1.0))), "MULTIPLY")
    pores = t.math("LESS_THAN", t.cells(t.vector("MULTIPLY", place, (40.0, 40.0, 3.0)), 1.0), 0.18)
    colour = t.mix(t.math("MULTIPLY", pores, 0.6), colour, (0.03, 0.012, 0.006))
    tint = t.make(
        "HueSaturation", Hue=0.49, Saturation=0.9, Value=t.spread(t.make("ObjectInfo", "Random"), 0.0, 1.0, 0.8, 1.2), Color=colour
    )
    height = t.math("SUBTRACT", t.math("MULTIPLY_ADD", ring, 0.3, t.math("MULTIPLY", fibre, 0.5)), pores)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=tint,
            Roughness=t.spread(fibre, 0.0, 1.0, 0.35, 0.6),
            Normal=t.bump(height, 0.4, 0.02),
            Coat_Weight=t.spread(pores, 0.0, 1.0, 0.5, 0.1),
            Coat_Roughness=0.15,
        )
    )
    on_stage(made)


def marble() -> None:
    """Bent space, three kinds of veins, a polish with smudges."""
    made, t = begun("Marble")
    place = t.place(Scale=(1.2, 1.2, 1.2), Rotation=(0.3, 0.5, 0.1))
    warp = t.noise(place, 1.8, "Color", Detail=6.0, Roughness=0.55)
    bent = t.vector("ADD", place, t.scaled(t.vector("SUBTRACT", warp, (0.5, 0.5, 0.5)), 0.8))
    wave = t.make("TexWave", "Fac", bands_direction="DIAGONAL", Vector=bent, Scale=1.1, Distortion=6.0, Detail=4.0, Detail_Scale=1.4)
    broad = t.ramp(wave, (0.0, (0.25, 0.27, 0.3)), (0.3, (0.75, 0.75, 0.74)), (1.0, (0.92, 0.9, 0.86)), interpolation="EASE")
    crack = t.cells(bent, 2.2, feature="DISTANCE_TO_EDGE", Randomness=1.0)
    vein = t.math("POWER", t.math("SUBTRACT", 1.0, t.spread(crack, 0.0, 0.08), use_clamp=True), 2.0)
    vein = t.math("MULTIPLY", vein, t.noise(place, 3.0, noise_type="RIDGED_MULTIFRACTAL", Detail=5.0, Offset=0.9, Gain=1.5))
    colour = t.mix(t.math("MINIMUM", vein, 0.8), broad, (0.16, 0.13, 0.1))
    gold = t.ramp(t.noise(bent, 4.0, noise_type="HETERO_TERRAIN", Detail=3.0, Offset=0.2), (0.45, (0.0, 0.0, 0.0)), (0.8, (1.0, 1.0, 1.0)))
    colour = t.mix(t.math("MULTIPLY", gold, 0.4), colour, (0.6, 0.42, 0.2), "OVERLAY")
    colour = t.make("BrightContrast", Color=colour, Bright=0.02, Contrast=0.1)
    smudge = t.noise(t.place("Generated"), 6.0, Detail=8.0, Roughness=0.65, Distortion=1.0)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=colour,
            Roughness=t.spread(smudge, 0.3, 0.7, 0.12, 0.35, interpolation_type="SMOOTHSTEP"),
            IOR=1.55,
            Normal=t.bump(vein, 0.3, 0.02, invert=True),
        )
    )
    on_stage(made)


def skin() -> None:
    """Blotches under the surface, pores in two sizes, an oily sheen at the edge."""
    made, t = begun("Skin")
    place = t.place(Scale=(1.5, 1.5, 1.5))
    blotch = t.noise(place, 2.5, Detail=4.0, Roughness=0.6)
    redness = t.ramp(blotch, (0.3, (0.7, 0.42, 0.32)), (0.55, (0.8, 0.5, 0.4)), (0.75, (0.75, 0.32, 0.26)))
    freckle = t.math("LESS_THAN", t.cells(place, 9.0, Randomness=1.0), t.spread(t.noise(place, 30.0, Detail=1.0), 0.3, 0.7, 0.02, 0.22))
    colour = t.mix(t.math("MULTIPLY", freckle, 0.5), redness, (0.35, 0.15, 0.08))
    veins = t.make("TexWave", "Fac", Vector=place, Scale=1.0, Distortion=9.0, Detail=3.0)
    colour = t.mix(t.math("MULTIPLY", t.math("POWER", veins, 8.0), 0.15), colour, (0.35, 0.3, 0.5))
    large = t.cells(place, 22.0, feature="SMOOTH_F1", Smoothness=0.4)
    small = t.cells(t.vector("ADD", place, t.scaled(t.noise(place, 6.0, "Color"), 0.05)), 60.0, feature="F2")
    height = t.math("ADD", t.math("MULTIPLY", large, 0.7), t.math("MULTIPLY", small, 0.3))
    rim = t.make("LayerWeight", "Facing", Blend=0.3)
    t.end(
        t.make(
            "BsdfPrincipled",
            subsurface_method="RANDOM_WALK",
            Base_Color=colour,
            Subsurface_Weight=t.spread(blotch, 0.3, 0.7, 0.8, 1.0),
            Subsurface_Radius=(1.0, 0.35, 0.2),
            Subsurface_Scale=0.08,
            Roughness=t.math("SUBTRACT", t.spread(large, 0.0, 0.6, 0.4, 0.6), t.math("MULTIPLY", rim, 0.1)),
            IOR=1.4,
            Sheen_Weight=t.math("MULTIPLY", rim, 0.2),
            Normal=t.bump(height, 0.35, 0.015),
        )
    )
    on_stage(made)


def hills(u: numpy.ndarray, v: numpy.ndarray) -> numpy.ndarray:
    """Heights of a landscape."""
    crest = numpy.abs(numpy.sin(1.1 * u + 0.5 * numpy.sin(1.7 * v))) * numpy.cos(0.5 * v)
    return 0.9 * crest**2 + 0.12 * numpy.sin(4.0 * u) * numpy.cos(3.1 * v + 0.5)


def slope(t, start: float, end: float):
    """How level the ground is, with a rough edge."""
    upwards = t.make("SeparateXYZ", 2, Vector=t.make("NewGeometry", "Normal"))
    rough = t.spread(t.noise(t.place(), 5.0, Detail=6.0, Roughness=0.6), 0.25, 0.75, -0.08, 0.08)
    return t.spread(t.math("ADD", upwards, rough), start, end, interpolation_type="SMOOTHERSTEP")


def terrain() -> None:
    """Rock where it is steep, grass where it is level, snow above a line; strata by height, displacement as bump."""
    resolution(192, 128)
    made, t = begun("Terrain")
    place = t.place()
    up = t.make("SeparateXYZ", 2, Vector=t.make("NewGeometry", "Position"))
    strata = t.make("TexWave", "Fac", bands_direction="Z", wave_profile="TRI", Vector=place, Scale=2.5, Distortion=4.0, Detail=4.0)
    rock = t.ramp(strata, (0.0, (0.12, 0.09, 0.07)), (0.5, (0.3, 0.25, 0.2)), (1.0, (0.42, 0.38, 0.33)))
    rock = t.mix(0.6, rock, t.cells(place, 6.0, "Color", feature="F1", Detail=2.0, normalize=True), "SOFT_LIGHT")
    tufts = t.noise(place, 14.0, Detail=6.0, Roughness=0.7)
    grass = t.ramp(tufts, (0.3, (0.03, 0.07, 0.01)), (0.5, (0.1, 0.18, 0.03)), (0.7, (0.25, 0.25, 0.06)), interpolation="B_SPLINE")
    ground = t.mix(slope(t, 0.75, 0.92), rock, grass)
    line = t.math(
        "ADD", up, t.spread(t.noise(place, 3.0, noise_type="HYBRID_MULTIFRACTAL", Detail=5.0, Offset=0.3, Gain=0.8), 0.0, 1.0, -0.2, 0.2)
    )
    snow = t.math("MULTIPLY", t.spread(line, 0.45, 0.6), slope(t, 0.5, 0.7))
    shader = t.make(
        "BsdfPrincipled",
        Base_Color=t.mix(snow, ground, (0.85, 0.88, 0.95)),
        Roughness=t.math("MULTIPLY_ADD", snow, -0.4, 0.9),
        Specular_IOR_Level=t.math("MULTIPLY", snow, 0.5),
    )
    roughness = t.math("MULTIPLY", tufts, t.math("SUBTRACT", 1.0, snow))
    height = t.math("ADD", roughness, t.math("MULTIPLY", t.cells(place, 8.0, distance="MANHATTAN"), 0.3))
    t.end(shader, t.make("Displacement", Height=height, Midlevel=0.5, Scale=0.08))
    sheet(made, hills, (7.0, 6.0), location=(0.0, 0.6, 0.0), rotation=(0.0, 0.0, 0.2))
    ball(made, 0.55, location=(0.2, -1.9, 0.75))
    lit()
