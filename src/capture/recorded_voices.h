// SPDX-License-Identifier: Apache-2.0
// The voices of a recording, packet by packet (docs/formats/recording.md, "Voices").
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "record/recording_file.h"

namespace theatron::capture {

// The speech of a person, without the silence that the recorder put in.
struct RecordedSpeech {
    ParticipantId person{};   // as it was recorded; 0: its mark is damaged
    Duration at{};            // since the recording's first picture
    std::size_t samples = 0;  // at 48 kHz
    bool pauses = false;      // silence follows
    int level_db = -127;
    ByteView opus;  // valid during the call
};

// Safe for untrusted files: damaged packets are left out and counted. One thread at a time.
class RecordedVoices {
public:
    explicit RecordedVoices(std::shared_ptr<const record::RecordingFile> recording);

    // Calls `speech` for each packet from where the last call ended, or from `restart_at()`, to
    // before `end`. By track, each in order.
    void play(Duration end, const std::function<void(const RecordedSpeech&)>& speech);
    // The next packets are those from `begin` on.
    void restart_at(Duration begin);

    struct Figures {
        std::uint64_t packets = 0;  // of people
        std::uint64_t damaged = 0;
    };
    const Figures& figures() const { return figures_; }

private:
    bool read(const record::VoiceContent& voice, std::size_t frame, RecordedSpeech& speech);

    std::shared_ptr<const record::RecordingFile> recording_;
    struct Place {
        std::size_t next = 0, change = 0;
        ParticipantId person{};
    };
    std::vector<Place> places_;  // by track
    Bytes payload_;
    Figures figures_;
};

}  // namespace theatron::capture
