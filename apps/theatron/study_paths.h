// SPDX-License-Identifier: Apache-2.0
// Where the participant's head and hands were, and what happened, on the session's clock: a file of
// comma-separated values beside the journal (docs/formats/study.md).
//
// It has numbers and kinds, and no name. Each write is on the disk within a second.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "client/participant.h"
#include "files/journal_file.h"
#include "study/study_run.h"
#include "wire/person_pose.h"

namespace theatron::app {

inline constexpr std::size_t max_paths_bytes = std::size_t(256) << 20;

class StudyPaths {
public:
    // The time between two poses of the file, and between two writes.
    static constexpr Duration pose_every = std::chrono::milliseconds(33);
    static constexpr Duration write_every = std::chrono::milliseconds(500);

    explicit StudyPaths(const std::filesystem::path& path);

    // From any thread: a pose of whoever it is; only those of the participant are kept.
    void take(ParticipantId person, const wire::PersonPose& pose);
    // The participant is this one from now on, or away.
    void follow(std::optional<ParticipantId> person, TimePoint session_time);
    // An event of the study: "step" or "reply".
    void note(TimePoint session_time, std::string_view event, std::string_view detail);
    // Writes down how the participant has changed the room since the last call.
    void compare(const client::Participant::Room& room, TimePoint session_time);
    // Writes what is due. False: the file has its full size, and nothing more is written.
    bool on_tick(TimePoint now);
    void write();

private:
    void add(TimePoint session_time, std::string_view what, const std::string& values);
    void add_part(TimePoint time, const char* part, const std::optional<wire::PartPose>& pose);

    files::JournalFile file_;
    std::size_t bytes_ = 0;
    std::mutex mutex_;  // of all below
    std::string waiting_;
    std::optional<ParticipantId> person_;
    TimePoint last_pose_, written_;
    bool knows_room_ = false;
    session::RoomObjects objects_;
    std::uint64_t version_ = 0;
};

}  // namespace theatron::app
