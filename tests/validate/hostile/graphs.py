"""Material graphs that are nested absurdly, as the bodies of stages; a wall is bound to /M."""

import pictures
from nests import MESH, layer, stage

WALL = MESH.format(more="rel material:binding = </M>")
SURFACE = """
    token outputs:mtlx:surface.connect = </M/S.outputs:out>
    def Shader "S"
    {{
        uniform token info:id = "ND_standard_surface_surfaceshader"
        color3f inputs:base_color.connect = <{source}>
        token outputs:out
    }}
"""
PREVIEW = """
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>
        token outputs:surface
    }
    def Shader "T"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @there.png@
        float2 inputs:st.connect = </M/U0.outputs:result>
        float3 outputs:rgb
    }
"""


def material(*parts):
    return WALL + 'def Material "M"\n{' + "".join(parts) + "}\n"


def add(number, first, second):
    """A node that adds two others."""
    ends = "".join(f"color3f inputs:in{k + 1}.connect = </M/N{end}.outputs:out>\n" for k, end in enumerate((first, second)))
    return f'def Shader "N{number}"\n{{\nuniform token info:id = "ND_add_color3"\n{ends}color3f outputs:out\n}}\n'


def constant(number):
    value = f'def Shader "N{number}"\n{{\nuniform token info:id = "ND_constant_color3"\n'
    return value + "color3f inputs:value = (0.1, 0.2, 0.3)\ncolor3f outputs:out\n}\n"


def from_first(*parts):
    return material(SURFACE.format(source="/M/N0.outputs:out"), *parts)


def nodes_3000_deep(folder):
    chain = (add(k, k + 1, 3001) for k in range(3000))
    stage(folder, from_first(*chain, constant(3000), constant(3001)))


def nodes_in_a_circle(folder):
    stage(folder, from_first(add(0, 1, 0), add(1, 2, 1), add(2, 0, 2)))


def nodes_in_a_circle_of_3000(folder):
    stage(folder, from_first(*(add(k, (k + 1) % 3000, (k + 1) % 3000) for k in range(3000))))


def nodes_doubled_64_times(folder):
    stage(folder, from_first(*(add(k, k + 1, k + 1) for k in range(64)), constant(64)))


def patterns_that_vary_3000_deep(folder):
    """A chain that no folding of constants shortens."""
    noise = 'def Shader "N3000"\n{\nuniform token info:id = "ND_noise3d_color3"\ncolor3f outputs:out\n}\n'
    chain = (add(k, k + 1, 3001) for k in range(3000))
    stage(folder, from_first(*chain, noise, constant(3001)))


def node_graphs_500_deep(folder):
    inner = 'color3f outputs:out.connect = <N.outputs:out>\ndef Shader "N"\n{\nuniform token info:id = "ND_constant_color3"\ncolor3f outputs:out\n}\n'
    for _ in range(500):
        inner = 'color3f outputs:out.connect = <G.outputs:out>\ndef NodeGraph "G"\n{\n' + inner + "}\n"
    stage(folder, material(SURFACE.format(source="/M/G.outputs:out"), 'def NodeGraph "G"\n{\n' + inner + "}\n"))


def interfaces_in_a_circle(folder):
    graph = 'def NodeGraph "{0}"\n{{\ncolor3f inputs:a.connect = </M/{1}.outputs:o>\ncolor3f outputs:o.connect = </M/{0}.inputs:a>\n}}\n'
    stage(folder, material(SURFACE.format(source="/M/A.outputs:o"), graph.format("A", "B"), graph.format("B", "A")))


def interfaces_5000_long(folder):
    link = "".join(f"color3f inputs:a{k}.connect = </M.inputs:a{k + 1}>\n" for k in range(5000))
    stage(folder, material(SURFACE.format(source="/M.inputs:a0"), link, "color3f inputs:a5000 = (0.1, 0.8, 0.1)\n"))


def places_3000_deep(folder):
    picture(folder)
    stage(folder, material(PREVIEW, *(place(k, k + 1) for k in range(3000)), place(3000, None)))


def places_in_a_circle_of_3000(folder):
    picture(folder)
    stage(folder, material(PREVIEW, *(place(k, (k + 1) % 3000) for k in range(3000))))


def picture(folder):
    pictures.write_png(folder / "there.png", [[[200, 100, 50]] * 4] * 4)


