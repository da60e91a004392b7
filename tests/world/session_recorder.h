// SPDX-License-Identifier: Apache-2.0
// A recorder of a World's session, as 'theatron record' has it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "record/source.h"
#include "world/world.h"

namespace theatron::world {

class SessionRecorder {
public:
    SessionRecorder(World& world, const std::string& name, const std::string& depth_codec = "zstd");
    ~SessionRecorder();

    // Ends the recording and closes its file. The counts stay.
    void finish();

    const std::filesystem::path& file() const { return file_; }
    record::RecordSource& source() { return *source_; }
    Path& path() { return *path_; }
    // Pictures of all streams.
    std::uint64_t recorded();
    // No stream has lost one, and none was interrupted.
    bool is_complete();

private:
    void later();

    const std::filesystem::path file_;
    const std::shared_ptr<Path> path_;
    std::unique_ptr<record::RecordSource> source_;
    std::optional<Schedule::Key> timer_;
};

}  // namespace theatron::world
