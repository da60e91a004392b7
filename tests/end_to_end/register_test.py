# SPDX-License-Identifier: Apache-2.0
"""Cameras are registered with a board; a file of places is written, or left as it was, and used."""
import json
import math
import pathlib
import shutil
import struct
import tempfile
import unittest

from screens_test import write_video
from theatron_process import Process, host, run, write_png

WIDTH, HEIGHT, FOCAL = 320, 288, 252.0
FRAMES = 60
BOARD_WIDTH, BOARD_HEIGHT, BAR = 0.8, 0.6, 0.06
FILLED = {(0, 0), (1, 0), (0, 1)}  # column, row


def is_board(u, v):
    """True if the front of the board has material there; u to the right, v up, from its middle."""
    if abs(u) > BOARD_WIDTH / 2 or abs(v) > BOARD_HEIGHT / 2:
        return False
    cell_width, cell_height = (BOARD_WIDTH - 5 * BAR) / 4, (BOARD_HEIGHT - 4 * BAR) / 3
    x, y = u + BOARD_WIDTH / 2, BOARD_HEIGHT / 2 - v
    column, row = int(x // (cell_width + BAR)), int(y // (cell_height + BAR))
    in_hole = column < 4 and row < 3 and x - column * (cell_width + BAR) > BAR and y - row * (cell_height + BAR) > BAR
    return not in_hole or (column, row) in FILLED


def position(degrees, radius=1.3):
    """The position of a camera around the board, at its height, that is turned to it."""
    a = math.radians(degrees)
    return radius * math.sin(a), 1.2, radius * math.cos(a)


def make_depth_camera(folder, degrees, radius, depth_mm):
    """A level camera around the room's middle; `depth_mm(place, ray)` is the exact depth of a pixel whose ray is 1 m deep."""
    (folder / "depth").mkdir(parents=True)
    (folder / "calibration.json").write_text(json.dumps({"depth": {
        "width": WIDTH, "height": HEIGHT, "fx": FOCAL, "fy": FOCAL, "cx": 159.5, "cy": 143.5}}))
    a = math.radians(degrees)
    forward, right = (-math.sin(a), -math.cos(a)), (math.cos(a), -math.sin(a))  # x and z in the room
    place = position(degrees, radius)
    rows = []
    for y in range(HEIGHT):
        row = []
        for x in range(WIDTH):
            rx, ry = (x - 159.5) / FOCAL, (y - 143.5) / FOCAL
            row.append(depth_mm(place, (right[0] * rx + forward[0], -ry, right[1] * rx + forward[1])))
        rows.append(struct.pack(f">{WIDTH}H", *row))
    write_png(folder / "depth" / "00000.png", WIDTH, HEIGHT, 16, 1, rows)
    for n in range(1, FRAMES):
        shutil.copy(folder / "depth" / "00000.png", folder / "depth" / f"{n:05}.png")
    return f"folder:{folder}"


def make_camera(folder, degrees, size=1.0, board=True):
    """A board that is turned by 9 degrees in itself before a wall; exact depth."""
    roll = math.radians(9)

    def depth_mm(place, ray):
        z = -place[2] / ray[2] if ray[2] < 0 else -1
        u, v = place[0] + ray[0] * z, ray[1] * z
        turned = u * math.cos(roll) + v * math.sin(roll), v * math.cos(roll) - u * math.sin(roll)
        hit = board and z > 0 and is_board(turned[0] / size, turned[1] / size)
        return round(1000 * z) if hit else 3000
    return make_depth_camera(folder, degrees, 1.3, depth_mm)


def turned(quaternion, place):
    w, x, y, z = quaternion
    cross = [y * place[2] - z * place[1], z * place[0] - x * place[2], x * place[1] - y * place[0]]
    again = [y * cross[2] - z * cross[1], z * cross[0] - x * cross[2], x * cross[1] - y * cross[0]]
    return [p + 2 * (w * c + a) for p, c, a in zip(place, cross, again)]


def to_first(first, second, place):
    """A place in the second camera's frame, in the first one's."""
    room = [a + b for a, b in zip(turned(second["quaternion"], place), second["translation"])]
    w, *xyz = first["quaternion"]
    return turned([w, *(-c for c in xyz)], [a - b for a, b in zip(room, first["translation"])])


def make_room_camera(folder, degrees):
    """Exact depth of two walls, a floor and a table, seen by a level camera 1.2 m high."""
    def depth_mm(place, ray):
        (px, py, pz), (dx, dy, dz) = place, ray
        hits = [3.9]
        if dy < 0:
            hits.append(-py / dy)  # the floor
            table = (0.7 - py) / dy
            if abs(px + dx * table) < 0.5 and abs(pz + dz * table) < 0.4:
                hits.append(table)
        for slope in (-0.5, 0.5):  # two walls with an edge between them: z = -0.9 - |x| / 2
            wall = (-0.9 - pz - slope * px) / (dz + slope * dx)
            if wall > 0 and slope * (px + dx * wall) >= 0:
                hits.append(wall)
        return round(1000 * min(hits))
    return make_depth_camera(folder, degrees, 2.2, depth_mm)


class Register(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_register_"))
        cls.left = make_camera(cls.folder / "left", -30)
        cls.right = make_camera(cls.folder / "right", 30)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def register(self, *cameras, output, options=()):
        given = [word for camera in cameras for word in ("--camera", camera)]
        return run("register", *given, "--output", output, "--poses", "1", "--json", *options)

    def test_the_places_of_two_cameras_are_found_saved_and_used(self):
        file = self.folder / "places.json"
        code, out, errors = self.register(self.left, self.right, output=file)
        self.assertEqual(code, 0, errors)
        events = [json.loads(line) for line in out.splitlines()]
        self.assertEqual(events[-1]["event"], "saved")
        self.assertLess(events[-2]["pairs"][0]["apart_mm"], 5)
        places = json.loads(file.read_text())
        self.assertRegex(places["made"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.assertEqual([camera["camera"] for camera in places["cameras"]], ["left", "right"])
        at = [camera["room_from_camera"]["translation"] for camera in places["cameras"]]
        self.assertAlmostEqual(math.dist(*at), math.dist(position(-30), position(30)), delta=0.01)

        with host(self.folder / "state", self.left + ",loop=1", self.right + ",loop=1", options=("--places", file)) as h:
            code, out, errors = run("status", h.greeting["link"], "--json")
            self.assertEqual(code, 0, errors)
            self.assertFalse([line for line in h.errors if "Nobody knows where" in line])

    def test_the_cameras_of_a_running_session_are_registered_by_its_link(self):
        file = self.folder / "live.json"
        with host(self.folder / "state", self.left + ",loop=1", self.right + ",loop=1", options=("--filter", "off")) as h:
            code, out, errors = run("register", h.greeting["link"], "--output", file, "--poses", "1", "--json")
        self.assertEqual(code, 0, errors)
        views = [json.loads(line) for line in out.splitlines()][:-1]
        self.assertRegex(views[0]["next"], "hold the board where '(left|right)' and '(left|right)' both see it")
        self.assertEqual(views[-1]["next"], "")
        places = json.loads(file.read_text())
        self.assertEqual([camera["camera"] for camera in places["cameras"]], ["left", "right"])
        at = [camera["room_from_camera"]["translation"] for camera in places["cameras"]]
        self.assertAlmostEqual(math.dist(*at), math.dist(position(-30), position(30)), delta=0.01)

    def test_screens_and_cameras_that_are_not_wanted_are_left_out_of_a_session(self):
        video, file = self.folder / "v.y4m", self.folder / "chosen.json"
        write_video(video, 60)
        other = make_camera(self.folder / "other", 0, board=False)
        cameras = [f"{camera},loop=1" for camera in (self.left, self.right, other)]
        screen = f"video:{video},loop=1,place=0:1.8:-1.5"
        with host(self.folder / "state", *cameras, screen, options=("--filter", "off")) as h:
            link = h.greeting["link"]
            with Process("publish", h.greeting["publish_link"], "--share", f"{video},loop=1", "--every", "1") as cart:
                cart.read_json()
                register = ("register", link, "--output", file, "--poses", "1", "--json")
                code, out, errors = run(*register, "--only", "left", "--only", "right")
                self.assertEqual(code, 0, errors)
                self.assertEqual([c["camera"] for c in json.loads(file.read_text())["cameras"]], ["left", "right"])
                self.assertNotIn("left out", errors)
                code, _, errors = run(*register, "--seconds", "6")
                self.assertIn("'v' is left out: it is a screen.", errors)
                self.assertEqual(code, 1)
                self.assertRegex(errors, "'other' never saw the board|No camera saw the board held still")
                code, _, errors = run(*register, "--only", "left", "--only", "v")
                self.assertEqual((code, "No camera to be registered is called 'v'" in errors), (1, True), errors)
            code, _, errors = run("register", link, "--output", self.folder / "refined.json", "--refine", file)
            self.assertIn("'other' is left out: the file of places does not have it.", errors)
            self.assertNotIn("register it with the board", errors)
            self.assertFalse([line for line in h.errors if "12 m apart" in line and "'v'" in line], h.errors)

    def test_a_session_of_one_camera_and_a_link_that_leads_nowhere_are_refused(self):
        file = self.folder / "kept.json"
        file.write_text("{as it was")
        with host(self.folder / "state", self.left + ",loop=1") as h:
            link = h.greeting["link"]
            code, _, errors = run("register", link, "--output", file)
            self.assertEqual(code, 1)
            self.assertIn("give at least two", errors)
        for arguments in ((link, "--camera", self.left), ()):
            code, _, errors = run("register", *arguments, "--output", file)
            self.assertEqual(code, 1)
            self.assertIn("Say which cameras", errors)
        self.assertEqual(file.read_text(), "{as it was")

    def test_cameras_whose_place_nobody_knows_are_named(self):
        with host(self.folder / "state", self.left + ",loop=1", self.right + ",loop=1,place=1:1.5:2:30") as h:
            while not any("Nobody knows where these cameras are in the room: left." in line for line in h.errors):
                self.assertIsNone(h.process.poll())

    def refused(self, *cameras, says, options=()):
        file = self.folder / "kept.json"
        file.write_text("{as it was")
        code, _, errors = self.register(*cameras, output=file, options=options)
        self.assertEqual(code, 1)
        self.assertIn(says, errors)
        self.assertEqual(file.read_text(), "{as it was")

    def test_bad_input_ends_in_a_sentence_and_changes_no_file(self):
        blind = make_camera(self.folder / "blind", 0, board=False)
        other = make_camera(self.folder / "elsewhere", 0, board=False)
        small = [make_camera(self.folder / f"small{i}", degrees, size=0.8) for i, degrees in ((0, -30), (1, 30))]
        self.refused(self.left, blind, says="The camera 'blind' never saw the board.")
        self.refused(blind, other, says="No camera saw the board held still.")
        self.refused(*small, says="--board")
        self.refused(self.left, self.left, says="Two cameras are called 'left'")
        self.refused(self.left, says="give at least two")
        for bad in ("a3", "80x60:", "80x60:20", "60x80:6", "nanx60:6", "80x60:6x"):
            self.refused(self.left, self.right, options=("--board", bad), says=f"There is no board '{bad}'")
        file = self.folder / "kept.json"
        for refused in (("--touches", file), ("--holder", file), ("--poses", "7"), ("--thickness", "20"), ("--board", "a2")):
            code, _, errors = run("register", "--camera", self.left, "--camera", self.right, "--output", file,
                                  "--refine", file, *refused)
            self.assertEqual((code != 0, "excludes" in errors), (True, True), errors)
        code, _, errors = self.register(self.left, self.right, output=file, options=("--tip", "0:0:0.1"))
        self.assertEqual((code != 0, "--touches" in errors), (True, True), errors)
        self.refused(self.left, self.right, options=("--touches", file, "--tip", "0:0:0.1:5"), says="--tip 0:0:0.1:5 is not")
        file = self.folder / "kept.json"
        for bad in ("nan", "-1", "thick"):
            code, _, errors = self.register(self.left, self.right, output=file, options=("--thickness", bad))
            self.assertNotEqual(code, 0)
            self.assertIn("is not a thickness from 0.5 to 40 millimetres", errors)
        touches = self.folder / "touches.txt"
        touches.write_text("A 0 1 0\nB 0.8 1\n")
        self.refused(self.left, self.right, options=("--touches", touches), says="Line 2 of the touches is not")
        touches.write_text("A 0 1 0\nB 2.8 1 0\nC 0.8 0.4 0\n")
        self.refused(self.left, self.right, options=("--touches", touches), says="mm off the board's corners")
        touches.write_text("1 0 1 0\n")
        self.refused(self.left, self.right, options=("--holder", touches), says="Line 1 of the holder's poses is not")
        touches.write_text("7 0 1 0 1 0 0 0\n")
        self.refused(self.left, self.right, options=("--holder", touches), says="name place 7")
        self.refused(self.left, self.right, options=("--report", file), says="name the same file")
        foreign = self.folder / "letter.txt"
        foreign.write_text("Dear Ann")
        self.refused(self.left, self.right, options=("--report", foreign), says="is not a report")
        code, _, errors = self.register(self.left, self.right, output=foreign)
        self.assertEqual((code, "is not a file of places" in errors), (1, True), errors)
        self.assertEqual(foreign.read_text(), "Dear Ann")
        code, _, errors = run("register", "--camera", self.left, "--camera", self.right, "--output", file, "--refine", file)
        self.assertEqual((code, "The file of places" in errors), (1, True), errors)
        self.assertEqual(file.read_text(), "{as it was")

    def test_a_board_of_another_size_is_taken_with_its_size(self):
        small = [make_camera(self.folder / f"true{i}", degrees, size=0.8) for i, degrees in ((0, -30), (1, 30))]
        file = self.folder / "true.json"
        code, out, errors = self.register(*small, output=file, options=("--board", "64x48:4.8"))
        self.assertEqual(code, 0, errors)
        at = [camera["room_from_camera"]["translation"] for camera in json.loads(file.read_text())["cameras"]]
        self.assertAlmostEqual(math.dist(*at), math.dist(position(-30), position(30)), delta=0.01)
        # Without --json, to a pipe: nothing that only a terminal understands.
        code, out, errors = run("register", "--camera", small[0], "--camera", small[1], "--output", file, "--poses", "1",
                                "--board", "64x48:4.8")
        self.assertEqual(code, 0, errors)
        self.assertNotIn("\033", out)
        self.assertNotIn("\r", out)
        self.assertIn("the reference;", out)

    def test_a_controllers_tip_at_the_boards_corners_gives_the_rooms_frame_and_a_report_is_drawn(self):
        # The board's middle is at 1.2 m in make_camera's room, turned by 9 degrees in itself.
        file, touches, report = (self.folder / name for name in ("touched.json", "touches.txt", "report.html"))
        a, lines = math.radians(9), []
        for corner, (x, y) in zip("ABCD", ((-0.4, 0.3), (0.4, 0.3), (0.4, -0.3), (-0.4, -0.3))):
            u, v = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
            lines.append(f"{corner} {u} {v + 1.2} -0.1 1 0 0 0")  # the tip is 10 cm before the controller's origin
        touches.write_text("\n".join(lines))
        code, out, errors = self.register(self.left, self.right, output=file, options=(
            "--touches", touches, "--tip", "0:0:0.1", "--report", report))
        self.assertEqual(code, 0, errors)
        saved = json.loads(out.splitlines()[-1])
        self.assertEqual(saved["room"], "the touched corners of the board")
        for camera, degrees in zip(json.loads(file.read_text())["cameras"], (-30, 30)):
            self.assertLess(math.dist(camera["room_from_camera"]["translation"], position(degrees)), 0.02)
        html = report.read_text()
        self.assertIn("Registration of 2 cameras", html)
        self.assertIn("Fixed errors of depth", html)
        self.assertNotIn("http", html)

    def test_the_board_in_a_tracked_holder_gives_the_rooms_frame(self):
        # The board's middle is at 1.2 m, turned by 9 degrees in itself; the controller is 30 cm below it.
        file, poses = self.folder / "held.json", self.folder / "holder.txt"
        a = math.radians(9)
        poses.write_text(f"1 {0.3 * math.sin(a)} {1.2 - 0.3 * math.cos(a)} 0 {math.cos(a / 2)} 0 0 {math.sin(a / 2)}\n")
        code, out, errors = self.register(self.left, self.right, output=file, options=(
            "--holder", poses, "--holder-offset", "0:0.3:0"))
        self.assertEqual(code, 0, errors)
        self.assertEqual(json.loads(out.splitlines()[-1])["room"], "the board's tracked holder")
        for camera, degrees in zip(json.loads(file.read_text())["cameras"], (-30, 30)):
            self.assertLess(math.dist(camera["room_from_camera"]["translation"], position(degrees)), 0.02)

    def test_a_camera_that_was_moved_a_little_is_found_again_without_a_board(self):
        cameras = [make_room_camera(self.folder / name, degrees) for name, degrees in (("west", -30), ("east", 30))]
        old, new = self.folder / "old.json", self.folder / "new.json"
        moved = (0.012, -0.006, 0.008)
        # Rotations of cameras that are level: about x by 180 degrees, then about y.
        entries = [{"camera": name, "depth_offset_mm": 0.4, "room_from_camera": {
            "quaternion": [0, math.cos(math.radians(degrees) / 2), 0, -math.sin(math.radians(degrees) / 2)],
            "translation": [p + m for p, m in zip(position(degrees, 2.2), shift)]}}
            for name, degrees, shift in (("west", -30, (0, 0, 0)), ("east", 30, moved))]
        old.write_text(json.dumps({"theatron_places": 1, "made": "", "method": "by hand", "cameras": entries}))
        report = self.folder / "refined.html"
        code, out, errors = run("register", "--camera", cameras[0], "--camera", cameras[1], "--output", new, "--json",
                                "--refine", old, "--report", report)
        self.assertEqual(code, 0, errors)
        saved = json.loads(new.read_text())
        self.assertIn("surfaces; before: by hand", saved["method"])
        # Nobody estimated how well the places are known; the offset is kept, and said.
        told = json.loads(out.splitlines()[-1])["cameras"]
        for camera, kept in zip(told, saved["cameras"]):
            self.assertFalse(camera["reference"])
            self.assertNotIn("sigma_mm", camera)
            self.assertEqual(camera["depth_offset_mm"], kept["depth_offset_mm"])
        html = report.read_text()
        self.assertNotIn("the reference", html)
        self.assertIn("+0.4 mm, as before", html)
        # Places that the second camera sees, by its new pose relative to the first camera's.
        poses = [camera["room_from_camera"] for camera in saved["cameras"]]
        true = [entry["room_from_camera"] for entry in entries]
        true[1] = true[1] | {"translation": position(30, 2.2)}
        for place in ((0, 0, 2.2), (-0.5, 0, 2.2), (0.5, 0, 2.2), (0, 0.5, 2), (0, -0.4, 2.5)):
            found, expected = (to_first(*pair, place) for pair in (poses, true))
            self.assertLess(math.dist(found, expected), 0.005)
            self.assertGreater(math.dist(to_first(*(e["room_from_camera"] for e in entries), place), expected), 0.008)

    def test_places_of_other_cameras_are_refused(self):
        file = self.folder / "others.json"
        pose = {"quaternion": [1, 0, 0, 0], "translation": [0, 1, 0]}
        file.write_text(json.dumps({"theatron_places": 1, "made": "", "method": "", "cameras": [
            {"camera": "another", "room_from_camera": pose}]}))
        with Process("host", "--camera", self.left, "--places", file, "--state", self.folder / "state") as h:
            self.assertEqual(h.end(), 1)
        self.assertIn("has no place of a camera that is opened (left)", "".join(h.errors))

    def test_the_board_is_drawn_at_true_scale(self):
        drawing = self.folder / "board.svg"
        code, _, errors = run("target", "--out", drawing)
        self.assertEqual(code, 0, errors)
        self.assertIn('width="800.000mm" height="600.000mm"', drawing.read_text())
        code, _, errors = run("target", "--out", drawing)
        self.assertEqual(code, 1)
        self.assertIn("exists already", errors)
        self.assertEqual(run("target", "--out", drawing, "--overwrite")[0], 0)
        code, _, errors = run("target", "--out", self.folder / "thick.svg", "--thickness", "nan")
        self.assertNotEqual(code, 0)
        self.assertIn("not a thickness", errors)
        code, _, errors = run("target", "--out", self.folder / "board.pdf")
        self.assertEqual(code, 1)
        self.assertIn("ends neither in .svg nor in .dxf", errors)


if __name__ == "__main__":
    unittest.main()
