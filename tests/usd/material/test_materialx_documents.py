"""Forms of MaterialX documents: inputs of the whole document, materials by definitions, pictures and spaces inside them."""

import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

import pictures
from squares import shown, square

# The bytes of the only colour of the pictures, as they stand and from sRGB.
BYTES = (128, 64, 200)
RAW = np.array(BYTES) / 255
LINEAR = ((RAW + 0.055) / 1.055) ** 2.4


def library(text, space='colorspace="lin_rec709"'):
    return f'<?xml version="1.0"?>\n<materialx version="1.39" {space}>\n{text}\n</materialx>\n'


def unlit(name, colour):
    """A material that shines with an input: the attributes of that."""
    return (
        f'<surface_unlit name="U_{name}" type="surfaceshader"><input name="emission_color" type="color3" {colour}/></surface_unlit>\n'
        f'<surfacematerial name="{name}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="U_{name}"/></surfacematerial>\n'
    )


def colours(tmp_path, text, *names, space='colorspace="lin_rec709"', strict=True):
    """Mean colours of squares in the materials of a document."""
    (tmp_path / "doc.mtlx").write_text(library(text, space))
    squares = [square(number, f"/L/Materials/{name}") for number, name in enumerate(names)]
    return shown(tmp_path / "a.usda", len(names), 'def "L" (references = @doc.mtlx@</MaterialX>) {}\n', *squares, strict=strict)


