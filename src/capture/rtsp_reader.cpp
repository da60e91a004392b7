// SPDX-License-Identifier: Apache-2.0
// RTSP over one TCP connection (RFC 2326, interleaved). The connection and the text are this
// file's; RTP packets go to libavformat as they come, with a description of one track.
extern "C" {
#include <libavutil/log.h>
}

#include <errno.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <memory>
#include <new>

#include "base/steady_clock.h"
#include "capture/av_input.h"
#include "capture/av_video.h"
#include "capture/device_clock.h"
#include "capture/rtsp_text.h"
#include "capture/source_readers.h"
#include "capture/source_request.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

// Bytes that may come between two packets, for example of other channels.
constexpr std::size_t most_passed_over = std::size_t(1) << 20;
constexpr int packet_bytes = 65536;
// A picture older than this is left out while more has arrived, but not more than so many in a row.
constexpr Duration most_behind = 100ms;
constexpr int most_left_out = 10;
constexpr int rtp_ticks_per_ms = 90;  // of all video
constexpr Duration longest_analysis = 2s;

class Connection {
public:
    explicit Connection(int descriptor) : descriptor_(descriptor) {}

    bool send(const std::string& text) {
        for (std::size_t sent = 0; sent < text.size();) {
            const ssize_t count = write(descriptor_, text.data() + sent, text.size() - sent);
            if (count > 0)
                sent += std::size_t(count);
            else if (count < 0 && errno == EAGAIN)
                wait(POLLOUT, 1000);
            else
                return false;
        }
        return true;
    }

    // At least `count` bytes, at most 64 KiB, are in the buffer; false at the end. `idle` is called
    // while nothing comes, each second.
    template <class Idle>
    bool need(std::size_t count, const Idle& idle) {
        if (begin_ > 0 && begin_ + count > buffer_.size()) {
            std::copy(buffer_.begin() + std::ptrdiff_t(begin_),
                      buffer_.begin() + std::ptrdiff_t(end_), buffer_.begin());
            end_ -= begin_;
            begin_ = 0;
        }
        while (end_ - begin_ < count) {
            if (!wait(POLLIN, 1000)) {
                idle();
                continue;
            }
            const ssize_t got = read(descriptor_, buffer_.data() + end_, buffer_.size() - end_);
            if (got > 0)
                end_ += std::size_t(got);
            else if (got == 0 || errno != EAGAIN)
                return false;
        }
        return true;
    }
    std::string_view buffered() const { return {buffer_.data() + begin_, end_ - begin_}; }
    void drop(std::size_t count) { begin_ += count; }
    bool has_more() const { return end_ > begin_ || wait(POLLIN, 0); }

private:
    bool wait(short events, int ms) const {
        pollfd ready{descriptor_, events, 0};
        return poll(&ready, 1, ms) > 0;
    }

    int descriptor_;
    std::vector<char> buffer_ = std::vector<char>(std::size_t(128) << 10);
    std::size_t begin_ = 0, end_ = 0;
};

void nothing() {}

class Rtsp {
public:
    Rtsp(const SourceOpening& opening, sandbox::Inside& inside)
        : wanted_(opening.wanted),
          url_(parse_rtsp_url(opening.text).value_or(RtspUrl{})),
          connection_(inside.input()),
          video_(inside.area()) {}
    ~Rtsp() {
        avformat_close_input(&file_);
        if (packets_) {
            av_freep(&packets_->buffer);
            avio_context_free(&packets_);
        }
    }
    Rtsp(const Rtsp&) = delete;

    VideoAnswer open();
    std::optional<VideoAnswer> next();

private:
    std::optional<RtspResponse> ask(const std::string& method, const std::string& address,
                                    const std::string& headers, std::string* body = nullptr);
    std::optional<RtspResponse> receive(std::string* body);
    bool send(const std::string& method, const std::string& address, const std::string& headers);
    VideoAnswer open_track(const RtspTrack& track);
    int read_packet(std::uint8_t* out, int size);
    void note_arrival(std::string_view packet);
    void keep_alive();

    static int read(void* self, std::uint8_t* out, int size) {
        return static_cast<Rtsp*>(self)->read_packet(out, size);
    }
    // Reports of this receiver are not sent: over TCP nothing is lost.
    static int discard(void*, std::uint8_t*, int size) { return size; }

