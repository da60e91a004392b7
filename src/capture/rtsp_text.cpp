// SPDX-License-Identifier: Apache-2.0
#include "capture/rtsp_text.h"
#include "base/small_letters.h"
#include "base/trimmed.h"
#include "ffmpeg/ffmpeg.h"

extern "C" {
#include <libavutil/base64.h>
#include <libavutil/md5.h>
}

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

namespace theatron::capture {
namespace {

constexpr std::string_view scheme = "rtsp://";
constexpr int max_sequence = 1'000'000'000;

bool begins_with_word(std::string_view text, std::string_view word) {
    return text.size() >= word.size() && equal_without_case(text.substr(0, word.size()), word);
}

// Takes the text up to `end` off `rest`.
std::string_view cut(std::string_view& rest, char end) {
    const auto at = rest.find(end);
    const std::string_view part = rest.substr(0, at);
    rest = at == std::string_view::npos ? std::string_view{} : rest.substr(at + 1);
    return part;
}

std::optional<int> number(std::string_view text, int least, int most) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most)
        return std::nullopt;
    return value;
}

bool is_printable(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
}

std::optional<std::string> without_percents(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            plain += text[i];
            continue;
        }
        unsigned value = 0;
        const char* const digits = text.data() + i + 1;
        if (i + 2 >= text.size() ||
            std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2)
            return std::nullopt;
        plain += char(value);
        i += 2;
    }
    return plain;
}

// The value of name="value" or name=value in a list of these.
std::string parameter(std::string_view list, std::string_view name) {
    while (!list.empty()) {
        const std::string_view key = trimmed(cut(list, '='));
        std::string_view value;
        if (!list.empty() && list.front() == '"') {
            list.remove_prefix(1);
            value = cut(list, '"');
            cut(list, ',');
        } else {
            value = trimmed(cut(list, ','));
        }
        if (equal_without_case(key, name))
            return std::string(value);
    }
    return "";
}

std::string md5(const std::string& text) {
    ffmpeg::load_if_there();
    std::uint8_t sum[16];
    av_md5_sum(sum, reinterpret_cast<const std::uint8_t*>(text.data()), int(text.size()));
    std::string hex;
    for (const std::uint8_t byte : sum) {
        hex += "0123456789abcdef"[byte >> 4];
        hex += "0123456789abcdef"[byte & 15];
    }
    return hex;
}

// The characters that libavformat may get of a track: letters, digits and what parameters consist
// of.
bool is_harmless(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; });
}

bool is_known_video(std::string_view encoding) {
    // Some servers name a number of channels, too, which is for sound.
    if (encoding.ends_with("/1"))
        encoding.remove_suffix(2);
    for (const std::string_view name : {"H264/90000", "H265/90000", "JPEG/90000", "MP4V-ES/90000"})
        if (equal_without_case(encoding, name))
            return true;
    return false;
}

// A digest by another function cannot be answered.
bool is_known_digest(std::string_view challenge) {
    if (!begins_with_word(challenge, "Digest"))
        return false;
    const std::string algorithm = parameter(challenge.substr(6), "algorithm");
    return algorithm.empty() || equal_without_case(algorithm, "MD5");
}

void read_header(std::string_view name, std::string_view value, RtspResponse& response,
                 bool& is_bad) {
    if (equal_without_case(name, "Content-Length")) {
        const auto bytes = number(value, 0, int(max_rtsp_description));
        is_bad = is_bad || !bytes;
        response.body_bytes = std::size_t(bytes.value_or(0));
    } else if (equal_without_case(name, "CSeq")) {
        response.sequence = number(value, 0, max_sequence).value_or(0);
    } else if (equal_without_case(name, "Location")) {
        response.location = value;
    } else if (equal_without_case(name, "Session")) {
        response.session = trimmed(cut(value, ';'));
        if (const auto seconds = number(parameter(value, "timeout"), 1, 3600))
            response.session_timeout_s = *seconds;
    } else if (equal_without_case(name, "Content-Base")) {
        response.base = value;
    } else if (equal_without_case(name, "WWW-Authenticate")) {
        const bool is_better =
            !is_known_digest(response.challenge) && begins_with_word(value, "Basic");
        if (response.challenge.empty() || is_known_digest(value) || is_better)
            response.challenge = value;
    } else if (equal_without_case(name, "Transport")) {
        response.is_over_udp =
            equal_without_case(trimmed(value.substr(0, value.find(';'))), "RTP/AVP") ||
            begins_with_word(value, "RTP/AVP/UDP");
        while (!value.empty()) {
            std::string_view part = trimmed(cut(value, ';'));
            if (equal_without_case(cut(part, '='), "interleaved"))
                response.channel = number(cut(part, '-'), 0, 255);
        }
        response.is_over_udp = response.is_over_udp && !response.channel;
    }
}

}  // namespace