def test_inputs_of_the_document_are_read_by_name(tmp_path):
    text = (
        '<input name="shared_tint" type="color3" value="0.8, 0.4, 0.2"/><input name="half" type="float" value="0.5"/>\n'
        '<constant name="blue" type="color3"><input name="value" type="color3" value="0, 0, 1"/></constant>\n'
        '<input name="read" type="color3" nodename="blue"/>\n'
        '<nodegraph name="G"><input name="c" type="color3" interfacename="shared_tint"/>'
        '<multiply name="m" type="color3"><input name="in1" type="color3" interfacename="c"/><input name="in2" type="float" value="0.5"/></multiply>'
        '<output name="o" type="color3" nodename="m"/></nodegraph>\n'
        '<nodedef name="ND_dim" node="dim"><output name="out" type="color3"/></nodedef>'
        '<nodegraph name="NG_dim" nodedef="ND_dim"><multiply name="m" type="color3"><input name="in1" type="color3" interfacename="shared_tint"/>'
        '<input name="in2" type="float" interfacename="half"/></multiply><output name="out" type="color3" nodename="m"/></nodegraph>'
        '<dim name="d" type="color3"/>\n'
        + unlit("A", 'interfacename="shared_tint"') + unlit("B", 'interfacename="read"') + unlit("C", 'nodegraph="G"') + unlit("D", 'nodename="d"')
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B", "C", "D")
    assert found == pytest.approx(np.array([(0.8, 0.4, 0.2), (0, 0, 1), (0.4, 0.2, 0.1), (0.4, 0.2, 0.1)]), abs=1e-4)


PAINT = (
    '<nodedef name="ND_paint" node="paint"><input name="colorA" type="color3" value="0, 0.5, 0"/><output name="out" type="material"/></nodedef>\n'
    '<nodegraph name="NG_paint" nodedef="ND_paint">'
    '<surface_unlit name="su" type="surfaceshader"><input name="emission_color" type="color3" interfacename="colorA"/></surface_unlit>'
    '<surfacematerial name="sm" type="material"><input name="surfaceshader" type="surfaceshader" nodename="su"/></surfacematerial>'
    '<output name="out" type="material" nodename="sm"/></nodegraph>\n'
)


def test_materials_come_from_definitions(tmp_path):
    text = PAINT + (
        '<nodedef name="ND_coat" node="coat"><input name="tint" type="color3" value="0.25, 0, 0"/><output name="out" type="material"/></nodedef>\n'
        '<nodegraph name="NG_coat" nodedef="ND_coat"><paint name="inner" type="material"><input name="colorA" type="color3" interfacename="tint"/></paint>'
        '<output name="out" type="material" nodename="inner"/></nodegraph>\n'
        '<paint name="A" type="material"/><paint name="B" type="material"><input name="colorA" type="color3" value="0.5, 0, 1"/></paint>'
        '<coat name="C" type="material"/>\n'
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B", "C")
    assert found == pytest.approx(np.array([(0, 0.5, 0), (0.5, 0, 1), (0.25, 0, 0)]), abs=1e-4)


def test_materials_without_a_surface_inside_are_told(tmp_path):
    text = (
        '<nodedef name="ND_round" node="round_and_round"><output name="out" type="material"/></nodedef>\n'
        '<nodegraph name="NG_round" nodedef="ND_round"><round_and_round name="r" type="material"/><output name="out" type="material" nodename="r"/></nodegraph>\n'
        '<round_and_round name="A" type="material"/><volumematerial name="B" type="material"/>' + unlit("C", 'value="1, 0, 0"')
    )  # fmt: skip
    found, told = colours(tmp_path, text, "C", strict=False)
    assert found[0] == pytest.approx([1, 0, 0], abs=1e-4)
    assert sum("stands inside itself" in message for message in told) == 1 and sum("'B' has no volume shader" in message for message in told) == 1, told


DECAL = (
    '<nodedef name="ND_decal" node="decal"><input name="file" type="filename" value="maps/f.png" uniform="true"/><output name="out" type="color3"/></nodedef>'
    '<nodegraph name="NG_decal" nodedef="ND_decal"><image name="i" type="color3"><input name="file" type="filename" interfacename="file"/></image>'
    '<output name="out" type="color3" nodename="i"/></nodegraph>\n'
    '<nodedef name="ND_fixed" node="fixed"><output name="out" type="color3"/></nodedef>'
    '<nodegraph name="NG_fixed" nodedef="ND_fixed"><image name="i" type="color3"><input name="file" type="filename" value="maps/f.png"/></image>'
    '<output name="out" type="color3" nodename="i"/></nodegraph>\n'
    '<decal name="d1" type="color3"/><decal name="d2" type="color3"><input name="file" type="filename" value="maps/f.png"/></decal><fixed name="d3" type="color3"/>\n'
    + unlit("A", 'nodename="d1"') + unlit("B", 'nodename="d2"') + unlit("C", 'nodename="d3"')
)  # fmt: skip


@pytest.mark.parametrize(
    ("space", "expected"), [('colorspace="lin_rec709"', RAW), ("", RAW), ('colorspace="srgb_texture"', LINEAR), ('colorspace="gamma18"', RAW**1.8)]
)
def test_pictures_of_definitions_lie_beside_the_document_in_its_space(tmp_path, space, expected):
    (tmp_path / "maps").mkdir()
    pictures.write_png(tmp_path / "maps" / "f.png", np.full((2, 2, 3), BYTES, dtype=np.uint8))
    found, _ = colours(tmp_path, DECAL, "A", "B", "C", space=space)
    assert found == pytest.approx(np.array([expected] * 3), abs=2e-3)


def test_pictures_of_definitions_are_found_from_any_folder(tmp_path):
    (tmp_path / "maps").mkdir()
    pictures.write_png(tmp_path / "maps" / "f.png", np.full((2, 2, 3), BYTES, dtype=np.uint8))
    (tmp_path / "doc.mtlx").write_text(library(DECAL))
    (tmp_path / "a.usda").write_text('#usda 1.0\ndef "L" (references = @doc.mtlx@</MaterialX>) {}\n' + square(0, "/L/Materials/C"))
    code = f"import gonio; print(gonio.load_usd({str(tmp_path / 'a.usda')!r}).diagnostics)"
    done = subprocess.run([sys.executable, "-c", code], cwd=os.sep, check=True, capture_output=True, text=True, timeout=60)
    assert "does not exist" not in done.stdout, done.stdout


def test_numbers_inside_definitions_keep_out_of_the_documents_space(tmp_path):
    """A roughness picture beside a colour in one definition of several outputs: the space is for the colour."""
    pictures.write_png(tmp_path / "f.png", np.full((2, 2, 3), BYTES, dtype=np.uint8))
    text = (
        '<nodedef name="ND_pair" node="pair"><input name="file" type="filename" value="f.png"/>'
        '<output name="tint" type="color3"/><output name="rough" type="vector3"/></nodedef>'
        '<nodegraph name="NG_pair" nodedef="ND_pair"><image name="c" type="color3"><input name="file" type="filename" interfacename="file"/></image>'
        '<image name="r" type="vector3"><input name="file" type="filename" interfacename="file"/></image>'
        '<output name="tint" type="color3" nodename="c"/><output name="rough" type="vector3" nodename="r"/></nodegraph>\n'
        '<pair name="p" type="multioutput"><input name="file" type="filename" value="f.png"/></pair>'
        '<convert name="v" type="color3"><input name="in" type="vector3" nodename="p" output="rough"/></convert>\n'
        + unlit("A", 'nodename="p" output="tint"') + unlit("B", 'nodename="v"')
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B", space='colorspace="srgb_texture"')
    assert found == pytest.approx(np.array([LINEAR, RAW]), abs=2e-3)


def test_what_a_document_reads_and_does_not_have_is_told(tmp_path):
    text = unlit("A", 'nodename="gone"') + unlit("B", 'interfacename="gone_too"') + unlit("C", 'nodegraph="G" output="o"') + '<nodegraph name="G"/>'
    _, told = colours(tmp_path, text, "A", "B", "C", strict=False)
    assert sum("is not there" in message for message in told) == 3, told


@pytest.mark.parametrize("gamma", ["1.8", "2.2", "2.4"])
def test_spaces_by_materialx_names(tmp_path, gamma):
    found, _ = colours(tmp_path, unlit("A", f'value="0.5, 0.25, 1" colorspace="gamma{gamma.replace(".", "")}"'), "A")
    assert found[0] == pytest.approx(np.array([0.5, 0.25, 1]) ** float(gamma), abs=1e-4)


def test_the_librarys_translations_are_put_together(tmp_path):
    pytest.importorskip("MaterialX", reason="the extra materialx is not installed")
    to = "standard_surface_to_UsdPreviewSurface"
    text = (
        f'<{to} name="t" type="multioutput"><input name="base" type="float" value="0.5"/><input name="base_color" type="color3" value="0.8, 0.4, 0.2"/>'
        '<input name="emission" type="float" value="2"/><input name="emission_color" type="color3" value="0.25, 0.5, 0.125"/></' + to + ">"
        + unlit("A", 'nodename="t" output="emissiveColor_out"') + unlit("B", 'nodename="t" output="diffuseColor_out"')
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B")
    assert found == pytest.approx(np.array([(0.5, 1, 0.25), (0.4, 0.2, 0.1)]), abs=1e-3)


EDF = '<surface name="S_{0}" type="surfaceshader"><input name="edf" type="EDF" nodename="{1}"/></surface><surfacematerial name="{0}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S_{0}"/></surfacematerial>\n'


def test_emission_by_definitions(tmp_path):
    text = (
        '<nodedef name="ND_lamp_edf" node="lamp_edf"><input name="tint" type="color3" value="0.5, 0.25, 0.125"/><output name="out" type="EDF"/></nodedef>'
        '<nodegraph name="NG_lamp" nodedef="ND_lamp_edf"><uniform_edf name="u" type="EDF"><input name="color" type="color3" interfacename="tint"/></uniform_edf>'
        '<multiply name="m" type="EDF"><input name="in1" type="EDF" nodename="u"/><input name="in2" type="float" value="2"/></multiply>'
        '<output name="out" type="EDF" nodename="m"/></nodegraph>\n<lamp_edf name="l" type="EDF"/>' + EDF.format("A", "l")
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A")
    assert found[0] == pytest.approx([1, 0.5, 0.25], abs=1e-4)


def test_lamas_emission_is_its_definition(tmp_path):
    pytest.importorskip("MaterialX", reason="the extra materialx is not installed")
    text = (
        '<LamaEmission name="a" type="EDF"><input name="color" type="color3" value="0.5, 0.25, 0.125"/></LamaEmission>'
        '<LamaEmission name="b" type="EDF"><input name="color" type="color3" value="0, 0.25, 1"/></LamaEmission>'
        '<LamaMix name="m" type="EDF"><input name="material1" type="EDF" nodename="a"/><input name="material2" type="EDF" nodename="b"/>'
        '<input name="mix" type="float" value="0.25"/></LamaMix>' + EDF.format("A", "a") + EDF.format("B", "m")
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B")
    assert found == pytest.approx(np.array([(0.5, 0.25, 0.125), (0.375, 0.25, 0.34375)]), abs=1e-4)


def test_a_studios_pictures_lie_beside_its_definitions(tmp_path):
    """Definitions that are found by the search path of USD's own reader."""
    studio = tmp_path / "studio"
    (studio / "maps").mkdir(parents=True)
    pictures.write_png(studio / "maps" / "f.png", np.full((2, 2, 3), BYTES, dtype=np.uint8))
    (studio / "defs.mtlx").write_text(library(DECAL.split("<decal name")[0]))
    (tmp_path / "doc.mtlx").write_text(library('<fixed name="d" type="color3"/>' + unlit("A", 'nodename="d"')))
    (tmp_path / "a.usda").write_text('#usda 1.0\ndef "L" (references = @doc.mtlx@</MaterialX>) {}\n' + square(0, "/L/Materials/A"))
    code = f"import gonio; scene = gonio.load_usd({str(tmp_path / 'a.usda')!r}); print(scene.diagnostics, len(scene.to_dict()['textures']))"
    environment = os.environ | {"PXR_MTLX_PLUGIN_SEARCH_PATHS": str(studio)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, cwd=pathlib.Path("/"), check=True, capture_output=True, text=True, timeout=60)
    assert "does not exist" not in done.stdout and done.stdout.strip().endswith("1"), done.stdout


def test_tokens_stand_in_names_of_files(tmp_path):
    """Of the document, of a graph, of a definition, and as a node sets them."""
    for name, value in (("a", 51), ("b", 102), ("c", 204)):
        pictures.write_png(tmp_path / f"t_{name}.png", np.full((2, 2, 3), value, dtype=np.uint8))
    image = '<image name="{0}" type="color3"><input name="file" type="filename" value="{1}"/></image>'
    text = (
        '<token name="which" type="string" value="a"/>\n'
        '<nodedef name="ND_pick" node="pick"><token name="one" type="string" value="b"/><output name="out" type="color3"/></nodedef>'
        f'<nodegraph name="NG_pick" nodedef="ND_pick">{image.format("i", "t_[one].png")}<output name="out" type="color3" nodename="i"/></nodegraph>\n'
        '<nodedef name="ND_outer" node="outer"><output name="out" type="color3"/></nodedef>'
        '<nodegraph name="NG_outer" nodedef="ND_outer"><pick name="p" type="color3"><token name="one" type="string" value="a"/></pick>'
        '<output name="out" type="color3" nodename="p"/></nodegraph>\n'
        f'<nodegraph name="G"><token name="which" type="string" value="c"/>{image.format("i", "t_[which].png")}<output name="o" type="color3" nodename="i"/></nodegraph>\n'
        + image.format("i", "t_[which].png")
        + '<pick name="p" type="color3"/><pick name="q" type="color3"><token name="one" type="string" value="c"/></pick><outer name="r" type="color3"/>\n'
        + unlit("A", 'nodename="i"') + unlit("B", 'nodegraph="G"') + unlit("C", 'nodename="p"') + unlit("D", 'nodename="q"') + unlit("E", 'nodename="r"')
    )  # fmt: skip
    found, _ = colours(tmp_path, text, "A", "B", "C", "D", "E")
    assert found[:, 0] == pytest.approx(np.array([0.2, 0.8, 0.4, 0.8, 0.2]), abs=2e-3)


@pytest.mark.parametrize("pattern", ["t.{04frame}.png", "t.{frame}.png", "t.$F4.png", "t.####.png"])
def test_files_of_sequences_follow_the_frame(tmp_path, pattern):
    pictures.write_png(tmp_path / ("t.3.png" if "{frame}" in pattern else "t.0003.png"), np.full((2, 2, 3), 51, dtype=np.uint8))
    image = f'<image name="i" type="color3"><input name="file" type="filename" value="{pattern}"/></image>'
    (tmp_path / "doc.mtlx").write_text(library(image + unlit("A", 'nodename="i"')))
    (tmp_path / "a.usda").write_text(
        '#usda 1.0\n(\n    startTimeCode = 3\n    endTimeCode = 4\n)\ndef "L" (references = @doc.mtlx@</MaterialX>) {}\n' + square(0, "/L/Materials/A")
    )
    scene = gonio.load_usd(str(tmp_path / "a.usda"))
    assert not [message for _, message in scene.diagnostics if "image" in message] and len(scene.to_dict()["textures"]) == 1
    scene = gonio.load_usd(str(tmp_path / "a.usda"), frame=4)
    assert any("does not exist" in message for _, message in scene.diagnostics), scene.diagnostics


def test_matrices_are_computed_of_what_varies(tmp_path):
    """A vector comes back from a matrix of primvars and its inverse; sums, choices and definitions of matrices."""
    row = '<geompropvalue name="r{0}" type="vector3"><input name="geomprop" type="string" value="row{0}"/></geompropvalue>'
    create = '<creatematrix name="m" type="matrix33"><input name="in1" type="vector3" nodename="r1"/><input name="in2" type="vector3" nodename="r2"/><input name="in3" type="vector3" nodename="r3"/></creatematrix>'
    vector = '<constant name="v" type="vector3"><input name="value" type="vector3" value="0.25, 0.5, 1"/></constant>'

    def by(name, source, matrix):
        return (
            f'<transformmatrix name="{name}" type="vector3"><input name="in" type="vector3" nodename="{source}"/><input name="mat" type="matrix33" nodename="{matrix}"/></transformmatrix>'
            f'<convert name="c_{name}" type="color3"><input name="in" type="vector3" nodename="{name}"/></convert>'
        )

    sum_ = '<add name="s" type="matrix33"><input name="in1" type="matrix33" nodename="m"/><input name="in2" type="matrix33" nodename="m"/></add>'
    choice = '<ifgreater name="w" type="matrix33"><input name="value1" type="float" value="0"/><input name="value2" type="float" value="1"/><input name="in1" type="matrix33" nodename="m"/><input name="in2" type="matrix33" nodename="s"/></ifgreater>'
    own = (
        '<nodedef name="ND_double" node="double_matrix"><input name="in" type="matrix33" value="1,0,0, 0,1,0, 0,0,1"/><output name="out" type="matrix33"/></nodedef>'
        '<nodegraph name="NG_double" nodedef="ND_double"><add name="a" type="matrix33"><input name="in1" type="matrix33" interfacename="in"/><input name="in2" type="matrix33" interfacename="in"/></add>'
        '<output name="out" type="matrix33" nodename="a"/></nodegraph><double_matrix name="d" type="matrix33"><input name="in" type="matrix33" nodename="m"/></double_matrix>'
    )
    text = (
        "".join(row.format(number) for number in (1, 2, 3)) + create + vector + sum_ + choice + own
        + '<invertmatrix name="i" type="matrix33"><input name="in" type="matrix33" nodename="m"/></invertmatrix>'
        + by("a", "v", "m") + by("b", "a", "i") + by("c", "v", "s") + by("e", "v", "w") + by("f", "v", "d")
        + unlit("A", 'nodename="c_a"') + unlit("B", 'nodename="c_b"') + unlit("C", 'nodename="c_c"') + unlit("E", 'nodename="c_e"') + unlit("F", 'nodename="c_f"')
    )  # fmt: skip
    (tmp_path / "doc.mtlx").write_text(library(text))
    rows = np.array([(0.5, 0.25, 0), (0.125, 0.5, 0.25), (0.25, 0, 0.5)])
    own = "\n".join(f"vector3f[] primvars:row{number + 1} = [{tuple(row)}]" for number, row in enumerate(rows.tolist()))
    squares = [square(number, f"/L/Materials/{name}", own) for number, name in enumerate("ABCEF")]
    found, _ = shown(tmp_path / "a.usda", 5, 'def "L" (references = @doc.mtlx@</MaterialX>) {}\n', *squares)
    once = np.array([0.25, 0.5, 1]) @ rows
    assert found == pytest.approx(np.array([once, (0.25, 0.5, 1), 2 * once, 2 * once, 2 * once]), abs=1e-4)


def test_matrices_are_multiplied_transposed_and_measured(tmp_path):
    """Of three and of four rows, constant and of a primvar."""
    create = (
        '<geompropvalue name="r" type="vector3"><input name="geomprop" type="string" value="row"/></geompropvalue>'
        '<creatematrix name="m" type="matrix33"><input name="in1" type="vector3" nodename="r"/><input name="in2" type="vector3" value="0, 0.5, 0"/>'
        '<input name="in3" type="vector3" value="0, 0, 1"/></creatematrix>'
        '<creatematrix name="n" type="matrix44"><input name="in1" type="vector4" value="2, 0, 0, 0"/><input name="in2" type="vector4" value="0, 3, 0, 0"/>'
        '<input name="in3" type="vector4" value="0, 0, 1, 0"/><input name="in4" type="vector4" value="0.1, 0, 0.2, 1"/></creatematrix>'
    )

    def two(name, node, one, other):
        return f'<{node} name="{name}" type="matrix33"><input name="in1" type="matrix33" nodename="{one}"/><input name="in2" type="matrix33" nodename="{other}"/></{node}>'

    def by(name, kind, matrix, value="1, 1, 1"):
        return (
            f'<transformmatrix name="t_{name}" type="vector3"><input name="in" type="vector3" value="{value}"/><input name="mat" type="{kind}" nodename="{matrix}"/></transformmatrix>'
            f'<convert name="c_{name}" type="color3"><input name="in" type="vector3" nodename="t_{name}"/></convert>' + unlit(name, f'nodename="c_{name}"')
        )

    text = (
        create + two("p", "multiply", "m", "m") + two("q", "divide", "p", "m")
        + '<transpose name="x" type="matrix33"><input name="in" type="matrix33" nodename="m"/></transpose>'
        '<determinant name="d" type="float"><input name="in" type="matrix33" nodename="m"/></determinant>'
        '<convert name="c_d" type="color3"><input name="in" type="float" nodename="d"/></convert>'
        + by("A", "matrix33", "p") + by("B", "matrix33", "q") + by("C", "matrix33", "x") + by("D", "matrix44", "n", "0.1, 0.2, 0.3") + unlit("E", 'nodename="c_d"')
    )  # fmt: skip
    (tmp_path / "doc.mtlx").write_text(library(text))
    squares = [square(number, f"/L/Materials/{name}", "vector3f[] primvars:row = [(0.5, 0.25, 0)]") for number, name in enumerate("ABCDE")]
    found, _ = shown(tmp_path / "a.usda", 5, 'def "L" (references = @doc.mtlx@</MaterialX>) {}\n', *squares)
    m, ones = np.array([(0.5, 0.25, 0), (0, 0.5, 0), (0, 0, 1)]), np.ones(3)
    expected = [ones @ m @ m, ones @ m, m @ ones, (0.3, 0.6, 0.5), [np.linalg.det(m)] * 3]
    assert found == pytest.approx(np.array(expected), abs=1e-4)


def test_prefixes_of_files_and_spaces_of_graphs(tmp_path):
    """As the document, a graph and a definition's graph have them."""
    (tmp_path / "maps").mkdir()
    pictures.write_png(tmp_path / "maps" / "f.png", np.full((2, 2, 3), BYTES, dtype=np.uint8))
    image = '<image name="{}" type="color3"><input name="file" type="filename" value="f.png"/></image>'
    text = (
        f'<nodegraph name="G" colorspace="gamma22">{image.format("i")}<output name="o" type="color3" nodename="i"/></nodegraph>\n'
        '<nodedef name="ND_seen" node="seen"><output name="out" type="color3"/></nodedef>'
        f'<nodegraph name="NG_seen" nodedef="ND_seen" colorspace="gamma18">{image.format("i")}<output name="out" type="color3" nodename="i"/></nodegraph>\n'
        '<seen name="s" type="color3"/>' + image.format("j") + unlit("A", 'nodegraph="G"') + unlit("B", 'nodename="s"') + unlit("C", 'nodename="j"')
    )
    found, _ = colours(tmp_path, text, "A", "B", "C", space='colorspace="lin_rec709" fileprefix="maps/"')
    assert found == pytest.approx(np.array([RAW**2.2, RAW**1.8, RAW]), abs=3e-3)
