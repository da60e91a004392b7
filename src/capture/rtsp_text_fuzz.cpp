// SPDX-License-Identifier: Apache-2.0
// The text of an RTSP server must be safe in any form: responses, challenges, descriptions.
#include <cstdint>
#include <cstdlib>

#include "capture/rtsp_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron::capture;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)parse_rtsp_url(text);
    if (const auto response = parse_rtsp_response(text)) {
        if (response->body_bytes > max_rtsp_description || response->session_timeout_s < 1)
            std::abort();
        const RtspUrl url{"host", 554, "user", "secret", "rtsp://host/"};
        const std::string answer =
            rtsp_authorization(url, response->challenge, "DESCRIBE", url.address);
        // A header of its own would be another request.
        if (answer.find_first_of("\r\n") != std::string::npos)
            std::abort();
    }
    // One empty line: a second one would be another answer.
    if (const std::string answer = answer_to_rtsp_request(text);
        !answer.empty() && answer.find("\r\n\r\n") != answer.size() - 4)
        std::abort();
    if (const auto track = find_rtsp_track(text, "rtsp://host/"))
        if (track->control.find_first_of("\r\n ") != std::string::npos)
            std::abort();
    return 0;
}
