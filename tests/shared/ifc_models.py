"""Small IFC models for tests, made by IfcOpenShell; lengths are given in metres, whatever the model's unit."""

import importlib

import numpy as np

FOOT = 0.3048


def api(usecase, model, **arguments):
    """A use case of IfcOpenShell's API, such as `root.create_entity`."""
    module, name = usecase.split(".")
    return getattr(importlib.import_module(f"ifcopenshell.api.{module}"), name)(model, **arguments)


class Building:
    """A site, a building and a storey, with blocks in it."""

    def __init__(self, schema="IFC4", unit="metre"):
        self.model = _new(schema)
        self.unit = {"metre": 1.0, "millimetre": 0.001, "foot": FOOT}[unit]
        self.project = self.new("IfcProject", "Project")
        if unit == "foot":
            length = api("unit.add_conversion_based_unit", self.model, name="foot")
        else:
            length = api("unit.add_si_unit", self.model, unit_type="LENGTHUNIT", prefix="MILLI" if unit == "millimetre" else None)
        angle = api("unit.add_si_unit", self.model, unit_type="PLANEANGLEUNIT")
        api("unit.assign_unit", self.model, units=[length, angle])
        self.context = api("context.add_context", self.model, context_type="Model")
        words = {"context_type": "Model", "target_view": "MODEL_VIEW", "parent": self.context}
        self.body = api("context.add_context", self.model, context_identifier="Body", **words)
        self.site, self.house, self.storey = self.new("IfcSite", "Site"), self.new("IfcBuilding", "House"), self.new("IfcBuildingStorey", "Ground")
        for part, whole in ((self.site, self.project), (self.house, self.site), (self.storey, self.house)):
            api("aggregate.assign_object", self.model, products=[part], relating_object=whole)

    def new(self, kind, name=None, **attributes):
        """A rooted entity."""
        entity = api("root.create_entity", self.model, ifc_class=kind, name=name)
        for attribute, value in attributes.items():
            setattr(entity, attribute, value)
        return entity

    def length(self, values):
        return [float(value) / self.unit for value in values]

    def point(self, values):
        return self.model.create_entity("IfcCartesianPoint", self.length(values))

    def direction(self, values):
        return self.model.create_entity("IfcDirection", [float(value) for value in values])

    def axes(self, place=(0, 0, 0), z=None, x=None):
        """An IfcAxis2Placement3D."""
        words = (None if z is None else self.direction(z), None if x is None else self.direction(x))
        return self.model.create_entity("IfcAxis2Placement3D", self.point(place), *words)

    def solid(self, size, place=(0, 0, 0)):
        """A box from a corner."""
        width, depth, height = self.length(size)
        middle = self.model.create_entity("IfcCartesianPoint", (0.5 * width, 0.5 * depth))
        flat = self.model.create_entity("IfcAxis2Placement2D", middle)
        profile = self.model.create_entity("IfcRectangleProfileDef", "AREA", None, flat, width, depth)
        return self.extruded(profile, height * self.unit, place)

    def prism(self, corners, height, place=(0, 0, 0)):
        """A polygon of (x, y) lifted."""
        points = [self.model.create_entity("IfcCartesianPoint", self.length(corner)) for corner in [*corners, corners[0]]]
        outline = self.model.create_entity("IfcPolyline", points)
        return self.extruded(self.model.create_entity("IfcArbitraryClosedProfileDef", "AREA", None, outline), height, place)

    def extruded(self, profile, height, place):
        return self.model.create_entity("IfcExtrudedAreaSolid", profile, self.axes(place), self.direction((0, 0, 1)), *self.length([height]))

    def place(self, element, matrix):
        """Places an element by a matrix, metres."""
        matrix = np.array(matrix, float)
        matrix[:3, 3] /= self.unit
        api("geometry.edit_object_placement", self.model, product=element, matrix=matrix, is_si=False)

    def show(self, element, items, kind="SweptSolid", name="Body"):
        """Gives an element a representation."""
        shape = self.model.create_entity("IfcShapeRepresentation", self.body, name, kind, items)
        if element.Representation:
            element.Representation.Representations = [*element.Representation.Representations, shape]
        else:
            element.Representation = self.model.create_entity("IfcProductDefinitionShape", None, None, [shape])
        return shape

    def block(self, kind, name, low, high, style=None, **attributes):
        """A box between two corners in the storey."""
        element = self.new(kind, name, **attributes)
        low, high = np.array(low, float), np.array(high, float)
        solid = self.solid(high - low)
        self.show(element, [solid])
        self.place(element, moved(low))
        if kind == "IfcSpace":
            api("aggregate.assign_object", self.model, products=[element], relating_object=self.storey)
        elif kind != "IfcOpeningElement":
            api("spatial.assign_container", self.model, products=[element], relating_structure=self.storey)
        if style:
            self.paint(solid, style)
        return element

    def hole(self, element, low, high):
        """An opening through an element."""
        opening = self.block("IfcOpeningElement", None, low, high)
        self.model.create_entity("IfcRelVoidsElement", _guid(), element.OwnerHistory, None, None, element, opening)
        return opening

    def colour(self, values):
        return self.model.create_entity("IfcColourRgb", None, *map(float, values))

    def style(self, name, colour=(0.5, 0.5, 0.5), transparency=None, method="NOTDEFINED"):
        """A style of rendering."""
        words = {"SurfaceColour": self.colour(colour), "Transparency": transparency, "ReflectanceMethod": method}
        return self.surface(name, self.model.create_entity("IfcSurfaceStyleRendering", **words))

    def surface(self, name, part):
        return self.model.create_entity("IfcSurfaceStyle", name, "BOTH", [part])

    def paint(self, item, style):
        styles = [style]
        if self.model.schema == "IFC2X3":
            styles = [self.model.create_entity("IfcPresentationStyleAssignment", styles)]
        self.model.create_entity("IfcStyledItem", item, styles, None)

    def properties(self, element, name, **values):
        """A property set."""
        api("pset.edit_pset", self.model, pset=api("pset.add_pset", self.model, product=element, name=name), properties=values)

    def fixture(self, name, place, *sources, matrix=None, body=None, kind="IfcLightFixture"):
        """A light fixture with light sources, and a box (low, high) about its origin as its body."""
        element = self.new(kind, name)
        self.place(element, moved(place) if matrix is None else matrix)
        api("spatial.assign_container", self.model, products=[element], relating_structure=self.storey)
        if body:
            low, high = np.array(body[0], float), np.array(body[1], float)
            self.show(element, [self.solid(high - low, low)])
        if sources:
            self.show(element, list(sources), "LightSource", "Lighting")
        return element

    def goniometric(self, data, lumens=0.0, kelvin=0.0, axes=None):
        """A light source with a distribution."""
        white = self.colour((1, 1, 1))
        words = ("Lamp", white, None, None, axes or self.axes(), None, kelvin, lumens, "LIGHTEMITTINGDIODE", data)
        return self.model.create_entity("IfcLightSourceGoniometric", *words)

    def table(self, planes, angles, intensities, curve="TYPE_C", unit=1.0):
        """An IfcLightIntensityDistribution; angles in degrees times `unit`."""
        rows = [
            self.model.create_entity("IfcLightDistributionData", float(plane) * unit, [float(a) * unit for a in angles], [float(i) for i in row])
            for plane, row in zip(planes, intensities)
        ]
        return self.model.create_entity("IfcLightIntensityDistribution", curve, rows)

    def file(self, location):
        return self.model.create_entity("IfcDocumentReference", location)

    def save(self, path):
        self.model.write(str(path))
        return path


def moved(place):
    """A matrix that moves."""
    matrix = np.eye(4)
    matrix[:3, 3] = place
    return matrix


def _new(schema):
    """An empty model, in IFC2X3 with the owner that everything has there."""
    model = importlib.import_module("ifcopenshell.api.project").create_file(version=schema)
    if schema == "IFC2X3":
        maker = model.create_entity("IfcOrganization", None, "gonio")
        person = model.create_entity("IfcPerson", None, "Tester")
        model.create_entity("IfcPersonAndOrganization", person, maker)
        model.create_entity("IfcApplication", maker, "1", "gonio", "gonio")
    return model


def _guid():
    return importlib.import_module("ifcopenshell.guid").new()
