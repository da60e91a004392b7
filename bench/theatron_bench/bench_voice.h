// SPDX-License-Identifier: Apache-2.0
// `theatron bench voice`: from a mouth to an ear through real processes, the host's cost of many
// speakers, the jitter buffer's losses, and a loudspeaker's callback on a busy machine.
//
// Devices are WAV files with blocks of 10 ms: a sample counts as spoken 10 ms before its block is
// taken, and as heard 10 ms after its block was asked for, as with a sound card of two blocks.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace theatron::bench {

struct VoiceBench {
    std::vector<std::string> cameras;  // specifications; the listener receives them all
    double seconds = 20;               // of clicks, two a second
    int frame_ms = 20;                 // 10 or 20
    // Network namespaces as in InteractionBench: the speaker is with the host.
    std::string host_namespace, listener_namespace;
    // A specification: the speaker's own camera, whose colour is compared with the voice. Empty:
    // none.
    std::string own_camera;
    // A folder of cases: the listener fetches the first one meanwhile. Empty: none.
    std::string cases;
};

// {p50,p95,max,count}: milliseconds from the saying of a click to its hearing. With an own camera
// also {color_age_p50,after_color}: the age of the speaker's decoded colour at the listener, and by
// how much the voice is later (negative: earlier). Throws Error.
nlohmann::json mouth_to_ear(const VoiceBench& bench);

// {cores,idle_cores}: of a host without cameras with 24 participants, 4 of whom speak. Throws
// Error.
nlohmann::json host_cores_of_24(double seconds);

// {longest_gap_ms,concealed_percent,beyond_lost_percent}: a minute of voice through the jitter
// buffer, with 5 % of the frames lost and up to 30 ms of delay, in simulated time.
nlohmann::json lost_5_percent(int frame_ms);

// {p50_us,p99_us,max_us,count,period_us,missing_ms,lead_ms}: the time that a loudspeaker's callback
// takes with four speakers in space while each processor is also busy with a thread of lower
// priority; the sound that it asked for in vain; and the lead of rendering at the end.
nlohmann::json callback_under_load(double seconds);

void add_voice_bench(CLI::App& bench);

}  // namespace theatron::bench
