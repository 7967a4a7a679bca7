#!/usr/bin/env python3
"""Who gets in: nobody but the page that the server gave out, and nothing that is too large."""
import http.client
import json
import os
import pathlib
import shutil
import socket
import stat
import tempfile
import time
import unittest

import studio


class Guard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.models = pathlib.Path(cls.folder.name)
        cls.studio = studio.Studio("--max-upload", "1", environment={"TMPDIR": cls.folder.name})

    @classmethod
    def tearDownClass(cls):
        cls.studio.__exit__()
        cls.folder.cleanup()

    def status(self, method="GET", path="/api/start", body=None, **changes):
        return self.studio.request(method, path, body, **changes).status

    def test_the_page_gets_in(self):
        self.assertEqual(self.status(), 200)
        port = self.studio.port
        self.assertEqual(self.status(Host=f"localhost:{port}", Origin=f"http://localhost:{port}"), 200)
        self.assertEqual(self.status(Origin=f"http://127.0.0.1:{port}", Sec_Fetch_Site="same-origin"), 200)

    def test_nobody_gets_in_without_the_token(self):
        token = self.studio.token
        for wrong in (None, "", "Bearer", "Bearer ", f"Bearer {token[:-1]}", f"Bearer {token}0", f"bearer {token}", token,
                      f"Bearer {'0' * len(token)}", f"Basic {token}"):
            for method, path in (("GET", "/api/start"), ("POST", "/api/cancel"), ("POST", "/api/quit"),
                                 ("POST", "/api/stand"), ("GET", "/api/no_such")):
                self.assertEqual(self.status(method, path, b"" if method == "POST" else None, Authorization=wrong), 401, wrong)
        self.assertIsNone(self.studio.process.poll())

    def test_the_browsers_command_line_has_a_ticket_that_lets_in_once_and_not_the_token(self):
        temporary = tempfile.TemporaryDirectory()  # others look at what lies beside the models
        self.addCleanup(temporary.cleanup)
        folder = pathlib.Path(temporary.name)
        (folder / "xdg-open").write_text(f"#!/bin/sh\necho \"$1\" >{folder}/part && mv {folder}/part {folder}/opened\n")
        (folder / "xdg-open").chmod(0o755)
        with studio.Studio(opens_browser=True, environment={"PATH": f"{folder}:{os.environ['PATH']}"}) as opened:
            deadline = time.monotonic() + 20
            while not (folder / "opened").exists() and time.monotonic() < deadline:
                time.sleep(0.02)
            address, _, ticket = (folder / "opened").read_text().strip().partition("#once-")
            self.assertEqual(address, f"http://127.0.0.1:{opened.port}/")
            self.assertNotIn(opened.token, ticket)

            def ask(word, **changes):
                return opened.request("POST", "/api/token", json.dumps({"name": word}).encode(), Authorization=None, **changes)

            for wrong in ("", ticket[:-1], ticket + "0", opened.token):
                self.assertEqual(ask(wrong).status, 401)
            self.assertEqual(ask(ticket, Host="rebound.example").status, 403)
            self.assertEqual(ask(ticket, Origin="http://rebound.example").status, 403)
            self.assertEqual(ask(ticket).json(), {"token": opened.token})
            self.assertEqual(ask(ticket).status, 401)

    def test_what_has_no_place_on_the_disk_is_refused_before_it_is_sent(self):
        with studio.Studio("--max-upload", "1e9", environment={"TMPDIR": self.folder.name}) as large:
            answer = None
            while answer is None or shutil.disk_usage(self.models).free >= free + (64 << 20):  # others have freed so much meanwhile
                free = shutil.disk_usage(self.models).free
                answer = large.request("POST", "/api/model?name=a.stl", b"", Content_Length=str(free))
            self.assertEqual((answer.status, answer.json()["code"]), (500, 2))
            self.assertRegex(answer.json()["error"], "^there is no place for [0-9]+ MB in .*: [0-9]+ MB are free$")

    def test_the_token_is_long_and_another_each_time(self):
        with studio.Studio() as other:
            self.assertRegex(other.token, r"^[0-9a-f]{64}$")
            self.assertNotEqual(other.token, self.studio.token)
            self.assertEqual(other.request("GET", "/api/start", Authorization=f"Bearer {self.studio.token}").status, 401)

    def test_other_names_of_this_machine_are_refused(self):
        port = self.studio.port
        for host in (None, "", "127.0.0.1", "localhost", f"127.0.0.1:{port + 1}", f"127.0.0.1.nip.io:{port}",
                     f"rebound.example:{port}", f"localhost.rebound.example:{port}", f"[::1]:{port}", f"0.0.0.0:{port}",
                     f"127.1:{port}", f"127.0.0.1:0{port}", f"127.0.0.1:{port}.example", f"a@127.0.0.1:{port}"):
            for path in ("/", "/api/start"):
                self.assertEqual(self.status(path=path, Host=host), 403, host)

    def test_other_origins_are_refused(self):
        port = self.studio.port
        for origin in ("null", "http://rebound.example", f"http://rebound.example:{port}", f"https://127.0.0.1:{port}",
                       f"http://127.0.0.1:{port + 1}", "http://127.0.0.1", f"http://127.0.0.1:{port}.example"):
            self.assertEqual(self.status(Origin=origin), 403, origin)
        for site in ("cross-site", "same-site", "anything"):
            self.assertEqual(self.status(Sec_Fetch_Site=site), 403, site)

    def test_a_header_that_comes_twice_is_refused(self):
        for name in ("Host", "Authorization", "Origin"):
            connection = http.client.HTTPConnection("127.0.0.1", self.studio.port, timeout=10)
            connection.putrequest("GET", "/api/start", skip_host=True)
            good = {**self.studio.headers(), "Origin": f"http://127.0.0.1:{self.studio.port}"}
            for key, value in good.items():
                for _ in range(2 if key == name else 1):
                    connection.putheader(key, value)
            connection.endheaders()
            self.assertEqual(connection.getresponse().status, 403, name)

    def test_refusals_say_no_more(self):
        for changes in ({"Authorization": None}, {"Host": "rebound.example"}):
            answer = self.studio.request("GET", "/api/start", **changes)
            self.assertEqual(answer.body, b"")
            self.assertNotIn(self.studio.token, str(answer.headers))

    def test_it_listens_on_the_loopback_alone(self):
        listening = [line.split() for line in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]]
        at_port = [row[1] for row in listening if row[3] == "0A" and int(row[1].split(":")[1], 16) == self.studio.port]
        self.assertEqual(at_port, [f"0100007F:{self.studio.port:04X}"])

    def test_every_answer_is_hardened(self):
        for path, changes in (("/", {}), ("/api/start", {}), ("/api/start", {"Authorization": None}), ("/nothing", {})):
            headers = self.studio.request("GET", path, **changes).headers
            policy = headers["Content-Security-Policy"]
            self.assertIn("default-src 'none'", policy)
            self.assertIn("frame-ancestors 'none'", policy)
            self.assertNotIn("unsafe", policy)
            self.assertNotIn("http", policy)
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual(headers["Referrer-Policy"], "no-referrer")
            self.assertEqual(headers["Cache-Control"], "no-store")
            self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_two_gigabytes_are_refused_before_they_come(self):
        for length in (str(2 << 30), "99999999999999999999999"):
            begun = time.monotonic()
            connection = self.studio.send("POST", "/api/model?name=large.stl", Content_Length=length)
            answer = studio.Answer(connection.getresponse())  # not one byte of it was sent
            self.assertEqual(answer.status, 413)
            self.assertIn("1 MB", answer.json()["error"])
            self.assertEqual(answer.json()["code"], 5)
            self.assertLess(time.monotonic() - begun, 2)
        waiting = self.studio.send("POST", "/api/model?name=large.stl", Content_Length=str(2 << 30), Expect="100-continue")
        self.assertEqual(waiting.getresponse().status, 413)

    def test_what_does_not_say_how_long_it_is_is_refused_when_it_is_too_long(self):
        def send(pieces):
            connection = self.studio.send("POST", "/api/model?name=chunked.stl", Transfer_Encoding="chunked")
            try:
                for _ in range(pieces):
                    connection.send(b"10000\r\n" + b"x" * 0x10000 + b"\r\n")
                connection.send(b"0\r\n\r\n")
            except OSError:
                pass  # it hung up
            return connection.getresponse().status
        self.assertEqual(send(4), 200)
        self.assertEqual(send(40), 413)
        connection = self.studio.send("POST", "/api/check", Transfer_Encoding="chunked")
        try:
            for _ in range(40):
                connection.send(b"10000\r\n" + b" " * 0x10000 + b"\r\n")
            connection.send(b"0\r\n\r\n")
        except OSError:
            pass
        self.assertEqual(connection.getresponse().status, 413)

    def test_nothing_is_left_of_what_was_refused_or_cut_off(self):
        def kept():
            return sorted(os.path.join(folder, name) for folder, _, files in os.walk(self.models) for name in (".", *files))

        def wait(happened):
            deadline = time.monotonic() + 15
            while not happened() and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertTrue(happened(), kept())

        def send(length):
            raw = socket.create_connection(("127.0.0.1", self.studio.port), timeout=15)
            raw.sendall((f"POST /api/model?name=cut.stl HTTP/1.1\r\nHost: 127.0.0.1:{self.studio.port}\r\n"
                         f"Authorization: Bearer {self.studio.token}\r\nContent-Length: {length}\r\n\r\nsolid").encode())
            return raw
        before = kept()
        with send(2000000) as refused:
            self.assertIn(b" 413 ", refused.recv(100))
        self.assertEqual(kept(), before)
        with send(50000):  # more than will come
            wait(lambda: any(path.endswith("/cut.stl") for path in kept()))
        wait(lambda: kept() == before)

    def test_models_lie_where_only_this_user_sees_them(self):
        (folder,) = self.models.iterdir()
        self.assertEqual(stat.S_IMODE(folder.stat().st_mode), 0o700)

    def test_names_of_uploads_cannot_lead_anywhere(self):
        tail = {"../../../etc/passwd.stl": "passwd.stl", "a\\b\\c.obj": "c.obj", "..": "model", "": "model", "-": "model",
                "x/": "model", "evil\x1b[31m\n\0.stl": "evil[31m.stl", "süß.stl": "süß.stl", ".hidden.stl": "hidden.stl",
                "y" * 300 + ".3mf": "y" * 96 + ".3mf", "-o.stl": "o.stl"}
        for name, kept in tail.items():
            coded = "".join("%%%02X" % byte for byte in name.encode())
            answer = self.studio.request("POST", f"/api/model?name={coded}", b"solid").json()
            self.assertEqual(answer["name"], kept, name)
            self.assertEqual(answer["bytes"], 5)
            self.assertTrue(list(self.models.glob(f"*/model-{answer['id']}/{kept}")), kept)
        self.assertEqual(self.studio.request("POST", "/api/model?name=%FF%FE.stl", b"solid").json()["name"], "__.stl")
        outside = [path for path in self.models.iterdir() if not path.name.startswith("aplomb-studio-")]
        self.assertEqual(outside, [])


