"""Stages that are nested absurdly. Each function writes its files into a folder; the first, stage.usda, shows a room beside the nest."""

import pictures

MESH = """
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)]
    uniform token subdivisionScheme = "none"
    {more}
}}
"""
HEADER = pictures.HEADER.format(metres=1, up="Y")


def stage(folder, body="", head="", name="stage.usda"):
    """The room with its lamp and a camera, and what is hostile."""
    text = (HEADER + pictures.ROOM + pictures.LAMP + pictures.camera() + body).replace("(\n", f"(\n    {head}\n", 1)
    (folder / name).write_text(text)


def layer(folder, name, body="", head=""):
    (folder / name).write_text(HEADER.replace("(\n", f"(\n    {head}\n", 1) + body)


def deep(count, first="def Xform \"A\" {\n", inner="def Cube \"C\" {}\n"):
    return first * count + inner + "}\n" * count


# Hierarchies.


def xforms_10000(folder):
    stage(folder, deep(10_000))


def moved_xforms_10000(folder):
    op = "double3 xformOp:translate = (0.0001, 0, 0)\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
    stage(folder, deep(10_000, 'def Xform "A" {\n' + op))


def xforms_over_seven_crates(folder):
    """Each file is as deep as a file may be; together they are 10,000 deep."""
    from pxr import Sdf

    for number in range(7):
        inner = f'def "N" (prepend references = @d{number + 1}.usdc@</A>) {{}}\n' if number < 6 else 'def Cube "C" {}\n'
        text = Sdf.Layer.CreateAnonymous(".usda")
        assert text.ImportFromString("#usda 1.0\n" + deep(1500, inner=inner))
        text.Export(str(folder / f"d{number}.usdc"))
    stage(folder, 'def "X" (prepend references = @d0.usdc@</A>) {}\n')


def variants_200(folder):
    body = 'def Cube "C" {}\n'
    for number in range(200):
        body = f'def "V{number}" (\nvariants = {{\nstring v = "a"\n}}\nprepend variantSets = "v"\n)\n{{\nvariantSet "v" = {{\n"a" {{\n{body}}}\n}}\n}}\n'
    stage(folder, body)


def metadata_5000(folder):
    stage(folder, 'def "D" (\ncustomData = ' + "{\ndictionary a = " * 5000 + "{}" + "\n}" * 5000 + "\n) {}\n")


# Layers.


def sublayers_in_a_circle(folder):
    stage(folder, head="subLayers = [@a.usda@]")
    for name, following in (("a", "b"), ("b", "c"), ("c", "a")):
        layer(folder, f"{name}.usda", head=f"subLayers = [@{following}.usda@]")


def sublayer_of_itself(folder):
    stage(folder, head="subLayers = [@stage.usda@, @./stage.usda@]")


def sublayers_500(folder):
    stage(folder, head="subLayers = [@l0.usda@]")
    for number in range(500):
        layer(folder, f"l{number}.usda", 'def Cube "Last" {}\n' if number == 499 else "", f"subLayers = [@l{number + 1}.usda@]" if number < 499 else "")


def references_in_a_circle(folder):
    stage(folder, 'def "X" (prepend references = @a.usda@</A>) {}\n')
    for name, following in (("a", "b"), ("b", "c"), ("c", "a")):
        layer(folder, f"{name}.usda", f'def "A" (prepend references = @{following}.usda@</A>)\n{{\n def Cube "C{name}" {{}}\n}}\n')


def reference_to_the_parent(folder):
    stage(folder, 'def Xform "P"\n{\n def Cube "C" {}\n def "K" (prepend references = </P>) {}\n}\n')


def references_between_children(folder):
    stage(folder, 'def "P"\n{\n def "K" (prepend references = </Q/L>) {}\n}\ndef "Q"\n{\n def "L" (prepend references = </P>) {}\n}\n')


def reference_in_a_variant(folder):
    body = 'def "V" (\nvariants = {\nstring v = "a"\n}\nprepend variantSets = "v"\n)\n{\nvariantSet "v" = {\n"a" (\nprepend references = </V>\n) {\n}\n}\n}\n'
    stage(folder, body)


def payloads_500(folder):
    stage(folder, 'def "X" (prepend payload = @p0.usda@</A>) {}\n')
    for number in range(500):
        onwards = f"(prepend payload = @p{number + 1}.usda@</A>)" if number < 499 else ""
        layer(folder, f"p{number}.usda", f'def Xform "A" {onwards}\n{{\n def Cube "C{number}" {{\ndouble size = 0.1\n}}\n}}\n')


def payloads_in_a_circle(folder):
    stage(folder, 'def "X" (prepend payload = @p0.usda@</A>) {}\n')
    for number in range(100):
        layer(folder, f"p{number}.usda", f'def "A" (prepend payload = @p{(number + 1) % 100}.usda@</A>) {{}}\n')


def inherits_1000(folder):
    body = "".join(f'class "K{k}" (inherits = </K{k + 1}>) {{}}\n' for k in range(1000)) + 'class "K1000" {\ndouble size = 0.3\n}\n'
    stage(folder, body + 'def Cube "C" (inherits = </K0>) {}\n')


def doubled_references(levels):
    """Each prim has two children that are the next one: 2 to the power of the levels."""

    def write(folder):
        two = "".join(
            f'def Xform "L{k}"\n{{\n def "a" (prepend references = </L{k + 1}>) {{}}\n def "b" (prepend references = </L{k + 1}>) {{}}\n}}\n'
            for k in range(levels)
        )
        stage(folder, two + f'def Cube "L{levels}" {{\ndouble size = 0.01\n}}\n')

    return write


