// SPDX-License-Identifier: Apache-2.0
#include "capture/video_reader.h"

#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include "capture/av_complaints.h"
#include "capture/av_input.h"
#include "capture/av_video.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

// Playlists and other containers that name files get none.
int refuse_io(AVFormatContext*, AVIOContext**, const char*, int, AVDictionary**) {
    return AVERROR(EACCES);
}

bool names_other_files(const AVInputFormat& format) {
    const std::string_view own = format.name;
    for (const std::string_view name : {"hls", "concat", "dash", "imf", "sdp"})
        if (own == name)
            return true;
    return false;
}

class Video {
public:
    Video(int descriptor, std::span<std::byte> area) : input_(descriptor), video_(area) {}
    ~Video() { avformat_close_input(&file_); }
    Video(const Video&) = delete;

    VideoAnswer open();
    // Writes the picture into the area.
    VideoAnswer next();

private:
    AvInput input_;
    AVFormatContext* file_ = nullptr;
    AvVideo video_;
};

VideoAnswer Video::open() {
    count_av_complaints();
    file_ = avformat_alloc_context();
    if (!file_)
        throw std::bad_alloc();
    file_->pb = input_.context();
    file_->io_open = refuse_io;
    const AVInputFormat* format = nullptr;
    check_av_memory(av_probe_input_buffer2(file_->pb, &format, "", nullptr, 0, 0));
    if (!format)
        return {.kind = Kind::unreadable};
    if (names_other_files(*format))
        return {.kind = Kind::names_files};
    const int failed = avformat_open_input(&file_, "", format, nullptr);
    check_av_memory(failed);
    return failed ? VideoAnswer{.kind = Kind::unreadable} : video_.open(*file_);
}

VideoAnswer Video::next() {
    const bool is_picture = video_.decode();
    if (is_picture)
        video_.write();
    return {.kind = is_picture ? Kind::picture : Kind::end,
            .time = is_picture ? video_.time() : Duration(0),
            .size = {},
            .lost = video_.lost()};
}

}  // namespace

void serve_video(sandbox::Inside& inside) {
    std::unique_ptr<Video> video;
    while (const std::optional<Bytes> request = inside.receive()) {
        if (request->size() == 1 && (*request)[0] == std::byte(VideoRequest::open)) {
            video.reset();
            video = std::make_unique<Video>(inside.input(), inside.area());
            inside.send(encode(video->open()));
        } else {
            inside.send(encode(video ? video->next() : VideoAnswer{.kind = Kind::end, .size = {}}));
        }
    }
}

}  // namespace theatron::capture
