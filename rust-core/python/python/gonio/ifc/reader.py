"""The process that reads a model: `python -m gonio.ifc.reader MODEL STAGE` answers with a line of JSON."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from .stage import build


def main(source: str, target: str) -> None:
    """Writes the stage; the answer has the notes or an error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    # Libraries that print must not answer.
    os.dup2(2, 1)
    try:
        answer: dict[str, object] = {"notes": build(Path(source), Path(target))}
    except ValueError as error:
        answer = {"error": " ".join(str(error).split())}
    except Exception as error:  # What IFC's schema forbids may stand anywhere.
        answer = {"error": f"{source}: the model is malformed ({type(error).__name__}: {' '.join(str(error).split())})"}
    print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
