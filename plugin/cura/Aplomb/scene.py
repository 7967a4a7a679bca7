"""What is in Cura's scene: which models are meant, their triangles, and how Cura is set to print them."""
from UM.Application import Application
from UM.Logger import Logger
from UM.Mesh.MeshData import MeshData, calculateNormalsFromVertices
from UM.Scene.Iterator.DepthFirstIterator import DepthFirstIterator
from UM.Scene.Selection import Selection

from . import meshes, verdict
from .ballast import ballast_of

# What the program reads of Cura's settings.
SETTINGS = ("machine_nozzle_size", "layer_height", "layer_height_0", "line_width", "wall_line_width", "wall_line_width_0", "wall_line_width_x",
            "infill_line_width", "skin_line_width", "wall_thickness", "wall_line_count", "top_bottom_thickness", "top_layers",
            "bottom_layers", "infill_sparse_density", "infill_pattern", "infill_overlap_mm", "min_infill_area", "material_flow")
NOT_PRINTED = ("isNonPrintingMesh", "isInfillMesh", "isSupportMesh", "isAntiOverhangMesh", "isCuttingMesh")


def _is_model(node):
    return node.callDecoration("isSliceable") and node.getMeshData() is not None and not any(
        node.callDecoration(role) for role in NOT_PRINTED)


def chosen_models():
    """The models of the selection, or all where nothing is selected."""
    roots = Selection.getAllSelectedObjects() or [Application.getInstance().getController().getScene().getRoot()]
    found = []
    for root in roots:
        for node in DepthFirstIterator(root):
            if _is_model(node) and node not in found:
                found.append(node)
    return found


def is_in_group(node):
    """Parts of a group (or of merged models) are printed as one: they do not stand by themselves."""
    parent = node.getParent()
    return parent is not None and bool(parent.callDecoration("isGroup"))


class ModelState:
    """A model as it is at one moment: what a run is made of, and whether it still is that."""

    def __init__(self, node):
        self.node = node
        self.name = node.getName()
        self.mesh_data = node.getMeshData()
        self.world = node.getWorldTransformation().getData().copy()
        self.ballast = ballast_of(node)

    def is_current(self):
        """Whether it is still in the scene with the same mesh, size and turn; it may have been moved."""
        node = self.node
        if node.getParent() is None or node.getMeshData() is not self.mesh_data:
            return False
        now = node.getWorldTransformation().getData()
        return bool(abs(now[:3, :3] - self.world[:3, :3]).max() < 1e-9)

    def own_triangles(self):
        return meshes.triangles_of(self.mesh_data.getVertices(), self.mesh_data.getIndices())

    def mesh_of(self, triangles):
        """A mesh for the node, of triangles in its own coordinates."""
        vertices = triangles.reshape(-1, 3)
        return MeshData(vertices=vertices, normals=calculateNormalsFromVertices(vertices, len(vertices)),
                        file_name=self.mesh_data.getFileName(), center_position=self.mesh_data.getCenterPosition(),
                        zero_position=self.mesh_data.getZeroPosition())


def print_profile(node):
    """How Cura will print a model: infill_percent, layer_mm, density_g_per_cm3, all that the program reads (settings), and
    what spoils a void (spoilt_by); what it does not tell is missing."""
    profile = {}
    try:
        stack = Application.getInstance().getGlobalContainerStack()
        profile["layer_mm"] = float(stack.getProperty("layer_height", "value"))
        position = int(node.callDecoration("getActiveExtruderPosition") or 0)
        extruder = stack.extruderList[position]
        own = node.callDecoration("getStack") or extruder  # settings of the model itself, over the extruder's
        profile["infill_percent"] = float(own.getProperty("infill_sparse_density", "value"))
        profile["spoilt_by"] = verdict.spoilers(lambda key: own.getProperty(key, "value"))
        density = extruder.material.getMetaDataEntry("properties", {}).get("density")
        if density:
            profile["density_g_per_cm3"] = float(density)
        profile["settings"] = _settings(own, profile)
    except (AttributeError, IndexError, TypeError, ValueError):  # no printer, or another Cura's idea of one
        Logger.logException("w", "Aplomb: Cura does not tell how it prints")
    return profile


def _settings(stack, profile):
    """SETTINGS as Cura resolves them. What an older or newer Cura does not have is left out."""
    values = {key: stack.getProperty(key, "value") for key in SETTINGS}
    told = {key: value for key, value in values.items() if isinstance(value, (int, float, str)) and not isinstance(value, bool)}
    if "density_g_per_cm3" in profile:
        told["material_density"] = profile["density_g_per_cm3"]
    return told
