// SPDX-License-Identifier: Apache-2.0
// The text of RTSP 1.0 (RFC 2326) and SDP (RFC 8866) that a client of one video track reads and
// writes. Pure; what servers send is untrusted.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/status.h"

namespace theatron::capture {

inline constexpr std::size_t max_rtsp_url = 1000;       // characters
inline constexpr std::size_t max_rtsp_head = 16 << 10;  // bytes of a response without its body
inline constexpr std::size_t max_rtsp_description = 64 << 10;  // bytes of a body
inline constexpr int usual_rtsp_port = 554;

// rtsp://USER:PASSWORD@HOST:PORT/PATH, where all but the host may be left out.
struct RtspUrl {
    std::string host;
    int port = usual_rtsp_port;
    std::string user, password;  // without percent signs
    std::string address;         // the URL without user and password, as requests name it
};
std::optional<RtspUrl> parse_rtsp_url(std::string_view text);

struct RtspResponse {
    int status = 0;
    int sequence = 0;  // CSeq; 0: none
    std::size_t body_bytes = 0;
    std::string session;         // without its timeout
    int session_timeout_s = 60;  // 1 to 3600
    std::string base;            // Content-Base, may be empty
    std::string challenge;       // the strongest known of WWW-Authenticate: digest, then basic
    std::optional<int> channel;  // of Transport: interleaved, the first
    bool is_over_udp = false;    // Transport names another way than this connection
    std::string location;        // of a server that has moved; may be relative
};
// `head` ends behind the empty line. Refuses what is no response, and bodies that are too long.
Result<RtspResponse> parse_rtsp_response(std::string_view head);

// The number of bytes up to the end of the empty line, which has or lacks carriage returns; npos:
// there is none.
std::size_t rtsp_head_bytes(std::string_view text);

// The answer to a request of the server: that this client is still there, or that it does not know
// the method. `head` as above. Empty: it is no request.
std::string answer_to_rtsp_request(std::string_view head);

// The first video track of a description that is H.264, H.265, MPEG-4 or JPEG, as a description of
// its own: of the server's lines only the payload's name and parameters. nullopt: there is none.
struct RtspTrack {
    std::string description;
    std::string control;    // the URL for SETUP
    std::string aggregate;  // the URL for PLAY
};
std::optional<RtspTrack> find_rtsp_track(std::string_view description, std::string_view base);

// The value of the header Authorization that answers the challenge, for the `count`th time; empty
// if this one is unknown.
std::string rtsp_authorization(const RtspUrl& url, std::string_view challenge,
                               std::string_view method, std::string_view address,
                               unsigned count = 1);

// The address that a server of `address` has moved to, where it may name the path alone.
std::string moved_rtsp_address(std::string_view address, std::string_view location);

}  // namespace theatron::capture