def place(number, following):
    end = f"float2 inputs:in.connect = </M/U{following}.outputs:result>\n" if following is not None else ""
    return f'def Shader "U{number}"\n{{\nuniform token info:id = "UsdTransform2d"\n{end}float2 outputs:result\n}}\n'


DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.38">
{body}
  <standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="first"/></standard_surface>
  <surfacematerial name="Mat" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
"""


def document(folder, body):
    (folder / "doc.mtlx").write_text(DOCUMENT.format(body=body))
    bound = MESH.format(more="rel material:binding = </L/Materials/Mat>")
    stage(folder, 'def "L" (prepend references = @doc.mtlx@</MaterialX>) {}\n' + bound)


def chain(count, last):
    """Nodes of a document, each of which adds the next one to itself."""
    name = lambda k: "first" if k == 0 else f"n{k}"  # noqa: E731
    one = '<add name="{0}" type="color3"><input name="in1" type="color3" nodename="{1}"/><input name="in2" type="color3" nodename="{1}"/></add>'
    return "\n".join(one.format(name(k), name(k + 1) if k + 1 < count else last) for k in range(count))


def document_3000_deep(folder):
    document(folder, chain(3000, "end") + '<constant name="end" type="color3"><input name="value" type="color3" value="0, 0.1, 0"/></constant>')


def document_in_a_circle(folder):
    document(folder, chain(3000, "first"))


def definition_of_itself(folder):
    head = '<nodedef name="ND_{0}" node="{0}" type="color3"><output name="out" type="color3"/></nodedef>'
    graph = '<nodegraph name="NG_{0}" nodedef="ND_{0}"><{1} name="i" type="color3"/><output name="out" type="color3" nodename="i"/></nodegraph>'
    pairs = (("one", "two"), ("two", "three"), ("three", "one"))
    document(folder, "\n".join(head.format(a) + graph.format(a, b) for a, b in pairs) + '<one name="first" type="color3"/>')


def definitions_doubled_40_times(folder):
    head = '<nodedef name="ND_d{0}" node="d{0}" type="color3"><output name="out" type="color3"/></nodedef>'
    two = '<{1} name="a" type="color3"/><{1} name="b" type="color3"/>'
    both = '<add name="s" type="color3"><input name="in1" type="color3" nodename="a"/><input name="in2" type="color3" nodename="b"/></add>'
    graph = '<nodegraph name="NG_d{0}" nodedef="ND_d{0}">' + two + both + '<output name="out" type="color3" nodename="s"/></nodegraph>'
    pairs = [(k, f"d{k + 1}" if k < 39 else "constant") for k in range(40)]
    document(folder, "\n".join(head.format(k) + graph.format(k, following) for k, following in pairs) + '<d0 name="first" type="color3"/>')


def documents_that_include_each_other(folder):
    for name, following in (("doc", "other"), ("other", "doc")):
        (folder / f"{name}.mtlx").write_text(
            '<?xml version="1.0"?>\n<materialx version="1.38" xmlns:xi="http://www.w3.org/2001/XInclude">\n'
            f'<xi:include href="{following}.mtlx"/>\n</materialx>\n'
        )
    stage(folder, 'def "L" (prepend references = @doc.mtlx@</MaterialX>) {}\n')


def elements_10000_deep(folder):
    document(folder, "".join(f'<nodegraph name="g{k}">' for k in range(10_000)) + "</nodegraph>" * 10_000)


def materials_that_reference_each_other(folder):
    layer(folder, "m.usda", 'def Material "M" (prepend references = @stage.usda@</M>) {}\n')
    stage(folder, WALL + 'def Material "M" (prepend references = @m.usda@</M>) {}\n')


GRAPHS = [
    nodes_3000_deep,
    nodes_in_a_circle,
    nodes_in_a_circle_of_3000,
    nodes_doubled_64_times,
    patterns_that_vary_3000_deep,
    node_graphs_500_deep,
    interfaces_in_a_circle,
    interfaces_5000_long,
    places_3000_deep,
    places_in_a_circle_of_3000,
    document_3000_deep,
    document_in_a_circle,
    definition_of_itself,
    definitions_doubled_40_times,
    documents_that_include_each_other,
    elements_10000_deep,
    materials_that_reference_each_other,
]
