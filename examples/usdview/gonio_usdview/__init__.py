"""A menu of usdview that renders what it shows with gonio.

Put the folder above this one on PYTHONPATH, and this folder on PXR_PLUGINPATH_NAME.
"""

from pxr import Tf
from pxr.Usdviewq.plugin import PluginContainer


class GonioContainer(PluginContainer):
    """The menu 'gonio'."""

    def registerPlugins(self, registry, _api):
        window = self.deferredImport(".window")
        self._render = registry.registerCommandPlugin("GonioContainer.render", "Render View", window.render)

    def configureView(self, _registry, builder):
        builder.findOrCreateMenu("gonio").addItem(self._render, shortcut="Ctrl+Shift+R")


Tf.Type.Define(GonioContainer)
