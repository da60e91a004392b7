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
#include <span>
#include <utility>

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

// Bytes that may come between two packets of this track: of other channels, or of none.
constexpr std::size_t most_passed_over = std::size_t(1) << 20;
constexpr std::size_t most_stray_bytes = std::size_t(64) << 10;
// "$", the channel and the number of bytes.
constexpr std::size_t packet_head = 4;
constexpr int packet_bytes = 65536;
// A picture older than `most_behind` is left out while more has arrived; at most `most_left_out` in
// a row.
constexpr Duration most_behind = 100ms;
constexpr int most_left_out = 10;
constexpr int rtp_ticks_per_ms = 90;  // of all video
constexpr Duration longest_analysis = 2s;
// A server may say nothing for this long until its stream is open: shorter than the caller waits.
constexpr Duration longest_silence = 8s;

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
    // while nothing comes, each second, and says whether to wait on.
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
                if (!idle())
                    return false;
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

constexpr const char* play = "PLAY";

bool is_moved(int status) {
    return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}

class Rtsp {
public:
    Rtsp(const SourceOpening& opening, sandbox::Inside& inside)
        : wanted_(opening.wanted),
          url_(parse_rtsp_url(opening.text).value_or(RtspUrl{})),
          connection_(inside.input()),
          area_(inside.area()),
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
    VideoAnswer begin();
    bool waits_on();
    // The kind of data at the beginning of the connection's buffer.
    enum class Next : std::uint8_t { packet, response, request, end };
    template <class Idle>
    Next find_next(const Idle& idle);
    template <class Idle>
    std::string_view read_head(const Idle& idle);
    template <class Idle>
    bool answer_request(const Idle& idle);
    template <class Idle>
    std::optional<RtspResponse> receive(std::string* body, const Idle& idle);
    bool take_response(const RtspResponse& response);
    void take_challenge(const RtspResponse& response) {
        challenge_ = response.challenge;
        challenge_uses_ = 0;
    }
    VideoAnswer moved(const std::string& location);
    std::optional<RtspResponse> ask(const std::string& method, const std::string& address,
                                    const std::string& headers, std::string* body = nullptr);
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
    std::span<std::byte> area_;
    int sent_ = 0;  // requests
    std::string challenge_, session_;
    unsigned challenge_uses_ = 0;
    std::string aggregate_;  // the address of PLAY
    std::optional<TimePoint> opening_since_;
    bool silent_ = false;  // nothing came for too long
    // A request whose response comes between packets.
    struct Outstanding {
        std::string method, headers;
        int sequence = 0;
        bool is_repeated = false;  // with an answer to its challenge
    };
    static constexpr std::size_t most_outstanding = 4;  // some servers never answer keep-alives
    std::deque<Outstanding> outstanding_;
    bool send_between(Outstanding request);
    std::optional<Kind> refusal_;  // of PLAY
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
        if (const std::string answer =
                rtsp_authorization(url_, challenge_, method, address, ++challenge_uses_);
            !answer.empty())
            text += "Authorization: " + answer + "\r\n";
    return connection_.send(text + "\r\n");
}

// Stray bytes are passed over up to a response, a request of the server, or a packet of this track.
template <class Idle>
Rtsp::Next Rtsp::find_next(const Idle& idle) {
    for (std::size_t stray = 0; stray <= most_stray_bytes; ++stray) {
        // The first byte of RTP says version 2.
        if (!connection_.need(packet_head + (stray > 0 ? 1 : 0), idle))
            return Next::end;
        const std::string_view next = connection_.buffered();
        const auto is_own = [&] {
            const int channel = std::uint8_t(next[1]);
            return (channel == channel_ || channel == channel_ + 1) &&
                   (std::uint8_t(next[packet_head]) & 0xc0) == 0x80;
        };
        if (next[0] == '$' && (stray == 0 || is_own()))
            return Next::packet;
        if (next.starts_with("RTSP"))
            return Next::response;
        for (const std::string_view method :
             {"OPTI", "SET_", "GET_", "ANNO", "REDI", "TEAR", "PAUS", "PLAY"})
            if (next.starts_with(method))
                return Next::request;
        connection_.drop(1);
    }
    return Next::end;
}

