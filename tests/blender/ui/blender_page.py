"""The tables of docs/blender.md: Cycles' panels and settings, and what each comes to here. Used inside the child process, in Blender 5.0."""

import importlib
from fnmatch import fnmatch

import bpy

VERSION = (5, 0)
HEADING = "## What Cycles' users find\n\n"

# Why a setting of Cycles has no line in the report, by its pattern; the rest are of noise and speed alone.
REASONS = (
    (("sample_offset", "sample_subset_length", "film_transparent_roughness", "rolling_shutter_*", "*motion*"), "followed"),
    (("use_pass_*",), "not followed: the pass is absent, and leaves a line"),
    (("fast_gi_method", "ao_bounces*", "ao_distance"), "of Fast GI, which leaves a line"),
    (("*_cull_margin", "*_cull"), "of culling, which leaves a line"),
    (("volume_*", "homogeneous_volume"), "of volumes"),
    (("dicing_rate", "preview_dicing_rate", "max_subdivisions"), "followed"),
    (("*dicing*",), "not followed: the camera that renders counts"),
    (("shadow_terminator_geometry_*",), "followed"),
    (("shadow_terminator_*",), "not followed, leaves a line"),
    (("use_guiding", "use_surface_guiding", "use_deterministic_guiding"), "followed: *Path Guiding*, always deterministic, on surfaces"),
    (("bake_type",), "a setting of Gonio's own in the *Bake* panel"),
    (("denoiser", "denoising_*", "preview_denois*", "use_denoising"), "Open Image Denoise, chosen by Gonio"),
)


def part(name):
    return importlib.import_module(f"gonio_extension.{name}")


def page() -> str:
    """The generated part, below its heading."""
    return "\n".join([*_panels(), "", *_settings()]) + "\n"


def _panels() -> list[str]:
    # Blender's own panels and Gonio's.
    stock = [panel for panel in bpy.types.Panel.__subclasses__() if "GONIO" in getattr(panel, "COMPAT_ENGINES", ())]
    shown = {(panel.bl_context, panel.bl_label) for panel in (*stock, *part("ui").PANELS) if hasattr(panel, "bl_context")}
    rows = {}
    for panel in importlib.import_module("cycles.ui").classes:
        if (
            not issubclass(panel, bpy.types.Panel)
            or not hasattr(panel, "bl_context")
            or getattr(panel, "bl_space_type", "") != "PROPERTIES"
        ):
            continue
        key = (panel.bl_context, panel.bl_label)
        if key[1]:
            rows[key] = key in shown or panel in stock or rows.get(key, False)
    lines = ["### Panels", "", "| tab | panel of Cycles | here |", "| --- | --- | --- |"]
    tab = {"data": "object data", "view_layer": "view layer"}
    return lines + [
        f"| {tab.get(context, context)} | {label} | {'yes' if found else '–'} |" for (context, label), found in sorted(rows.items())
    ]


def _settings() -> list[str]:
    limits, taken, table = part("export.limits"), part("operators.from_cycles"), part("unsupported").LIMITS
    scene = bpy.context.scene
    owners = (
        ("Scene", scene, taken.SCENE, limits.SCENE),
        ("View layer", bpy.context.view_layer, taken.VIEW_LAYER, limits.LAYER),
        ("Object", bpy.data.objects["Cube"], {}, limits.OBJECT),
        ("Light", bpy.data.lights[0], taken.LIGHT, limits.LIGHT),
        ("World", bpy.data.worlds[0], {}, limits.WORLD),
        ("Material", bpy.data.materials[0], {}, limits.MATERIAL),
    )
    lines = ["### Settings", "", "| of | Cycles' setting | here |", "| --- | --- | --- |"]
    for kind, owner, followed, told in owners:
        instead = {path.rpartition("cycles.")[2]: table[limit].instead for limit, path, *_ in told}
        for setting in owner.cycles.bl_rna.properties:
            name = setting.identifier
            if name not in ("rna_type", "name") and not name.startswith("debug_"):
                lines.append(f"| {kind} | {setting.name or name} (`{name}`) | {_state(name, followed, instead)} |")
    return lines


def _state(name: str, followed, instead) -> str:
    if name in followed.values() or name in part("session.passes").SWITCHES:
        return "followed"
    if name in instead:
        return f"not followed: {instead[name]}"
    return next((words for patterns, words in REASONS if any(fnmatch(name, pattern) for pattern in patterns)), "of noise and speed alone")
