"""Materials as people build them, of what is outside a house: rust, tiles with grout, wet asphalt, stained glass."""

import bpy
from trees import begun, inner, on_stage


def wear() -> bpy.types.NodeTree:
    """A group: where paint is gone, by noise at two sizes and by how far edges stand out."""
    made, t, start, end = inner("Wear", {"Vector": "Vector", "Amount": "Float"}, {"Mask": "Float", "Edge": "Float"})
    place, amount = start.outputs["Vector"], start.outputs["Amount"]
    coarse = t.noise(place, 2.0, Detail=8.0, Roughness=0.65, Distortion=0.4)
    fine = t.noise(place, 11.0, noise_type="MULTIFRACTAL", Detail=5.0, Roughness=0.5)
    both = t.math("ADD", coarse, t.math("MULTIPLY", t.math("SUBTRACT", fine, 0.5), 0.15))
    both = t.math("ADD", both, t.math("MULTIPLY", t.math("SUBTRACT", t.make("NewGeometry", "Pointiness"), 0.5), 2.0))
    low = t.math("SUBTRACT", 1.0, amount)
    mask = t.make("MapRange", Value=both, From_Min=low, From_Max=t.math("ADD", low, 0.06))
    edge = t.make("MapRange", Value=both, From_Min=t.math("SUBTRACT", low, 0.05), From_Max=low, interpolation_type="SMOOTHSTEP")
    t.tree.links.new(mask, end.inputs["Mask"])
    t.tree.links.new(edge, end.inputs["Edge"])
    return made


def rust() -> None:
    """Paint that flakes off rusty iron: two shaders mixed by a group's mask, each with bumps of its own."""
    made, t = begun("Rust")
    place = t.place()
    parts = t.group(wear(), Vector=place, Amount=0.5)
    mask, edge = parts.outputs["Mask"], parts.outputs["Edge"]
    grains = t.noise(place, 16.0, Detail=8.0, Roughness=0.75)
    pits = t.cells(place, 20.0, feature="F1", distance="CHEBYCHEV", Randomness=0.9)
    brown = t.ramp(grains, (0.25, (0.03, 0.012, 0.008)), (0.5, (0.2, 0.06, 0.02)), (0.65, (0.42, 0.15, 0.04)), (0.8, (0.6, 0.3, 0.1)))
    brown = t.mix(t.spread(pits, 0.0, 0.5, 0.7, 0.0), brown, (0.05, 0.02, 0.015), "MULTIPLY")
    iron = t.make(
        "BsdfPrincipled",
        Base_Color=brown,
        Metallic=t.spread(grains, 0.3, 0.7, 0.5, 0.0),
        Roughness=t.spread(grains, 0.2, 0.8, 0.65, 0.95),
        Normal=t.bump(t.math("ADD", grains, pits), 0.6, 0.02),
    )
    dirt = t.make("Gamma", Color=t.noise(place, 4.0, "Color", Detail=3.0), Gamma=1.4)
    paint = t.mix(0.25, t.make("ObjectInfo", "Color"), dirt, "OVERLAY")
    paint = t.mix(edge, (0.1, 0.35, 0.4), t.mix(0.5, paint, brown))
    cover = t.make("BsdfPrincipled", Base_Color=paint, Roughness=0.35, Normal=t.bump(edge, 0.5, 0.03))
    t.end(t.between(mask, cover, iron))
    on_stage(made)


