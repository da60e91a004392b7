// SPDX-License-Identifier: Apache-2.0
// Decodes the video track of an open libavformat source into rows of red, green, blue bytes. Only
// for code that runs in a sandbox.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "capture/video_answer.h"

namespace theatron::capture {

// How the pixels of a picture lie on the screen.
struct PictureShape {
    AVRational pixel{1, 1};  // width to height of a pixel
    // First the rows become columns, then columns and rows are counted from the other end.
    bool swapped = false, from_right = false, from_below = false;
    bool is_turned() const { return swapped || from_right || from_below; }
};

// The quarter turn or mirror image that is nearest to the display matrix, as libavutil has them;
// null: none.
PictureShape shape_of(const std::int32_t* display_matrix, AVRational pixel);

// The size of a picture of `pixels` on the screen, in square pixels: no side is smaller than it
// was, unless it would be too large.
Size shown_size(Size pixels, const PictureShape& shape);

// Writes pictures of any format and size into one picture of a fixed size: turned and scaled in
// their own shape, with black beside them.
class PictureWriter {
public:
    // `area` holds video_bytes() of every size that begin() gets.
    explicit PictureWriter(std::span<std::byte> area) : area_(area) {}
    ~PictureWriter() { sws_freeContext(scaler_); }
    PictureWriter(const PictureWriter&) = delete;

    // False if pictures of this size do not fit into the area.
    bool begin(Size size);
    Size size() const { return size_; }

    struct Source {
        AVPixelFormat format = AV_PIX_FMT_NONE;
        Size size;
        const std::uint8_t* const* rows = nullptr;  // four, as in AVFrame
        const int* strides = nullptr;
        AVColorSpace colors = AVCOL_SPC_UNSPECIFIED;
        AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
        PictureShape shape = {};
    };
    // Throws std::bad_alloc.
    void write(const Source& source);

private:
    // The conversion that a scaler is made for.
    struct Scaling {
        Size from, to;
        AVPixelFormat format = AV_PIX_FMT_NONE;
        int colors = 0;  // as sws_getCoefficients() counts them
        bool is_full = false;
        bool operator==(const Scaling&) const = default;
    };
    void prepare(const Scaling& scaling);
    void scale(const Source& source, Size to, std::uint8_t* first, int stride);

    std::span<std::byte> area_;
    Size size_;
    Scaling scaling_;
    SwsContext* scaler_ = nullptr;
    std::vector<std::uint8_t> unturned_;
};

PictureWriter::Source source_of(const AVFrame& frame);

class AvVideo {
public:
    // Throws std::bad_alloc, as all functions.
    explicit AvVideo(std::span<std::byte> area);
    ~AvVideo();
    AvVideo(const AvVideo&) = delete;

    // Chooses the track of `file`, which is open and outlives this. Pictures get the size `wanted`;
    // without one, their own.
    VideoAnswer open(AVFormatContext& file, Size wanted = {});

    // Called after each packet of the track was read; its result is in stamp() of the picture.
    void set_stamps(std::function<std::int64_t()> stamps) { stamps_ = std::move(stamps); }

    // The next picture; false at the end. Damaged parts are left out.
    bool decode();
    // Pictures that were left out.
    std::uint32_t lost() const { return lost_; }
    std::int64_t stamp() const { return frame_->reordered_opaque; }
    // The time of the picture in the file.
    Duration time();
    // Writes the picture into the area.
    void write();

private:
    PictureShape shape(AVFrame* frame) const;
    VideoAnswer::Kind why_no_track() const;
    int read_packet();

    AVFormatContext* file_ = nullptr;
    AVCodecContext* decoder_ = nullptr;
    AVPacket* packet_ = av_packet_alloc();
    AVFrame* frame_ = av_frame_alloc();
    PictureWriter writer_;
    int track_ = -1;
    bool draining_ = false;
    std::uint32_t lost_ = 0;
    std::uint64_t complaints_ = 0;  // until now
    double frames_per_second_ = 30;
    std::optional<Duration> last_;
    std::function<std::int64_t()> stamps_;
};

}  // namespace theatron::capture
