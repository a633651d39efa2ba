"""A scene bundle rendered by an installed gonio: `bundle_picture.py SCENE PICTURE.exr LEVEL SEED`. Needs no other package."""

import os
import sys

if __name__ == "__main__":
    scene, picture, level, seed = sys.argv[1:]
    # Chosen when gonio is imported.
    os.environ["GONIO_SIMD"] = level
    import gonio

    if gonio.simd_level != level:
        raise SystemExit(f"the level is {gonio.simd_level}, not {level}")
    loaded = gonio.Scene.load(scene)
    loaded.set(seed=int(seed))
    with gonio.Render(loaded) as render:
        render.wait()
        render.film().write_exr(picture)
