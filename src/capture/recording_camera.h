// SPDX-License-Identifier: Apache-2.0
// Plays a camera of a recording (docs/formats/recording.md): exactly the images that were
// encoded, at their original times.
#pragma once

#include <filesystem>
#include <map>

#include "base/options.h"
#include "base/utc.h"
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

// Counts of pictures that could not be decoded.
struct PictureLosses {
    std::uint64_t damaged_depth = 0, damaged_color = 0;  // by checksum or decoder
    // Pictures that refer to damaged pictures or to ones that were never recorded.
    std::uint64_t undecodable_depth = 0, undecodable_color = 0;

    std::uint64_t depth() const { return damaged_depth + undecodable_depth; }
    std::uint64_t color() const { return damaged_color + undecodable_color; }
};

// The number of successive calibrations of the camera, without changes of its colour gains alone;
// at least one.
std::size_t calibrations_of(const record::CameraContent& camera);

// The calibration of the camera at this time since the recording's first picture: cameras are
// registered anew or adjusted while they are recorded.
bool differ_in_place_only(const Bytes& one, const Bytes& other);
const Bytes& calibration_at(const record::CameraContent& camera, Duration position);

// The decoded frames of one camera in order, through consecutive segments with the same
// calibration, starting at the first segment that has it. Damaged pictures and pictures with
// a missing reference are skipped and counted; decoding continues at the next key frame. JPEG
// colour is returned undecoded.
class RecordedFrames final : public Recording {
public:
    // As `part`: all from the first one on that differ in the camera's place only.
    static constexpr std::size_t any_place = std::size_t(-1);

    // `camera` counts from 0 in the order of the file. `file` is its name in messages. `part`
    // counts the camera's calibrations from 0. Throws Error if there is no such camera or part,
    // or if this build cannot decode it.
    RecordedFrames(std::shared_ptr<const record::RecordingFile> recording, std::size_t camera,
                   std::string file, std::size_t part = 0);

    const CameraInfo& info() const { return info_; }
    std::size_t frames() const { return end_ - begin_; }
    // Losses since the last rewind(), among the frames before the next one.
    const PictureLosses& losses() const { return losses_; }

    std::optional<Duration> offset() override;
    void skip() override;
    bool read(Frame& out) override;
    void rewind() override;
    void go_to(Duration position) override;
    std::optional<Duration> round() const override;
    std::uint64_t lost_pictures() const override;
    std::string problem_at_end() const override;

    // The next frame's header as recorded. Precondition: offset() returned a value.
    wire::MediaHeader upcoming() const;
    // The time of day at which it was captured; the epoch: not known.
    // Precondition: offset() returned a value.
    UtcTime upcoming_utc() const;

private:
    // The colour of one segment, decoded in order.
    struct ColorOfSegment {
        std::unique_ptr<video::ColorDecoder> decoder;  // null for JPEG
        std::size_t next = 0;                          // index after the last one given to it
        std::optional<FrameNumber> last;               // last one decoded
    };

    // Makes the decoders of a part, whose codecs may differ from those before.
    void begin_part(std::size_t part);
    // Decodes the next depth image into `decoded_`; false if that fails.
    bool decode();
    bool read_color(std::size_t index, ColorData& out);
    bool decode_color(ColorOfSegment& colors, std::size_t index, ColorData& out);
    ColorOfSegment& colors_of(std::size_t segment);
    void match_colors();

    std::shared_ptr<const record::RecordingFile> recording_;
    const record::CameraContent& content_;
    std::string file_;
    CameraInfo info_;
    std::vector<record::CameraPart> parts_;  // with the selected calibration
    std::size_t begin_ = 0, end_ = 0;        // range of depth frames

    std::size_t part_ = 0;  // that the decoders belong to
    std::unique_ptr<codec::DepthStreamDecoder> depth_;
    // Where a segment changes, depth and colour of a frame may be on either side: for the segments
    // of the part and beside it.
    std::map<std::size_t, ColorOfSegment> color_;
    std::vector<std::uint32_t> colors_;  // for each depth frame, index of its colour
    std::size_t next_ = 0;
    bool is_decoded_ = false;
    DepthImage decoded_;
    Duration last_offset_{};
    Bytes payload_;
    PictureLosses losses_;
    std::uint64_t lost_before_ = 0;  // in the worst round before this one
};

}  // namespace theatron::capture
