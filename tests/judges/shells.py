"""Shells as the judges see them: read from the file itself, measured by formulae of their own. Standard library only."""
import collections
import math
import struct
import xml.etree.ElementTree
import zipfile

Mesh = collections.namedtuple("Mesh", "vertices triangles")
Body = collections.namedtuple("Body", "volume centroid inertia")  # of density 1; inertia about the centroid

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
RAY = (0.2718281828, 0.3141592654, 0.9096)  # in no special direction, so that it meets no vertex and no edge


def read(path):
    return read_3mf(path) if path.endswith(".3mf") else read_stl(path)


def read_3mf(path):
    """The one object of a core-only 3MF in millimetres, which is what slicers agree on."""
    with zipfile.ZipFile(path) as archive:
        model = xml.etree.ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    meshes = model.findall(f".//{CORE}mesh")
    items = model.findall(f"{CORE}build/{CORE}item")
    if len(meshes) != 1 or len(items) != 1 or items[0].get("transform") or model.get("unit", "millimeter") != "millimeter":
        raise ValueError(f"{path}: not one mesh in millimetres, placed as it is")
    vertices = [tuple(float32(float(v.get(axis))) for axis in "xyz") for v in meshes[0].iter(CORE + "vertex")]
    triangles = [tuple(int(t.get(corner)) for corner in ("v1", "v2", "v3")) for t in meshes[0].iter(CORE + "triangle")]
    return Mesh(vertices, triangles)


def read_stl(path):
    """A binary STL; corners are the same vertex where their coordinates are the same bits."""
    with open(path, "rb") as file:
        data = file.read()
    count, = struct.unpack_from("<I", data, 80)
    if len(data) != 84 + 50 * count:
        raise ValueError(f"{path}: {len(data)} bytes do not hold {count} triangles")
    index, triangles = {}, []
    for facet in struct.iter_unpack("<12x9f2x", data[84:]):
        triangles.append(tuple(index.setdefault(facet[i:i + 3], len(index)) for i in (0, 3, 6)))
    return Mesh(list(index), triangles)


def write_stl(path, mesh):
    with open(path, "wb") as file:
        file.write(b"binary".ljust(80) + struct.pack("<I", len(mesh.triangles)))
        for triangle in mesh.triangles:
            a, b, c = (mesh.vertices[i] for i in triangle)
            normal = cross(minus(b, a), minus(c, a))
            length = math.hypot(*normal) or 1
            file.write(struct.pack("<12f2x", *(n / length for n in normal), *a, *b, *c))


def float32(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def turned_upright(mesh, up):
    """The mesh turned so that `up` points along +z; as it is where it does."""
    length = math.hypot(*up)
    up = tuple(u / length for u in up)
    if up == (0, 0, 1):
        return mesh
    side = cross(up, min(((1, 0, 0), (0, 1, 0), (0, 0, 1)), key=lambda axis: abs(dot(axis, up))))
    side = tuple(s / math.hypot(*side) for s in side)
    axes = (side, cross(up, side), up)
    return Mesh([tuple(dot(axis, v) for axis in axes) for v in mesh.vertices], mesh.triangles)


def components(mesh):
    """Triangles grouped by the closed surface that they belong to, as meshes with the same vertices."""
    parent = list(range(len(mesh.vertices)))

    def root(vertex):
        while parent[vertex] != vertex:
            parent[vertex] = parent[parent[vertex]]
            vertex = parent[vertex]
        return vertex

    for a, b, c in mesh.triangles:
        parent[root(a)] = parent[root(b)] = root(c)
    groups = collections.defaultdict(list)
    for triangle in mesh.triangles:
        groups[root(triangle[0])].append(triangle)
    return [Mesh(mesh.vertices, triangles) for triangles in groups.values()]


def encloses(surface, point):
    """Whether a ray from the point crosses the surface an odd number of times."""
    inside = False
    for triangle in surface.triangles:
        a, b, c = (surface.vertices[i] for i in triangle)
        e1, e2, s = minus(b, a), minus(c, a), minus(point, a)
        p = cross(RAY, e2)
        determinant = dot(e1, p)
        if determinant == 0:
            continue
        u = dot(s, p) / determinant
        q = cross(s, e1)
        v = dot(RAY, q) / determinant
        if u >= 0 and v >= 0 and u + v <= 1 and dot(e2, q) / determinant > 0:
            inside = not inside
    return inside


def split_voids(mesh):
    """(outer surfaces, voids), told apart by nesting alone: winding is what a judge is to find wrong."""
    parts = components(mesh)
    outer, voids = [], []
    for part in parts:
        point = mesh.vertices[part.triangles[0][0]]
        depth = sum(encloses(other, point) for other in parts if other is not part)
        (voids if depth % 2 else outer).append(part)
    return outer, voids


def intended_volume(outer, voids):
    """Outer less voids, however they are wound."""
    return sum(abs(body(part).volume) for part in outer) - sum(abs(body(part).volume) for part in voids)


def body(mesh):
    """Volume, centroid and inertia by summing signed tetrahedra from the first vertex (Eberly's polynomials)."""
    origin = mesh.vertices[mesh.triangles[0][0]]
    volume, first, second = 0.0, [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for triangle in mesh.triangles:
        a, b, c = (minus(mesh.vertices[i], origin) for i in triangle)
        six = dot(a, cross(b, c))
        volume += six / 6
        for i in range(3):
            first[i] += six * (a[i] + b[i] + c[i]) / 24
            for j in range(i, 3):
                total = (a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j])
                second[i][j] += six * (total + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) / 120
    centre = [m / volume for m in first]
    covariance = [[second[min(i, j)][max(i, j)] - volume * centre[i] * centre[j] for j in range(3)] for i in range(3)]
    trace = sum(covariance[i][i] for i in range(3))
    inertia = [[(trace if i == j else 0) - covariance[i][j] for j in range(3)] for i in range(3)]
    return Body(volume, tuple(o + c for o, c in zip(origin, centre)), inertia)


def support_polygon(mesh, contact_height):
    """Convex hull, counter-clockwise, of what lies within contact_height of the lowest point; seen from above."""
    bottom = min(mesh.vertices[i][2] for triangle in mesh.triangles for i in triangle)
    level = bottom + contact_height
    points = set()
    for triangle in mesh.triangles:
        corners = [mesh.vertices[i] for i in triangle]
        if min(corner[2] for corner in corners) > level:
            continue
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if a[2] <= level:
                points.add(a[:2])
            if (a[2] <= level) != (b[2] <= level):
                t = (level - a[2]) / (b[2] - a[2])
                points.add((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
    return convex_hull(points)


def convex_hull(points):
    """Andrew's monotone chain."""
    def chain(ordered):
        hull = []
        for p in ordered:
            while len(hull) > 1 and turn(hull[-2], hull[-1], p) <= 0:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    ordered = sorted(points)
    return chain(ordered) + chain(ordered[::-1])


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
