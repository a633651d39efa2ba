"""What usdview shows, as a command line of gonio: the stage as it stands, with the view as a camera. Knows nothing of windows."""

import pathlib
import sys

from pxr import Sdf, Usd, UsdGeom

CAMERA = "/gonio_view"


def command(api, folder, size, samples=64):
    """The command that renders the view into a picture in the folder; gives it and the picture's path."""
    folder = pathlib.Path(folder)
    picture = folder / "view.png"
    root, session = files(api, folder)
    line = [sys.executable, "-m", "gonio.cli", "render", root, "--session-layer", session, "--camera", CAMERA, "-o", picture]
    line += ["--res", *size, "--spp", samples, "--snapshot", 2, "--purposes", ",".join(purposes(api))]
    if not api.frame.IsDefault():
        line += ["--frames", api.frame.GetValue()]
    return [str(word) for word in line], picture


def files(api, folder):
    """The stage's file, and a layer with the view's camera over what usdview itself has changed."""
    stage = api.stage
    above = Sdf.Layer.CreateNew(str(folder / "session.usda"))
    root = stage.GetRootLayer().realPath
    if not root or any(layer.dirty for layer in stage.GetUsedLayers() if layer != stage.GetSessionLayer()):
        # What is not saved is nowhere but in this process.
        root = str(folder / "stage.usdc")
        stage.Export(root)
    else:
        above.TransferContent(stage.GetSessionLayer())
    add_camera(above, api)
    above.Save()
    return root, folder / "session.usda"


def add_camera(layer, api):
    """The free camera of the view, or the one that is looked through, as a prim of its own."""
    alone = Usd.Stage.CreateInMemory()
    # The new prim is in the stage's units and axes, as the view's camera is.
    UsdGeom.Camera.Define(alone, CAMERA).SetFromCamera(api.currentGfCamera, Usd.TimeCode.Default())
    Sdf.CreatePrimInLayer(layer, CAMERA)
    Sdf.CopySpec(alone.GetRootLayer(), CAMERA, layer, CAMERA)


def purposes(api):
    """Those that the view shows."""
    settings = getattr(getattr(api, "dataModel", None), "viewSettings", None)
    shown = {"render": "displayRender", "proxy": "displayProxy", "guide": "displayGuide"}
    return ["default"] + [purpose for purpose, name in shown.items() if getattr(settings, name, purpose == "render")]
