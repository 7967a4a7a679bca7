#!/usr/bin/env python3
"""What libaplomb.so shows, what its example does, and that it makes what the program makes."""
import ctypes
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

CLI, LIBRARY, EXAMPLE = (os.environ[name] for name in ("APLOMB_CLI", "APLOMB_C", "APLOMB_EXAMPLE"))
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])
HEADER = pathlib.Path(__file__).resolve().parents[2] / "plugin" / "capi" / "aplomb.h"


class Mesh(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_uint64), ("float_vertices", ctypes.POINTER(ctypes.c_float)),
                ("double_vertices", ctypes.POINTER(ctypes.c_double)), ("vertex_count", ctypes.c_uint64),
                ("triangles", ctypes.POINTER(ctypes.c_uint32)), ("triangle_count", ctypes.c_uint64)]


def read_stl(path):
    """(corner coordinates, 9 a triangle) of a binary STL."""
    data = pathlib.Path(path).read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    return [struct.unpack_from("<12f", data, 84 + 50 * i)[3:] for i in range(count)]


def stand(triangles, job=None):
    """(status, report, corner coordinates) from the library, of loose triangles."""
    library = ctypes.CDLL(LIBRARY)
    library.aplomb_result_report.restype = ctypes.c_char_p
    numbers = [number for triangle in triangles for number in triangle]
    mesh = Mesh(ctypes.sizeof(Mesh), (ctypes.c_float * len(numbers))(*numbers), None, len(numbers) // 3,
                (ctypes.c_uint32 * (len(numbers) // 3))(*range(len(numbers) // 3)), len(triangles))
    result, made = ctypes.c_void_p(), Mesh(struct_size=ctypes.sizeof(Mesh))
    status = library.aplomb_stand(ctypes.byref(mesh), job, None, ctypes.byref(result))
    library.aplomb_result_mesh(result, ctypes.byref(made))
    corners = [tuple(made.double_vertices[3 * made.triangles[i] + axis] for i in range(3 * t, 3 * t + 3) for axis in range(3))
               for t in range(made.triangle_count)]
    report = json.loads(library.aplomb_result_report(result))
    library.aplomb_result_free(result)
    return status, report, corners


class Library(unittest.TestCase):
    def test_it_exports_what_the_header_declares_and_nothing_else(self):
        symbols = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], check=True, capture_output=True, text=True).stdout
        exported = {line.split()[-1] for line in symbols.splitlines()}
        declared = set(re.findall(r"^APLOMB_API [^(]*?\b(aplomb_\w+)\(", HEADER.read_text(), re.MULTILINE))
        self.assertEqual(exported, declared)
        self.assertGreaterEqual(len(declared), 10)

    def test_its_name_carries_the_abi_version(self):
        version = re.search(r"#define APLOMB_ABI_VERSION (\d+)", HEADER.read_text())[1]
        self.assertEqual(os.environ["APLOMB_SONAME"], f"libaplomb.so.{version}")

    def test_it_may_be_unloaded_after_it_has_worked(self):
        worked = ("import _ctypes, ctypes, time; library = ctypes.CDLL(%r); assert library.aplomb_check(None, None, None, None) == 1; "
                  "_ctypes.dlclose(library._handle); time.sleep(0.2)" % LIBRARY)
        subprocess.run([sys.executable, "-c", worked], check=True)
        told = subprocess.run(["readelf", "-d", LIBRARY], check=True, capture_output=True, text=True).stdout
        self.assertIn("NODELETE", told)

    def test_its_header_is_a_header_of_cplusplus_too(self):
        for compiler, language in (("cc", "c"), ("c++", "c++")):
            subprocess.run([compiler, "-x", language, "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", HEADER], check=True)

    def test_its_statuses_are_the_exit_codes_that_the_program_tells(self):
        told = subprocess.run([CLI, "--help"], check=True, capture_output=True, text=True).stdout
        told = dict(re.findall(r"(\d) ([a-z ]+)", told[told.index("Exit:"):].replace("\n", " ")))
        library = ctypes.CDLL(LIBRARY)
        library.aplomb_status_text.restype = ctypes.c_char_p
        for code, text in told.items():
            first = " ".join(text.split()).split()[0].replace("usage", "wrong use").replace("input", "unusable")
            self.assertIn(first, library.aplomb_status_text(int(code)).decode(), code)

    def test_it_makes_the_mesh_and_the_report_that_the_program_makes(self):
        for figure, job, flags in (("trex", None, []), ("flamingo", b'{"aplomb_job": 1, "aim": "stable"}', ["--aim", "stable"])):
            with self.subTest(figure), tempfile.TemporaryDirectory() as folder:
                model, made = FIXTURES / f"{figure}.stl", pathlib.Path(folder, "made.stl")
                code = subprocess.run([CLI, "stand", model, "-o", made, "--report", f"{folder}/report.json", "-q", *flags]).returncode
                status, report, corners = stand(read_stl(model), job)
                self.assertEqual(status, code)
                self.assertEqual(corners, read_stl(made))
                expected = json.loads(pathlib.Path(folder, "report.json").read_text())
                for run_itself in ("seconds", "peak_memory_mb", "options"):
                    expected.pop(run_itself), report.pop(run_itself)
                self.assertEqual(report, expected)

    def test_the_example_makes_a_box_stand_and_ends_as_the_program_does(self):
        with tempfile.TemporaryDirectory() as folder:
            obj = f"{folder}/box.obj"
            ran = subprocess.run([EXAMPLE, obj], capture_output=True, text=True)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertIn("Stands now", ran.stderr)
            self.assertEqual(subprocess.run([CLI, "check", obj, "-q"]).returncode, 0)
            self.assertEqual(subprocess.run([EXAMPLE, obj, '{"aplomb_job": 1, "wall_mm": 13.9}'], capture_output=True).returncode, 3)
            self.assertEqual(subprocess.run([EXAMPLE, obj, "garbage"], capture_output=True).returncode, 1)


if __name__ == "__main__":
    sys.exit(unittest.main())
