"""Materials as people build them, of what is manufactured: car paint with flakes, cloth, brushed metal, screens."""

import bpy
from stage import node
from trees import begun, inner, on_stage


def car_flakes() -> None:
    """Flakes whose normals are random by cell, a base that changes with the angle, orange peel under the coat."""
    made, t = begun("Car flakes")
    place = t.place("Object")
    facing = t.make("LayerWeight", "Facing", Blend=0.35)
    base = t.ramp(facing, (0.0, (0.35, 0.02, 0.03)), (0.5, (0.18, 0.01, 0.06)), (1.0, (0.02, 0.01, 0.1)))
    flakes = t.cells(place, 45.0, "Color", Randomness=1.0)
    size = t.cells(place, 45.0)
    tilt = t.vector("SUBTRACT", flakes, (0.5, 0.5, 0.5))
    bent = t.vector("NORMALIZE", t.vector("ADD", t.make("NewGeometry", "Normal"), t.scaled(tilt, 0.35)))
    chance = t.make("TexWhiteNoise", "Value", noise_dimensions="3D", Vector=flakes)
    shown = t.math("MULTIPLY", t.math("GREATER_THAN", chance, 0.45), t.math("LESS_THAN", size, 0.55))
    hue = t.make("HueSaturation", Hue=t.spread(chance, 0.45, 1.0, 0.45, 0.55), Saturation=0.8, Value=1.0, Color=(0.9, 0.45, 0.4, 1.0))
    fresnel = t.make("LayerWeight", "Fresnel", Blend=0.2)
    colour = t.mix(t.math("MULTIPLY", shown, t.math("SUBTRACT", 1.0, fresnel)), base, hue)
    normal = t.vector("NORMALIZE", t.mix(shown, t.make("NewGeometry", "Normal"), bent))
    peel = t.noise(place, 25.0, Detail=2.0, Roughness=0.4)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=colour,
            Metallic=t.math("MULTIPLY", shown, 0.9),
            Roughness=t.spread(chance, 0.0, 1.0, 0.35, 0.5),
            Normal=normal,
            Coat_Weight=1.0,
            Coat_Roughness=0.1,
            Coat_Tint=(1.0, 0.97, 0.92),
            Coat_Normal=t.bump(peel, 0.05, 0.01),
        )
    )
    on_stage(made)


def weave() -> bpy.types.NodeTree:
    """A group: threads over and under each other; their height, and which of the two is on top."""
    made, t, start, end = inner("Weave", {"Vector": "Vector"}, {"Height": "Float", "Warp": "Float"})
    place = start.outputs["Vector"]
    warp = t.make("TexWave", "Fac", bands_direction="X", wave_profile="SIN", Vector=place, Scale=0.5)
    weft = t.make("TexWave", "Fac", bands_direction="Y", wave_profile="SIN", Vector=place, Scale=0.5)
    over = t.make("TexChecker", "Fac", Vector=place, Scale=0.8)
    first, second = (t.math("POWER", each, 0.6) for each in (warp, weft))
    top = t.math(
        "MAXIMUM",
        t.math("MULTIPLY", first, t.spread(over, 0.0, 1.0, 0.5, 1.0)),
        t.math("MULTIPLY", second, t.spread(over, 0.0, 1.0, 1.0, 0.5)),
    )
    t.tree.links.new(top, end.inputs["Height"])
    t.tree.links.new(t.math("COMPARE", over, 1.0, 0.1), end.inputs["Warp"])
    return made


