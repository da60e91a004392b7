// SPDX-License-Identifier: Apache-2.0
// A camera of a recording (docs/formats/recording.md) as a camera again: the
// very images that were encoded, in their original spacing.
#pragma once

#include <filesystem>

#include "base/options.h"
#include "capture/camera.h"
#include "capture/playback.h"
#include "codec/depth_stream.h"
#include "record/recording_file.h"
#include "video/color_codec.h"

namespace theatron::capture {

inline constexpr const char* recording_camera_help =
    "recording:FILE  a camera of a recording that 'theatron record' made; camera=0 (which of "
    "its cameras), loop=0, start=0 (first frame), preload=0 (decode all at start)";

std::unique_ptr<Camera> open_recording_camera(Options& options, const Progress& progress);

// One camera's decoded frames in their order. Frames whose reference was never
// recorded are left out. JPEG colour is handed on as it is.
class RecordedFrames final : public Recording {
public:
    // `camera` counts from 0 in the order of the file; `file` is its name in messages. Throws Error
    // if there is no such camera, or if this build cannot decode it.
    RecordedFrames(std::shared_ptr<const record::RecordingFile> recording, std::size_t camera,
                   std::string file);

    const CameraInfo& info() const { return info_; }
    std::size_t frames() const { return content_.depth.frames.size(); }

    std::optional<Duration> offset() override;
    void skip() override;
    void read(Frame& out) override;
    void rewind() override;
    std::optional<Duration> round() const override;

    // The upcoming frame as it was recorded; only after offset() gave something.
    const record::RecordedFrame& upcoming() const { return content_.depth.frames[next_]; }

private:
    // Decodes the upcoming depth image into `decoded_`; false if its reference is missing.
    bool decode();
    void read_color(std::size_t index, ColorData& out);
    void decode_color(std::size_t index, ColorData& out);
    [[noreturn]] void refuse(const char* what, FrameNumber number, Status why) const;

    std::shared_ptr<const record::RecordingFile> recording_;
    const record::CameraContent& content_;
    std::string file_;
    CameraInfo info_;
    codec::DepthSetting setting_;
    bool temporal_ = false;  // frames refer to others, so none may be passed over undecoded

    std::unique_ptr<codec::DepthStreamDecoder> depth_;
    std::unique_ptr<video::ColorDecoder> color_;      // null for JPEG and where there is none
    std::vector<std::optional<std::size_t>> colors_;  // of each depth frame: its colour's index
    std::size_t next_ = 0;
    std::size_t next_color_ = 0;  // after the one that `color_` decoded last
    bool is_decoded_ = false;
    DepthImage decoded_;
    Duration last_offset_{};
    Bytes payload_;
};

}  // namespace theatron::capture