class Files(unittest.TestCase):
    """The page's files, beside a program of their own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for program in (studio.PROGRAM, studio.CLI):
            shutil.copy(program, root)
        (root / "page/assets").mkdir(parents=True)
        (root / "page/index.html").write_text("<!doctype html>the page")
        (root / "page/assets/studio.js").write_text("'the script'")
        (root / "secret.txt").write_text("a secret")
        self.root = root
        self.studio = studio.Studio(program=root / pathlib.Path(studio.PROGRAM).name)
        self.addCleanup(self.studio.__exit__)

    def test_are_given_with_their_types_and_without_a_token(self):
        page = self.studio.request("GET", "/", Authorization=None)
        self.assertEqual((page.status, page.body), (200, b"<!doctype html>the page"))
        self.assertTrue(page.headers["Content-Type"].startswith("text/html"))
        script = self.studio.request("GET", "/assets/studio.js", Authorization=None)
        self.assertEqual((script.status, script.headers["Content-Type"]), (200, "text/javascript"))

    def test_come_as_they_are(self):
        """The library's compression took 1.7 s for the page's script."""
        script = self.studio.request("GET", "/assets/studio.js", Accept_Encoding="gzip, deflate, br")
        self.assertEqual((script.headers["Content-Encoding"], script.body), (None, b"'the script'"))

    def test_nothing_beside_the_page_is_given(self):
        for path in ("/../secret.txt", "/assets/../../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
                     "/assets/%2e%2e/%2e%2e/secret.txt", "/..\\secret.txt", "/....//secret.txt", f"/{self.root}/secret.txt",
                     "/%00/../secret.txt", "//secret.txt", "/assets/..%5c..%5csecret.txt"):
            answer = self.studio.request("GET", path, Authorization=None)
            self.assertNotIn(b"secret", answer.body, path)
            self.assertNotEqual(answer.status, 200, path)


if __name__ == "__main__":
    unittest.main()
