# SPDX-License-Identifier: Apache-2.0
"""A patient's case in the shared room: offered while the session runs, opened by one, seen by all."""
import json
import math
import pathlib
import shutil
import struct
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run, wait_until, write_png


def sphere(radius, middle, rings=24):
    """The bytes of a surface (docs/formats/case_mesh.md): a sphere, millimetres."""
    vertices, normals, triangles = [], [], []
    columns = 2 * rings
    for r in range(rings + 1):
        for c in range(columns):
            down, around = math.pi * r / rings, math.pi * c / rings
            n = (math.sin(down) * math.cos(around), math.sin(down) * math.sin(around), math.cos(down))
            normals.append(n)
            vertices.append(tuple(m + radius * x for m, x in zip(middle, n)))
    for r in range(rings):
        for c in range(columns):
            a, b = r * columns + c, r * columns + (c + 1) % columns
            triangles += [(a, a + columns, b + columns), (a, b + columns, b)]
    data = b"THME" + struct.pack("<B3xII", 1, len(vertices), len(triangles))
    for list_, form in ((vertices, "<3f"), (normals, "<3f"), (triangles, "<3I")):
        data += b"".join(struct.pack(form, *each) for each in list_)
    return data


def images(columns=64, rows=64, slices=32, step=(3.0, 3.0, 5.0)):
    """The bytes of a series (docs/formats/case_volume.md): a bright ball of 80 mm in dark air."""
    origin = tuple(-0.5 * (n - 1) * s for n, s in zip((columns, rows, slices), step))
    header = b"THVO" + struct.pack("<BB2x3I", 1, 0, columns, rows, slices) + struct.pack("<3d", *origin)
    header += struct.pack("<9d", step[0], 0, 0, 0, step[1], 0, 0, 0, step[2]) + struct.pack("<4d", 1, 0, 60, 400)
    samples = []
    for k in range(slices):
        for j in range(rows):
            for i in range(columns):
                x, y, z = (o + n * s for o, n, s in zip(origin, (i, j, k), step))
                samples.append(150 if x * x + y * y + z * z < 80 * 80 else -500)
    return header + struct.pack(f"<{len(samples)}h", *samples)


def picture(color, width=40, height=30):
    """The bytes of a picture (docs/formats/case_picture.md) in one colour."""
    return b"THPI" + struct.pack("<BB2xII", 1, 3, width, height) + bytes(color) * (width * height)


def write_case(folder, name="Made liver", tumour=True, more_parts=0, pictures=()):
    """A shell, a vessel, and a tumour inside; a matching series; pictures of these colours."""
    folder.mkdir(parents=True)
    parts = [("liver", "shell", "#b25c4a", 0.35, sphere(80, (0, 0, 0))),
             ("portal vein", "portal_vein", "#466ed2", 1, sphere(12, (20, 0, 0)))]
    if tumour:
        parts.append(("tumour", "tumour", "#eccc3c", 1, sphere(18, (-25, 0, 10))))
    parts += [(f"lymph node {i}", "other", "#88aa88", 1, sphere(3, (5 * i - 100, 90, 0))) for i in range(more_parts)]
    manifest = {"theatron_case": 1, "name": name, "units": "mm", "space": "LPS", "deidentified": True,
                "license": "CC0", "credit": "made by a test", "parts": [],
                "series": [{"name": "CT", "modality": "CT", "file": "ct.thvolume"}]}
    for number, (part, role, color, opacity, mesh) in enumerate(parts):
        (folder / f"part_{number}.thmesh").write_bytes(mesh)
        manifest["parts"].append({"name": part, "role": role, "file": f"part_{number}.thmesh", "color": color, "opacity": opacity})
    if pictures:
        manifest.update({"theatron_case": 2, "pictures": [{"name": f"picture {i}", "file": f"{i}.thpicture"} for i in range(len(pictures))]})
    for i, color in enumerate(pictures):
        (folder / f"{i}.thpicture").write_bytes(picture(color))
    (folder / "ct.thvolume").write_bytes(images())
    (folder / "identifiers.json").write_text('{"series": [{"PatientName": "Doe^Jane"}]}')
    (folder / "identifiers.json").chmod(0o600)
    (folder / "case.json").write_text(json.dumps(manifest))
    return folder


def member(link, name, *options):
    return Process("join", link, "--name", name, "--every", "0.1", *options)


def has_all(figures):
    open_case = figures["cases"]["open"]
    return open_case and open_case["complete"]