    Size wanted_;
    RtspUrl url_;
    Connection connection_;
    int sent_ = 0;  // requests
    std::string challenge_, session_;
    int channel_ = 0;
    Duration keep_alive_every_{};
    TimePoint kept_alive_;
    AVFormatContext* file_ = nullptr;
    AVIOContext* packets_ = nullptr;
    AvVideo video_;
    // The arrivals of the first packets of the newest two pictures; packets that waited in the
    // connection count as older.
    DeviceClock clock_;
    std::optional<std::uint32_t> picture_;  // time stamp
    std::int64_t ticks_ = 0;                // since the first time stamp
    TimePoint began_, began_before_;
};

bool Rtsp::send(const std::string& method, const std::string& address, const std::string& headers) {
    std::string text = method + " " + address + " RTSP/1.0\r\nCSeq: " + std::to_string(++sent_) +
                       "\r\nUser-Agent: theatron\r\n" + headers;
    if (!session_.empty())
        text += "Session: " + session_ + "\r\n";
    if (!challenge_.empty() && !url_.user.empty())
        if (const std::string answer = rtsp_authorization(url_, challenge_, method, address);
            !answer.empty())
            text += "Authorization: " + answer + "\r\n";
    return connection_.send(text + "\r\n");
}

std::optional<RtspResponse> Rtsp::receive(std::string* body) {
    std::size_t size = 0;
    std::size_t wanted = 1;
    while (true) {
        if (!connection_.need(wanted, nothing))
            return std::nullopt;
        const std::string_view text = connection_.buffered();
        if (const auto end = text.find("\r\n\r\n"); end != std::string_view::npos) {
            size = end + 4;
            break;
        }
        if (text.size() >= max_rtsp_head)
            return std::nullopt;
        wanted = text.size() + 1;
    }
    const auto response = parse_rtsp_response(connection_.buffered().substr(0, size));
    if (!response)
        return std::nullopt;
    connection_.drop(size);
    if (!connection_.need(response->body_bytes, nothing))
        return std::nullopt;
    if (body)
        *body = connection_.buffered().substr(0, response->body_bytes);
    connection_.drop(response->body_bytes);
    return *response;
}

// Answers a challenge once.
std::optional<RtspResponse> Rtsp::ask(const std::string& method, const std::string& address,
                                      const std::string& headers, std::string* body) {
    if (!send(method, address, headers))
        return std::nullopt;
    auto response = receive(body);
    if (!response || response->status != 401 || response->challenge.empty() || url_.user.empty())
        return response;
    challenge_ = response->challenge;
    return send(method, address, headers) ? receive(body) : std::nullopt;
}

VideoAnswer Rtsp::open() {
    av_log_set_level(AV_LOG_QUIET);
    std::string description;
    auto response = ask("DESCRIBE", url_.address, "Accept: application/sdp\r\n", &description);
    if (!response)
        return {.kind = Kind::unreadable};
    if (response->status == 401 || response->status == 403)
        return {.kind = Kind::denied};
    if (response->status != 200)
        return {.kind = Kind::refused};
    const auto track =
        find_rtsp_track(description, response->base.empty() ? url_.address : response->base);
    if (!track)
        return {.kind = Kind::no_video};
    response = ask("SETUP", track->control, "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n");
    if (!response)
        return {.kind = Kind::unreadable};
    if (response->status != 200)
        return {.kind = Kind::refused};
    session_ = response->session;
    channel_ = response->channel.value_or(0);
    keep_alive_every_ = std::chrono::seconds(std::max(1, response->session_timeout_s / 2));
    // The response to PLAY is read with the packets, which may come before it.
    if (!send("PLAY", url_.address, "Range: npt=0.000-\r\n"))
        return {.kind = Kind::unreadable};
    kept_alive_ = steady_now();
    return open_track(*track);
}