// The text up to the empty line, which stays in the buffer. Empty: there is none.
template <class Idle>
std::string_view Rtsp::read_head(const Idle& idle) {
    for (std::size_t wanted = 1; wanted <= max_rtsp_head;
         wanted = connection_.buffered().size() + 1) {
        if (!connection_.need(wanted, idle))
            return {};
        const std::string_view text = connection_.buffered();
        if (const auto bytes = rtsp_head_bytes(text); bytes != std::string_view::npos)
            return text.substr(0, bytes);
    }
    return {};
}

// Bytes that are no request after all are stray.
template <class Idle>
bool Rtsp::answer_request(const Idle& idle) {
    const std::string_view head = read_head(idle);
    const std::string answer = answer_to_rtsp_request(head);
    connection_.drop(answer.empty() ? 1 : head.size());
    return answer.empty() || connection_.send(answer);
}

// The next response. Packets before it are left out.
template <class Idle>
std::optional<RtspResponse> Rtsp::receive(std::string* body, const Idle& idle) {
    for (std::size_t passed_over = 0; passed_over < most_passed_over;) {
        switch (find_next(idle)) {
            case Next::end:
                return std::nullopt;
            case Next::packet: {
                const std::string_view head = connection_.buffered();
                const std::size_t count =
                    packet_head + std::size_t(std::uint8_t(head[2]) << 8 | std::uint8_t(head[3]));
                if (!connection_.need(count, idle))
                    return std::nullopt;
                connection_.drop(count);
                passed_over += count;
                continue;
            }
            case Next::request:
                if (!answer_request(idle))
                    return std::nullopt;
                passed_over += max_rtsp_head;
                continue;
            case Next::response:
                break;
        }
        const std::string_view head = read_head(idle);
        const auto response = parse_rtsp_response(head);
        if (!response)
            return std::nullopt;
        connection_.drop(head.size());
        if (!connection_.need(response->body_bytes, idle))
            return std::nullopt;
        if (body)
            *body = connection_.buffered().substr(0, response->body_bytes);
        connection_.drop(response->body_bytes);
        return *response;
    }
    return std::nullopt;
}

// Answers a challenge once: each request may need the newest one.
std::optional<RtspResponse> Rtsp::ask(const std::string& method, const std::string& address,
                                      const std::string& headers, std::string* body) {
    if (!send(method, address, headers))
        return std::nullopt;
    const auto idle = [this] { return waits_on(); };
    auto response = receive(body, idle);
    if (!response || response->status != 401 || response->challenge.empty() || url_.user.empty())
        return response;
    take_challenge(*response);
    return send(method, address, headers) ? receive(body, idle) : std::nullopt;
}

// The response is read with the packets, which may come before it.
bool Rtsp::send_between(Outstanding request) {
    const bool is_sent = send(request.method, aggregate_, request.headers);
    request.sequence = sent_;
    outstanding_.push_back(std::move(request));
    if (outstanding_.size() > most_outstanding)
        outstanding_.pop_front();
    return is_sent;
}

// The response to a request, between packets. False ends the stream.
bool Rtsp::take_response(const RtspResponse& response) {
    const auto found =
        std::find_if(outstanding_.begin(), outstanding_.end(), [&](const Outstanding& one) {
            return response.sequence == 0 || response.sequence == one.sequence;
        });
    if (found == outstanding_.end())
        return true;
    Outstanding request = std::move(*found);
    outstanding_.erase(found);
    if (response.status == 401 && !response.challenge.empty() && !url_.user.empty() &&
        !request.is_repeated) {
        take_challenge(response);
        request.is_repeated = true;
        return send_between(std::move(request));
    }
    // Servers that know no keep-alive say so, and go on.
    if (request.method != play || response.status == 200)
        return true;
    refusal_ = response.status == 401 || response.status == 403 ? Kind::denied : Kind::refused;
    return false;
}

