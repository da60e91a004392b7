# SPDX-License-Identifier: Apache-2.0
"""Participants in one room: all see the same people, their poses, and the held objects."""
import json
import pathlib
import shutil
import struct
import tempfile
import unittest

from raw_peer import STATES, RawPeer
from theatron_process import Process, host, make_recording, read_png, run, wait_until, write_png

ROOM = 3         # wire::Feature
OBJECT_POSE = 2  # wire::StateTopic


def member(link, name, *options, **settings):
    return Process("join", link, "--name", name, "--every", "0.1", *options, **settings)


def people(figures):
    return sorted(person["name"] for person in figures["room"]["people"])


def brick(figures, number=None):
    found = [o for o in figures["room"]["objects"] if number in (None, o["id"])]
    return found[0] if found else None


FACE, WALL = (30, 220, 60), (220, 40, 220)


def make_face(folder, width=160, height=120):
    """A head and a trunk 0.8 m before the camera; a wall at 3 m."""
    (folder / "depth").mkdir(parents=True)
    (folder / "color").mkdir()
    for n in range(5):
        depth, pixels = [], []
        for y in range(height):
            person = [(x - 80) ** 2 + ((y - 60) * 0.8) ** 2 < 16 ** 2 or (y > 78 and abs(x - 80) < 36) for x in range(width)]
            depth.append(struct.pack(f">{width}H", *[800 + (x + n) % 2 if p else 3000 for x, p in enumerate(person)]))
            pixels.append(b"".join(bytes(FACE if p else WALL) for p in person))
        write_png(folder / "depth" / f"{n:05}.png", width, height, 16, 1, depth)
        write_png(folder / "color" / f"{n:05}.png", width, height, 8, 3, pixels)
    lens = {"width": width, "height": height, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
    (folder / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens}))
    return folder


