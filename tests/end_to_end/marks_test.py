# SPDX-License-Identifier: Apache-2.0
"""Marks in the shared room: all see the same, they survive the host and replay, and nobody marks in another's name."""
import json
import os
import pathlib
import shutil
import struct
import tempfile
import unittest

from case_test import case_host, has_all, parts_of, write_case
from raw_peer import CONTROL, RawPeer, control_message
from room_test import ROOM, member, people
from theatron_process import Process, host, read_png, run

CREATE, CLEAR, MARK = 1, 7, 5  # docs/formats/room.md
TOO_MANY, MALFORMED, TOO_OFTEN, OF_ANOTHER = 6, 7, 8, 11


def marks(figures, recorded=False):
    return [dict(o["mark"], id=o["id"]) for o in figures["room"]["objects"] if o["kind"] == "mark" and o["recorded"] == recorded]


def stroke_bytes(color, initials, points):
    """The bytes of docs/formats/mark.md."""
    data = struct.pack("<BBIBHfB", 1, 1, 0, color, 0, 0, len(initials)) + initials.encode() + struct.pack("<B", points % 256)
    return data + struct.pack("<3f3h", 0, 1, 0, 0, 32767, 0) * points


def create(properties):
    return list(struct.pack("<BB8dH", CREATE, MARK, 1, 0, 0, 0, 0, 0, 0, 1, len(properties)) + properties)