def cloth() -> None:
    """A plaid woven of two threads, with fuzz, worn in places."""
    made, t = begun("Cloth")
    place = t.place("UV", Scale=(20.0, 14.0, 1.0), Rotation=(0.0, 0.0, 0.3))
    wobble = t.noise(place, 0.4, "Color", Detail=2.0)
    place = t.vector("ADD", place, t.scaled(t.vector("SUBTRACT", wobble, (0.5, 0.5, 0.5)), 0.6))
    parts = t.group(weave(), Vector=place)
    height, warp = parts.outputs["Height"], parts.outputs["Warp"]
    split = t.make("SeparateXYZ", 0, Vector=t.scaled(place, 0.22))
    stripes = [t.math("GREATER_THAN", t.math("PINGPONG", each, 1.0), 0.6) for each in (split, split.node.outputs[1])]
    red, blue = (0.4, 0.04, 0.04), (0.03, 0.06, 0.25)
    colour = t.mix(warp, t.mix(stripes[0], red, blue), t.mix(stripes[1], red, (0.5, 0.45, 0.3)))
    fibres = t.noise(t.vector("MULTIPLY", place, (1.0, 8.0, 1.0)), 3.0, Detail=4.0, Roughness=0.7)
    colour = t.mix(t.spread(fibres, 0.3, 0.7, 0.0, 0.5), colour, t.make("Invert", Fac=0.1, Color=colour), "LIGHTEN")
    colour = t.mix(t.spread(height, 0.0, 1.0, 0.6, 0.0), colour, (0.01, 0.01, 0.01), "MULTIPLY")
    worn = t.spread(t.noise(t.place(), 2.0, Detail=5.0, noise_type="MULTIFRACTAL"), 0.8, 1.3, 0.0, 0.35)
    colour = t.make("RGBCurve", Fac=1.0, Color=t.mix(worn, colour, (0.5, 0.48, 0.45)))
    rim = t.make("LayerWeight", "Facing", Blend=0.6)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=colour,
            Roughness=0.85,
            Specular_IOR_Level=0.2,
            Diffuse_Roughness=0.8,
            Sheen_Weight=t.spread(rim, 0.0, 1.0, 0.1, 0.6),
            Sheen_Roughness=0.5,
            Sheen_Tint=(1.0, 0.9, 0.85),
            Normal=t.bump(t.math("MULTIPLY_ADD", fibres, 0.2, height), 0.5, 0.03),
        )
    )
    on_stage(made)


def brushed_metal() -> None:
    """Scratches along one direction in two sizes, anisotropy around the axis, fingerprints, heat colours."""
    made, t = begun("Brushed metal")
    place = t.place()
    stretched = t.make("Mapping", Vector=place, Scale=(0.6, 0.6, 45.0))
    coarse, fine = t.noise(stretched, 1.0, Detail=4.0, Roughness=0.7), t.noise(t.scaled(stretched, 3.0), 1.0, Detail=2.0)
    brush = t.math("ADD", t.math("MULTIPLY", coarse, 0.7), t.math("MULTIPLY", fine, 0.3))
    prints = t.math("MULTIPLY", t.make("TexWave", "Fac", wave_type="RINGS", Vector=place, Scale=6.0, Distortion=4.0, Detail=1.0), 0.5)
    prints = t.math("MULTIPLY", prints, t.spread(t.noise(place, 1.6, Detail=3.0), 0.5, 0.6))
    heat = t.make("Blackbody", Temperature=t.spread(t.noise(place, 0.8, Detail=1.0), 0.3, 0.7, 4000.0, 9000.0))
    steel = t.mix(0.35, (0.62, 0.6, 0.57), heat, "MULTIPLY")
    steel = t.mix(t.spread(brush, 0.3, 0.7, 0.3, 0.0), steel, (0.35, 0.34, 0.33), "DARKEN")
    roughness = t.math("ADD", t.spread(brush, 0.25, 0.75, 0.28, 0.42), t.math("MULTIPLY", prints, 0.2))
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=steel,
            Metallic=1.0,
            Roughness=roughness,
            Anisotropic=t.spread(coarse, 0.2, 0.8, 0.5, 0.75),
            Anisotropic_Rotation=t.math("MULTIPLY", fine, 0.05),
            Tangent=t.make("Tangent", direction_type="RADIAL", axis="Z"),
            Specular_Tint=(1.0, 0.98, 0.95),
            Normal=t.bump(brush, 0.08, 0.01),
        )
    )
    on_stage(made)