def tiling() -> bpy.types.NodeTree:
    """A group by arithmetic alone: rows of tiles shifted by half; where the grout is, how far in, and the tile's number."""
    made, t, start, end = inner("Tiling", {"Vector": "Vector", "Grout": "Float"}, {"Joint": "Float", "Rise": "Float", "Number": "Vector"})
    split = t.make("SeparateXYZ", 0, Vector=start.outputs["Vector"])
    x, y = split, split.node.outputs[1]
    row = t.math("FLOOR", y)
    x = t.math("ADD", x, t.math("MULTIPLY", t.math("FLOORED_MODULO", row, 2.0), 0.5))
    across, up = (t.math("SUBTRACT", 0.5, t.math("ABSOLUTE", t.math("SUBTRACT", t.math("FRACT", each), 0.5))) for each in (x, y))
    inside = t.math("SMOOTH_MIN", t.math("MULTIPLY", across, 2.0), up, 0.05)
    grout = start.outputs["Grout"]
    rise = t.make("MapRange", Value=inside, From_Min=grout, From_Max=t.math("MULTIPLY", grout, 2.5), interpolation_type="SMOOTHSTEP")
    for name, value in (
        ("Joint", t.math("LESS_THAN", inside, grout)),
        ("Rise", rise),
        ("Number", t.make("CombineXYZ", X=t.math("FLOOR", x), Y=row)),
    ):
        t.tree.links.new(value, end.inputs[name])
    return made


def tiles() -> None:
    """Glazed tiles of many colours, grout between them, cracks in some."""
    made, t = begun("Tiles")
    place = t.place("UV", Scale=(6.0, 9.0, 1.0))
    parts = t.group(tiling(), Vector=place, Grout=0.06)
    joint, rise, number = (parts.outputs[name] for name in ("Joint", "Rise", "Number"))
    chance = t.make("TexWhiteNoise", "Value", Vector=number)
    shade = t.ramp(
        chance,
        (0.0, (0.03, 0.1, 0.25)),
        (0.3, (0.05, 0.25, 0.35)),
        (0.6, (0.6, 0.55, 0.4)),
        (0.85, (0.5, 0.12, 0.05)),
        interpolation="CONSTANT",
    )
    hsv = t.make("HueSaturation", Hue=t.spread(chance, 0.0, 1.0, 0.47, 0.53), Saturation=1.0, Value=1.0, Color=shade)
    glaze = t.noise(t.vector("ADD", place, number), 1.5, "Color", Detail=3.0)
    glaze = t.make("Gamma", Color=t.mix(0.25, hsv, glaze, "SOFT_LIGHT"), Gamma=1.1)
    crack = t.spread(t.cells(t.vector("ADD", place, t.scaled(number, 3.7)), 2.0, feature="DISTANCE_TO_EDGE"), 0.01, 0.05)
    crack = t.math("MAXIMUM", crack, t.math("LESS_THAN", chance, 0.7))
    glaze = t.mix(crack, (0.02, 0.015, 0.01), glaze)
    sand = t.noise(place, 12.0, Detail=6.0, Roughness=0.8)
    colour = t.mix(joint, glaze, t.ramp(sand, (0.3, (0.2, 0.19, 0.17)), (0.7, (0.45, 0.43, 0.4))))
    dirt = t.noise(t.place(), 1.3, Detail=6.0, Roughness=0.6)
    runs = t.make("TexWave", "Fac", Vector=place, Scale=0.3, Distortion=3.0, Detail=3.0)
    dirt = t.math("MULTIPLY", t.spread(dirt, 0.45, 0.7), t.spread(runs, 0.2, 0.8, 0.3, 1.0))
    dirt = t.math("MULTIPLY", dirt, t.math("MULTIPLY_ADD", rise, -0.6, 1.0))
    colour = t.mix(dirt, colour, t.ramp(sand, (0.2, (0.12, 0.09, 0.05)), (0.8, (0.3, 0.26, 0.2))))
    height = t.math("MULTIPLY_ADD", sand, t.math("MULTIPLY", joint, 0.15), rise)
    smooth = t.spread(t.noise(place, 0.7, Detail=2.0), 0.3, 0.7, 0.08, 0.3)
    smooth = t.math("MULTIPLY_ADD", dirt, 0.3, smooth)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=colour,
            Roughness=t.make("Mix", "Result", data_type="FLOAT", Factor=joint, A=smooth, B=0.9),
            Normal=t.bump(height, 0.5, 0.03),
        )
    )
    on_stage(made)


