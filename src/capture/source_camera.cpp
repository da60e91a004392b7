// SPDX-License-Identifier: Apache-2.0
#include "capture/source_camera.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/shown_address.h"
#include "base/steady_clock.h"
#include "capture/readable_file.h"
#include "capture/rtsp_text.h"
#include "capture/source_inputs.h"
#include "capture/video_answer.h"
#include "capture/x11_windows.h"
#include "ffmpeg/ffmpeg.h"
#include "geometry/screen.h"
#include "image/frame_pool.h"
#include "sandbox/child.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

// The clock of a reader is not believed beyond this.
constexpr Duration oldest_picture = 10s;
constexpr std::size_t text_piece = sandbox::max_message_bytes - 1;
constexpr double least_fps = 1, most_fps = 60;

struct Opening {
    std::string reader;   // as in foreign_readers
    std::string subject;  // within a sentence, as "the window 'x'"
    std::string text;     // SourceOpening
    Size wanted;
    double frames_per_second = 30;
    // Pictures are made when they are asked for, at this rate; else they come by themselves.
    bool paced = false;
};

// Thrown by SourceCamera: its server is at another address, which is untrusted.
struct Moved {
    std::string address;
};

class SourceCamera final : public Camera {
public:
    SourceCamera(const SourceInput& input, const Opening& opening, std::string name, double width_m)
        : subject_(opening.subject),
          paced_(opening.paced),
          child_(opening.reader, input.descriptor(), opening.subject) {
        for (std::size_t at = 0; at < opening.text.size(); at += text_piece) {
            Bytes message{std::byte(VideoRequest::text)};
            const ByteView piece =
                as_bytes(opening.text).subspan(at, std::min(text_piece, opening.text.size() - at));
            message.insert(message.end(), piece.begin(), piece.end());
            child_.send(message);
        }
        Bytes message;
        ByteWriter out(message);
        out.put(std::uint8_t(VideoRequest::open));
        out.put(std::int32_t(opening.wanted.width));
        out.put(std::int32_t(opening.wanted.height));
        out.put_f64(opening.frames_per_second);
        child_.send(message);
        const VideoAnswer opened = answer();
        require_opened(opened);
        info_.name = std::move(name);
        info_.frames_per_second = std::clamp(opened.frames_per_second, least_fps, 4 * most_fps);
        info_.live = true;
        info_.calibration = screen_calibration(opened.size, width_m, usual_screen_place);
        info_.calibration.registered = false;
    }

    const CameraInfo& info() const override { return info_; }

    Capture next(Duration timeout) override {
        if (over_)
            return *over_;
        try {
            return take(timeout);
        } catch (const Error& problem) {
            over_ = {.kind = Capture::Kind::failed, .frame = {}, .problem = problem.what()};
            return *over_;
        }
    }

private:
    VideoAnswer answer() {
        const auto answer = decode_video_answer(child_.receive(), child_.area().size());
        if (!answer)
            child_.refuse("one that is " + std::string(to_text(answer.error())));
        return *answer;
    }

    std::string subject_at_start() const {
        std::string text = subject_;
        text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
        return text;
    }

    void require_opened(const VideoAnswer& opened) {
        switch (opened.kind) {
            case Kind::opened:
                return;
            case Kind::unreadable:
            case Kind::damaged:
                throw Error(subject_at_start() + " gives nothing that Theatron reads as video.");
            case Kind::no_video:
                throw Error(subject_at_start() + " has no video.");
            case Kind::no_decoder:
                throw Error(subject_at_start() + " has a video format that cannot be decoded.");
            case Kind::impossible_size:
                throw Error(subject_at_start() +
                            " has no size, or is larger than 4096 x 2700 pixels.");
            case Kind::refused:
                throw Error(subject_at_start() + " was refused by its server or driver.");
            case Kind::denied:
                throw Error(subject_at_start() +
                            " needs the right user and password, as in rtsp://USER:PASSWORD@HOST.");
            case Kind::hidden:
                throw Error(subject_at_start() + " is closed or minimised.");
            case Kind::not_found:
                throw Error(
                    subject_at_start() +
                    " is not there: its server knows no such path. Look for the path in the "
                    "manual of the camera.");
            case Kind::only_udp:
                throw Error(
                    subject_at_start() +
                    " comes over UDP only, which is not read; let its server send over TCP.");
            case Kind::silent:
                throw Error(subject_at_start() +
                            " has been without an answer or a picture for 8 s.");
            case Kind::moved: {
                std::string address;
                for (const std::byte byte : child_.area().first(max_rtsp_url)) {
                    if (byte == std::byte{0})
                        break;
                    address += char(byte);
                }
                throw Moved{std::move(address)};
            }
            default:
                child_.refuse("a picture before the description");
        }
    }

