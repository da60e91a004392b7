// SPDX-License-Identifier: Apache-2.0
// The voices of a recording: what there is, whether it is whole, and as WAV files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "record/recording_file.h"

namespace theatron::exporting {

struct RecordedPerson {
    ParticipantId id{};  // as it was recorded; 0: nobody knows, as the marks are damaged
    std::string name;
    std::uint64_t packets = 0;
    double seconds = 0;  // of voice
};

struct VoicesSummary {
    std::vector<RecordedPerson> people;
    std::uint64_t blocks = 0;   // silence included
    std::uint64_t bytes = 0;    // Opus
    std::uint64_t damaged = 0;  // packets, by checksum, or no Opus, or without a header
};

// Reads and decodes all packets.
VoicesSummary summarize_voices(const std::shared_ptr<const record::RecordingFile>& recording);

// Writes FOLDER/voice-N.wav for each person, N its number: 48 kHz, 16 bits, one channel, from the
// recording's first picture on, so that the files are in sync with each other. Damaged packets are
// silence. Returns the files; throws Error, also for a file that exists unless `overwrite`.
std::vector<std::filesystem::path> export_voices(
    const std::shared_ptr<const record::RecordingFile>& recording,
    const std::filesystem::path& folder, bool overwrite, VoicesSummary& summary);

}  // namespace theatron::exporting
