"""Light path expressions that part classes of light: sums, closed forms, and what they leave as it is."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, at, finished, floor_scene
from test_light_path_passes import room, values

SCATTERINGS = ["<RD>", "<RG>", "<RS>", "<TD>", "<TG>", "<TS>"]


def check_sums(film, names, wanted="color"):
    colour = values(film, wanted)[..., :3]
    total = sum(values(film, name) for name in names)
    assert abs(total - colour).max() < 2e-5 * colour.max()


@pytest.mark.parametrize("settings", [{}, {"integrator": "direct"}, {"film_transparent": True}, {"clamp_indirect": 1.0}])
def test_first_scatterings_sum_up_to_the_colour(settings):
    # Every path has a first scattering or none; G and S together keep sharp from glossy.
    names = ["lpe:CL", *(f"lpe:C{first}L|C<RG>(<RS><RG>V)L" for first in SCATTERINGS), *(f"lpe:C{first}.+L|C<RG>(<RS><RG>V)L" for first in SCATTERINGS)]
    film = finished(room(*names, **settings))
    check_sums(film, names)
    assert all(values(film, f"lpe:C{first}L|C<RG>(<RS><RG>V)L").max() > 0.0 for first in ("<RD>", "<RG>"))


def test_last_scatterings_and_numbers_of_them_sum_up_to_the_colour():
    last = ["lpe:CL", *(f"lpe:C.*{event}L|C<RG><RS>V" for event in SCATTERINGS)]
    count = ["lpe:CL", "lpe:C.L", "lpe:C.{2}L", "lpe:C.{3}L", "lpe:C.{4,}L"]
    mirrors = ["lpe:C[^D]*L", "lpe:C[^D]*D[^D]*L", "lpe:C[^D]*D[^D]*D.*L"]
    film = finished(room(*last, *count, *mirrors))
    for names in (last, count, mirrors):
        check_sums(film, names)
    assert all(values(film, name).max() > 0.0 for name in [*count[:4], *mirrors])


def test_sources_and_groups_sum_up_to_the_colour():
    scene = room()
    scene.add_light("sphere", (900.0, 300.0, 300.0), radius=0.05, transform=at(1.0, 1.5, 1.0), name="key", group="key")
    sources = ["lpe:C.*<L.'key'>|C[LO]VB", "lpe:C.*<L.[^'key']>|CVOVB", "lpe:C.*O|CVB", "lpe:C.*B|CVO"]
    groups = [f"lpe:C{first}<L.{which}>|C<RG><RS>V" for first in (".*<RD>", ".*<RG>", ".*<RS>", ".*<TD>", ".*<TG>", ".*<TS>", "") for which in ("'key'", "[^'key']")]
    scene.set(passes=["color", *sources, *groups, "lightgroup:key"])
    film = finished(scene)
    check_sums(film, sources)
    check_sums(film, groups)
    check_sums(film, [name for name in groups if "[" not in name], "lightgroup:key")
    assert all(values(film, name).max() > 0.0 for name in sources)


def test_followed_expressions_are_the_classes_that_they_mean():
    # With the group of all lights, whole classes are followed too.
    pairs = {
        "lpe:C<RD><L.'other'>": "lpe:C<RD>L",
        "lpe:C<RD>.+<L.'other'>": "lpe:C<RD>.+L",
        "lpe:C<R[GS]>.*<L.'other'>": "lpe:C<R[GS]>.*L",
        "lpe:C<T[GS]>.+<L.'other'>": "lpe:C<T[GS]>.+L",
        "lpe:C<L.'other'>": "lpe:C[LOB]",
    }
    parts = ["lpe:C<RD><RD>L", "lpe:C<RD><R[GS]>L", "lpe:C<RD><T.>L", "lpe:C<RD>.{2,}L"]
    film = finished(room(*pairs, *pairs.values(), *parts))
    for one, other in pairs.items():
        assert np.allclose(values(film, one), values(film, other), rtol=1e-5, atol=1e-6), one
    check_sums(film, parts, "lpe:C<RD>.+L")


def test_the_colour_stays_as_it_is_whatever_is_followed():
    plain = finished(room(samples=32))["color"].tobytes()
    for threads in (1, 2):
        film = finished(room("lpe:C<RD><RD>L", "lpe:CS*DL", samples=32, threads=threads))
        assert film["color"].tobytes() == plain
        if threads == 1:
            first = film["lpe:CS*DL"].tobytes()
    assert film["lpe:CS*DL"].tobytes() == first


def test_light_between_walls_of_a_furnace_falls_as_the_albedo_to_the_number_of_bounces():
    """In a closed box whose walls all emit E and reflect a, light after n scatterings is E aⁿ."""
    scene = gonio.Scene()
    names = ["lpe:CO", *(f"lpe:C.{{{count}}}O" for count in range(1, 5))]
    scene.set(width=16, height=16, samples=256, max_bounces=12, passes=["color", *names])
    albedo, emitted = 0.6, 2.0
    wall = scene.add_material("wall", base_color=[albedo] * 3, specular_weight=0.0, emission_color=[emitted] * 3)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4")
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([face for a, b, c, d in faces for face in ((a, b, c), (a, c, d))], "i4")
    scene.add_instance(scene.add_mesh(corners, triangles), [wall], name="box")
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], fov=60)
    film = finished(scene)
    for count, name in enumerate(names):
        mean = values(film, name).mean()
        assert mean == pytest.approx(emitted * albedo**count, rel=0.02), count


def test_a_mirror_shows_the_floor_by_its_own_path():
    """A floor that a mirror shows is S D, its light by direct sampling and by hits alike."""
    scene = floor_scene(samples=64, passes=["color"])
    mirror = scene.add_material("mirror", base_color=(1.0, 1.0, 1.0), metalness=1.0, specular_roughness=0.0, specular_color=(1.0, 1.0, 1.0))
    # Straight above the floor's edge, tilted so that the camera sees the floor in it.
    corners = np.array([[-1, 4, 1], [1, 4, 1], [1, 5.0, -1.0], [-1, 5.0, -1.0]], "f4")
    scene.add_instance(scene.add_mesh(corners, QUAD), [mirror], name="mirror")
    names = ["lpe:CL", "lpe:CDL|C<RG>V", "lpe:CSDL|C<RG>V", "lpe:CD.+L|C<RG>V", "lpe:CS(L|D.+L|S.*L)|C<RG>V"]
    scene.set(passes=["color", *names])
    film = finished(scene)
    check_sums(film, names)
    assert values(film, "lpe:CDL|C<RG>V").max() > 0.0


def test_subsurface_light_is_diffuse():
    scene = floor_scene(samples=16, passes=["color"])
    skin = scene.add_material("skin", base_color=(0.8, 0.5, 0.4), specular_weight=0.0, subsurface_weight=1.0, subsurface_radius=0.1)
    scene.add_instance(scene.add_mesh(FLOOR * np.float32(0.3), QUAD), [skin], transform=at(0, 0.5, 0), name="skin")
    names = ["lpe:CL", "lpe:C<RD>L|C<RG><RS>V", "lpe:CDD+L"]
    scene.set(passes=["color", *names])
    check_sums(finished(scene), names)


def test_trees_of_rays_and_denoisers_guides_follow_expressions_too():
    names = ["lpe:C[^S]*L", "lpe:C[^S]*S.*L"]
    names = [f"{name}|C<RG><RS>V" for name in names]
    check_sums(finished(room(*names, integrator="whitted", samples=4)), names)
    film = finished(room(*names, "denoising_light", "denoising_albedo", "denoising_normal"))
    check_sums(film, names)


def test_too_many_expressions_are_refused():
    with pytest.raises(gonio.SettingError, match="expected 32 at most"):
        gonio.Render(room(*(f"lpe:C.{{{a}}}D.{{{b}}}L" for a in range(6) for b in range(6))))
    with pytest.raises(gonio.SettingError, match="cases|no pass"):
        gonio.Render(room("lpe:C.*D.{7}L", "lpe:C.*G.{7}L", "lpe:C.*S.{7}L|C<RG>V"))
