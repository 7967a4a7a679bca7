"""The inside of a void, well away from its walls, as a grid of columns that are bit masks along z."""
import math

JITTER = (0.3819660, 0.2360680, 0.1458980)  # of a cell: columns miss the vertices and edges of models with round coordinates


class VoidCore:
    """Cells whose neighbours within `margin` (mm, measured along the axes) all lie inside the given closed surfaces."""

    def __init__(self, surfaces, margin=1.0, cell=0.5):
        self.cell = cell
        vertices = [surface.vertices[i] for surface in surfaces for triangle in surface.triangles for i in triangle]
        self.origin = [min(v[axis] for v in vertices) - JITTER[axis] * cell for axis in range(3)]
        self.layers = math.ceil((max(v[2] for v in vertices) - self.origin[2]) / cell) + 1
        self.columns = {}
        for surface in surfaces:
            for triangle in surface.triangles:
                self._cross(*(surface.vertices[i] for i in triangle))
        if any(mask >> (self.layers - 1) & 1 for mask in self.columns.values()):
            raise ValueError("the void's surface is not closed")
        for _ in range(math.ceil(margin / cell)):
            self._erode()

    def volume(self):
        return self.cell**3 * sum(mask.bit_count() for mask in self.columns.values())

    def __contains__(self, point):
        i, j, k = (math.floor((p - o) / self.cell) for p, o in zip(point, self.origin))
        return k >= 0 and self.columns.get((i, j), 0) >> k & 1 == 1

    def share_along(self, start, end, z):
        """The share of a level path that runs inside, from a sample in every cell's length."""
        samples = max(1, math.ceil(math.dist(start, end) / self.cell))
        layer = 1 << max(0, math.floor((z - self.origin[2]) / self.cell))
        dx, dy = ((b - a) / samples / self.cell for a, b in zip(start, end))
        x, y = ((a - o) / self.cell for a, o in zip(start, self.origin))
        steps = [i + 0.5 for i in range(samples)]
        return sum(self.columns.get((math.floor(x + s * dx), math.floor(y + s * dy)), 0) & layer != 0 for s in steps) / samples

    def _cross(self, a, b, c):
        """Flips, in every column whose axis meets the triangle, the cells whose centre lies above it."""
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            return
        everything = (1 << self.layers) - 1
        for i in self._centres(0, a, b, c):
            x = self.origin[0] + (i + 0.5) * self.cell
            for j in self._centres(1, a, b, c):
                y = self.origin[1] + (j + 0.5) * self.cell
                wb = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
                wc = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
                if wb >= 0 and wc >= 0 and wb + wc <= 1:
                    z = a[2] + wb * (b[2] - a[2]) + wc * (c[2] - a[2])
                    first = math.ceil((z - self.origin[2]) / self.cell - 0.5)
                    self.columns[i, j] = self.columns.get((i, j), 0) ^ (everything >> first << first)

    def _centres(self, axis, *corners):
        """The cells along an axis whose centres lie between the corners."""
        low, high = min(c[axis] for c in corners), max(c[axis] for c in corners)
        first = math.ceil((low - self.origin[axis]) / self.cell - 0.5)
        return range(first, math.floor((high - self.origin[axis]) / self.cell - 0.5) + 1)

    def _erode(self):
        """Keeps the cells all of whose 26 neighbours are inside: an axis at a time."""
        self.columns = {at: mask & mask << 1 & mask >> 1 for at, mask in self.columns.items()}
        for di, dj in ((1, 0), (0, 1)):
            old = self.columns
            eroded = {(i, j): mask & old.get((i - di, j - dj), 0) & old.get((i + di, j + dj), 0)
                      for (i, j), mask in old.items()}
            self.columns = {at: mask for at, mask in eroded.items() if mask}
