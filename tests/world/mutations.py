#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts faults into host, participant, viewer and the path of a recording, and tells which of them the tests find.

All faults are compiled at once, each behind a switch that THEATRON_FAULT=NUMBER turns on, so a run costs one build and not
thirty. The sources are as before when it ends, whatever happens.

    tests/world/mutations.py                 # the World and the unit tests of the modules
    tests/world/mutations.py --world         # the World alone
    tests/world/mutations.py --only 3 17
    tests/world/mutations.py --list
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build/release"
WORLD = BUILD / "tests/world/world_test"
SWITCH = """#ifndef THEATRON_FAULT_SWITCH
#define THEATRON_FAULT_SWITCH
#include <cstdlib>
inline bool theatron_fault(int number) {
    static const char* const on = std::getenv("THEATRON_FAULT");
    return on && std::atoi(on) == number;
}
#endif
"""

# (what is wrong, file below src, text that stands there once, the same with FAULT as the switch)
FAULTS = [
    # Host
    ("the session is not told that somebody has left", "host/host_impl.cpp",
     "        session->on_closed(", "        if (!FAULT) session->on_closed("),
    ("the pose of somebody who has left stays", "host/host_impl.cpp",
     "        poses.remove(ParticipantId(std::uint32_t(peer)), steady_now());",
     "        if (!FAULT) poses.remove(ParticipantId(std::uint32_t(peer)), steady_now());"),
    ("a newcomer gets no poses of those who stand still", "host/host_impl.cpp",
     "    server->post([this, id = a.participant] { send_poses_to(id, poses.all()); });",
     "    if (!FAULT) server->post([this, id = a.participant] { send_poses_to(id, poses.all()); });"),
    ("an observer points", "host/host_impl.cpp",
     "return session->allow(sender, right); };", "return FAULT || session->allow(sender, right); };"),
    ("poses of held objects are not sent on", "host/host_impl.cpp",
     "    for (const ParticipantId receiver : forward.receivers)\n        server->send_states(",
     "    for (const ParticipantId receiver : forward.receivers)\n        if (!FAULT) server->send_states("),
    ("everybody gets their own pose", "host/host_impl.cpp",
     "        if (entry.participant != receiver)", "        if (FAULT || entry.participant != receiver)"),
    ("poses are not sent on", "host/host_impl.cpp",
     "    if (!states.empty())\n", "    if (!states.empty() && !FAULT)\n"),
    ("the end of the session is not said", "host/host_impl.cpp",
     "        session->end(farewell);", "        if (!FAULT) session->end(farewell);"),
    ("a refused connection is not closed", "host/host_impl.cpp",
     "    server->close(peer, a.why);", "    if (!FAULT) server->close(peer, a.why);"),
    ("a publisher's pictures are not allowed", "host/host_impl.cpp",
     "    server->take_media(peer_of(a.participant), a.max_message);",
     "    if (!FAULT) server->take_media(peer_of(a.participant), a.max_message);"),
    ("a recorder's pictures give way to newer ones", "host/host_impl.cpp",
     "    server->keep_everything(peer_of(a.participant));",
     "    if (!FAULT) server->keep_everything(peer_of(a.participant));"),
    ("the session has no time", "host/host_impl.cpp",
     "        session->on_tick(steady_now());", "        if (!FAULT) session->on_tick(steady_now());"),
    ("the room is not loaded", "host/host.cpp",
     "    config.room = std::move(saved.room);", "    if (!FAULT) config.room = std::move(saved.room);"),
    ("the past is not sent", "host/host_alarm.cpp",
     "    send_past();\n    set_alarm();", "    if (!FAULT) send_past();\n    set_alarm();"),
    ("a revoked link stays valid", "host/host_people.cpp",
     "    links->revoke(a.link, steady_now());", "    if (!FAULT) links->revoke(a.link, steady_now());"),
    ("voices are not sent on", "host/host_people.cpp",
     "        server->send_voice(", "        if (!FAULT) server->send_voice("),
    ("people of an ended session stay connected", "host/host_impl.cpp",
     '    server->close(peer, "the session has ended");', '    if (!FAULT) server->close(peer, "the session has ended");'),
    ("the figures count everybody", "host/host_participants.cpp",
     "        if (participant.joined)\n", "        if (FAULT || participant.joined)\n"),
    # Participant
    ("poses of the connection before stay", "client/participant.cpp",
     "        shared_->poses.clear();", "        if (!FAULT) shared_->poses.clear();"),
    ("who has left stays in sight", "client/participant.cpp",
     "            shared_->poses.erase(person);", "            (void)(FAULT || shared_->poses.erase(person));"),
    ("cameras keep their numbers of the connection before", "client/participant.cpp",
     "        forget_numbers(offer);\n    announce();", "        if (!FAULT) forget_numbers(offer);\n    announce();"),
    ("poses of held objects are not taken", "client/participant.cpp",
     "            shared_->room.on_pose(", "            if (!FAULT) shared_->room.on_pose("),
    ("a lost connection is not made again", "client/participant.cpp",
     "judged.next == Attempts::Next::again;", "!FAULT && judged.next == Attempts::Next::again;"),
    ("a lost connection counts as an end", "client/participant.cpp",
     "        attempts_.came_in();", "        if (!FAULT) attempts_.came_in();"),
    ("moves are not sent to the host", "client/participant_room.cpp",
     "    for (const auto& [object, body] : poses) {", "    for (const auto& [object, body] : poses) {\n        if (FAULT) continue;"),
    ("former operators still see who waits", "client/participant_people.cpp",
     "        if (now.role != wire::Role::operator_)", "        if (!FAULT && now.role != wire::Role::operator_)"),
    ("cameras are not offered again", "client/participant.cpp",
     "                offer_all();", "                if (!FAULT) offer_all();"),
    ("a withdrawn camera is not withdrawn", "client/participant_publishing.cpp",
     "    take_back(std::exchange(numbers(what), {}));\n", "    if (!FAULT) take_back(std::exchange(numbers(what), {}));\n"),
    ("the room of the connection before stays", "client/participant_cameras.cpp",
     "    shared_->room.begin(", "    if (!FAULT) shared_->room.begin("),
    # Record path
    ("a recorder does not say that it records", "client/session_recording.cpp",
     "        options.records = true;", "        options.records = !FAULT;"),
    ("pictures of those who have not agreed are recorded", "client/session_recording.cpp",
     "            return !d.may_record;", "            return !FAULT && !d.may_record;"),
    ("the next connection is taken for the same", "client/session_recording.cpp",
     "            new_connection_ = true;", "            new_connection_ = !FAULT;"),
    ("pictures before the clock is known are left out", "client/session_recording.cpp",
     "        if (early_bytes_ <= max_early_bytes)", "        if (!FAULT && early_bytes_ <= max_early_bytes)"),
    ("a camera that has left is still recorded", "client/session_recording.cpp",
     "                intake_.on_end(described_.at(camera).camera.id);",
     "                if (!FAULT) intake_.on_end(described_.at(camera).camera.id);"),
    # Viewer
    ("the room is shown as it became later", "viewer/room_past.cpp",
     "            if (state.from <= moment)", "            if (FAULT || state.from <= moment)"),
    ("pictures of the past and the present are mixed up", "viewer/looking_back.cpp",
     "    return looking.empty() ? past : present;", "    return looking.empty() != FAULT ? past : present;"),
    ("a screen of the past looks live", "viewer/shared_screens.cpp",
     "    screen.is_past = frame.past;", "    screen.is_past = !FAULT && frame.past;"),
]


