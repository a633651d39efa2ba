"""Textures that are made of hashes: noise, Voronoi cells, waves, white noise, Gabor's."""

from .case import WHOLE, Case, Node

FAMILY = "Texture"
NOISES = ["FBM", "MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "HETERO_TERRAIN"]
DIMENSIONS = ["1D", "2D", "3D", "4D"]
METRICS = ["EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI"]
# Cells' borders, where one rounding more or less gives another cell.
BORDERS = 0.003


def _place(dimensions: str) -> dict:
    """Coordinates of so many dimensions."""
    return {**({} if dimensions == "1D" else {"Vector": "place 0"}), **({"W": "place 1.x"} if dimensions in ("1D", "4D") else {})}


def _noises() -> tuple[Case, ...]:
    """Noise Texture: each kind in each dimension with usual values, and everything driven."""
    made = []
    for dimensions in DIMENSIONS:
        for kind in NOISES:
            fields = {"noise_dimensions": dimensions, "noise_type": kind}
            extra = {"Offset": "unit 2.x", "Gain": "positive 2.y"} if kind not in ("FBM", "MULTIFRACTAL") else {}
            driven = {
                **{**_place(dimensions), "Scale": 2.5, "Detail": "positive 0.x", "Roughness": "unit 0.x", "Lacunarity": "octaves 1.y"},
                **{"Distortion": "unit 1.z", **{name: each for name, each in extra.items() if kind != "HETERO_TERRAIN" or name != "Gain"}},
            }
            made.append(Case(f"{dimensions}, {kind}", fields, {**_place(dimensions), "Scale": 5.0}))
            made.append(Case(f"{dimensions}, {kind}, driven", fields, driven, steps=BORDERS))
        plain = {"noise_dimensions": dimensions, "normalize": False}
        made.append(Case(f"{dimensions}, FBM, not normalized", plain, {**_place(dimensions), "Scale": 5.0, "Detail": 3.5}))
        made.append(Case(f"{dimensions}, distorted", {"noise_dimensions": dimensions}, {**_place(dimensions), "Distortion": 2.0}))
    far = {"noise_dimensions": "3D"}
    made.append(Case("3D, FBM, far away", far, {"Vector": "far 0", "Scale": 1.0}))
    made.append(Case("3D, FBM, unlinked", far, {"Scale": 1.5}, on_sphere=True))
    return tuple(made)


def _voronois() -> tuple[Case, ...]:
    """Voronoi Texture: each feature in each dimension by each metric, layers of it, and everything driven."""
    made = []
    for dimensions in DIMENSIONS:
        base = {"voronoi_dimensions": dimensions}
        for feature in ("F1", "F2", "SMOOTH_F1"):
            smooth = {"Smoothness": 0.6} if feature == "SMOOTH_F1" else {}
            for metric in METRICS if dimensions != "1D" else METRICS[:1]:
                fields = {**base, "feature": feature, "distance": metric}
                exponent = {"Exponent": 0.8} if metric == "MINKOWSKI" and dimensions != "1D" else {}
                name = f"{dimensions}, {feature}" + ("" if dimensions == "1D" else f", {metric}")
                made.append(Case(name, fields, {**_place(dimensions), "Scale": 2.0, **smooth, **exponent}, steps=BORDERS))
            driven = {
                **{**_place(dimensions), "Scale": "positive 0.x", "Detail": "unit 2.x", "Roughness": "unit 0.x"},
                **{"Lacunarity": "octaves 1.y", "Randomness": "unit 1.x", **({"Smoothness": "unit 1.y"} if smooth else {})},
            }
            made.append(Case(f"{dimensions}, {feature}, driven", {**base, "feature": feature}, driven, steps=3 * BORDERS))
        for feature in ("DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"):
            fields = {**base, "feature": feature}
            made.append(Case(f"{dimensions}, {feature}", fields, {**_place(dimensions), "Scale": 2.0}, steps=BORDERS))
        layers = {**_place(dimensions), "Scale": 2.0, "Detail": 2.5, "Roughness": 0.7, "Lacunarity": 2.2}
        for feature in ("F1", "DISTANCE_TO_EDGE"):
            for normalize in (False, True):
                name = f"{dimensions}, {feature}, layers{', normalized' if normalize else ''}"
                made.append(Case(name, {**base, "feature": feature, "normalize": normalize}, layers, steps=3 * BORDERS))
    made.append(Case("3D, F1, far away", {}, {"Vector": "far 0", "Scale": 1.0}, steps=BORDERS))
    made.append(Case("3D, F1, unlinked", {}, {"Scale": 2.0}, ("Distance", "Color"), on_sphere=True, steps=0.05))
    return tuple(made)


def _waves() -> tuple[Case, ...]:
    """Wave Texture: each direction by each profile, and everything driven."""
    made = []
    for kind, name, directions in (
        ("BANDS", "bands_direction", ["X", "Y", "Z", "DIAGONAL"]),
        ("RINGS", "rings_direction", ["X", "Y", "Z", "SPHERICAL"]),
    ):
        for direction in directions:
            for profile in ("SIN", "SAW", "TRI"):
                fields = {"wave_type": kind, name: direction, "wave_profile": profile}
                mode = f"{kind}, {direction}, {profile}"
                made.append(Case(mode, fields, {0: "place 0", "Scale": 1.5}, steps=BORDERS if profile == "SAW" else 0.0))
        driven = {
            **{0: "place 0", "Scale": "positive 0.x", "Distortion": "place 1.x", "Detail": "positive 1.x", "Detail Scale": "positive 2.x"},
            **{"Detail Roughness": "unit 0.x", "Phase Offset": "place 2.x"},
        }
        made.append(Case(f"{kind}, driven", {"wave_type": kind}, driven, steps=BORDERS))
    made.append(Case("unlinked", {}, {"Scale": 1.0}, on_sphere=True))
    return tuple(made)


NODES = {
    "ShaderNodeTexNoise": Node("Noise Texture", FAMILY, cases=_noises()),
    "ShaderNodeTexVoronoi": Node("Voronoi Texture", FAMILY, cases=_voronois()),
    "ShaderNodeTexWave": Node("Wave Texture", FAMILY, cases=_waves()),
    "ShaderNodeTexWhiteNoise": Node(
        "White Noise Texture",
        FAMILY,
        cases=tuple(Case(each, {"noise_dimensions": each}, _place(each), tolerance=WHOLE) for each in DIMENSIONS),
    ),
    "ShaderNodeTexGabor": Node(
        "Gabor Texture",
        FAMILY,
        cases=(
            Case("2D", {"gabor_type": "2D"}, {"Vector": "place 0", "Scale": 2.0}),
            Case("3D", {"gabor_type": "3D"}, {"Vector": "place 0", "Scale": 2.0}),
            Case(
                "2D, driven",
                {"gabor_type": "2D"},
                {
                    **{"Vector": "place 0", "Scale": "positive 0.x", "Frequency": "positive 1.x", "Anisotropy": "unit 0.x"},
                    "Orientation 2D": "place 1.x",
                },
            ),
            Case(
                "3D, driven",
                {"gabor_type": "3D"},
                {
                    **{"Vector": "place 0", "Scale": "positive 0.x", "Frequency": "positive 1.x", "Anisotropy": "unit 0.x"},
                    "Orientation 3D": "place 1",
                },
            ),
            Case("unlinked", {}, {"Scale": 1.5}, on_sphere=True, steps=0.02),
        ),
    ),
}
