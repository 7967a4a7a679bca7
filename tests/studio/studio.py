"""A running aplomb-studio and a page's side of its protocol, for tests."""
import http.client
import json
import os
import pathlib
import re
import struct
import subprocess

PROGRAM = os.environ["APLOMB_STUDIO"]
CLI = os.environ["APLOMB"]
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])

END, JSON, MESH, POSITIONS = range(4)

# The T-Rex falls by itself; carved on a coarse grid it stands, in a second or two.
QUICK = {"poses": [{"stand": {"tip_deg": 2}}], "voxel_mm": 0.8, "ceiling": "any"}


def words(payload):
    return struct.unpack("<%dI" % (len(payload) // 4), payload)


class Mesh:
    def __init__(self, payload):
        (length,) = struct.unpack_from("<I", payload)
        self.name = payload[4:4 + length].decode()
        at = 4 + (length + 3) // 4 * 4
        vertices, triangles = struct.unpack_from("<II", payload, at)
        assert len(payload) == at + 8 + 12 * (vertices + triangles), "a MESH frame is as long as it says"
        self.vertices = list(struct.iter_unpack("<3f", payload[at + 8:at + 8 + 12 * vertices]))
        self.triangles = list(struct.iter_unpack("<3I", payload[at + 8 + 12 * vertices:]))


class Stream:
    """The frames of an answer, as they come."""

    def __init__(self, connection, response):
        self.connection, self.response, self.ended = connection, response, False

    def take(self, count):
        data = b""
        while len(data) < count:
            part = self.response.read(count - len(data))
            if not part:
                raise EOFError("the stream was cut off")
            data += part
        return data

    def frames(self):
        """(kind, JSON, mesh or positions), heartbeats left out, until END."""
        while not self.ended:
            length, kind = struct.unpack("<II", self.take(8))
            payload = self.take(length)
            if kind == END:
                self.ended = True
            elif kind == JSON:
                message = json.loads(payload)
                if message["type"] != "alive":
                    yield kind, message
            elif kind == MESH:
                yield kind, Mesh(payload)
            else:
                assert kind == POSITIONS, kind
                (vertices,) = struct.unpack_from("<I", payload)
                assert len(payload) == 4 + 12 * vertices
                yield kind, list(struct.iter_unpack("<3f", payload[4:]))
        self.close()

    def messages(self, *types):
        """All JSON messages, or those of the types."""
        return [said for kind, said in self.frames() if kind == JSON and (not types or said["type"] in types)]

    def close(self):
        """As a page that goes away."""
        self.response.close()
        self.connection.close()


class Answer:
    def __init__(self, response):
        self.status, self.headers, self.body = response.status, response.headers, response.read()

    def json(self):
        return json.loads(self.body)


class Studio:
    def __init__(self, *arguments, environment=None, program=PROGRAM, opens_browser=False):
        arguments = arguments if opens_browser else ("--no-browser", *arguments)
        self.process = subprocess.Popen([program, *arguments], stdout=subprocess.PIPE, text=True,
                                        env={**os.environ, **(environment or {})})
        line = self.process.stdout.readline()
        self.address = re.search(r"http://127\.0\.0\.1:(\d+)/#(\w+)$", line.strip())
        assert self.address, line
        self.port, self.token = int(self.address[1]), self.address[2]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate(timeout=20)

    def headers(self, **changes):
        """Those of the page; a change of None leaves one out."""
        names = {"Host": f"127.0.0.1:{self.port}", "Authorization": f"Bearer {self.token}", **changes}
        return {name.replace("_", "-"): value for name, value in names.items() if value is not None}

    def send(self, method, path, body=None, **changes):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        headers = self.headers(**changes)
        if body is not None and "Content-Length" not in headers and "Transfer-Encoding" not in headers:
            headers["Content-Length"] = str(len(body))
        for name, value in headers.items():
            connection.putheader(name, value)
        connection.endheaders(body)
        return connection

    def request(self, method, path, body=None, **changes):
        connection = self.send(method, path, body, **changes)
        answer = Answer(connection.getresponse())
        connection.close()
        return answer

    def post(self, path, **fields):
        return self.request("POST", path, json.dumps(fields).encode())

    def stream(self, path, **fields):
        connection = self.send("POST", path, json.dumps(fields).encode())
        response = connection.getresponse()
        assert response.status == 200, (response.status, response.read())
        return Stream(connection, response)

    def fixture(self, name):
        return self.post("/api/fixture", name=name).json()["id"]

    def upload(self, path, kind="model"):
        return self.request("POST", f"/api/{kind}?name={path.name}", path.read_bytes()).json()["id"]

    def children(self):
        """(process id, command line) of the server's own."""
        found = []
        for folder in pathlib.Path("/proc").iterdir():
            try:
                if folder.name.isdigit() and f"\nPPid:\t{self.process.pid}\n" in (folder / "status").read_text():
                    found.append((int(folder.name), (folder / "cmdline").read_text().replace("\0", " ")))
            except OSError:
                pass
        return found
