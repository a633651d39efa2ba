"""IFC building models as USD stages: what the extra `ifc` brings.

`write_stage` reads IFC2X3, IFC4 and IFC4X3 files by IfcOpenShell. `docs/models.md` says what becomes of what.
"""

from .apart import write_stage

__all__ = ["write_stage"]