std::optional<RtspUrl> parse_rtsp_url(std::string_view text) {
    if (!text.starts_with(scheme) || text.size() > max_rtsp_url || !is_printable(text))
        return std::nullopt;
    std::string_view rest = text.substr(scheme.size());
    const auto slash = std::min(rest.find('/'), rest.size());
    std::string_view authority = rest.substr(0, slash);
    RtspUrl url;
    if (const auto at = authority.rfind('@'); at != std::string_view::npos) {
        std::string_view person = authority.substr(0, at);
        const auto user = without_percents(cut(person, ':'));
        const auto password = without_percents(person);
        if (!user || !password)
            return std::nullopt;
        url.user = *user;
        url.password = *password;
        authority.remove_prefix(at + 1);
    }
    url.address = std::string(scheme) + std::string(authority) + std::string(rest.substr(slash));
    if (authority.starts_with('[')) {
        authority.remove_prefix(1);
        url.host = cut(authority, ']');
        if (!authority.empty() && authority.front() != ':')
            return std::nullopt;
        if (!authority.empty())
            authority.remove_prefix(1);
    } else {
        url.host = cut(authority, ':');
    }
    if (!authority.empty()) {
        const auto port = number(authority, 1, 65535);
        if (!port)
            return std::nullopt;
        url.port = *port;
    }
    return url.host.empty() ? std::nullopt : std::optional(url);
}

Result<RtspResponse> parse_rtsp_response(std::string_view head) {
    if (head.size() > max_rtsp_head)
        return Status::too_large;
    RtspResponse response;
    std::string_view first = trimmed(cut(head, '\n'));
    if (!first.starts_with("RTSP/1."))
        return Status::malformed;
    cut(first, ' ');
    const auto status = number(cut(first, ' '), 100, 999);
    if (!status)
        return Status::malformed;
    response.status = *status;
    bool is_bad = false;
    while (!head.empty()) {
        std::string_view line = trimmed(cut(head, '\n'));
        const std::string_view name = trimmed(cut(line, ':'));
        read_header(name, trimmed(line), response, is_bad);
    }
    if (is_bad)
        return Status::too_large;
    if (!is_printable(response.session) || !is_printable(response.base) ||
        !is_printable(response.location) || response.location.size() > max_rtsp_url)
        return Status::malformed;
    return response;
}

std::size_t rtsp_head_bytes(std::string_view text) {
    for (auto at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) {
        const std::string_view next = text.substr(at + 1, 2);
        if (next.starts_with('\n'))
            return at + 2;
        if (next == "\r\n")
            return at + 3;
    }
    return std::string_view::npos;
}

std::string answer_to_rtsp_request(std::string_view head) {
    std::string_view first = trimmed(cut(head, '\n'));
    const std::string_view method = cut(first, ' ');
    cut(first, ' ');
    const bool is_method = !method.empty() && std::all_of(method.begin(), method.end(), [](char c) {
        return (c >= 'A' && c <= 'Z') || c == '_';
    });
    if (!first.starts_with("RTSP/1.") || !is_method)
        return "";
    const bool is_known =
        method == "OPTIONS" || method == "SET_PARAMETER" || method == "GET_PARAMETER";
    while (!head.empty()) {
        std::string_view line = trimmed(cut(head, '\n'));
        if (const std::string_view name = trimmed(cut(line, ':'));
            !equal_without_case(name, "CSeq"))
            continue;
        const auto sequence = number(trimmed(line), 0, max_sequence);
        return sequence ? std::string("RTSP/1.0 ") + (is_known ? "200 OK" : "501 Not Implemented") +
                              "\r\nCSeq: " + std::to_string(*sequence) +
                              "\r\nPublic: OPTIONS, SET_PARAMETER, GET_PARAMETER\r\n\r\n"
                        : "";
    }
    return "";
}