def asphalt() -> None:
    """Stones in tar as displacement, puddles that smooth it and shine."""
    made, t = begun("Wet asphalt")
    place = t.place()
    stones, shape = t.cells(place, 12.0, "Color", Randomness=1.0), t.cells(place, 12.0, feature="SMOOTH_F1", Smoothness=0.3, Detail=1.0)
    grit = t.noise(place, 40.0, Detail=4.0, Roughness=0.8)
    level = t.noise(place, 1.1, Detail=5.0, Roughness=0.5, Distortion=0.3)
    puddle = t.spread(level, 0.42, 0.55, interpolation_type="SMOOTHSTEP")
    grey = t.ramp(t.make("RGBToBW", Color=stones), (0.0, (0.015, 0.015, 0.017)), (0.6, (0.06, 0.058, 0.055)), (1.0, (0.2, 0.19, 0.18)))
    grey = t.mix(0.3, grey, t.ramp(grit, (0.3, (0.0, 0.0, 0.0)), (0.7, (1.0, 1.0, 1.0))), "OVERLAY")
    damp = t.spread(level, 0.3, 0.5)
    colour = t.mix(damp, grey, t.make("Gamma", Color=grey, Gamma=1.35))
    oil = t.make("TexMagic", 0, turbulence_depth=3, Vector=place, Scale=0.6, Distortion=1.2)
    colour = t.mix(t.math("MULTIPLY", puddle, 0.015), colour, oil, "SCREEN")
    height = t.math("ADD", t.math("SUBTRACT", 1.0, shape), t.math("MULTIPLY", grit, 0.4))
    dry = t.math("SUBTRACT", 1.0, puddle)
    ripples = t.make("TexWave", "Fac", wave_type="RINGS", rings_direction="SPHERICAL", Vector=place, Scale=5.0, Distortion=1.0)
    t.end(
        t.make(
            "BsdfPrincipled",
            Base_Color=colour,
            Roughness=t.math("MULTIPLY_ADD", dry, 0.6, 0.15),
            Coat_Weight=puddle,
            Coat_Roughness=0.12,
            Coat_IOR=1.33,
            Coat_Normal=t.bump(ripples, 0.05, 0.02),
        ),
        t.make("Displacement", Height=t.math("MULTIPLY", height, dry), Midlevel=0.0, Scale=0.04),
    )
    on_stage(made, made)


def stained_glass() -> None:
    """Panes by cells, each its own colour and ripples, in lead; light passes straight and spread."""
    made, t = begun("Stained glass")
    place = t.place("Generated", Scale=(4.0, 4.0, 4.0))
    pane, edge = t.cells(place, 1.3, "Color"), t.cells(place, 1.3, feature="DISTANCE_TO_EDGE")
    lead = t.math("LESS_THAN", edge, 0.06)
    vivid = t.make("HueSaturation", Hue=0.5, Saturation=1.6, Value=1.1, Color=pane)
    streaks = t.noise(t.vector("MULTIPLY", place, (1.0, 6.0, 1.0)), 2.0, Detail=4.0, Distortion=0.8)
    vivid = t.mix(t.spread(streaks, 0.35, 0.7, 0.0, 0.4), vivid, (0.95, 0.93, 0.88))
    ripple = t.bump(t.noise(place, 5.0, Detail=2.0), 0.3, 0.05)
    through = t.make("BsdfTransparent", Color=vivid)
    glow = t.make("BsdfTranslucent", Color=vivid, Normal=ripple)
    glass = t.between(t.spread(streaks, 0.3, 0.7, 0.2, 0.6), through, glow)
    shine = t.make("BsdfAnisotropic", Color=(1.0, 1.0, 1.0), Roughness=0.35, Normal=ripple)
    glass = t.between(t.make("Fresnel", IOR=1.45, Normal=ripple), glass, shine)
    metal = t.make(
        "BsdfPrincipled",
        Base_Color=t.ramp(t.noise(place, 8.0, Detail=5.0), (0.3, (0.08, 0.08, 0.09)), (0.7, (0.3, 0.3, 0.32))),
        Metallic=0.9,
        Roughness=0.5,
        Normal=t.bump(t.spread(edge, 0.0, 0.06, 1.0, 0.0), 1.0, 0.05),
    )
    t.end(t.between(lead, glass, metal))
    on_stage(made)
