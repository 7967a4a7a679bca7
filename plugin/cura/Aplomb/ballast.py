"""Ballast: a mesh inside which Cura fills more densely, as a child of the model that it makes stand."""
from UM.Application import Application
from UM.Mesh.MeshData import MeshData, calculateNormalsFromVertices
from UM.Operations.AddSceneNodeOperation import AddSceneNodeOperation
from UM.Operations.RemoveSceneNodeOperation import RemoveSceneNodeOperation
from UM.Settings.SettingInstance import SettingInstance
from cura.Scene.BuildPlateDecorator import BuildPlateDecorator
from cura.Scene.CuraSceneNode import CuraSceneNode
from cura.Scene.SliceableObjectDecorator import SliceableObjectDecorator

NAME = "Ballast (Aplomb)"


def ballast_of(node):
    """What was added to a model before, as long as it is a ballast."""
    return [child for child in node.getChildren() if child.getName() == NAME and child.callDecoration("isInfillMesh")]


def adding(node, triangles, infill_percent):
    """Operations that give a model ballast in place of what it has. \\param triangles  in the model's own coordinates."""
    return removing(node) + [AddSceneNodeOperation(_ballast_node(node, triangles, infill_percent), node)]


def removing(node):
    """Operations that take its ballast from a model."""
    return [RemoveSceneNodeOperation(old) for old in ballast_of(node)]


def _ballast_node(model, triangles, infill_percent):
    vertices = triangles.reshape(-1, 3).astype("float32")
    node = CuraSceneNode()
    node.setName(NAME)
    node.setSelectable(True)
    node.setCalculateBoundingBox(True)
    node.setMeshData(MeshData(vertices=vertices, normals=calculateNormalsFromVertices(vertices, len(vertices))))
    node.calculateBoundingBoxMesh()
    plate = model.callDecoration("getBuildPlateNumber")
    node.addDecorator(BuildPlateDecorator(Application.getInstance().getMultiBuildPlateModel().activeBuildPlate if plate is None else plate))
    node.addDecorator(SliceableObjectDecorator())
    extruder = model.callDecoration("getActiveExtruder")
    if extruder:
        node.callDecoration("setActiveExtruder", extruder)
    # An infill mesh has no walls and no skins of its own.
    for key, value in (("infill_mesh", True), ("infill_sparse_density", infill_percent), ("wall_line_count", 0), ("top_layers", 0),
                       ("bottom_layers", 0)):
        _set(node.callDecoration("getStack"), key, value)
    return node


def _set(stack, key, value):
    instance = SettingInstance(stack.getSettingDefinition(key), stack.getTop())
    instance.setProperty("value", value)
    instance.resetState()  # the model's own, not the user's
    stack.getTop().addInstance(instance)