std::optional<RtspTrack> find_rtsp_track(std::string_view description, std::string_view base) {
    struct Media {
        bool is_video = false, is_known = false;
        std::string format, control;
        std::vector<std::string> lines;
    };
    Media media;
    std::string session_control;
    bool in_session = true;
    const auto is_wanted = [&] { return media.is_video && media.is_known; };
    while (!description.empty()) {
        std::string_view line = trimmed(cut(description, '\n'));
        if (line.starts_with("m=")) {
            if (is_wanted())
                break;
            in_session = false;
            media = {};
            // "video 0 RTP/AVP 96"
            std::string_view rest = line.substr(2);
            const bool is_video = cut(rest, ' ') == "video";
            cut(rest, ' ');
            cut(rest, ' ');
            media.format = cut(rest, ' ');
            const auto format = number(media.format, 0, 127);
            media.is_video = is_video && format;
            media.is_known = media.is_video && *format == 26;  // JPEG has a number of its own
        } else if (line.starts_with("a=control:")) {
            (in_session ? session_control : media.control) = line.substr(10);
        } else if (line.starts_with("a=rtpmap:" + media.format + " ") && is_harmless(line)) {
            media.is_known = media.is_known ||
                             is_known_video(line.substr(("a=rtpmap:" + media.format + " ").size()));
            media.lines.emplace_back(line);
        } else if ((line.starts_with("a=fmtp:" + media.format + " ") ||
                    line.starts_with("a=framerate:")) &&
                   is_harmless(line)) {
            media.lines.emplace_back(line);
        }
    }
    if (!is_wanted())
        return std::nullopt;
    RtspTrack track;
    track.description = "v=0\r\no=- 0 0 IN IP4 0.0.0.0\r\ns=-\r\nt=0 0\r\nm=video 0 RTP/AVP " +
                        media.format + "\r\n";
    for (const std::string& line : media.lines)
        track.description += line + "\r\n";
    if (session_control.starts_with(scheme))
        base = session_control;
    track.aggregate = base;
    if (media.control.starts_with(scheme))
        track.control = media.control;
    else if (media.control.empty() || media.control == "*")
        track.control = base;
    else
        track.control = std::string(base) + (base.ends_with('/') ? "" : "/") + media.control;
    for (const std::string* address : {&track.control, &track.aggregate})
        if (!is_printable(*address) || address->size() > 2 * max_rtsp_url)
            return std::nullopt;
    return track;
}

std::string rtsp_authorization(const RtspUrl& url, std::string_view challenge,
                               std::string_view method, std::string_view address, unsigned count) {
    if (begins_with_word(challenge, "Basic")) {
        ffmpeg::load_if_there();
        const std::string plain = url.user + ":" + url.password;
        std::string coded(AV_BASE64_SIZE(plain.size()), '\0');
        if (!av_base64_encode(coded.data(), int(coded.size()),
                              reinterpret_cast<const std::uint8_t*>(plain.data()),
                              int(plain.size())))
            return "";
        return "Basic " + std::string(coded.c_str());
    }
    if (!is_known_digest(challenge))
        return "";
    challenge.remove_prefix(6);
    const std::string realm = parameter(challenge, "realm"), nonce = parameter(challenge, "nonce"),
                      opaque = parameter(challenge, "opaque"),
                      quality = parameter(challenge, "qop");
    for (const std::string* text : {&realm, &nonce, &opaque})
        if (!is_harmless(*text))
            return "";
    const std::string person = md5(url.user + ":" + realm + ":" + url.password);
    const std::string what = md5(std::string(method) + ":" + std::string(address));
    // RFC 2617. The nonce of the client protects passwords from chosen ones of the server, which
    // may as well ask for them in plain text (Basic).
    char number_text[16];
    std::snprintf(number_text, sizeof(number_text), "%08x", count);
    const std::string own = std::string(number_text) + ":theatron:auth:";
    const std::string response =
        md5(person + ":" + nonce + ":" + (quality.empty() ? "" : own) + what);
    std::string text = "Digest username=\"" + url.user + "\", realm=\"" + realm + "\", nonce=\"" +
                       nonce + "\", uri=\"" + std::string(address) + "\", response=\"" + response +
                       "\"";
    if (!quality.empty())
        text += ", qop=auth, nc=" + std::string(number_text) + ", cnonce=\"theatron\"";
    if (!opaque.empty())
        text += ", opaque=\"" + opaque + "\"";
    return text;
}

std::string moved_rtsp_address(std::string_view address, std::string_view location) {
    if (location.find("://") != std::string_view::npos)
        return std::string(location);
    // Behind the host, or behind the last folder of the path.
    const auto host_end = std::min(address.find('/', scheme.size()), address.size());
    const auto folder_end = std::max(address.substr(0, address.find('?')).rfind('/') + 1, host_end);
    const bool is_whole = location.starts_with('/');
    std::string moved(address.substr(0, is_whole ? host_end : folder_end));
    if (!is_whole && !moved.ends_with('/'))
        moved += '/';
    return moved + std::string(location);
}

}  // namespace theatron::capture
