"""What the package says of each public name, as JSON: `python python_words.py`, run by the Python that has gonio."""

import json

import gonio


def main() -> None:
    found = {}
    for name in gonio.__all__:
        thing = getattr(gonio, name)
        if isinstance(thing, str):
            continue
        found[name] = thing.__doc__ or ""
        for base in reversed(thing.__mro__) if isinstance(thing, type) else ():
            if base.__module__.startswith("gonio"):
                found.update({f"{name}.{member}": value.__doc__ or "" for member, value in vars(base).items() if member[0] != "_"})
    print(json.dumps(found))


main()
