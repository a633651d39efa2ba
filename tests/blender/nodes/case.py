"""What the catalogue of shader nodes is made of. No Blender needed."""

from dataclasses import dataclass, field

# How a node is held to Cycles.
VALUE = "value"
CLOSURE = "closure"
STRUCTURE = "structure"
NOT_APPLICABLE = "not applicable"

# Largest relative differences that count as exact: of hashes and arithmetic of whole numbers, and of all others.
WHOLE = 1e-6
USUAL = 1e-4


@dataclass(frozen=True)
class Case:
    """A node as it is set for one comparison.

    `fields` are properties of the node ("operation": "ADD"), dotted for what lies deeper ("texture_mapping.scale").
    `inputs` drive sockets by identifier, by name, or by number: a number or a tuple is the socket's value; a text names the data that
    varies from texel to texel ("wide 1", a vector, "unit 2.x", one component), see `data.py`; "hit.NODE.OUTPUT" links another node.
    """

    mode: str
    fields: dict = field(default_factory=dict)
    inputs: dict = field(default_factory=dict)
    # Identifiers of the outputs that are compared; all that are enabled where it is None.
    outputs: tuple | None = None
    # On a sphere, at places as both engines see it, in the stead of a plane of texels.
    on_sphere: bool = False
    # Which of the scenes of `stage.py` shows it; "" is "balls" for what is on a sphere, else "tiles"; "near" are balls of fewer
    # cases, which lie nearer to the origin.
    stage: str = ""
    tolerance: float = USUAL
    # The share of texels that may fall to the other side of a step.
    steps: float = 0.0
    # Whether values hang on steps so small that single precision rounds them: middles of blocks of pixels are compared.
    rounded: bool = False
    # What is looked at: the output, the normal of a surface that it displaces, or what it is: a shader, a volume, a colour.
    seen: str = "output"
    # A function of `prepare.py` that makes the node what fields alone cannot.
    prepare: str | None = None
    # The first and the last Blender that has it.
    since: tuple = (4, 5)
    until: tuple = (9, 9)

    @property
    def shown_on(self) -> str:
        """The scene that shows it."""
        return self.stage or ("balls" if self.on_sphere else "tiles")


@dataclass(frozen=True)
class Node:
    """A row of the catalogue."""

    name: str
    family: str
    kind: str = VALUE
    cases: tuple[Case, ...] = ()
    # Other tests that hold it, or why there is nothing to hold.
    remark: str = ""
    # Why it differs, said where it does and the add-on says nothing.
    reason: str = ""
    # Blenders that have it: the first, and the last where it has gone.
    since: tuple = (4, 5)
    until: tuple = (9, 9)
    # Whether a material that Cycles renders can make use of it, so that it counts among the hundred.
    counts: bool = True


def modes(name: str, values: list[str], **rest) -> tuple[Case, ...]:
    """A case for each value of an enumeration."""
    fields = rest.pop("fields", {})
    return tuple(Case(value, {name: value, **fields}, **rest) for value in values)
