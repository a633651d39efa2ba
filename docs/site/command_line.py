"""The command line's page, from what `gonio --help` and `gonio COMMAND --help` say."""

from __future__ import annotations

import re
import subprocess
from concurrent.futures import ThreadPoolExecutor

COMMAND = re.compile(r"^  ([a-z]+) {2,}(.*)$")
HEADING = re.compile(r"^([A-Z][A-Za-z ]*):$")
# An option or an argument: "  -o, --output <FILE>", "      --json", "  <STAGE>", with its words in the same line or below.
ENTRY = re.compile(r"^ {2,6}((?:-{1,2}[a-zA-Z]|[<\[])\S*(?: \S+)*)(?: {2,}(\S.*))?$")


def page(gonio: list[str]) -> str:
    """All commands with their options; `gonio` is what starts the program."""
    overview = said([*gonio, "--help"])
    commands = [found.groups() for line in overview.splitlines() if (found := COMMAND.match(line)) and found[1] not in ("help",)]
    with ThreadPoolExecutor() as pool:
        helps = list(pool.map(lambda command: said([*gonio, command[0], "--help"]), commands))
    lines = ["# Command line", "", "What `gonio --help` and `gonio COMMAND --help` say.", "", "| command | what |", "| --- | --- |"]
    lines += [f"| [`gonio {name}`](#gonio-{name}) | {plain(words)} |" for name, words in commands]
    lines += ["", *block("Exit status", overview.split("Exit status:\n")[1].splitlines())]
    for (name, _), text in zip(commands, helps, strict=True):
        lines += [f"## gonio {name}", "", *described(text)]
    return "\n".join(lines)


def said(line: list[str]) -> str:
    return subprocess.run(line, capture_output=True, text=True, check=True, timeout=60).stdout


def described(text: str) -> list[str]:
    """One command: its words, its usage, and a table for each heading."""
    head, *rest = re.split(r"^(?=[A-Z][A-Za-z ]*:(?:$| ))", text, flags=re.MULTILINE)
    lines = [plain(head.strip()).replace("<br>", "\n\n"), ""]
    for part in rest:
        first, *body = part.rstrip().splitlines()
        if first.startswith("Usage: "):
            lines += ["```", first.removeprefix("Usage: "), *(line.strip() for line in body if line.strip()), "```", ""]
        elif any(ENTRY.match(line) for line in body) and not first.startswith(("Example", "Exit")):
            lines += table(first.rstrip(":"), body)
        else:
            lines += block(first.rstrip(":"), body)
    return lines


def table(heading: str, body: list[str]) -> list[str]:
    """Options with what they do. Words stand deeper than options; blank lines part paragraphs."""
    rows: list[tuple[str, list[str]]] = []
    for line in body:
        entry = ENTRY.match(line)
        if entry:
            rows.append((entry[1], [entry[2] or ""]))
        elif rows:
            rows[-1][1].append(line.strip())
    lines = [f"**{heading}**", "", f"| {'argument' if heading == 'Arguments' else 'option'} | what |", "| --- | --- |"]
    return [*lines, *(f"| `{option.replace('|', chr(92) + '|')}` | {plain(chr(10).join(words).strip())} |" for option, words in rows), ""]


def block(heading: str, body: list[str]) -> list[str]:
    return [f"**{heading}**", "", "```", *(line for line in body if line.strip()), "```", ""]


def plain(text: str) -> str:
    """Help as the cell of a table: nothing of it is Markdown, and lines of their own stay so."""
    text = re.sub(r"([\\`*_<>|\[\]#])", r"\\\1", text).replace("\\<", "&lt;").replace("\\>", "&gt;")
    return re.sub(r"\n+", "<br>", text)