def count(picture, color, side):
    """Pixels of this colour in the left (0) or the right half (1)."""
    width, height, channels, rows = picture
    columns = range(width // 2) if side == 0 else range(width // 2, width)
    return sum(all(abs(rows[y][channels * x + c] - color[c]) < 30 for c in range(3)) for y in range(height) for x in columns)


def colorful(picture):
    """Pixels in the middle of the picture with an avatar's strong colour."""
    width, height, channels, rows = picture
    return sum(max(row[channels * x:channels * x + 3]) - min(row[channels * x:channels * x + 3]) > 90
               for row in rows[height // 3:2 * height // 3] for x in range(2 * width // 5, 3 * width // 5))


class Room(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_room_"))
        self.addCleanup(shutil.rmtree, self.folder)
        recording = make_recording(self.folder / "box")
        # The camera stands 1.6 m above the floor and looks level along -z.
        lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
        pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.6, 0]}
        (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
        camera = f"folder:{recording},loop=1,preload=1"
        self.start = lambda: host(self.folder / "state", camera)

    def test_people_meet_without_a_camera(self):
        picture = self.folder / "view.png"
        look = lambda link: run("join", link, "--offscreen", picture, "--size", "160x120", "--seconds", "1")
        with host(self.folder / "state") as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: people(f) == ["Anna"])
            self.assertEqual(look(h.greeting["link"])[0], 0)
            alone = read_png(picture)
            self.assertGreater(min(max(row[:3]) for row in alone[3]), 5)  # walls and floor
            without = colorful(alone)
            anna.say("stand 0 1.4 0 0 1.4 1")  # where everybody who comes looks
            # The one who looks comes when her place has arrived at the host, or once more.
            wait_until(lambda: look(h.greeting["link"])[0] == 0 and colorful(read_png(picture)) > without + 100)

    def test_a_picture_is_of_the_place_where_its_person_stands(self):
        with host(self.folder / "state") as h, member(h.greeting["link"], "Anna") as anna:
            anna.say("stand 2 1.4 2 2 1.4 1")
            anna.wait_for(lambda f: people(f) == ["Anna"])

            def picture(line):
                file = self.folder / "view.png"
                with Process("join", h.greeting["link"], "--offscreen", file, "--size", "160x120", "--seconds", "1") as eye:
                    eye.say(line)
                    self.assertEqual(eye.end(), 0, "".join(eye.errors))
                return colorful(read_png(file))
            self.assertGreater(picture("stand 2 1.4 0.8 2 1.4 2"), picture("stand 2 1.4 0.8 2 1.4 -2") + 100)

    def test_people_meet_hold_hand_over_and_let_go(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, member(h.greeting["link"], "Zoë") as zoe:
            for person in (anna, zoe):
                person.wait_for(lambda f: people(f) == ["Anna", "Zoë"])
            anna.say("brick 0.5 1 0.25")
            number = brick(zoe.wait_for(brick))["id"]
            anna.say(f"grab {number}")
            anna.say("move 0.5 1.5 0.25 30")
            held = zoe.wait_for(lambda f: brick(f)["held_by"] and brick(f)["position"][1] == 1.5)
            self.assertEqual(brick(held)["held_by"], self.number(anna))
            zoe.say(f"grab {number}")
            anna.say("give Zoë")
            anna.wait_for(lambda f: brick(f)["held_by"] == self.number(zoe))
            # The hash covers all objects: both have the same room.
            self.assertEqual(*(p.wait_for(lambda f: brick(f)["held_by"] == self.number(zoe))["room"]["hash"]
                               for p in (anna, zoe)))
            # Zoë holds what she was given, without a grab of her own.
            zoe.say("move 0.5 1.25 0.25")
            anna.wait_for(lambda f: brick(f)["position"][1] == 1.25)
            zoe.process.kill()
            left = anna.wait_for(lambda f: people(f) == ["Anna"])
            self.assertEqual(brick(left)["held_by"], 0)
            self.assertEqual(brick(left)["position"], [0.5, 1.25, 0.25])

    @staticmethod
    def number(person):
        return person.newest_json()["room"]["self"]

    def test_the_room_is_still_there_after_the_host_is_started_again(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: people(f))
            anna.say("brick 1 2 3")
            anna.wait_for(brick)
            h.process.terminate()
            self.assertEqual(h.end(), 0)
        with self.start() as h, member(h.greeting["link"], "Ben") as ben:
            again = ben.wait_for(people)
            self.assertEqual(brick(again)["position"], [1, 2, 3])
            self.assertEqual(people(again), ["Ben"])

    def test_a_person_is_drawn_where_it_stands(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(people)

            def picture(name):
                with Process("join", h.greeting["link"], "--offscreen", self.folder / name, "--size", "320x240",
                             "--seconds", "1.5", "--color-codec", "raw", "--json") as viewer:
                    self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                return read_png(self.folder / name)

            # The name and the initials are lighter than what is there without a person.
            alone = picture("alone.png")

            def of_plate(picture):
                _, _, channels, rows = picture
                return sum(row[x + 2] > row[x] + 40 and abs(row[x + 2] - bare[x + 2]) > 20
                           for row, bare in zip(rows, alone[3]) for x in range(0, len(row), channels))

            def different(one, other):
                return sum(abs(a - b) > 24 for row, bare in zip(one[3], other[3]) for a, b in zip(row, bare))

            def light_pixels(picture):
                width, height, channels, rows = picture
                lightness = lambda rows, x, y: min(rows[y][channels * x:channels * x + 3])
                return sum(lightness(rows, x, y) > max(110, lightness(alone[3], x, y) + 20)
                           for y in range(height) for x in range(width))
            anna.say("stand 0 1.6 -0.5 0 1.6 0")
            with member(h.greeting["link"], "Ben") as ben:
                ben.wait_for(lambda f: people(f) == ["Anna", "Ben"])
            facing = picture("facing.png")
            anna.say("stand 0 1.6 -0.5 0 1.6 -2")
            with member(h.greeting["link"], "Ben") as ben:
                ben.wait_for(lambda f: people(f) == ["Anna", "Ben"])
            facing_away = picture("away.png")
            for shown in (facing, facing_away):
                self.assertGreater(light_pixels(shown), 50, "the name")
                self.assertGreater(of_plate(shown), 500, "the plate in the person's colour")
            self.assertGreater(different(facing, facing_away), 100, "the cone below the plate turns")

    def test_an_own_camera_is_its_persons_cloud(self):
        face = make_face(self.folder / "face")
        with self.start() as h, member(h.greeting["link"], "Ben") as ben:
            with member(h.greeting["publish_link"], "Anna", "--publish", f"folder:{face},loop=1,preload=1") as anna:
                ben.wait_for(lambda f: people(f) == ["Anna", "Ben"] and len(f["cameras"]) == 2)

                def picture(name, place):
                    anna.say(f"stand {place}")
                    with Process("join", h.greeting["link"], "--offscreen", self.folder / name, "--size", "320x240",
                                 "--seconds", "1.5", "--color-codec", "raw", "--renderer", "mesh", "--json") as viewer:
                        self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                    return read_png(self.folder / name)

                for name, place, side in (("left.png", "-0.25 1.6 -0.75 -0.25 1.6 0", 0), ("right.png", "0.25 1.6 -0.75 0.25 1.6 0", 1)):
                    drawn = picture(name, place)
                    self.assertGreater(count(drawn, FACE, side), 500, name)
                    self.assertEqual(count(drawn, FACE, 1 - side), 0, name)
                    self.assertEqual(count(drawn, WALL, 0) + count(drawn, WALL, 1), 0, "the wall behind Anna is cut off")

    def test_an_observer_sees_a_scripted_person_and_one_with_a_camera_meet_hand_over_and_teleport(self):
        face = make_face(self.folder / "face")
        with self.start() as h, member(h.greeting["links"]["observer"], "Olga") as olga, \
                member(h.greeting["link"], "Sam") as sam, \
                member(h.greeting["publish_link"], "Cara", "--publish", f"folder:{face},loop=1,preload=1") as cara:
            everybody = (olga, sam, cara)
            for person in everybody:
                person.wait_for(lambda f: people(f) == ["Cara", "Olga", "Sam"])
            olga.wait_for(lambda f: len(f["cameras"]) == 2)
            sam.say("stand 0.5 1.6 -0.2 0 1 -1")
            sam.say("brick 0.5 1 -0.75")
            sam.say(f"grab {brick(olga.wait_for(brick))['id']}")
            for person in everybody:
                person.wait_for(lambda f: brick(f) and brick(f)["held_by"] == self.number(sam))
            sam.say("give Cara")
            cara.wait_for(lambda f: brick(f)["held_by"] == self.number(cara))
            cara.say("move 0 1.25 -0.75 30")

            def seen_at(x):
                """Cara stands here, with the brick; the observer's program draws what it sees."""
                cara.say(f"stand {x} 1.6 -0.75 {x} 1.6 0")
                picture = self.folder / "picture.png"
                with Process("join", h.greeting["links"]["observer"], "--name", "Painter", "--offscreen", picture,
                             "--size", "320x240", "--seconds", "1.5", "--color-codec", "raw", "--renderer", "mesh",
                             "--json") as painter:
                    self.assertEqual(painter.end(), 0, "".join(painter.errors))
                return [count(read_png(picture), FACE, side) for side in (0, 1)]

            left, right = seen_at(-0.25)
            self.assertTrue(left > 500 and right == 0, (left, right))
            left, right = seen_at(0.25)
            self.assertTrue(left == 0 and right > 500, (left, right))
            cara.say("release")
            rooms = [p.wait_for(lambda f: brick(f)["held_by"] == 0 and people(f) == ["Cara", "Olga", "Sam"])["room"]
                     for p in everybody]
            self.assertEqual([r["objects"][0]["position"] for r in rooms], [[0, 1.25, -0.75]] * 3)
            self.assertEqual(len({r["hash"] for r in rooms}), 1)
            olga.say("brick 0 1 0")
            wait_until(lambda: any("role does not allow" in line for line in olga.errors))

    def test_what_cannot_be_done_is_said(self):
        with self.start() as h, member(h.greeting["link"], "Anna Ö. Two") as anna, \
                member(h.greeting["link"], "Ben") as ben:
            for person in (anna, ben):
                person.wait_for(lambda f: len(people(f)) == 2)
            for line, problem in (("grab 9999", "no object of this number"), ("release", "Nothing is held"),
                                  ("brick 1 2", "numbers of metres"), ("brick nan 1 1", "numbers of metres"),
                                  ("stand 1 1 1 1 1 1", "the same")):
                ben.say(line)
                ben.wait_for_error(problem)
            ben.say("stand 0 1.6 0 0 0 0")  # straight down
            ben.say("brick 0 1 0")
            ben.say(f"grab {brick(ben.wait_for(brick))['id']}")
            ben.say("give nobody")
            ben.wait_for_error("Nobody of this name")
            ben.say("give Anna Ö. Two")
            anna.wait_for(lambda f: brick(f) and brick(f)["held_by"] == f["room"]["self"])
            for i in range(400):
                ben.say(f"brick 1 1 {i / 100}")
            ben.wait_for_error("changes of the room were refused")

    def test_what_a_hostile_member_sends_harms_nobody(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(people)
            anna.say("brick 0 1 0")
            number = brick(anna.wait_for(brick))["id"]
            anna.say(f"grab {number}")
            anna.say("move 0 1.25 0")
            anna.wait_for(lambda f: brick(f)["position"][1] == 1.25)
            with RawPeer(h.greeting["link"]) as stranger:
                stranger.join(depth_codec="raw", color_codec="raw", features=[ROOM])
                stranger.receive_control("RoomSnapshot")
                place = struct.pack("<8d", 1, 0, 0, 0, 9, 9, 9, 1)
                for kind, request in (("junk", b"\xff" * 30), ("grab", struct.pack("<BI", 3, number)),
                                      ("release", struct.pack("<BII", 4, number, 1) + place),
                                      ("remove", struct.pack("<BI", 2, number)),
                                      ("nan", struct.pack("<BB", 1, 2) + struct.pack("<8d", *[float("nan")] * 8) + b"\0\0")):
                    stranger.send_control("RoomRequest", number=1, request=list(request))
                    self.assertNotEqual(stranger.receive_control("RoomDecision")[1].get("refusal", 0), 0, kind)
                # A pose of the object that Anna holds.
                body = struct.pack("<IIq", 1, 2, self.now_us(stranger)) + place
                stranger.send(bytes([STATES, OBJECT_POSE]) + struct.pack("<IH", number, len(body)) + body)
                stranger.send_control("RoomRequest", number=2, request=list(struct.pack("<BI", 3, number)))
                stranger.receive_control("RoomDecision")
            self.assertEqual(brick(anna.newest_json())["position"], [0, 1.25, 0])

    @staticmethod
    def now_us(peer):
        peer.send_control("Ping", sent_us=1)
        return peer.receive_control("Pong")[1]["sent_us"]


if __name__ == "__main__":
    unittest.main()