# Relationships.


def bad_relationships_100000(folder):
    kinds = (
        'def Cube "P{0}" (prepend apiSchemas = ["MaterialBindingAPI"]) {{\ndouble size = 0.01\nrel material:binding = </Nowhere/M{0}>\n}}\n',
        'def PointInstancer "P{0}" {{\nint[] protoIndices = [0]\npoint3f[] positions = [(0, 0, 0)]\nrel prototypes = </Nowhere{0}>\n}}\n',
        'def Scope "P{0}" {{\nrel proxyPrim = </P{0}>\nrel odd = [</P{0}.odd>, </Q.x{0}>]\n}}\n',
        'def SphereLight "P{0}" {{\nfloat inputs:intensity = 0\nrel light:filters = </Nowhere{0}>\nfloat inputs:radius.connect = </P{0}.inputs:radius>\n}}\n',
    )
    stage(folder, "".join(kinds[number % 4].format(number) for number in range(100_000)))


def prims_100000_with_bad_points(folder):
    one = 'def Mesh "P{0}" {{\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 9]\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}}\n'
    stage(folder, "".join(one.format(number) for number in range(100_000)))


def collections_in_a_circle(folder):
    lamp = 'def SphereLight "L{0}" (prepend apiSchemas = ["CollectionAPI:lightLink"])\n{{\n float inputs:intensity = 9\n rel collection:lightLink:includes = [</L{1}.collection:lightLink>, </Floor>]\n}}\n'
    stage(folder, "".join(lamp.format(number, (number + 1) % 300) for number in range(300)))


def targets_of_one_relationship_100000(folder):
    paths = ", ".join(f"</Nowhere{number}>" for number in range(100_000))
    body = f'def PointInstancer "P" {{\nint[] protoIndices = [99999]\npoint3f[] positions = [(0, 0, 0)]\nrel prototypes = [{paths}]\n}}\n'
    stage(folder, body + MESH.format(more=f"rel material:binding = [{paths}]"))


# Instancers.


def instancer(name, prototypes, body="", count=1):
    numbers, places = ", ".join("0" * count), ", ".join(["(0, 0, 0)"] * count)
    return f'def PointInstancer "{name}"\n{{\nint[] protoIndices = [{numbers}]\npoint3f[] positions = [{places}]\nrel prototypes = <{prototypes}>\n{body}}}\n'


def instancers_of_themselves(folder):
    stage(folder, instancer("I", "/I") + instancer("J", "/J/K", instancer("K", "/J")) + instancer("M", "/N") + instancer("N", "/M"))


def instancers_in_a_ring_of_1000(folder):
    stage(folder, "".join(instancer(f"I{k}", f"/I{(k + 1) % 1000}", count=2) for k in range(1000)))


def instancers_500_deep(folder):
    # Relative paths, for absolute ones grow with the square of the depth.
    body = 'def Cube "P" {\ndouble size = 0.1\n}\n'
    for _ in range(500):
        body = instancer("P", "P", body)
    stage(folder, body)


def instancers_one_after_another_500(folder):
    stage(folder, "".join(instancer(f"I{k}", f"/I{k + 1}") for k in range(500)) + 'def Cube "I500" {\ndouble size = 0.1\n}\n')


def instances_in_a_circle(folder):
    body = 'def "A" (\ninstanceable = true\nprepend references = </B>\n) {}\ndef "B"\n{\n def "K" (\ninstanceable = true\nprepend references = </A>\n) {}\n}\n'
    stage(folder, body)


# Subsets.


def subsets_in_subsets_1000(folder):
    subset = 'def GeomSubset "S" {\nuniform token elementType = "face"\nuniform token familyName = "materialBind"\nint[] indices = [0]\n'
    stage(folder, MESH.format(more=deep(1000, subset, "")))


def subsets_20000(folder):
    subset = 'def GeomSubset "S{0}" {{\nuniform token elementType = "face"\nuniform token familyName = "materialBind"\nint[] indices = [0, 0, {0}]\nrel material:binding = </S{0}>\n}}\n'
    stage(folder, MESH.format(more="".join(subset.format(number) for number in range(20_000))))


def subset_of_millions(folder):
    subset = 'def GeomSubset "S" {\nuniform token elementType = "face"\nuniform token familyName = "materialBind"\nint[] indices = [' + "0, " * 2_000_000 + "0]\n}\n"
    stage(folder, MESH.format(more=subset))


def meshes_in_meshes_1000(folder):
    mesh = 'def Mesh "M" {\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\npoint3f[] points = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)]\n'
    stage(folder, deep(1000, mesh, ""))


HIERARCHIES = [xforms_10000, moved_xforms_10000, xforms_over_seven_crates, variants_200, metadata_5000, meshes_in_meshes_1000]
LAYERS = [
    sublayers_in_a_circle,
    sublayer_of_itself,
    sublayers_500,
    references_in_a_circle,
    reference_to_the_parent,
    references_between_children,
    reference_in_a_variant,
    payloads_500,
    payloads_in_a_circle,
    inherits_1000,
]
RELATIONSHIPS = [bad_relationships_100000, prims_100000_with_bad_points, collections_in_a_circle, targets_of_one_relationship_100000]
INSTANCES = [
    instancers_of_themselves,
    instancers_in_a_ring_of_1000,
    instancers_500_deep,
    instancers_one_after_another_500,
    instances_in_a_circle,
]
SUBSETS = [subsets_in_subsets_1000, subsets_20000, subset_of_millions]