// The address goes through the shared memory to the process that may connect to it.
VideoAnswer Rtsp::moved(const std::string& location) {
    if (location.empty() || location.size() >= area_.size())
        return {.kind = Kind::refused};
    const ByteView bytes = as_bytes(location);
    std::copy(bytes.begin(), bytes.end(), area_.begin());
    area_[location.size()] = std::byte{0};
    return {.kind = Kind::moved};
}

bool Rtsp::waits_on() {
    silent_ = opening_since_ && steady_now() - *opening_since_ > longest_silence;
    return !silent_;
}

VideoAnswer Rtsp::open() {
    av_log_set_level(AV_LOG_QUIET);
    opening_since_ = steady_now();
    VideoAnswer opened = begin();
    opening_since_.reset();
    if (opened.kind != Kind::opened && silent_)
        opened.kind = Kind::silent;
    return opened;
}

VideoAnswer Rtsp::begin() {
    std::string description;
    auto response = ask("DESCRIBE", url_.address, "Accept: application/sdp\r\n", &description);
    if (!response)
        return {.kind = Kind::unreadable};
    if (response->status == 401 || response->status == 403)
        return {.kind = Kind::denied};
    if (is_moved(response->status))
        return moved(response->location);
    if (response->status != 200)
        return {.kind = response->status == 404 ? Kind::not_found : Kind::refused};
    const auto track = find_rtsp_track(
        description, response->base.starts_with("rtsp://") ? response->base : url_.address);
    if (!track)
        return {.kind = Kind::no_video};
    response = ask("SETUP", track->control, "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n");
    if (!response)
        return {.kind = Kind::unreadable};
    if (response->status == 461 || (response->status == 200 && response->is_over_udp))
        return {.kind = Kind::only_udp};
    if (response->status != 200)
        return {.kind = response->status == 401 ? Kind::denied : Kind::refused};
    aggregate_ = track->aggregate;
    session_ = response->session;
    channel_ = response->channel.value_or(0);
    keep_alive_every_ = std::chrono::seconds(std::max(1, response->session_timeout_s / 2));
    if (!send_between({play, "Range: npt=0.000-\r\n"}))
        return {.kind = Kind::unreadable};
    kept_alive_ = steady_now();
    VideoAnswer opened = open_track(*track);
    if (opened.kind != Kind::opened && refusal_)
        opened.kind = *refusal_;
    return opened;
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
    (void)send_between({"OPTIONS", ""});
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
    const auto idle = [this] {
        keep_alive();
        return waits_on();
    };
    for (std::size_t passed_over = 0; passed_over < most_passed_over;) {
        keep_alive();
        const Next next = find_next(idle);
        if (next == Next::response) {
            const auto response = receive(nullptr, idle);
            if (!response || !take_response(*response))
                return AVERROR_EOF;
        } else if (next == Next::request && !answer_request(idle)) {
            return AVERROR_EOF;
        }
        if (next == Next::response || next == Next::request) {
            passed_over += max_rtsp_head;
            continue;
        }
        if (next == Next::end)
            return AVERROR_EOF;
        const std::string_view head = connection_.buffered();
        const int channel = std::uint8_t(head[1]);
        const std::size_t count = std::size_t(std::uint8_t(head[2]) << 8 | std::uint8_t(head[3]));
        if (!connection_.need(packet_head + count, idle))
            return AVERROR_EOF;
        const std::string_view packet = connection_.buffered().substr(packet_head, count);
        const bool is_video = channel == channel_, is_report = channel == channel_ + 1;
        if (is_video)
            note_arrival(packet);
        const int copied = std::min(size, int(count));
        if (is_video || is_report)
            std::memcpy(out, packet.data(), std::size_t(copied));
        connection_.drop(packet_head + count);
        if ((is_video || is_report) && copied > 0)
            return copied;
        passed_over += packet_head + count;
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
