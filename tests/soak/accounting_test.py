# SPDX-License-Identifier: Apache-2.0
"""The account of a soak finds what it must find."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))

from accounting import Accountant, Entry, Window, growing, linear_fit, longest_recovery, share_outside
from cameras import fault_of_stretch
from explanations import EXPLANATIONS, Happened, cost_of, kept_bytes, windows_of
from recordings import HEADER, Picture, decodable, read_pictures
from schedule import KINDS, QUIET_END_S, Fault, make_schedule

PERIOD = 1 / 30
SECONDS = 20
HOST_STARTS = [-5.0, 10.0]


def sent(begin=0, end=SECONDS):
    """The entries of a camera whose host was started anew after ten seconds."""
    for n in range(begin * 30, end * 30):
        yield Entry(n * PERIOD, n % 300, True)


def judge(entries, *windows, stream=0):
    accountant = Accountant(windows, HOST_STARTS, PERIOD, 0, SECONDS)
    accountant.judge(stream, entries)
    return accountant.account


class Account(unittest.TestCase):
    def test_nothing_missing_is_nothing_found(self):
        account = judge(list(sent()))
        self.assertEqual((account.recorded, account.late, account.findings), (600, 0, []))
        self.assertEqual(account.expected, 600)

    def test_pictures_that_were_sent_must_be_there(self):
        account = judge([e for e in sent() if not 4 <= e.captured < 4.2])
        self.assertEqual([f.pictures for f in account.findings], [6])
        self.assertAlmostEqual(account.findings[0].begin, 4, places=2)

    def test_a_fault_on_the_way_explains_them_as_long_as_it_lasts(self):
        entries = [e for e in sent() if not 4 <= e.captured < 5]
        self.assertEqual(judge(entries, Window(3.9, 5.1, "link cut")).lost, {"link cut": 30})
        account = judge(entries, Window(3.9, 4.5, "link cut"))
        self.assertEqual(len(account.findings), 1)
        self.assertEqual(account.findings[0].pictures, 30 - account.lost["link cut"])
        self.assertEqual(account.expected, 600)

    def test_a_fault_of_another_stream_explains_nothing(self):
        entries = [e for e in sent() if not 4 <= e.captured < 5]
        self.assertTrue(judge(entries, Window(3, 6, "camera", frozenset([2]))).findings)

    def test_a_camera_with_a_fault_does_not_excuse_the_recorder(self):
        camera = Window(3, 6, "camera", frozenset([0]), camera_side=True)
        self.assertTrue(judge([e for e in sent() if not 4 <= e.captured < 5], camera).findings)
        # The host did not number them: they were never there.
        silent = [Entry(e.captured, e.frame - (30 if 5 <= e.captured < 10 else 0), True)
                  for e in sent() if not 4 <= e.captured < 5]
        account = judge(silent, camera)
        self.assertEqual((account.findings, account.lost), ([], {"camera": 30}))

    def test_a_busy_machines_camera_may_pass_over_some_but_not_many(self):
        def without(begin, end):
            gone = round((end - begin) / PERIOD)
            return [Entry(e.captured, e.frame - (gone if end <= e.captured < 10 else 0), True)
                    for e in sent() if not begin <= e.captured < end]
        account = judge(without(4, 4.5))
        self.assertEqual((account.findings, account.late), ([], 15))
        self.assertTrue(judge(without(3, 8)).findings)

    def test_what_is_there_but_cannot_be_decoded_is_missing(self):
        entries = [e._replace(decodable=not 4 <= e.captured < 5) for e in sent()]
        account = judge(entries)
        self.assertEqual([f.pictures for f in account.findings], [30])

    def test_the_ends_of_the_run_count(self):
        self.assertTrue(judge(list(sent(0, SECONDS - 1))).findings)
        self.assertTrue(judge(list(sent(1))).findings)
        self.assertTrue(judge([]).findings)

    def test_a_new_host_counts_anew(self):
        entries = [e for e in sent() if not 9.5 <= e.captured < 10.5]
        self.assertEqual(judge(entries, Window(9.4, 10.6, "host killed")).lost, {"host killed": 30})
        self.assertTrue(judge(entries).findings)

    def test_a_picture_in_two_files_counts_once(self):
        self.assertEqual(judge([*sent(), *sent(3, 7)]).recorded, 600)

    def test_recovery_is_the_longest_until_a_decodable_picture(self):
        entries = {0: [Entry(1, 0, True), Entry(3, 1, False), Entry(4, 2, True)], 2: [Entry(2.5, 0, True)]}
        self.assertAlmostEqual(longest_recovery(entries, [2]), 2)

    def test_windows_that_cover_everything_are_noticed(self):
        self.assertAlmostEqual(share_outside([Window(0, 5, "x"), Window(4, 10, "y")], 0, 20), 0.5, places=1)

    def test_a_growing_process_has_a_slope(self):
        slope, last = linear_fit([(0, 10), (1, 11), (2, 12)])
        self.assertAlmostEqual(slope, 1)
        self.assertAlmostEqual(last, 12)


    def test_a_process_that_was_killed_early_grows_only_beyond_the_level_of_the_longest_lived(self):
        def row(name, seconds, growth, most):
            return {"process": name, "seconds": seconds, "growth_mib": growth, "max_mib": most}
        short, tall, longest = row("short", 96, 40, 129), row("tall", 96, 40, 190), row("longest", 3600, 6, 131)
        self.assertEqual(growing([short, tall, longest], 32), [tall])
        self.assertEqual(growing([short], 32), [short])
        self.assertEqual(growing([longest, row("leaking", 3601, 40, 150)], 32)[0]["process"], "leaking")


class Chain(unittest.TestCase):
    def test_followers_of_a_missing_picture_are_not_decodable_until_a_key_frame(self):
        def picture(frame, reference):
            return Picture(0, 1, frame, reference, 0, frame == 0)
        chain = [picture(0, 0), picture(1, 0), picture(3, 2), picture(4, 3), picture(5, 5), picture(6, 5)]
        self.assertEqual(decodable(chain), [True, True, False, False, True, True])


class Costs(unittest.TestCase):
    def test_what_the_host_keeps_for_a_recorder_is_not_lost(self):
        fault = Fault(0, "recorder stopped", "recording", 10)
        self.assertTrue(cost_of(fault, kept_bytes() / 100).nothing)
        self.assertFalse(cost_of(fault, kept_bytes() / 10).nothing)
        self.assertFalse(windows_of([Happened(fault, 5, 15)], 1, kept_bytes() / 100))

    def test_a_killed_host_takes_with_it_what_it_kept_for_the_recorder(self):
        stopped = Happened(Fault(5, "recorder stopped", "recording", 3.5), 5, 8.5)
        killed = Happened(Fault(9, "host killed", "host", 1), 9, 10)
        later = Happened(Fault(19, "host killed", "host", 1), 19, 20)
        windows = windows_of([stopped, killed, later], 1, 1)
        self.assertLess(windows[0].begin, 5)
        self.assertGreater(windows[1].begin, 18, "what the recorder has taken is not lost")

    def test_every_kind_of_fault_has_an_explanation(self):
        for kind in KINDS:
            self.assertTrue(kind.name in EXPLANATIONS or kind.name.startswith("guest: "), kind.name)


def element(identity, content):
    size = len(content)
    return bytes.fromhex(identity) + bytes([0x08, *size.to_bytes(4, "big")]) + content


def block_group(stream, frame, reference):
    header = HEADER.pack(1, 8, int(frame == reference), 0, stream, 1, frame, reference, 0, 1, 0, 7, 1000 * frame)
    additional = header.ljust(64, b"\0")
    more = element("a6", element("ee", b"\x02") + element("a5", additional))
    return element("a0", element("a1", b"\x81\0\0\0") + element("75a1", more))


class Recordings(unittest.TestCase):
    def read(self, *content):
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"".join(content))
            file.flush()
            return read_pictures(file.name)

    def test_media_headers_are_read_as_the_format_says(self):
        cluster = element("1f43b675", block_group(0, 5, 5) + block_group(1, 6, 5))
        pictures = self.read(element("1a45dfa3", b""), element("18538067", element("1549a966", b"") + cluster))
        self.assertEqual(pictures, [Picture(0, 1, 5, 5, 5000, True), Picture(1, 1, 6, 5, 6000, True)])

    def test_what_was_cut_off_costs_its_cluster_alone(self):
        clusters = [element("1f43b675", block_group(0, n, max(n - 1, 0))) for n in range(3)]
        unknown_size = bytes.fromhex("1853806701ffffffffffffff")
        self.assertEqual([p.frame for p in self.read(unknown_size, *clusters[:2], clusters[2][:-9])], [0, 1])

    def test_a_chain_does_not_go_on_in_the_next_segment(self):
        segment = element("18538067", element("1f43b675", block_group(0, 1, 0)))
        self.assertEqual([p.begins_chain for p in self.read(segment, segment)], [True, True])


class Schedule(unittest.TestCase):
    def test_the_same_seed_gives_the_same_faults(self):
        self.assertEqual(make_schedule(7, 600), make_schedule(7, 600))
        self.assertNotEqual(make_schedule(7, 600), make_schedule(8, 600))

    def test_every_kind_comes_and_the_end_is_quiet(self):
        faults = make_schedule(7, 600)
        self.assertEqual({f.kind for f in faults}, {k.name for k in KINDS})
        self.assertLess(max(f.end for f in faults), 600 - QUIET_END_S)

    def test_in_the_second_half_of_a_long_run_nobody_is_killed(self):
        deadly = {k.name for k in KINDS if k.deadly}
        self.assertEqual(len(deadly), 7)
        late = {f.kind for f in make_schedule(7, 7200) if f.at > 3600}
        self.assertEqual(late, {k.name for k in KINDS} - deadly)

    def test_faults_of_one_part_leave_it_time_to_recover(self):
        settle = {k.name: k.settle_s for k in KINDS}
        last = {}
        for fault in make_schedule(7, 3600):
            self.assertGreaterEqual(fault.at, last.get(fault.part, 0))
            last[fault.part] = fault.end + settle[fault.kind] - 0.02


class CameraFaults(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        # The same numbers as in src/capture/watched_camera_test.cpp.
        self.assertEqual(fault_of_stretch(7, 0, 15_000_000), ("time_jump", 4.693257, 7.490478))
        self.assertEqual(fault_of_stretch(7, 100_000, 15_000_000), ("repeat", 1500004.784225, 1500006.612370))


if __name__ == "__main__":
    unittest.main()
