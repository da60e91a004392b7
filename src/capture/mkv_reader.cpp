// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_reader.h"

extern "C" {
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "capture/av_complaints.h"
#include "capture/av_input.h"
#include "ffmpeg/ffmpeg.h"

namespace theatron::capture {
namespace {

constexpr std::uint32_t tag_of(const char (&text)[5]) {
    return std::uint32_t(text[0]) | std::uint32_t(text[1]) << 8 | std::uint32_t(text[2]) << 16 |
           std::uint32_t(text[3]) << 24;
}

std::string_view metadata(const AVStream& stream, const char* key) {
    const AVDictionaryEntry* entry = av_dict_get(stream.metadata, key, nullptr, 0);
    return entry ? entry->value : "";
}

// Infrared has the same format as depth; only names distinguish the tracks.
bool is_called(const AVStream& stream, std::string_view name) {
    const std::string tag = "K4A_" + std::string(name) + "_TRACK";
    return metadata(stream, "title") == name || !metadata(stream, tag.c_str()).empty();
}

struct PacketDeleter {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

Size size_of(const AVStream& stream) {
    const Size size{stream.codecpar->width, stream.codecpar->height};
    return is_valid(size) ? size : Size{};
}

}  // namespace

struct MkvReader::Library {
    explicit Library(int descriptor) : input(descriptor) {
        if (!packet)
            throw std::bad_alloc();
    }
    ~Library() {
        packet.reset();
        avformat_close_input(&file);
    }

    const AVStream& stream(int index) const { return *file->streams[index]; }

    Kind open();
    void find_tracks();

    AvInput input;
    AVFormatContext* file = nullptr;
    std::unique_ptr<AVPacket, PacketDeleter> packet{av_packet_alloc()};
    int depth = -1;  // track index
    int color = -1;
    bool has_infrared = false;
    std::uint64_t complaints = 0;  // until now
    bool has_ended = false;
    MkvDescription description;
};

MkvReader::Kind MkvReader::Library::open() {
    ffmpeg::load_if_there();
    count_av_complaints();
    file = avformat_alloc_context();
    if (!file)
        throw std::bad_alloc();
    file->pb = input.context();
    // Only this container format: the file cannot make libavformat open anything else.
    const int failed = avformat_open_input(&file, "", av_find_input_format("matroska"), nullptr);
    check_av_memory(failed);
    if (failed)
        return Kind::no_matroska;
    find_tracks();
    if (depth < 0)
        return has_infrared ? Kind::infrared_only : Kind::no_depth;
    description.depth = size_of(stream(depth));
    if (description.depth == Size{})
        return Kind::impossible_size;
    if (color >= 0)
        description.color = size_of(stream(color));
    complaints = av_complaints();
    const AVRational rate = stream(depth).avg_frame_rate;
    description.frames_per_second = rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
    return Kind::description;
}

void MkvReader::Library::find_tracks() {
    for (int i = 0; i < int(file->nb_streams); ++i) {
        AVStream& track = *file->streams[i];
        const AVCodecParameters& codec = *track.codecpar;
        track.discard = AVDISCARD_ALL;
        if (codec.codec_type == AVMEDIA_TYPE_ATTACHMENT) {
            if (metadata(track, "filename") == "calibration.json" && codec.extradata_size > 0)
                description.calibration.assign(
                    reinterpret_cast<const char*>(codec.extradata),
                    std::min(std::size_t(codec.extradata_size), max_calibration_bytes));
        } else if (codec.codec_type == AVMEDIA_TYPE_VIDEO) {
            const bool is_depth =
                codec.codec_tag == tag_of("b16g") && is_called(track, "DEPTH") && depth < 0;
            if (is_depth)
                depth = i;
            else if (is_called(track, "IR"))
                has_infrared = true;
            else if (is_called(track, "COLOR") && codec.codec_id == AV_CODEC_ID_MJPEG && color < 0)
                color = i;
            else if (color < 0)
                description.other_color =
                    std::string(avcodec_get_name(codec.codec_id)).substr(0, max_codec_name);
        }
    }
    if (color >= 0)
        description.other_color.clear();
    for (const int i : {depth, color})
        if (i >= 0)
            file->streams[i]->discard = AVDISCARD_DEFAULT;
}

MkvReader::MkvReader(int descriptor)
    : library_(std::make_unique<Library>(descriptor)), kind_(library_->open()) {}

MkvReader::~MkvReader() = default;

const MkvDescription& MkvReader::description() const {
    return library_->description;
}

std::optional<MkvReader::Picture> MkvReader::read() {
    AVPacket& packet = *library_->packet;
    while (true) {
        // Damage between pictures: how many were there, and of which kind, is not known.
        if (library_->complaints != av_complaints()) {
            library_->complaints = av_complaints();
            return Picture{Kind::depth, {}, {}};
        }
        if (library_->has_ended)
            return std::nullopt;
        av_packet_unref(&packet);
        const int failed = av_read_frame(library_->file, &packet);
        check_av_memory(failed);
        library_->has_ended = failed < 0;
        if (failed < 0)
            continue;
        const bool is_depth = packet.stream_index == library_->depth;
        const bool is_color = packet.stream_index == library_->color;
        if (!is_depth && !is_color)
            continue;
        // A damaged picture has no bytes.
        if (packet.flags & AV_PKT_FLAG_CORRUPT || packet.size <= 0 || packet.pts == AV_NOPTS_VALUE)
            return Picture{is_depth ? Kind::depth : Kind::color, {}, {}};
        const AVRational unit = library_->stream(packet.stream_index).time_base;
        const auto* data = reinterpret_cast<const std::byte*>(packet.data);
        return Picture{is_depth ? Kind::depth : Kind::color,
                       Duration(av_rescale_q(packet.pts, unit, {1, 1'000'000})),
                       {data, std::size_t(packet.size)}};
    }
}

void MkvReader::serve(sandbox::Inside& inside) {
    std::optional<MkvReader> reader;
    const auto answer = [&](Kind kind, Duration time = {}, ByteView bytes = {}) {
        // A picture above the size limit is sent empty and counts as damaged.
        if (bytes.size() > inside.area().size())
            bytes = {};
        std::copy(bytes.begin(), bytes.end(), inside.area().begin());
        inside.send(encode(MkvAnswer{kind, time, std::uint32_t(bytes.size())}));
    };
    while (const std::optional<Bytes> request = inside.receive()) {
        if (request->size() == 1 && (*request)[0] == std::byte(MkvRequest::open)) {
            reader.emplace(inside.input());
            if (reader->kind() == Kind::description)
                answer(Kind::description, {}, encode(reader->description()));
            else
                answer(reader->kind());
        } else if (const auto picture = reader ? reader->read() : std::nullopt) {
            answer(picture->kind, picture->time, picture->bytes);
        } else {
            answer(Kind::end);
        }
    }
}

}  // namespace theatron::capture