    // Asks for the next picture when it is due. False: not within the timeout.
    bool request(Duration timeout) {
        TimePoint now = steady_now();
        if (paced_) {
            if (due_ > now + timeout) {
                std::this_thread::sleep_for(timeout);
                return false;
            }
            std::this_thread::sleep_for(due_ - now);
            now = steady_now();
            // A late picture does not make the next one early.
            const Duration period = seconds_to_duration(1 / info_.frames_per_second);
            due_ = std::max(due_ + period, now);
        }
        const auto message = std::byte(VideoRequest::next);
        child_.send({&message, 1});
        requested_ = now;
        return true;
    }

    Capture take(Duration timeout) {
        const TimePoint end = steady_now() + timeout;
        if (requested_ == TimePoint{} && !request(timeout))
            return {};
        if (!child_.wait(std::max(Duration(0), end - steady_now())))
            return {};
        const VideoAnswer next = answer();
        const TimePoint now = steady_now();
        const TimePoint asked = std::exchange(requested_, TimePoint{});
        if (next.kind == Kind::end || next.kind == Kind::hidden)
            throw Error(subject_at_start() +
                        (next.kind == Kind::end ? " has ended." : " is closed or minimised."));
        if (next.kind != Kind::picture)
            child_.refuse("no picture");
        const auto frame = pool_.take();
        frame->number = number_++;
        frame->times = {};
        const TimePoint captured = paced_ ? asked : TimePoint(next.time);
        last_ = std::clamp(captured, std::max(now - oldest_picture, last_ + Duration(1)),
                           std::max(now, last_ + Duration(1)));
        frame->times.captured = last_;
        frame->depth.resize(screen_grid);
        std::fill(frame->depth.pixels.begin(), frame->depth.pixels.end(),
                  std::uint16_t(screen_distance_mm));
        const Size size = info_.calibration.color.size;
        frame->color.jpeg.clear();
        frame->color.size = size;
        frame->color.pixels.resize(size);
        // The shared memory may change at any time: any bytes are a picture.
        std::memcpy(frame->color.pixels.pixels.data(), child_.area().data(), 3 * size.area());
        if (!paced_)
            (void)request({});
        frame->times.delivered = steady_now();
        return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
    }

    std::string subject_;
    bool paced_;
    sandbox::Child child_;
    CameraInfo info_;
    FramePool pool_;
    FrameNumber number_ = 0;
    TimePoint due_, requested_, last_;
    std::optional<Capture> over_;
};

struct ScreenOptions {
    double width_m = 0;
    Size wanted;
    double frames_per_second = 30;
    std::string name;
};

ScreenOptions take_screen_options(Options& options) {
    ScreenOptions taken;
    taken.width_m = options.take_number("width", usual_screen_width_m, least_screen_width_m,
                                        largest_screen_width_m);
    taken.frames_per_second = options.take_number("fps", 30, least_fps, most_fps);
    taken.name = options.take("name");
    if (const std::string size = options.take("size"); !size.empty()) {
        char end = 0;
        if (std::sscanf(size.c_str(), "%4dx%4d%c", &taken.wanted.width, &taken.wanted.height,
                        &end) != 2 ||
            !is_valid(taken.wanted) || taken.wanted.area() > max_color_pixels)
            throw LastingError("size=" + size +
                               " is no size of a picture; write for example size=1280x720.");
    }
    return taken;
}

