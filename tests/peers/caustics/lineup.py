"""The scenes and who renders them."""

import os

SCENES = ("lens", "lantern", "glass_ball", "pool", "door_ajar", "louvres")
IN_THE_SUN = ("glass_ball", "pool")
# So many that no picture shows where paths end: references add light paths to camera paths, and have more of them.
BOUNCES = 40

# Settings of `gonio.Scene.set` for gonio with light paths, `name=value` with commas between them; none: plain path tracing alone takes part.
LIGHT_PATHS = os.environ.get("GONIO_CAUSTICS", "")

PLAIN = "gonio"
CYCLES = ("cycles", "cycles:guided", "cycles:shadow", "cycles:guided+shadow")
LUXCORE = ("luxcore:PATHCPU", "luxcore:BIDIRCPU", "luxcore:PATHCPU+photons", "luxcore:PATHCPU+hybrid")
MITSUBA = ("mitsuba:llvm_ad_rgb",)
# Its sun is a disk far away, and next to no particle from there would meet the scene.
PARTICLES = ("mitsuba:llvm_ad_rgb+ptracer",)


def entrants(scene: str) -> list[str]:
    """All engines for a scene, gonio's first."""
    ours = [PLAIN, f"gonio:{LIGHT_PATHS}"] if LIGHT_PATHS else [PLAIN]
    particles = () if scene in IN_THE_SUN else PARTICLES
    # Without anything that casts caustics its cache never ends.
    luxcore = [engine for engine in LUXCORE if scene != "door_ajar" or not engine.endswith("+photons")]
    return [*ours, *CYCLES, *luxcore, *MITSUBA, *particles]