class Marks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_marks_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.cases = self.folder / "cases"
        write_case(self.cases / "liver")
        self.start = case_host(self.folder, self.cases)

    def open_case(self, anna, *others):
        anna.wait_for(lambda f: f["cases"]["offered"])
        anna.say("case open --yes Made liver")
        for person in (anna, *others):
            person.wait_for(has_all)
        return anna.newest_json()["cases"]["open"]

    def test_two_see_the_same_marks_which_survive_a_restart_of_the_host(self):
        def own(name):
            """A person's own id, which the person's program keeps."""
            return {"env": {**os.environ, "XDG_STATE_HOME": str(self.folder / name)}}

        with self.start() as h, member(h.greeting["link"], "Anna Lind", **own("anna")) as anna, \
                member(h.greeting["links"]["operator"], "Ben", **own("ben")) as ben:
            case = self.open_case(anna, ben)
            screen, part = case["screen"]["object"], parts_of(anna.newest_json())["liver"]["object"]
            anna.say("mark stroke 0 1 0 0.1 1 0 0.1 1.1 0")
            anna.say(f"mark pin on {part} 0.08 0 0")
            ben.say(f"mark distance on {screen} 0 0 0 0.03 0 0.04")
            ben.say("mark arrow 0.5 1 0 0.2 1 0")
            figures = [person.wait_for(lambda f: len(marks(f)) == 4) for person in (anna, ben)]
            self.assertEqual(marks(figures[0]), marks(figures[1]))
            self.assertEqual(figures[0]["room"]["hash"], figures[1]["room"]["hash"])
            by_kind = {mark["kind"]: mark for mark in marks(figures[0])}
            self.assertEqual([by_kind[kind]["initials"] for kind in ("stroke", "pin", "distance", "arrow")], ["AL", "AL", "B", "B"])
            self.assertAlmostEqual(by_kind["distance"]["length_m"], 0.05, 6)
            self.assertEqual((by_kind["pin"]["number"], by_kind["pin"]["object"], by_kind["pin"]["surface"]), (1, part, "organ"))
            # Undo takes one's own newest, clear one's own.
            ben.say("mark undo")
            anna.say("mark pin 0 1 0")
            anna.wait_for(lambda f: sorted(mark["kind"] for mark in marks(f)) == ["distance", "pin", "pin", "stroke"])
            anna.say("mark clear all")
            anna.wait_for_error("Your role does not allow this")
            anna.say("mark undo")
            # Ben had three marks before, too, between his own undo and the pin: he waits for what the host made of Anna's.
            undone = anna.wait_for(lambda f: len(marks(f)) == 3)["room"]["hash"]
            kept = marks(ben.wait_for(lambda f: f["room"]["hash"] == undone))
            h.process.terminate()
            self.assertEqual(h.end(), 0)
        with self.start() as h, member(h.greeting["link"], "Cleo", **own("cleo")) as cleo, \
                member(h.greeting["link"], "Anna Lind", **own("anna")) as anna, \
                member(h.greeting["links"]["operator"], "Ben", **own("ben")) as ben:
            for person in (cleo, anna, ben):
                self.assertEqual(marks(person.wait_for(lambda f: len(marks(f)) == 3 and len(people(f)) == 3)), kept)
            # Nobody takes over the marks of others, their authors remove their own.
            cleo.say("mark undo")
            cleo.wait_for_error("There is no such mark")
            anna.say("mark pin 0 1 0")
            anna.wait_for(lambda f: len(marks(f)) == 4)
            anna.say("mark undo")
            anna.say("mark undo")
            anna.wait_for(lambda f: sorted(mark["kind"] for mark in marks(f)) == ["distance", "stroke"])
            # With the case go the marks on it; an operator removes those of others.
            anna.say("case close")
            ben.wait_for(lambda f: [mark["kind"] for mark in marks(f)] == ["stroke"])
            ben.say("mark clear all")
            anna.wait_for(lambda f: not marks(f))

    def test_a_wrong_line_is_said(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(people)
            for line, problem in (("mark pin 1 2", "A pin needs one place"), ("mark arrow 1 2 3", "an arrow and a distance two"),
                                  ("mark stroke 1 2 3 4 5 nan", "a stroke two or more"), ("mark pin on 4000 1 2 3", "no organ or screen"),
                                  ("mark undo", "There is no such mark"), ("mark what", "The lines on marks are")):
                anna.say(line)
                anna.wait_for_error(problem)

    def test_observers_forgers_floods_and_huge_strokes_are_refused(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna, member(h.greeting["links"]["observer"], "Cleo") as cleo:
            for person in (anna, cleo):
                person.wait_for(lambda f: len(people(f)) == 2)
            cleo.say("mark pin 0 1 0")
            cleo.wait_for_error("Your role does not allow this")
            anna.say("mark pin 0 1 0")
            anna.wait_for(lambda f: len(marks(f)) == 1)
            number = marks(anna.newest_json())[0]["id"]
            with RawPeer(h.greeting["link"]) as stranger:
                own = stranger.join(name="Eve", depth_codec="raw", color_codec="raw", features=[ROOM])
                stranger.receive_control("RoomSnapshot")
                color = anna.wait_for(lambda f: "Eve" in people(f))["room"]["people"]
                color = next(p["id"] for p in color if p["name"] == "Eve") % 7
                decided = 0

                def ask(request):
                    nonlocal decided
                    decided += 1
                    stranger.send_control("RoomRequest", number=decided, request=request)

                def refusal(request):
                    ask(request)
                    while True:
                        fields = stranger.receive_control("RoomDecision")[1]
                        if fields["number"] == decided:
                            return fields.get("refusal", 0)

                self.assertEqual(refusal(create(stroke_bytes(color, "A", 2))), OF_ANOTHER, "Anna's initials")
                self.assertEqual(refusal(create(stroke_bytes((color + 1) % 7, "E", 2))), OF_ANOTHER, "another colour")
                self.assertEqual(refusal(list(struct.pack("<BI", 2, number))), OF_ANOTHER, "Anna's mark removed")
                self.assertEqual(refusal(create(stroke_bytes(color, "E", 201))), MALFORMED, "too many points")
                self.assertEqual(refusal(list(struct.pack("<BB", CLEAR, 1))), 4, "all cleared by an expert")
                self.assertEqual(refusal(create(stroke_bytes(color, "E", 200))), 0)
                seen = set()
                for _ in range(60):
                    seen.add(refusal(create(stroke_bytes(color, "E", 200))))
                self.assertEqual(seen - {0}, {TOO_MANY}, "bytes of one author")
                # All at once: a slow sender is none who asks too often. One message is made and numbered anew, since somebody
                # who makes hundreds, and reads nothing meanwhile, is taken for gone.
                mould = 0x7a6b5c4d
                message = control_message(stranger.says, "RoomRequest", number=mould, request=create(stroke_bytes(color, "E", 2)))
                self.assertEqual(message.count(struct.pack("<I", mould)), 1)
                flood = []
                for decided in range(mould, mould + 900):
                    numbered = message.replace(struct.pack("<I", mould), struct.pack("<I", decided))
                    flood.append(stranger.frame(bytes([CONTROL]) + numbered))
                stranger.send_bytes(b"".join(flood))
                while TOO_OFTEN not in seen:
                    seen.add(stranger.receive_control("RoomDecision")[1].get("refusal", 0))
                # The others are not decoded: that takes longer than a host waits for a sign of life.
                while (envelope := stranger.receive())[0] != CONTROL or struct.pack("<I", decided) not in envelope:
                    pass
                self.assertIn(TOO_OFTEN, seen)
            # 49 152 bytes of one author, 4096 of a mark: nobody else is kept from marking.
            self.assertLess(len(marks(anna.newest_json())), 140)
            anna.say("mark pin 0 1.5 0")
            cleo.wait_for(lambda f: sum(mark["initials"] == "A" for mark in marks(f)) == 2)

    def marked(self, link, name, left=0):
        """Count and middle of the pixels of Anna's colour, right of a column; nothing else there has it."""
        with Process("join", link, "--offscreen", self.folder / name, "--size", "640x480", "--quality", "low",
                     "--seconds", "2", "--color-codec", "raw", "--renderer", "mesh", "--json") as viewer:
            self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
        width, height, channels, rows = read_png(self.folder / name)
        places = [(x, y) for y in range(height) for x in range(left, width) for r, g, b in [rows[y][channels * x:channels * x + 3]]
                  if b > r + 60 and g > r + 30]
        return len(places), *(sum(p[axis] for p in places) / max(len(places), 1) for axis in (0, 1))

    def assert_at_same_place(self, found, before):
        self.assertGreater(found[0], before[0] / 2)
        for axis in (1, 2):
            self.assertAlmostEqual(found[axis], before[axis], delta=3, msg=f"{found} instead of {before}")

    def test_a_replay_draws_marks_on_an_organ_where_they_were(self):
        recording = self.folder / "session.mkv"
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            case = self.open_case(anna)
            part = parts_of(anna.newest_json())["liver"]["object"]
            anna.say("case hide portal vein")  # blue, too
            anna.say("case scale 3")
            # Neither the organ nor the part are in their usual places.
            anna.say(f"grab {case['object']}")
            anna.say("move 0.12 1.35 -0.1 35")
            anna.say("release")
            anna.say(f"grab {part}")
            anna.say("move 0.2 1.4 0.05 20")
            anna.say("release")
            line = " ".join(f"{0.004 * i - 0.06:.3f} 0 {(0.08 ** 2 - (0.004 * i - 0.06) ** 2) ** 0.5:.4f}" for i in range(31))
            anna.say(f"mark stroke on {part} {line}")
            anna.wait_for(lambda f: len(marks(f)) == 1)
            # The recorded picture of the box, on the left, has blue pixels at its edges.
            before = self.marked(h.greeting["link"], "live.png", left=330)
            self.assertGreater(before[0], 40)
            with Process("record", h.greeting["link"], recording, "--seconds", "2") as recorder:
                self.assertEqual(recorder.end(), 0, "".join(recorder.errors))
        # Also where the host of the replay does not have the case, so that no organ is seen.
        for name, options in (("replay", ("--cases", self.cases)), ("alone", ())):
            with host(self.folder / name, f"recording:{recording},loop=1", options=options) as h, \
                    member(h.greeting["link"], "Ben") as ben:
                as_expected = has_all if options else lambda f: "--cases" in (f["cases"]["open"] or {}).get("problem", "")
                ben.wait_for(lambda f: len(marks(f, recorded=True)) == 1 and as_expected(f))
                self.assert_at_same_place(self.marked(h.greeting["link"], f"{name}.png", left=330), before)

    def test_a_recording_replays_and_exports_the_marks(self):
        recording = self.folder / "session.mkv"
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            case = self.open_case(anna)
            anna.say("mark pin 0 1 0")
            with Process("record", h.greeting["link"], recording, "--seconds", "2") as recorder:
                anna.wait_for(lambda f: len(f["room"]["people"]) == 2)
                anna.say(f"mark stroke on {case['object']} 0 0 0.08 0.01 0 0.08 0.02 0.01 0.08")
                before = marks(anna.wait_for(lambda f: len(marks(f)) == 2))
                self.assertEqual(recorder.end(), 0, "".join(recorder.errors))
        with host(self.folder / "other", f"recording:{recording}", options=("--cases", self.cases)) as h, \
                member(h.greeting["link"], "Ben") as ben:
            again = marks(ben.wait_for(lambda f: len(marks(f, recorded=True)) == 2), recorded=True)
            without = lambda found: [{k: v for k, v in mark.items() if k != "id"} for mark in found]
            self.assertEqual(without(again), without(before))
        exported = self.folder / "room.json"
        code, _, errors = run("export", recording, "--room", exported)
        self.assertEqual(code, 0, errors)
        last = json.loads(exported.read_text().splitlines()[-1])
        self.assertEqual([o["mark"] for o in last["objects"] if o["kind"] == "mark"], without(before))

    def test_marks_are_drawn_on_what_they_stick_to(self):
        with self.start() as h, member(h.greeting["link"], "Anna") as anna:
            case = self.open_case(anna)

            def marked(name):
                return self.marked(h.greeting["link"], name)[0]

            self.assertEqual(anna.newest_json()["room"]["self"] % 7, 1, "sky blue")
            part = parts_of(anna.newest_json())["liver"]["object"]
            anna.say("case hide portal vein")  # blue, too
            anna.say("case scale 3")
            anna.wait_for(lambda f: next(o for o in f["room"]["objects"] if o["id"] == case["object"])["scale"] == 3)
            without = marked("without.png")
            line = " ".join(f"{0.004 * i - 0.06:.3f} 0 {(0.08 ** 2 - (0.004 * i - 0.06) ** 2) ** 0.5:.4f}" for i in range(31))
            anna.say(f"mark stroke on {part} {line}")
            anna.wait_for(lambda f: len(marks(f)) == 1)
            drawn = marked("on_organ.png")
            self.assertGreater(drawn, without + 40)
            anna.say("case hide liver")
            anna.wait_for(lambda f: not parts_of(f)["liver"]["shown"])
            self.assertLess(marked("hidden.png"), without + (drawn - without) // 4)


if __name__ == "__main__":
    unittest.main()