def parts_of(figures):
    return {part["name"]: part for part in figures["cases"]["open"]["parts"]}


def case_host(folder, cases):
    """Starts a host with a camera and the cases of a folder."""
    recording = make_recording(folder / "box", width=160, height=120, frames=4)
    # The camera stands 1.3 m above the floor and looks level along -z.
    lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
    pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.3, 1]}
    (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
    return lambda *options: host(folder / "state", f"folder:{recording},loop=1,preload=1", options=("--cases", cases, *options))


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_case_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.cases = self.folder / "cases"
        self.cases.mkdir()
        self.start = case_host(self.folder, self.cases)

    def case_problems(self, h):
        code, out, errors = run("status", h.greeting["links"]["operator"], "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)["case_problems"]

    def test_a_case_dropped_in_is_opened_by_one_and_had_by_three(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, \
                member(h.greeting["link"], "Ben") as ben, \
                member(h.greeting["links"]["observer"], "Cleo") as cleo:
            for person in (anna, ben, cleo):
                person.wait_for(lambda f: len(f["room"]["people"]) == 3)
            write_case(self.cases / "liver")
            for person in (anna, ben):
                person.wait_for(lambda f: f["cases"]["offered"] == ["Made liver"])
            # A case that is not open is offered to nobody who may not open it.
            self.assertEqual(cleo.newest_json()["cases"]["offered"], [])
            anna.say("case open --yes Made liver")
            for person in (anna, ben, cleo):
                person.wait_for(has_all)
            # One takes the organ; the others see it in their hand, and all rooms are the same.
            organ = anna.newest_json()["cases"]["open"]["object"]
            ben.say(f"grab {organ}")
            ben.say("move 0.2 1.25 -0.3 40")
            ben.say("release")
            ben.say("case hide liver")
            ben.say("case explode 50")
            for person in (anna, ben, cleo):
                person.wait_for(lambda f: not parts_of(f)["liver"]["shown"] and f["cases"]["open"]["explosion"] > 0.4)
            hashes = {person.newest_json()["room"]["hash"] for person in (anna, ben, cleo)}
            self.assertEqual(len(hashes), 1)
            # A part of its own, then everything back.
            tumour = parts_of(anna.newest_json())["tumour"]["object"]
            anna.say(f"grab {tumour}")
            anna.say("move 0.5 1.4 0.1 0")
            anna.say("release")
            ben.wait_for(lambda f: self.position(f, tumour) != [0, 0, 0])
            ben.say("case together")
            anna.wait_for(lambda f: self.position(f, tumour) == [0, 0, 0] and parts_of(f)["liver"]["shown"])
            # The case goes on after a restart of the host, with the room.
            before = anna.newest_json()["cases"]["open"]["hash"]
            h.process.terminate()
            self.assertEqual(h.end(), 0)
        with self.start() as h, member(h.greeting["link"], "Dora") as dora:
            again = dora.wait_for(has_all)
            self.assertEqual(again["cases"]["open"]["hash"], before)
            self.assertEqual(self.position(again, again["cases"]["open"]["object"]), [0.2, 1.25, -0.3])
            write_case(self.cases / "next", "Second", tumour=False)
            dora.wait_for(lambda f: "Second" in f["cases"]["offered"])
            dora.say("case open --yes Second")
            dora.wait_for(lambda f: has_all(f) and f["cases"]["open"]["name"] == "Second" and len(parts_of(f)) == 2)
            dora.say("case close")
            dora.wait_for(lambda f: not f["cases"]["open"] and not f["room"]["objects"])

    def test_a_broken_case_is_said_and_the_others_are_offered(self):
        broken = write_case(self.cases / "broken", "Broken")
        (broken / "part_1.thmesh").unlink()
        cut = write_case(self.cases / "cut", "Cut")
        (cut / "ct.thvolume").write_bytes((cut / "ct.thvolume").read_bytes()[:5000])
        newer = write_case(self.cases / "newer", "Newer")
        (newer / "case.json").write_text((newer / "case.json").read_text().replace('"theatron_case": 1', '"theatron_case": 3'))
        write_case(self.cases / "whole", "Whole")
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["cases"]["offered"] == ["Whole"])
            for sentence in ("lacks the file 'part_1.thmesh'", "ct.thvolume' is", "case.json"):
                h.wait_for_error(sentence)
            # Two cases of the same name can both be opened, and the first one keeps its name.
            write_case(self.cases / "a_whole", "Whole", tumour=False)
            anna.wait_for(lambda f: f["cases"]["offered"] == ["Whole (2)", "Whole"])
            shutil.rmtree(self.cases / "a_whole")
            for i in range(70):
                (self.cases / f"zz{i}").mkdir()
            h.wait_for_error("holds more than 64 folders; only the first ones by name are read.")
            for i in range(70):
                (self.cases / f"zz{i}").rmdir()
            # Repaired while the session runs.
            (broken / "part_1.thmesh").write_bytes(sphere(5, (0, 0, 0)))
            anna.wait_for(lambda f: f["cases"]["offered"] == ["Broken", "Whole"])
            shutil.rmtree(broken)
            anna.wait_for(lambda f: f["cases"]["offered"] == ["Whole"])
            for line, problem in (("case open --yes Nothing", "offers no case 'Nothing'; it offers Whole."),
                                  ("case close", "No case is open"), ("case hide liver", "No case is open"),
                                  ("case explode 200", "from 0 to 100"), ("case scale 0", "from 0.01 to 100"),
                                  ("case what", "There is no such line on cases")):
                anna.say(line)
                anna.wait_for_error(problem)

    def test_an_open_case_whose_folder_is_moved_away_stays_and_the_operator_is_told(self):
        write_case(self.cases / "liver")
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case picture 1")
            anna.wait_for_error("'case picture 1': No case is open.")
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            anna.say("case picture 1")
            anna.wait_for_error("'case picture 1': The open case has no pictures.")
            self.assertEqual(self.case_problems(h), [])
            (self.cases / "liver").rename(self.folder / "away")
            anna.wait_for(lambda f: not f["cases"]["offered"])
            h.wait_for_error("The open case is not in the folder of cases any more as it was opened")
            wait_until(lambda: "as it was opened" in "".join(self.case_problems(h)))
            self.assertTrue(has_all(anna.newest_json()), "who has it keeps it")
            # Back, with damaged texts on the patient: it can be shown, and the operator is told.
            (self.folder / "away/identifiers.json").write_text('{"series": [{"PatientName": "Doe^')
            (self.folder / "away").rename(self.cases / "liver")
            anna.wait_for(lambda f: f["cases"]["offered"])
            h.wait_for_error("identifiers.json' is not what `theatron case import` writes")
            wait_until(lambda: self.case_problems(h) == [
                "Nobody is told who the patient of the case 'Made liver' is; the host's log says why."])
            self.assertNotIn("Doe", "".join(h.errors))
            # Status is read from elsewhere: the name of a folder is in the log alone.
            (self.cases / "Doe Jane").mkdir()
            (self.cases / "Doe Jane/case.json").write_text("{")
            wait_until(lambda: self.case_problems(h)[0] == "1 case is not offered; the host's log says why.")
            self.assertNotIn("Doe", "".join(self.case_problems(h)))

    def test_what_names_the_patient_leaves_the_folder_nowhere(self):
        write_case(self.cases / "liver")
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            h.process.terminate()
            self.assertEqual(h.end(), 0)
            self.assertNotIn("Doe", "".join(h.errors + anna.errors))
        for file in (self.folder / "state").rglob("*"):
            if file.is_file():
                self.assertNotIn(b"Doe", file.read_bytes(), file)

    def test_organ_slice_and_cut_are_drawn(self):
        write_case(self.cases / "liver")
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["cases"]["offered"])

            def count(name, is_it):
                with Process("join", h.greeting["link"], "--offscreen", self.folder / name, "--size", "320x240", "--quality", "low",
                             "--seconds", "2", "--color-codec", "raw", "--renderer", "mesh", "--json") as viewer:
                    self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                width, height, channels, rows = read_png(self.folder / name)
                return sum(is_it(*rows[y][channels * x:channels * x + 3]) for y in range(height) for x in range(width))

            def is_yellow(r, g, b):
                return r > b + 50 and g > b + 30

            def is_white(r, g, b):
                return min(r, g, b) > 150 and max(r, g, b) - min(r, g, b) < 8

            without = count("without.png", is_yellow), count("without.png", is_white)
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            anna.say("case scale 2")
            anna.say("case slice coronal 0")
            anna.wait_for(lambda f: f["cases"]["open"]["screen"]["orientation"] == 1)
            tumour = count("tumour.png", is_yellow)
            self.assertGreater(tumour, without[0] + 100, "the tumour through the shell")
            screen = count("tumour.png", is_white)
            self.assertGreater(screen, without[1] + 500, "the bright ball of the images")
            anna.say("case hide tumour")
            anna.wait_for(lambda f: not parts_of(f)["tumour"]["shown"])
            # The texts on the screen are yellow, too.
            self.assertLess(count("hidden.png", is_yellow), tumour - 150)
            anna.say("case cut")
            anna.wait_for(lambda f: f["cases"]["open"]["cut"])
            self.assertGreater(count("cut.png", is_white), screen + 500, "the slice in the organ")

    def test_the_or_screen_tells_sides_case_and_window_of_the_slice(self):
        write_case(self.cases / "liver")
        file = self.folder / "or.png"
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, \
                Process("join", h.greeting["link"], "--or-screen", "--offscreen", file, "--size", "1280x720",
                        "--seconds", "60", "--every", "0.2") as screen:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            for plane, letters in (("axial", "RLAP"), ("coronal", "RLHF"), ("sagittal", "APHF")):
                with self.subTest(plane):
                    anna.say(f"case slice {plane} 0")
                    anna.say("case window 60 350")
                    shown = screen.wait_for(
                        lambda f: f.get("or_screen", {}).get("slice") == f"{plane} 0.0 mm"
                        and f["or_screen"]["window"] == "L 60  W 350")["or_screen"]
                    self.assertEqual("".join(shown["slice_letters"]), letters)
                    self.assertEqual(shown["case"], "Made liver")
                    self.assertEqual(shown["notice"], "Not for diagnosis")
            screen.say("quit")
            self.assertEqual(screen.end(), 0, screen.errors)
        width, height, channels, rows = read_png(file)
        # The letters' colour, in the column beside the camera's picture.
        yellow = sum(tuple(row[x:x + 3]) == (255, 220, 90) for row in rows[height // 4:] for x in range(3 * width * 3 // 4, 3 * width, 3))
        self.assertGreater(yellow, 60)

    def test_the_places_where_two_people_point_on_the_slice_are_shown_on_the_organ_too(self):
        write_case(self.cases / "liver")
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, member(h.greeting["link"], "Ben") as ben:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            anna.say("case slice coronal 0")
            ben.wait_for(lambda f: has_all(f) and f["cases"]["open"]["screen"]["orientation"] == 1)
            figures = anna.newest_json()
            x, y, z = next(o for o in figures["room"]["objects"] if o["kind"] == "screen")["position"]
            numbers = {p["name"]: p["id"] for p in figures["room"]["people"]}
            # Corners of the slice, beside the ball, from so near that the ray is no longer than the hand.
            for person, side in ((anna, 0.2), (ben, -0.2)):
                person.say(f"point {x + side} {y + 0.2} {z + 0.03} {x + side} {y + 0.2} {z}")
            # Nobody is sent the own pose.
            for person, other in ((anna, "Ben"), (ben, "Anna")):
                person.wait_for(lambda f: [p["name"] for p in f["room"]["people"] if p["points"]] == [other])

            def dots():
                """Pixels in the colours of persons 1 (blue) and 2 (green) beside the organ."""
                with Process("join", h.greeting["link"], "--offscreen", self.folder / "dots.png", "--size", "640x480", "--quality", "low",
                             "--seconds", "0.5", "--color-codec", "raw", "--renderer", "mesh", "--json") as viewer:
                    self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                _, _, channels, rows = read_png(self.folder / "dots.png")
                pixels = [rows[y][channels * x:channels * x + 3] for y in range(180, 220) for x in range(260, 385)]
                return {1: sum(b > g + 50 > r + 100 for r, g, b in pixels), 2: sum(g > r + 60 and g > b + 30 for r, g, b in pixels)}

            both = dots()
            self.assertTrue(min(both.values()) > 5, both)
            anna.say("point")
            ben.wait_for(lambda f: not any(p["points"] for p in f["room"]["people"]))
            one = dots()
            self.assertEqual(one[numbers["Anna"]], 0)
            self.assertEqual(one[numbers["Ben"]], both[numbers["Ben"]])

    def test_pictures_are_imported_stepped_through_and_seen_by_all(self):
        source = self.folder / "source"
        source.mkdir()
        for name, color in (("a red", (200, 20, 20)), ("b green", (20, 190, 30))):
            write_png(source / f"{name}.png", 300, 200, 8, 3, [bytes(color) * 300] * 200)
        code, out, errors = run("case", "import", source, self.cases / "pictures", "--name", "Pictures")
        self.assertEqual(code, 0, errors)
        self.assertIn("picture: a red\npicture: b green\n", out)
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, member(h.greeting["link"], "Ben") as ben:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case open --yes Pictures")
            for person in (anna, ben):
                person.wait_for(lambda f: has_all(f) and f["cases"]["open"]["screen"]["picture"] == 1)

            def count(name, *tests):
                with Process("join", h.greeting["link"], "--offscreen", self.folder / name, "--size", "320x240", "--quality", "low",
                             "--seconds", "2", "--color-codec", "raw", "--renderer", "mesh", "--json") as viewer:
                    self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                width, height, channels, rows = read_png(self.folder / name)
                return [sum(is_it(*rows[y][channels * x:channels * x + 3]) for y in range(height) for x in range(width))
                        for is_it in tests]

            self.assertGreater(count("red.png", lambda r, g, b: r > 150 and g < 60 and b < 60)[0], 500)
            for line, problem in (("case picture 3", "has no picture '3'; it has 2, from 1."), ("case picture", "The line names no picture; it has 2"),
                                  ("case series 1", "The open case has no series of images.")):
                ben.say(line)
                ben.wait_for_error(problem)
            ben.say("case picture 2")
            anna.wait_for(lambda f: f["cases"]["open"]["screen"]["picture"] == 2)
            # Near enough to read its name and number below it.
            screen = anna.newest_json()["cases"]["open"]["screen"]["object"]
            for line in (f"grab {screen}", "move 0 1.3 0.5", "release"):
                ben.say(line)
            anna.wait_for(lambda f: self.position(f, screen) == [0, 1.3, 0.5])
            green, ink = count("green.png", lambda r, g, b: g > 140 and r < 60 and b < 70,
                               lambda r, g, b: r > 150 and g > 110 and r > b + 60)
            self.assertGreater(green, 500)
            self.assertGreater(ink, 30)
            # A case with both: slices first, pictures by a line, slices again.
            write_case(self.cases / "liver", pictures=[(200, 100, 90)])
            anna.wait_for(lambda f: "Made liver" in f["cases"]["offered"])
            anna.say("case open --yes Made liver")
            ben.wait_for(lambda f: has_all(f) and f["cases"]["open"]["screen"]["picture"] is None)
            ben.say("case series 99")
            ben.wait_for_error("The open case has no series '99'; it has one, which is number 1.")
            ben.say("case picture 1")
            anna.wait_for(lambda f: f["cases"]["open"]["screen"]["picture"] == 1)
            anna.say("case slice coronal")
            ben.wait_for(lambda f: f["cases"]["open"]["screen"]["picture"] is None and f["cases"]["open"]["screen"]["orientation"] == 1)
            # One presents; then it is everybody's again.
            anna.say("case present")
            ben.wait_for(lambda f: f["cases"]["open"]["screen"]["presenter"] == anna.newest_json()["room"]["self"])
            ben.say("case slice sagittal")
            ben.wait_for_error("Somebody else holds this")
            anna.say("case slice axial")
            anna.say("case present off")
            ben.wait_for(lambda f: f["cases"]["open"]["screen"]["presenter"] == 0 and f["cases"]["open"]["screen"]["orientation"] == 0)
            ben.say("case slice sagittal")
            anna.wait_for(lambda f: f["cases"]["open"]["screen"]["orientation"] == 2)

    def test_a_recording_replays_the_case(self):
        write_case(self.cases / "liver")
        recording = self.folder / "session.mkv"
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["cases"]["offered"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            with Process("record", h.greeting["link"], recording, "--seconds", "2") as recorder:
                anna.wait_for(lambda f: len(f["room"]["people"]) == 2)
                anna.say("case explode 80")
                self.assertEqual(recorder.end(), 0, "".join(recorder.errors))
            name = anna.newest_json()["cases"]["open"]["hash"]
        self.assertNotIn(b"Doe", recording.read_bytes())
        with host(self.folder / "other", f"recording:{recording}", options=("--cases", self.cases)) as h, \
                member(h.greeting["link"], "Ben") as ben:
            again = ben.wait_for(lambda f: has_all(f) and f["cases"]["open"]["explosion"] > 0.7)
            self.assertEqual(again["cases"]["open"]["hash"], name)
            self.assertTrue(all(o["recorded"] for o in again["room"]["objects"]))

    @staticmethod
    def position(figures, number):
        return next((o["position"] for o in figures["room"]["objects"] if o["id"] == number), None)


if __name__ == "__main__":
    unittest.main()