VideoAnswer Rtsp::open_track(const RtspTrack& track) {
    struct Text {
        std::string_view rest;
        static int read(void* self, std::uint8_t* out, int size) {
            std::string_view& rest = static_cast<Text*>(self)->rest;
            const auto count = std::min(rest.size(), std::size_t(size));
            std::memcpy(out, rest.data(), count);
            rest.remove_prefix(count);
            return count == 0 ? AVERROR_EOF : int(count);
        }
    };
    Text text{track.description};
    constexpr int text_buffer = 4096;
    const auto make_io = [](int size, int writes, void* self, auto* read, auto* write) {
        auto* const buffer = static_cast<unsigned char*>(av_malloc(std::size_t(size)));
        AVIOContext* const io =
            buffer ? avio_alloc_context(buffer, size, writes, self, read, write, nullptr) : nullptr;
        if (!io)
            throw std::bad_alloc();
        return io;
    };
    using Write = int(void*, std::uint8_t*, int);
    AVIOContext* words = make_io(text_buffer, 0, &text, Text::read, static_cast<Write*>(nullptr));
    // Open for both: packets are then read one by one, and reports can be discarded.
    packets_ = make_io(packet_bytes, 1, this, read, discard);
    file_ = avformat_alloc_context();
    if (!file_)
        throw std::bad_alloc();
    file_->pb = words;
    file_->max_analyze_duration = longest_analysis.count();
    file_->fps_probe_size = 0;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "sdp_flags", "custom_io", 0);
    av_dict_set(&options, "reorder_queue_size", "0", 0);
    const int failed = avformat_open_input(&file_, "", av_find_input_format("sdp"), &options);
    av_dict_free(&options);
    av_freep(&words->buffer);
    avio_context_free(&words);
    check_av_memory(failed);
    if (failed)
        return {.kind = Kind::unreadable};
    file_->pb = packets_;
    // Parsers give a picture when the next one begins.
    video_.set_stamps([this] { return to_us(began_before_); });
    return video_.open(*file_, wanted_);
}

void Rtsp::keep_alive() {
    const TimePoint now = steady_now();
    if (now - kept_alive_ < keep_alive_every_)
        return;
    kept_alive_ = now;
    (void)send("OPTIONS", url_.address, "");
}

// The time stamp of an RTP packet is the same for all packets of a picture.
void Rtsp::note_arrival(std::string_view packet) {
    if (packet.size() < 12)
        return;
    std::uint32_t stamp = 0;
    for (int i = 4; i < 8; ++i)
        stamp = stamp << 8 | std::uint8_t(packet[std::size_t(i)]);
    if (picture_ == stamp)
        return;
    ticks_ += picture_ ? std::int32_t(stamp - *picture_) : 0;
    const TimePoint arrived =
        clock_.captured(Duration(1000 * ticks_ / rtp_ticks_per_ms), steady_now());
    began_before_ = picture_ ? began_ : arrived;
    began_ = arrived;
    picture_ = stamp;
}

// One packet, or an error at the end of the connection.
int Rtsp::read_packet(std::uint8_t* out, int size) {
    constexpr std::size_t header = 4;
    for (std::size_t passed_over = 0; passed_over < most_passed_over;) {
        keep_alive();
        if (!connection_.need(header, [this] { keep_alive(); }))
            return AVERROR_EOF;
        const std::string_view head = connection_.buffered();
        if (head.starts_with("RTSP")) {
            const auto response = receive(nullptr);
            if (!response || (response->status != 200 && response->status != 501))
                return AVERROR_EOF;
            passed_over += max_rtsp_head;
            continue;
        }
        if (head[0] != '$')
            return AVERROR_EOF;
        const int channel = std::uint8_t(head[1]);
        const std::size_t count = std::size_t(std::uint8_t(head[2]) << 8 | std::uint8_t(head[3]));
        if (!connection_.need(header + count, [this] { keep_alive(); }))
            return AVERROR_EOF;
        const std::string_view packet = connection_.buffered().substr(header, count);
        const bool is_video = channel == channel_, is_report = channel == channel_ + 1;
        if (is_video)
            note_arrival(packet);
        const int copied = std::min(size, int(count));
        if (is_video || is_report)
            std::memcpy(out, packet.data(), std::size_t(copied));
        connection_.drop(header + count);
        if ((is_video || is_report) && copied > 0)
            return copied;
        passed_over += header + count;
    }
    return AVERROR_EOF;
}

std::optional<VideoAnswer> Rtsp::next() {
    for (int left_out = 0; video_.decode(); ++left_out) {
        const TimePoint time = from_us(video_.stamp());
        if (steady_now() - time > most_behind && connection_.has_more() && left_out < most_left_out)
            continue;
        video_.write();
        return VideoAnswer{.kind = Kind::picture, .time = Duration(video_.stamp()), .size = {}};
    }
    return std::nullopt;
}

}  // namespace

void serve_rtsp(sandbox::Inside& inside) {
    serve_source<Rtsp>(inside);
}

}  // namespace theatron::capture
