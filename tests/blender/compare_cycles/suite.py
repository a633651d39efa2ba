"""The scenes that are compared, fixed beforehand, and how many samples each engine needs for them."""

from dataclasses import dataclass

USUAL_SAMPLES = 128


@dataclass(frozen=True)
class Scene:
    """A function of `scenes_<theme>.py`, and samples a pixel in each of two renderings."""

    theme: str
    name: str
    cycles: int = USUAL_SAMPLES
    gonio: int = USUAL_SAMPLES


SCENES = [
    Scene("light", "point"),
    Scene("light", "sun"),
    Scene("light", "spot"),
    Scene("light", "goniogram"),
    Scene("light", "area_square"),
    Scene("light", "area_rectangle"),
    Scene("light", "area_disk", 512, 512),
    Scene("light", "area_ellipse"),
    Scene("light", "mesh_emitter", 256, 256),
    Scene("light", "light_linking", 512, 512),
    Scene("light", "negative", 256, 256),
    Scene("light", "soft_falloff", 384, 384),
    Scene("light", "world_visibility", 256, 256),
    Scene("light", "opaque_shadows", 384, 384),
    Scene("light", "clamped_caustics", 512, 512),
    Scene("light", "hdri"),
    Scene("light", "sky_single"),
    Scene("light", "sky_multiple"),
    Scene("light", "sky_preetham"),
    Scene("light", "sky_hosek_wilkie"),
    Scene("surface", "principled_lobes"),
    Scene("surface", "principled_transmission", 384, 384),
    Scene("surface", "principled_together"),
    Scene("surface", "closures"),
    Scene("surface", "closures_through", 384, 384),
    Scene("surface", "mixtures"),
    Scene("surface", "subsurface", 256, 256),
    Scene("texture", "textures"),
    Scene("texture", "relief"),
    Scene("texture", "alpha"),
    Scene("displacement", "displaced"),
    Scene("displacement", "displaced_and_bent"),
    Scene("displacement", "displaced_adaptively"),
    Scene("nature", "wood", 96, 96),
    Scene("nature", "marble", 96, 96),
    Scene("nature", "skin", 160, 160),
    Scene("nature", "terrain", 96, 96),
    Scene("building", "rust", 96, 96),
    Scene("building", "tiles", 96, 96),
    Scene("building", "asphalt", 192, 192),
    Scene("building", "stained_glass", 192, 352),
    Scene("made", "car_flakes", 160, 192),
    Scene("made", "cloth", 64, 64),
    Scene("made", "brushed_metal", 64, 64),
    Scene("made", "screens", 96, 160),
    Scene("camera", "perspective_shifted"),
    Scene("camera", "orthographic"),
    Scene("camera", "depth_of_field"),
    Scene("camera", "panoramic"),
    Scene("camera", "fisheye"),
    Scene("camera", "instances"),
    Scene("instances", "nested_attributes"),
    Scene("instances", "linked_instances", 256, 256),
    Scene("instances", "bordered"),
    Scene("hair", "hair_curves", 384, 384),
    Scene("hair", "hair_ribbons"),
    Scene("hair", "hair_elliptic"),
    Scene("bake", "bake_combined", 64, 64),
    Scene("bake", "bake_on_faces", 64, 64),
    Scene("bake", "bake_irradiance", 64, 64),
    Scene("bake", "bake_glossy", 128, 128),
    Scene("bake", "bake_occlusion", 64, 64),
    Scene("bake", "bake_normals", 8, 8),
    Scene("bake", "bake_denoised", 64, 64),
]
