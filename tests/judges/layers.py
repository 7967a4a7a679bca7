"""What PrusaSlicer's own layers of a shell show of its voids: layers of a resin print, as images, which no code of ours made."""
import collections
import pathlib
import subprocess
import tempfile
import zipfile

PIXEL_MM = 0.1
BED_MM = 2000

Island = collections.namedtuple("Island", "layer area_mm2")
Layers = collections.namedtuple("Layers", "void_mm2 span_mm islands")  # by layer, by layer, all


def shown(path, mesh, raster, layer_mm, allowed_mm):
    """Slices the mesh and looks at every layer. `raster` is the program of layer_raster.cpp."""
    used = [mesh.vertices[i] for triangle in mesh.triangles for i in triangle]
    across = [max(v[axis] for v in used) - min(v[axis] for v in used) for axis in range(2)]
    pixels = [round((size + 4) / PIXEL_MM) for size in across]
    with tempfile.TemporaryDirectory() as folder:
        images = export(path, pathlib.Path(folder), layer_mm, pixels)
        told = subprocess.run([raster, str(PIXEL_MM), str(allowed_mm), *images], check=True, capture_output=True, text=True)
    rows = [line.split() for line in told.stdout.splitlines()]
    layers = [row for row in rows if row[0] == "layer"]
    islands = [Island(int(row[1]), float(row[2])) for row in rows if row[0] == "island"]
    return Layers([float(row[2]) for row in layers], [float(row[3]) for row in layers], islands)


def export(path, folder, layer_mm, pixels):
    size = [count * PIXEL_MM for count in pixels]
    archive = folder / "print.sl1"
    command = ["prusa-slicer", "--export-sla", "--printer-technology", "SLA", "--supports-enable=0", "--pad-enable=0",
               "--layer-height", str(layer_mm), "--initial-layer-height", str(layer_mm), "--faded-layers", "3",
               "--display-orientation", "landscape", "--display-mirror-x=0", "--display-mirror-y=0",
               "--display-width", str(size[0]), "--display-height", str(size[1]),
               "--display-pixels-x", str(pixels[0]), "--display-pixels-y", str(pixels[1]),
               "--bed-shape", f"0x0,{size[0]}x0,{size[0]}x{size[1]},0x{size[1]}", "--max-print-height", str(BED_MM),
               "--relative-correction", "1,1", "--absolute-correction", "0", "--elefant-foot-compensation", "0",
               "--elefant-foot-min-width", "0", "--gamma-correction", "0", "--slice-closing-radius", "0",
               "--center", f"{size[0] / 2},{size[1] / 2}", "--output", str(archive), path]
    subprocess.run(command, check=True, capture_output=True)
    with zipfile.ZipFile(archive) as held:
        names = sorted(name for name in held.namelist() if name.endswith(".png") and "/" not in name)
        held.extractall(folder, names)
    return [str(folder / name) for name in names]
