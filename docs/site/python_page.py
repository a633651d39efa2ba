"""The page on the Python package: signatures from its stubs and sources, words from the package itself."""

from __future__ import annotations

import ast
import json
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "rust-core" / "python" / "python" / "gonio"
WORDS = Path(__file__).with_name("python_words.py")
# Where public names are defined; what stands later adds to classes of the same name.
FILES = ("_gonio.pyi", "scene.py", "oidn.py", "placing.py", "texture.py")
INTRODUCTION = """# Python

What `import gonio` brings. Lengths are metres, luminances cd/m², illuminances lx, angles degrees unless it says otherwise. Signatures are those of the
package's type stubs. `Numbers` is anything with the buffer protocol, such as arrays of numpy. Errors are subclasses of `gonio.Error`.
"""


def page(python: str) -> str:
    """All public names; `python` is one that has gonio."""
    words = json.loads(subprocess.run([python, str(WORDS)], capture_output=True, text=True, check=True, timeout=60).stdout)
    classes, functions = definitions()
    shown = {name: classes[name] for name in sorted(words) if name in classes}
    lines = [INTRODUCTION, "## Functions", ""]
    for name in sorted(words):
        if name in functions:
            lines += [f"### gonio.{name}", "", *code([functions[name]]), *paragraphs(words[name])]
    lines += ["## Classes", ""]
    for name, members in shown.items():
        lines += [f"### gonio.{name}", "", *paragraphs(words[name]), *body(name, members, words)]
    return "\n".join(lines)


def definitions() -> tuple[dict[str, list[ast.stmt]], dict[str, str]]:
    """Members of classes, and headers of functions, by name."""
    classes: dict[str, list[ast.stmt]] = {}
    functions: dict[str, str] = {}
    for name in FILES:
        source = (PACKAGE / name).read_text()
        for node in ast.parse(source).body:
            if isinstance(node, ast.ClassDef):
                members = classes.setdefault(node.name, [])
                for member in node.body:
                    member.header = header(source, member)  # type: ignore[attr-defined]
                    members.append(member)
            elif isinstance(node, ast.FunctionDef):
                functions[node.name] = header(source, node)
    return classes, functions


def header(source: str, node: ast.AST) -> str:
    """A definition without its body, as it stands in the file, moved to the margin."""
    if not isinstance(node, ast.FunctionDef):
        return ast.get_source_segment(source, node) or ""
    first = node.body[0]
    lines = source.splitlines()[node.lineno - 1 : max(first.lineno - 1, node.lineno)]
    end = source.splitlines()[first.lineno - 1]
    if first.lineno > node.lineno and end.lstrip().startswith(")"):
        lines.append(end)
    margin = len(lines[0]) - len(lines[0].lstrip())
    return re.sub(r":( \.\.\.)?$", "", "\n".join(line[margin:] for line in lines))


def body(name: str, members: list[ast.stmt], words: dict[str, str]) -> list[str]:
    """A class's values as a table, and each of its methods."""
    values, methods = [], []
    for member in members:
        if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name):
            values.append(row(member.target.id, member.annotation, ""))
        elif isinstance(member, ast.FunctionDef) and (member.name == "__new__" or member.name[0] != "_"):
            said = words.get(f"{name}.{member.name}", "")
            if any(isinstance(mark, ast.Name) and mark.id == "property" for mark in member.decorator_list):
                values.append(row(member.name, member.returns, said))
            elif member.name != "__new__":
                methods += [f"#### {name}.{member.name}", "", *code([member.header]), *paragraphs(said)]
            elif len(member.args.args) + len(member.args.kwonlyargs) > 1:
                methods += code([member.header])
    table = ["| value | type | what |", "| --- | --- | --- |", *values, ""] if values else []
    return [*table, *methods]


def row(name: str, kind: ast.expr | None, said: str) -> str:
    shown = ast.unparse(kind).replace("|", "\\|") if kind else ""
    return f"| `{name}` | `{shown}` | {' '.join(said.split()).replace('|', chr(92) + '|')} |"


def code(lines: list[str]) -> list[str]:
    return ["```python", *lines, "```", ""]


def paragraphs(said: str) -> list[str]:
    """A documentation string; what is indented in it stays so."""
    return [*said.strip().splitlines(), ""]
