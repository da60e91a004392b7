// SPDX-License-Identifier: Apache-2.0
// Figures of the streams that a participant receives, by camera and in total.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/participant.h"

namespace theatron::client {

// "connecting", "waiting", "joined", "lost", "refused" or "ended".
const char* text_of(Participant::Phase phase);

struct CameraFigures {
    Participant::Camera camera;
    receive::StreamFigures depth;
    receive::StreamFigures color;  // without frames where the camera has no colour
    bool relayed = false;          // its pictures come from a relay
    // It shows the recording that the host plays, which is never live, however young its frames
    // are. The host does not say which of its cameras do: all of its own count as such.
    enum class Played { no, goes_on, paused } played = Played::no;

    // The stream whose pictures tell that the camera lives: depth, or colour where this participant
    // asked for no depth. Null: it asked for neither.
    const receive::StreamFigures* seen() const;
    double mbit_per_second() const { return depth.mbit_per_second + color.mbit_per_second; }
    std::uint64_t dropped() const { return depth.dropped + color.dropped; }
};

struct ParticipantFigures {
    Participant::Status status;
    std::vector<CameraFigures> cameras;
    struct Recording {
        std::string name;  // of the participant that records
        Duration lasts{};
    };
    std::vector<Recording> recordings = {};
    MomentFigures moments = {};

    // Rate of the slowest camera, and of the slowest one that is live.
    double frames_per_second() const;
    double live_frames_per_second() const;
    // Sums over all cameras.
    double mbit_per_second() const;
    std::uint64_t dropped() const;
};

// "recording" or "paused" for a camera of the recording that the host plays, else its condition:
// "live", "stale", "ended" or "failed".
const char* state_text(const CameraFigures& camera);

// A camera's problem in the program's language; empty: none. Only those who may adjust cameras are
// told what to do about a place.
std::string problem_text(const wire::CameraState& state, wire::Role reader);

// A camera's adjustment: "moved by 12.0, 0.0, 0.0 mm"; empty: it is as registered.
std::string adjustment_text(const wire::Camera& camera);

// "recorded by Anna, 12 s; Ben, 3 min"; empty if nobody records.
std::string recorded_text(const ParticipantFigures& figures);

// Ages between this machine's clock and the session's mean nothing before the session's is known:
// the figures with ages of 0.
std::vector<receive::StreamFigures> without_ages(std::vector<receive::StreamFigures> figures);

// The figures after a reset, until a decoder tells new ones: without counts, with what is known of
// the newest frame's age.
std::vector<receive::StreamFigures> counted_anew(
    const std::vector<receive::StreamFigures>& figures);

// The figures `later` after they were told: the newest frames are older by it.
std::vector<receive::StreamFigures> aged_by(Duration later,
                                            std::vector<receive::StreamFigures> figures);

// The state of a camera as it shows here: one that is said to be live is stale while its pictures
// do not arrive, because its publisher or the host has stopped or the link is cut; also where none
// has come since they were asked for. `is_thinned`: the host leaves out frames for this
// participant. While this participant looks back, as it was said.
wire::CameraState state_here(const wire::CameraState& said, const receive::StreamFigures& seen,
                             bool is_thinned);

// With the cameras' states as they show here.
ParticipantFigures figures_of(const Participant& participant);

}  // namespace theatron::client
