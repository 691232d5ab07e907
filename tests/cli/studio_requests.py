"""Is the studio safe, and does it do what a page asks of it? Requests of Python's own HTTP client to the real program.

usage: studio_requests.py VEGARD FOLDER    the folder holds scene.toml; beside it lies secret.txt
"""
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time
import urllib.parse

VEGARD, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
HURT = []


def check(is_right, what):
    if not is_right:
        HURT.append(what)
        print("FAILED:", what, file=sys.stderr)


class Studio:
    def __init__(self, *words, cwd=FOLDER, **environment):
        self.process = subprocess.Popen([VEGARD, "studio", "--no-browser", *words], cwd=cwd, env={**os.environ, **environment},
                                        stdout=subprocess.PIPE, text=True)
        self.process.stdout.readline()
        self.address = self.process.stdout.readline().strip()
        parts = urllib.parse.urlsplit(self.address)
        self.host, self.port, self.root = parts.hostname, parts.port, parts.path

    def request(self, method, path, body=None, headers=None, root=None):
        """Status, headers and bytes; the path is sent as it is written."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=60)
        connection.request(method, (self.root if root is None else root) + path, body=body, headers=headers or {})
        answer = connection.getresponse()
        found = answer.status, dict(answer.getheaders()), answer.read()
        connection.close()
        return found

    def tell(self, path, asked, headers=None):
        status, _, body = self.request("POST", path, json.dumps(asked), {"Content-Type": "application/json", **(headers or {})})
        return status, json.loads(body)

    def end_of(self, number):
        where, said = 0, ""
        while True:
            state = json.loads(self.request("GET", f"job/{number}?from={where}")[2])
            where, said = state["end"], said + state["said"]
            if not state["runs"]:
                return state, said

    def close(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=20)


def refuses_strangers(studio, other):
    here = f"127.0.0.1:{studio.port}"
    check(studio.request("GET", "")[0] == 200, "the page is served")
    check(studio.request("GET", "", headers={"Host": f"localhost:{studio.port}", "Origin": f"http://localhost:{studio.port}"})[0] == 200,
          "localhost is this address")
    check(studio.request("GET", "files", headers={"Host": f"evil.example:{studio.port}"})[0] == 403, "another host (DNS rebinding)")
    for origin in ("https://evil.example", "null", f"http://127.0.0.1:{other.port}"):
        check(studio.tell("run", {"words": ["params", "scene.toml"]}, {"Origin": origin})[0] == 403, f"origin {origin}")
    check(studio.tell("run", {"words": ["params", "scene.toml"]}, {"Origin": f"http://{here}"})[0] == 200, "its own origin")
    check(studio.request("GET", "files", root="/")[0] == 404, "without the random word")
    check(studio.request("GET", "files", root=other.root)[0] == 404, "the random word of another studio")
    check(studio.root != other.root and re.fullmatch(r"/[0-9a-f]{32}/", studio.root), "a random word of 128 bits")
    check(studio.request("POST", "run", '{"words":["params"]}', {"Content-Type": "text/plain"})[0] == 415,
          "a form of another page can send text/plain")
    listening = socket.socket()
    check(listening.connect_ex((socket.gethostbyname(socket.gethostname()), studio.port)) != 0
          or socket.gethostbyname(socket.gethostname()).startswith("127."), "it listens on loopback only")
    listening.close()


def stays_in_its_folder(studio):
    for name in ("../secret.txt", "..%2Fsecret.txt", "%2e%2e/secret.txt", "/etc/passwd", "%2Fetc%2Fpasswd", "link.txt", ".hidden", "folder",
                 "nothing.txt", "scene.toml%00.png"):
        status, _, body = studio.request("GET", "file/" + name)
        check(status == 404 and b"secret" not in body, f"file/{name} is answered {status}")
    status, headers, body = studio.request("GET", "file/scene.toml")
    check(status == 200 and body == (FOLDER / "scene.toml").read_bytes(), "a file of the folder is served whole")
    check("sandbox" in headers.get("Content-Security-Policy", "") and "allow-same-origin" not in headers["Content-Security-Policy"],
          "files are shown without the studio's origin")
    for words in (["params", "../scene.toml"], ["render", "scene.toml", "-o", "/x.png"], ["render", "scene.toml", "--output=../x.png"],
                  ["render", "scene.toml", "--set", 'composite.foreground="/etc/passwd"'], ["survey", "run"], ["studio"], []):
        check(studio.tell("run", {"words": words})[0] == 422, f"refused: {words}")
    check(studio.tell("run", {"words": "params"})[0] == 422, "words that are no list")
    check(studio.request("POST", "run", "{", {"Content-Type": "application/json"})[0] == 422, "damaged JSON")
    check(studio.tell("save", {"scene": "../scene.toml", "changes": [], "to": "x.toml"})[0] == 422, "a scene outside")
    check(not (FOLDER.parent / "x.png").exists(), "nothing is written outside")


def takes_files(studio):
    before = (FOLDER / "scene.toml").read_bytes()
    binary = {"Content-Type": "application/octet-stream"}
    status, _, body = studio.request("POST", "upload?name=scene.toml", b"other", binary)
    check(status == 200 and json.loads(body)["name"] == "scene_2.toml", "a name that is taken gets a number")
    check((FOLDER / "scene.toml").read_bytes() == before and (FOLDER / "scene_2.toml").read_bytes() == b"other", "nothing is overwritten")
    status, _, body = studio.request("POST", "upload?name=..%2F..%2Fnew.jpg", b"x", binary)
    check(status == 200 and (FOLDER / "new.jpg").exists(), "folders in a name are left out")
    for name in ("", "..", ".profile", "a%0Ab.jpg", "a%5Cb.jpg"):
        check(studio.request("POST", "upload?name=" + name, b"x", binary)[0] == 422, f"no name for a file: {name}")
    connection = http.client.HTTPConnection(studio.host, studio.port, timeout=60)
    try:
        connection.putrequest("POST", studio.root + "upload?name=huge.jpg")
        for name, value in {**binary, "Content-Length": str(1 << 40)}.items():
            connection.putheader(name, value)
        connection.endheaders()
        status = connection.getresponse().status
    except ConnectionError:
        status = 413
    connection.close()
    check(status == 413, f"a terabyte is answered {status}")
    # One that breaks off leaves nothing.
    with socket.create_connection((studio.host, studio.port)) as broken:
        broken.sendall((f"POST {studio.root}upload?name=broken.jpg HTTP/1.1\r\nHost: {studio.host}:{studio.port}\r\n"
                        "Content-Type: application/octet-stream\r\nContent-Length: 1000\r\n\r\nhalf").encode())
    for _ in range(100):
        left = [path.name for path in FOLDER.iterdir() if "broken" in path.name or "huge" in path.name]
        if not left:
            break
        time.sleep(0.1)
    check(not left, f"what broke off has left {left}")


def runs_commands(studio):
    state, said = studio.end_of(studio.tell("run", {"words": ["params", "scene.toml", "--json"]})[1]["job"])
    check(state["exit_code"] == 0 and "camera.width" in state["output"] and said == state["output"], "the words of a command")
    state, said = studio.end_of(studio.tell("run", {"words": ["params", "nothing.toml"]})[1]["job"])
    check(state["exit_code"] == 3 and "nothing.toml" in said, "the message of what is wrong")
    job = studio.tell("run", {"words": ["render", "scene.toml"], "shown": True})[1]["job"]
    state, said = studio.end_of(job)
    picture = studio.request("GET", f"picture/{job}")
    check(state["exit_code"] == 0 and picture[2].startswith(b"\x89PNG"), f"a picture is shown: {said}")
    state, said = studio.end_of(view := studio.tell("run", {"words": ["export", "scene.toml"], "shown": True})[1]["job"])
    page = studio.request("GET", f"picture/{view}")
    check(state["exit_code"] == 0 and page[2].startswith(b"<!doctype html>"), f"a live view is shown: {said}")
    check("sandbox allow-scripts" in page[1].get("Content-Security-Policy", ""), "without the studio's origin")
    status, _, sky = studio.request("GET", "sky?camera=scene.toml")
    stars = json.loads(sky).get("stars", [])
    check(status == 200 and stars and all(0 <= x <= 160 and 0 <= y <= 120 for _, _, x, y in stars), "the catalogue's stars in a camera")
    for outside in ("../secret.txt", "nothing.toml", "/etc/passwd", ""):
        status, _, said = studio.request("GET", f"sky?camera={outside}")
        check(status == 422 and b"secret" not in said.replace(b"secret.txt", b""), f"the sky of {outside}: {status} {said}")
    names = [entry["name"] for entry in json.loads(studio.request("GET", "files")[2])]
    check("scene.toml" in names and not any(name.startswith(".") or "png" in name for name in names), f"files: {names}")
    status, saved = studio.tell("save", {"scene": "scene.toml", "changes": ["camera.hfov_deg=33"], "to": "wide.toml"})
    check(status == 200 and re.search(r"hfov_deg = 33\b", (FOLDER / saved["name"]).read_text()), "a changed scene is saved")
    status, said = studio.tell("save", {"scene": "scene.toml", "changes": ["camera.hfov_deg=-3"], "to": "bad.toml"})
    check(status == 422 and "hfov_deg" in said["error"] and not (FOLDER / "bad.toml").exists(), "a bad value is refused by name")
    check(studio.request("GET", "job/999")[0] == 404 and studio.request("POST", "job/999/stop")[0] == 404, "a job that is not")


def tells_lines_of_sight(studio):
    camera = {"file": "scene.toml", "changes": ["site.latitude_deg=67"]}
    cameras = [camera, {**camera, "changes": ["site.latitude_deg=66.5"]}]
    for earth, is_refracted in (("wgs84", True), ("sphere", False)):
        where = {"cameras": cameras, "earth": earth, "is_refracted": is_refracted}
        status, views = studio.tell("views", {**where, "height_km": 105})
        check(status == 200 and [view["place"][0] for view in views["views"]] == [67, 66.5] and views["views"][0]["width"] == 160, f"views: {views}")
        status, sight = studio.tell("sight", {**where, "pixel": [80, 60], "heights_km": [100, 200]})
        check(status == 200 and [point["height_km"] for point in sight["points"]] == [100, 200], f"sight: {sight}")
        # And back: the first camera has the places of its line of sight where the line is.
        places = [[*point["place"], point["height_km"]] for point in sight["points"]]
        status, seen = studio.tell("seen", {**where, "places": places})
        check(status == 200 and all(pixels[0] and max(abs(pixels[0][0] - 80), abs(pixels[0][1] - 60)) < 0.01 for pixels in seen["pixels"]), f"seen: {seen}")
        for point, pixels in zip(sight["points"], seen["pixels"]):
            check(all(a == b if a is None else max(abs(p - q) for p, q in zip(a, b)) < 1e-6 for a, b in zip(point["pixels"], pixels)), f"both ways: {point} {pixels}")
    check(studio.tell("seen", {**where, "places": [[-80.0, 0.0, 105.0]]})[1]["pixels"] == [[None, None]], "a place behind the Earth is not seen")
    for bad in ({"cameras": [{"file": "../secret.txt", "changes": []}]}, {"cameras": [{**camera, "changes": ["composite.foreground=/etc/passwd"]}]},
                {"cameras": [{**camera, "changes": ["camera.map=../secret.txt"]}]}, {"cameras": []}, {"cameras": [camera] * 9}, {"earth": "flat"},
                {"places": [[67.0, 20.0]]}, {"places": "all"}, {"is_refracted": "no"}):
        status, said = studio.tell("seen", {**where, "places": places, **bad})
        check(status == 422 and "secret\n" not in said["error"], f"{bad}: {status} {said}")
    for run in ("..", "", "nothing", "/etc"):
        check(studio.request("GET", f"map?run={run}")[0] == 404, f"the map of {run}")
    (FOLDER / "bad_map").mkdir()
    (FOLDER / "bad_map/precipitation.fits").write_bytes(b"SIMPLE  =")
    check(studio.request("GET", "map?run=bad_map")[0] == 422, "a damaged map")


def ends_with_its_commands(studio):
    job = studio.tell("run", {"words": ["preview", "scene.toml", "--frames", "9999"], "shown": True})[1]["job"]
    studio.tell(f"job/{job}/stop", {})
    state, _ = studio.end_of(job)
    check(state["exit_code"] in (130, -2 % 256), f"a stopped command ends with {state['exit_code']}")
    studio.tell("run", {"words": ["preview", "scene.toml", "--frames", "9999"], "shown": True})
    time.sleep(0.3)
    children = pathlib.Path(f"/proc/{studio.process.pid}/task/{studio.process.pid}/children")
    ours = {int(task) for path in pathlib.Path(f"/proc/{studio.process.pid}/task").iterdir()
            for task in (path / "children").read_text().split()} if children.exists() else set()
    check(ours or not children.exists(), "a command is running")
    code = studio.close()
    check(code == 0, f"Ctrl-C ends it with {code}")
    check(not [child for child in ours if os.path.exists(f"/proc/{child}")], "no command lives on")


def starts_from_a_menu():
    home = FOLDER.parent / "home"
    pictures, settings = home / "My Pictures", home / ".config/user-dirs.dirs"
    for folder in (pictures, settings.parent):
        folder.mkdir(parents=True)
    (pictures / "arc.png").write_bytes(b"")
    (home / "attic.png").write_bytes(b"")

    def shown(*words, **environment):
        studio = Studio("--desktop", *words, cwd="/", HOME=str(home), XDG_CONFIG_HOME="", **environment)
        listing = studio.request("GET", "files")[2].decode()
        studio.close()
        return studio.address.partition("#")[2], "My Pictures/arc.png" in listing, '"arc.png"' in listing

    check(shown() == ("", True, False), "without settings the home folder is shown")
    settings.write_text('# XDG_PICTURES_DIR="/none"\nXDG_PICTURES_DIR="$HOME/My Pictures"\n')
    check(shown() == ("", False, True), "the user's pictures are shown")
    settings.write_text('XDG_PICTURES_DIR="$HOME/gone"\n')
    check(shown() == ("", True, False), "of a folder that is gone the home folder is shown")
    check(shown(str(pictures / "arc.png")) == ("arc.png", False, True), "a picture is opened in its folder")
    check(shown(str(pictures)) == ("", False, True), "a folder is shown")


def main():
    (FOLDER / "link.txt").symlink_to(FOLDER.parent / "secret.txt")
    (FOLDER / ".hidden").write_text("secret")
    (FOLDER / "folder").mkdir()
    studio, other = Studio("scene.toml"), Studio()
    check(studio.address.endswith("#scene.toml"), "it opens what is named")
    refuses_strangers(studio, other)
    stays_in_its_folder(studio)
    takes_files(studio)
    runs_commands(studio)
    tells_lines_of_sight(studio)
    ends_with_its_commands(studio)
    other.close()
    starts_from_a_menu()
    return 1 if HURT else 0


sys.exit(main())
