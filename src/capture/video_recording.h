// SPDX-License-Identifier: Apache-2.0
// The pictures of a video file, as fast as they can be decoded.
#pragma once

#include <filesystem>
#include <optional>

#include "capture/playback.h"
#include "capture/readable_file.h"
#include "capture/steady_times.h"
#include "capture/video_answer.h"
#include "sandbox/child.h"

namespace theatron::capture {

// A video that a sandboxed process decodes, one picture ahead. Colour is what the file has, depth
// the plane of a screen (geometry/screen.h). One thread at a time.
class VideoRecording final : public Recording {
public:
    // Throws Error, one sentence, if this is no video that FFmpeg reads, as all functions do.
    explicit VideoRecording(const std::filesystem::path& path);

    Size size() const { return opened_.size; }
    double frames_per_second() const { return opened_.frames_per_second; }

    // Times that go back, in a damaged file, are those of the picture before.
    std::optional<Duration> offset() override;
    void skip() override { take(); }
    bool read(Frame& out) override;
    std::uint64_t lost_pictures() const override;
    void rewind() override;
    std::string problem_at_end() const override;

private:
    VideoAnswer answer();
    void request(VideoRequest what);
    VideoAnswer open();
    void receive();
    void take();

    std::filesystem::path path_;
    ReadableFile file_;
    sandbox::Child child_;
    VideoAnswer opened_;
    std::optional<Duration> upcoming_;
    SteadyTimes times_;
    bool any_ = false, jump_noted_ = false;
    std::uint64_t lost_ = 0, lost_before_ = 0;  // in this round, in those before it
    bool waiting_ = false;                      // an answer is outstanding
    bool ended_ = false;
};

}  // namespace theatron::capture
