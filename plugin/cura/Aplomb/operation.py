"""Gives a model another mesh, and takes it back."""
from UM.Operations.Operation import Operation


class SetMeshOperation(Operation):
    def __init__(self, node, mesh_data):
        super().__init__()
        self._node = node
        self._old = node.getMeshData()
        self._new = mesh_data

    def undo(self):
        self._node.setMeshData(self._old)

    def redo(self):
        self._node.setMeshData(self._new)
