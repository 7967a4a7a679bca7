"""Triangles between Cura's scene (y up) and the program (z up, binary STL). Knows numpy and nothing of Cura.

Triangles are arrays of the shape (n, 3, 3): triangle, corner, coordinate.
"""
import numpy

RECORD = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
HEADER = b"binary STL of Aplomb for Cura".ljust(80, b" ")  # never begins with "solid"


def triangles_of(vertices, indices=None):
    """Of a mesh of Cura's: three vertices a triangle, or indices into them."""
    vertices = numpy.asarray(vertices, dtype=numpy.float64)
    if indices is not None:
        vertices = vertices[numpy.asarray(indices).reshape(-1)]
    return vertices.reshape(-1, 3, 3)


def is_mirroring(matrix):
    return numpy.linalg.det(numpy.asarray(matrix, dtype=numpy.float64)[:3, :3]) < 0


def _moved(triangles, matrix):
    matrix = numpy.asarray(matrix, dtype=numpy.float64)
    moved = triangles @ matrix[:3, :3].T + matrix[:3, 3]
    return moved[:, ::-1] if is_mirroring(matrix) else moved  # outside stays outside


def to_plate(triangles, world):
    """From a node's own coordinates to the plate's: its world matrix, then y up to z up; as float32, which STL holds."""
    x, y, z = numpy.moveaxis(_moved(triangles, world), 2, 0)
    return numpy.stack([x, -z, y], axis=2).astype(numpy.float32)


def from_plate(triangles, world):
    """The inverse of to_plate()."""
    x, y, z = numpy.moveaxis(numpy.asarray(triangles, dtype=numpy.float64), 2, 0)
    return _moved(numpy.stack([x, z, -y], axis=2), numpy.linalg.inv(numpy.asarray(world, dtype=numpy.float64)))


def back_into_node(made, sent, own, world):
    """What the program made, in the node's coordinates. Triangles that it left as they were `sent` are those of the node
    (`own`, in the same order) to the last bit; the others go through the inverse of the world matrix."""
    known = {corners.tobytes(): i for i, corners in enumerate(numpy.ascontiguousarray(sent))}
    back = from_plate(made, world).astype(numpy.float32)
    for i, corners in enumerate(numpy.ascontiguousarray(made)):
        at = known.get(corners.tobytes())
        if at is not None:
            back[i] = own[at]
    return back


def write_stl(path, triangles):
    records = numpy.zeros(len(triangles), dtype=RECORD)
    corners = numpy.asarray(triangles, dtype=numpy.float32)
    records["corners"] = corners
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    records["normal"] = normals / numpy.where(lengths > 0, lengths, 1)
    with open(path, "wb") as file:
        file.write(HEADER)
        file.write(numpy.uint32(len(records)).astype("<u4").tobytes())
        file.write(records.tobytes())


def read_stl(path):
    """\\raises ValueError for what is no binary STL."""
    with open(path, "rb") as file:
        data = file.read()
    if len(data) < 84:
        raise ValueError("no binary STL: {} bytes".format(len(data)))
    count = int(numpy.frombuffer(data, "<u4", 1, 80)[0])
    if len(data) != 84 + count * RECORD.itemsize:
        raise ValueError("no binary STL: {} bytes for {} triangles".format(len(data), count))
    return numpy.frombuffer(data, RECORD, count, 84)["corners"].astype(numpy.float32)