def replaced(faults, texts):
    """The texts of the files with all switches in them."""
    for number, (what, file, old, new) in faults:
        text = texts[file]
        if text.count(old) != 1:
            sys.exit(f"{file}: '{old}' stands there {text.count(old)} times ({what})")
        texts[file] = text.replace(old, new.replace("FAULT", f"theatron_fault({number})"))
    return {file: SWITCH + text for file, text in texts.items()}


def finds(program, number, *options):
    """The tests of a program that fail with this fault; None: it was not built."""
    if not program.exists():
        return None
    environment = dict(os.environ, THEATRON_FAULT=str(number), SEEDS="3", MINUTES="20")
    try:
        run = subprocess.run([program, "--gtest_brief=1", *options], cwd=ROOT, env=environment, capture_output=True, text=True,
                             errors="replace", timeout=120)
    except subprocess.TimeoutExpired:
        return ["stands still"]
    failed = sorted(set(re.findall(r"^\[  FAILED  \] ([\w.]+)", run.stdout, re.M)))
    return failed or ([f"ends with {run.returncode}"] if run.returncode else [])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--world", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--only", type=int, nargs="*")
    options = parser.parse_args()
    faults = [(number, fault) for number, fault in enumerate(FAULTS, 1) if not options.only or number in options.only]
    if options.list:
        for number, (what, file, *_) in faults:
            print(f"{number:3} {file}: {what}")
        return 0
    files = {file: ROOT / "src" / file for _, (_, file, *_) in faults}
    if subprocess.run(["git", "diff", "--quiet", "--", *files.values()], cwd=ROOT).returncode:
        sys.exit("The files to be changed have changes already; commit them first.")
    modules = [] if options.world else sorted({file.split("/")[0] for file in files})
    before = {file: path.read_text() for file, path in files.items()}
    found = 0
    try:
        for file, text in replaced(faults, dict(before)).items():
            files[file].write_text(text)
        subprocess.run(["ninja", "-C", BUILD, "world_test", *(f"{module}_test" for module in modules)], check=True,
                       stdout=subprocess.DEVNULL)
        if wrong := finds(WORLD, 0):
            sys.exit(f"Without a fault: {wrong}")
        for number, (what, file, *_) in faults:
            by = finds(WORLD, number)
            for module in modules if not by else []:
                by = by or finds(BUILD / f"src/{module}/{module}_test", number)
            found += bool(by)
            print(f"{number:3} {'found' if by else 'NOT FOUND':9} {what} ({file}){': ' + ', '.join(by[:3]) if by else ''}", flush=True)
    finally:
        for file, text in before.items():
            files[file].write_text(text)
    print(f"{found} of {len(faults)} faults are found")
    return 0 if found >= 0.9 * len(faults) else 1


sys.exit(main())