def lamps_of_a_screen() -> bpy.types.NodeTree:
    """A group: the place of a screen's cell, and its three lamps side by side."""
    made, t, start, end = inner("Lamps", {"Vector": "Vector", "Size": "Vector"}, {"Cell": "Vector", "Lamps": "Color"})
    place, size = start.outputs["Vector"], start.outputs["Size"]
    inside = t.vector("FRACTION", t.vector("DIVIDE", place, size))
    split = t.make("SeparateXYZ", 0, Vector=inside)
    column = t.math("MULTIPLY", split, 3.0)
    row = t.spread(t.math("ABSOLUTE", t.math("SUBTRACT", split.node.outputs[1], 0.5)), 0.3, 0.5, 1.0, 0.0)
    lit = [t.math("MULTIPLY", t.math("COMPARE", t.math("FLOOR", column), float(n), 0.1), row) for n in range(3)]
    t.tree.links.new(t.vector("SNAP", place, size), end.inputs["Cell"])
    t.tree.links.new(t.make("CombineColor", Red=lit[0], Green=lit[1], Blue=lit[2]), end.inputs["Lamps"])
    return made


def screens() -> None:
    """A picture in cells of three lamps each, with lines that flicker, glowing cracks, and glass that reflects."""
    made, t = begun("Screens")
    place = t.place("UV")
    parts = t.group(lamps_of_a_screen(), Vector=place, Size=(0.04, 0.05, 1.0))
    cell, lamps = parts.outputs["Cell"], parts.outputs["Lamps"]
    picture = t.make("TexMagic", 0, turbulence_depth=4, Vector=cell, Scale=4.0, Distortion=1.5)
    clouds = t.noise(cell, 5.0, "Color", noise_dimensions="4D", W=2.5, Detail=4.0)
    picture = t.mix(0.5, picture, clouds, "DIFFERENCE")
    spots = t.cells(cell, 7.0, "Color", voronoi_dimensions="2D", feature="F1", distance="MINKOWSKI", Exponent=0.7)
    picture = t.mix(
        t.make("TexGradient", 1, gradient_type="RADIAL", Vector=t.vector("SUBTRACT", place, (0.5, 0.5, 0.0))), picture, spots, "HUE"
    )
    lines = t.make("TexWave", "Fac", bands_direction="Y", wave_profile="SAW", Vector=place, Scale=6.0)
    flicker = t.make("TexWhiteNoise", "Value", noise_dimensions="1D", W=t.math("FLOOR", t.math("MULTIPLY", lines, 9.0)))
    bright = t.math(
        "MULTIPLY", t.spread(flicker, 0.0, 1.0, 0.6, 1.3), t.spread(t.make("LayerWeight", "Facing", Blend=0.4), 0.0, 1.0, 1.0, 0.3)
    )
    shown = t.mix(1.0, picture, t.mix(0.2, lamps, (1.0, 1.0, 1.0)), "MULTIPLY")
    dead = t.math("LESS_THAN", t.make("TexWhiteNoise", "Value", noise_dimensions="2D", Vector=cell), 0.06)
    shown = t.mix(dead, shown, (0.0, 0.0, 0.0))
    split = t.make("SeparateColor", 0, mode="HSV", Color=shown)
    more = t.math("MINIMUM", t.math("MULTIPLY", split.node.outputs[1], 1.3), 1.0)
    shown = t.make("CombineColor", mode="HSV", Red=split, Green=more, Blue=split.node.outputs[2])
    is_seen = t.make("LightPath", "Is Camera Ray")
    glow = t.make("Emission", Color=shown, Strength=t.math("MULTIPLY", bright, t.spread(is_seen, 0.0, 1.0, 0.7, 1.2)))
    glass = t.make(
        "BsdfPrincipled", Base_Color=(0.01, 0.01, 0.012), Roughness=t.spread(t.noise(t.place(), 4.0, Detail=4.0), 0.3, 0.7, 0.1, 0.3)
    )
    t.end(t.filled(node(t.tree, "ShaderNodeAddShader"), (glow, glass)))
    on_stage(made)