// `address` with user and password of `url`, as they are written there.
std::string with_user_of(const std::string& url, const std::string& address) {
    constexpr std::size_t scheme = std::string_view("rtsp://").size();
    const std::string authority = url.substr(scheme, url.find('/', scheme) - scheme);
    const auto at = authority.rfind('@');
    return at == std::string::npos
               ? address
               : address.substr(0, scheme) + authority.substr(0, at + 1) + address.substr(scheme);
}

}  // namespace

std::unique_ptr<Camera> open_rtsp_camera(Options& options, const Progress&) {
    const ScreenOptions taken = take_screen_options(options);
    options.require_no_problem();
    const auto url = parse_rtsp_url("rtsp:" + options.value());
    if (!url)
        throw LastingError(
            "A network stream is written as rtsp://HOST/PATH or "
            "rtsp://USER:PASSWORD@HOST:PORT/PATH.");
    const std::string subject = "the stream '" + shown_address(url->address) + "'";
    Opening opening{
        ffmpeg::needed_by("rtsp"), subject, "rtsp:" + options.value(), taken.wanted, 30, false};
    const auto open = [&](int port) {
        return std::make_unique<SourceCamera>(connect_to(url->host, port, subject), opening,
                                              taken.name.empty() ? url->host : taken.name,
                                              taken.width_m);
    };
    try {
        return open(url->port);
    } catch (const Moved& moved) {
        // Once, and never to another host, which would get the password.
        const auto other = parse_rtsp_url(moved_rtsp_address(url->address, moved.address));
        if (!other || other->host != url->host)
            throw Error("The server of " + subject +
                        " has moved it to another host; give the stream's new address.");
        opening.text = with_user_of(opening.text, other->address);
        try {
            return open(other->port);
        } catch (const Moved&) {
            throw Error("The server of " + subject +
                        " moves it again and again; give the address where it is.");
        }
    }
}

std::unique_ptr<Camera> open_v4l2_camera(Options& options, const Progress&) {
    const ScreenOptions taken = take_screen_options(options);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("A video device needs its file, as in v4l2:/dev/video0.");
    const std::filesystem::path path = options.value();
    const SourceInput device = open_video_device(path);
    const Opening opening{ffmpeg::needed_by("v4l2"),
                          "the video device " + quoted(path),
                          "",
                          taken.wanted,
                          taken.frames_per_second,
                          false};
    return std::make_unique<SourceCamera>(
        device, opening, taken.name.empty() ? path.filename().string() : taken.name, taken.width_m);
}

namespace {

// A source that was away is opened anew by the same text, which may now name another window: that
// one is not shown.
void require_shared_window(const std::string& text, const X11Window& found) {
    static std::mutex mutex;
    static std::map<std::string, X11Window> shared;  // by text
    const std::lock_guard lock(mutex);
    const auto [first, is_new] = shared.try_emplace(text, found);
    if (!is_new && !is_same_window(first->second, found))
        throw Error("The window '" + text +
                    "' that is there now is another one than the shared one; share it anew to "
                    "show it.");
    first->second = found;
}

}  // namespace

std::unique_ptr<Camera> open_x11_camera(Options& options, const Progress&) {
    const ScreenOptions taken = take_screen_options(options);
    const bool cursor = options.take_flag("cursor", true);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError(
            "Name a window, or display for all of it, as in x11:display; 'theatron cameras' lists "
            "the windows.");
    const X11Window window = find_window(options.value());
    require_shared_window(options.value(), window);
    const X11Connection x11 = connect_to_x11();
    const std::string subject = window.number == 0
                                    ? "the display '" + x11.display + "'"
                                    : "the window '" + number_text(window.number) + "'";
    const Opening opening{ffmpeg::needed_by("x11"),
                          subject,
                          std::to_string(x11.screen) + " " + std::to_string(window.number) +
                              (cursor ? " 1 " : " 0 ") + x11.cookie_hex,
                          taken.wanted,
                          taken.frames_per_second,
                          true};
    return std::make_unique<SourceCamera>(
        x11.input, opening, taken.name.empty() ? window.program : taken.name, taken.width_m);
}

}  // namespace theatron::capture
