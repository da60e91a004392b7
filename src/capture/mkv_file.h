// SPDX-License-Identifier: Apache-2.0
// The pictures of an Azure Kinect recording, read by a sandboxed process (mkv_reader.h). A
// malicious file can only cause an Error here.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/bytes.h"
#include "base/time.h"
#include "capture/mkv_answer.h"
#include "sandbox/limits.h"

namespace theatron::capture {

class MkvFile {
public:
    struct Packet {
        enum class Track { depth, color };
        Track track = Track::depth;
        Duration time{};
        Bytes bytes;  // empty: the picture exceeded the size limit
    };

    // All functions throw Error: for files that are not Matroska or have no depth track, and if
    // the reader ended.
    explicit MkvFile(const std::filesystem::path& path, const sandbox::Limits& limits = {});
    ~MkvFile();

    Size depth_size() const { return description_.depth; }
    Size color_size() const { return description_.color; }  // 0 x 0 without a JPEG colour track
    // The format of a colour track that is not JPEG or has another name, or empty.
    const std::string& other_color() const { return description_.other_color; }
    // 0 if the file does not state it.
    double frames_per_second() const { return description_.frames_per_second; }
    // The factory calibration's text; empty if there is none.
    const std::string& calibration() const { return description_.calibration; }

    // True if the file lacks its end, for example after a full disk or an aborted copy.
    bool is_cut_off() const { return cut_off_; }

    // The next depth or colour picture; nullopt at the end.
    std::optional<Packet> read();
    // Continues with the first picture.
    void rewind();

private:
    struct Process;
    MkvDescription open();

    std::filesystem::path path_;
    std::unique_ptr<Process> process_;
    bool cut_off_ = false;
    MkvDescription description_;
};

}  // namespace theatron::capture
