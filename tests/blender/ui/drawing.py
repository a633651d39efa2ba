"""Which properties panels draw, without a window. Used inside the child process."""

import types

import bpy

HOLDERS = {"row", "column", "box", "split", "column_flow", "grid_flow"}
WIDGETS = {"prop", "prop_search", "prop_menu_enum"}


class Layout:
    """Takes what a panel draws and notes the properties: the type of their owner and their name."""

    def __init__(self, drawn):
        self.__dict__["_drawn"] = drawn

    def __setattr__(self, name, value):
        pass

    def __getattr__(self, name):
        if name in HOLDERS:
            return lambda *_, **__: Layout(self._drawn)
        if name in WIDGETS:
            return lambda owner, what, *_, **__: self._drawn.add((type(owner).__name__, what))
        if name == "operator":
            return lambda *_, **__: types.SimpleNamespace()
        return lambda *_, **__: None


class Drawn:
    """A panel's class as its methods know it, with a layout."""

    is_popover = False

    def __init__(self, panel, layout):
        self._panel, self.layout = panel, layout

    def __getattr__(self, name):
        value = next(each.__dict__[name] for each in self._panel.__mro__ if name in each.__dict__)
        if isinstance(value, (staticmethod, classmethod)):
            return value.__get__(None, self._panel)
        return value.__get__(self) if isinstance(value, types.FunctionType) else value


class Context:
    """What panels ask of a context; None for all else."""

    def __init__(self, engine, **known):
        self.__dict__.update(known, engine=engine)

    def __getattr__(self, name):
        return None


def contexts(engine):
    """Contexts of the open scene, one for each of its objects."""
    scene = bpy.context.scene
    scene.render.engine = engine
    for thing in scene.objects:
        of_kind = {thing.type.lower(): thing.data, "material": thing.active_material or bpy.data.materials[0]}
        space = types.SimpleNamespace(type="PROPERTIES", pin_id=None, use_pin_id=False)
        shared = {"view_layer": scene.view_layers[0], "world": scene.world, "preferences": bpy.context.preferences, "space_data": space}
        yield Context(engine, scene=scene, object=thing, active_object=thing, mode="OBJECT", blend_data=bpy.data, **shared, **of_kind)


def panels(engine):
    """The panels of the properties editor that an engine shows."""

    def below(kind):
        for each in kind.__subclasses__():
            yield each
            yield from below(each)

    found = [panel for panel in dict.fromkeys(below(bpy.types.Panel)) if engine in getattr(panel, "COMPAT_ENGINES", ())]
    return [panel for panel in found if getattr(panel, "bl_space_type", "") == "PROPERTIES" and hasattr(panel, "bl_context")]


def drawn_by(engine, shown=None):
    """The properties that an engine's panels draw for the open scene's objects; what a panel asks of a window ends it."""
    found = set()
    for context in contexts(engine):
        for panel in shown or panels(engine):
            made = Drawn(panel, Layout(found))
            try:
                if hasattr(panel, "poll") and not panel.poll(context):
                    continue
                for name in ("draw_header", "draw"):
                    if any(name in each.__dict__ for each in panel.__mro__):
                        getattr(made, name)(context)
            except (AttributeError, TypeError, SystemError) as problem:
                assert not panel.__name__.startswith(("GONIO", "CYCLES")) or "NoneType" in str(problem), (panel, problem)
    return found
