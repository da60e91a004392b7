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

// What of a camera could not be given, or is not a picture any more.
struct PictureLosses {
    std::uint64_t damaged_depth = 0, damaged_color = 0;  // as the checksum or the decoder says
    // Those refer to pictures that are damaged or were never recorded.
    std::uint64_t undecodable_depth = 0, undecodable_color = 0;

    std::uint64_t depth() const { return damaged_depth + undecodable_depth; }
    std::uint64_t color() const { return damaged_color + undecodable_color; }
};

// How many calibrations the camera has one after the other; at least one.
std::size_t calibrations_of(const record::CameraContent& camera);

// One camera's decoded frames in their order, through all segments that have its calibration: the
// first that has the camera, and those after it up to another calibration. Pictures that are
// damaged, and those that refer to what is not there, are left out and counted; the next key frame
// goes on. JPEG colour is handed on as it is.
class RecordedFrames final : public Recording {
public:
    // `camera` counts from 0 in the order of the file; `file` is its name in messages; `part`
    // counts the camera's calibrations from 0. Throws Error if there is no such camera or part, or
    // if this build cannot decode it.
    RecordedFrames(std::shared_ptr<const record::RecordingFile> recording, std::size_t camera,
                   std::string file, std::size_t part = 0);

    const CameraInfo& info() const { return info_; }
    std::size_t frames() const { return end_ - begin_; }
    // Since the last rewind(), of the frames before the upcoming one.
    const PictureLosses& losses() const { return losses_; }

    std::optional<Duration> offset() override;
    void skip() override;
    void read(Frame& out) override;
    void rewind() override;
    std::optional<Duration> round() const override;

    // The upcoming frame's header as it was recorded; only after offset() gave something.
    wire::MediaHeader upcoming() const;

private:
    // Decoders of a segment: another may be of another codec.
    void begin_part(std::size_t part);
    // Decodes the upcoming depth image into `decoded_`; false if it is lost.
    bool decode();
    bool read_color(std::size_t index, ColorData& out);
    bool decode_color(std::size_t index, ColorData& out);
    void match_colors();

    std::shared_ptr<const record::RecordingFile> recording_;
    const record::CameraContent& content_;
    std::string file_;
    CameraInfo info_;
    std::vector<record::CameraPart> parts_;  // those played
    std::size_t begin_ = 0, end_ = 0;        // depth frames

    std::size_t part_ = 0;  // that the decoders are of
    std::unique_ptr<codec::DepthStreamDecoder> depth_;
    std::unique_ptr<video::ColorDecoder> color_;  // null for JPEG and where there is none
    std::vector<std::uint32_t> colors_;           // of each depth frame: its colour's index
    std::size_t next_ = 0;
    std::size_t next_color_ = 0;             // after the one that `color_` was given last
    std::optional<FrameNumber> last_color_;  // that it decoded
    bool is_decoded_ = false;
    DepthImage decoded_;
    Duration last_offset_{};
    Bytes payload_;
    PictureLosses losses_;
};

}  // namespace theatron::capture
