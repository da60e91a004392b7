// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_file.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <string_view>

#include "base/error.h"

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

// Infrared has the format of depth, so that only names tell them apart.
bool is_called(const AVStream& stream, std::string_view name) {
    const std::string tag = "K4A_" + std::string(name) + "_TRACK";
    return metadata(stream, "title") == name || !metadata(stream, tag.c_str()).empty();
}

struct PacketDeleter {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

Size size_of(const AVStream& stream) {
    return {stream.codecpar->width, stream.codecpar->height};
}

// An EBML number: the leading zeros of its first byte tell how many bytes follow.
std::optional<std::uint64_t> read_size(ByteReader& in) {
    const auto first = in.get<std::uint8_t>();
    const int more = std::countl_zero(first);
    if (more > 7)
        return std::nullopt;
    std::uint64_t value = first & (0x7f >> more);
    bool unknown = value == std::uint64_t(0x7f >> more);
    for (int i = 0; i < more; ++i) {
        const auto next = in.get<std::uint8_t>();
        unknown = unknown && next == 0xff;
        value = value << 8 | next;
    }
    if (unknown || !in.ok())
        return std::nullopt;
    return value;
}

bool begins_like_a_longer_file(const std::filesystem::path& path) {
    std::array<std::byte, 128> beginning;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(path.c_str(), "rb"),
                                                                 std::fclose);
    if (!opened)
        return false;
    const std::size_t count = std::fread(beginning.data(), 1, beginning.size(), opened.get());
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    return !problem && is_cut_off(ByteView(beginning).first(count), size);
}

}  // namespace

// A file is one EBML header and one segment; each has an identifier of four
// bytes and a size.
bool is_cut_off(ByteView beginning, std::uint64_t file_bytes) {
    ByteReader in(beginning);
    in.get_bytes(4);
    const std::optional<std::uint64_t> header = read_size(in);
    if (!header || *header > in.rest().size())
        return false;
    in.get_bytes(std::size_t(*header) + 4);
    const std::optional<std::uint64_t> segment = read_size(in);
    if (!segment)
        return false;
    const std::uint64_t before = beginning.size() - in.rest().size();
    return *segment > file_bytes - std::min(before, file_bytes);
}

struct MkvFile::Library {
    AVFormatContext* file = nullptr;
    std::unique_ptr<AVPacket, PacketDeleter> packet{av_packet_alloc()};
    int depth = -1;  // indices of tracks
    int color = -1;
    std::string other_color;
    std::string calibration;
    bool cut_off = false;

    ~Library() { avformat_close_input(&file); }

    const AVStream& stream(int index) const { return *file->streams[index]; }

    void open(const std::filesystem::path& path);
    void find_tracks();
};

void MkvFile::Library::open(const std::filesystem::path& path) {
    // One sentence to the user, not libavformat's own lines.
    av_log_set_level(AV_LOG_QUIET);
    const std::string name = "'" + path.string() + "'";
    std::error_code problem;
    if (!std::filesystem::exists(path, problem))
        throw Error("There is no file " + name + ".");
    if (!std::filesystem::is_regular_file(path, problem))
        throw Error(name + " is not a file.");

    // Nothing but this file and this container: no playlists, no addresses.
    const AVInputFormat* matroska = av_find_input_format("matroska");
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    const int failed =
        avformat_open_input(&file, ("file:" + path.string()).c_str(), matroska, &options);
    av_dict_free(&options);
    if (failed == AVERROR(EACCES))
        throw Error("Cannot read " + name + ": Permission denied.");
    if (failed || !packet)
        throw Error(name + " is not a Matroska recording, or is damaged at its beginning.");
    find_tracks();
    cut_off = begins_like_a_longer_file(path);
    if (depth < 0)
        throw Error(name +
                    " has no depth track, so it is not an Azure Kinect recording, or is "
                    "damaged at its beginning; what Theatron recorded is recording:FILE.");
    if (!is_valid(size_of(stream(depth))))
        throw Error(name + " has depth of an impossible size.");
}

void MkvFile::Library::find_tracks() {
    for (int i = 0; i < int(file->nb_streams); ++i) {
        AVStream& track = *file->streams[i];
        const AVCodecParameters& codec = *track.codecpar;
        track.discard = AVDISCARD_ALL;
        if (codec.codec_type == AVMEDIA_TYPE_ATTACHMENT) {
            if (metadata(track, "filename") == "calibration.json" && codec.extradata_size > 0)
                calibration.assign(reinterpret_cast<const char*>(codec.extradata),
                                   std::size_t(codec.extradata_size));
        } else if (codec.codec_type == AVMEDIA_TYPE_VIDEO) {
            const bool is_depth =
                codec.codec_tag == tag_of("b16g") && is_called(track, "DEPTH") && depth < 0;
            if (is_depth)
                depth = i;
            else if (is_called(track, "COLOR") && codec.codec_id == AV_CODEC_ID_MJPEG && color < 0)
                color = i;
            else if (is_called(track, "COLOR"))
                other_color = avcodec_get_name(codec.codec_id);
        }
    }
    for (const int i : {depth, color})
        if (i >= 0)
            file->streams[i]->discard = AVDISCARD_DEFAULT;
}

MkvFile::MkvFile(const std::filesystem::path& path) : library_(std::make_unique<Library>()) {
    library_->open(path);
}

MkvFile::~MkvFile() = default;
MkvFile::MkvFile(MkvFile&&) noexcept = default;
MkvFile& MkvFile::operator=(MkvFile&&) noexcept = default;

Size MkvFile::depth_size() const {
    return size_of(library_->stream(library_->depth));
}

Size MkvFile::color_size() const {
    return library_->color < 0 ? Size{} : size_of(library_->stream(library_->color));
}

const std::string& MkvFile::other_color() const {
    return library_->other_color;
}

bool MkvFile::is_cut_off() const {
    return library_->cut_off;
}

double MkvFile::frames_per_second() const {
    const AVRational rate = library_->stream(library_->depth).avg_frame_rate;
    return rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
}

const std::string& MkvFile::calibration() const {
    return library_->calibration;
}

std::optional<MkvFile::Packet> MkvFile::read() {
    AVPacket& packet = *library_->packet;
    while (true) {
        if (av_read_frame(library_->file, &packet) < 0)
            return std::nullopt;
        const bool is_depth = packet.stream_index == library_->depth;
        const bool is_color = packet.stream_index == library_->color;
        const bool whole = !(packet.flags & AV_PKT_FLAG_CORRUPT) && packet.size > 0;
        if (!whole || packet.pts == AV_NOPTS_VALUE || (!is_depth && !is_color)) {
            av_packet_unref(&packet);
            continue;
        }
        const AVRational unit = library_->stream(packet.stream_index).time_base;
        Packet result;
        result.track = is_depth ? Packet::Track::depth : Packet::Track::color;
        result.time = Duration(av_rescale_q(packet.pts, unit, {1, 1'000'000}));
        const auto* data = reinterpret_cast<const std::byte*>(packet.data);
        result.bytes.assign(data, data + packet.size);
        av_packet_unref(&packet);
        return result;
    }
}

}  // namespace theatron::capture
