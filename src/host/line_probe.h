// SPDX-License-Identifier: Apache-2.0
// A page measures its line by this, mostly before somebody joins: by an answer of some bytes, and
// by a body that is read and dropped. All who measure share one bucket of bytes, so that a session
// keeps its line whoever asks how often.
//
// Time is an argument. Not thread safe.
#pragma once

#include <cstdint>

#include "base/time.h"
#include "net/http.h"
#include "session/request_budget.h"

namespace theatron::host {

class LineProbe {
public:
    // Bytes of one answer, and of one body. A measurement takes one answer and some bodies.
    static constexpr std::uint64_t max_answer_bytes = 2 * 1024 * 1024;
    static constexpr std::uint64_t max_body_bytes = 256 * 1024;
    // Bytes of all measurements, in both directions.
    static constexpr double max_bytes_per_second = 256 * 1024, max_bytes_at_once = 12 * 1024 * 1024;
    // That a request counts at least: it costs a handshake.
    static constexpr std::uint64_t least_bytes = 1024;

    // True for the page of this class.
    static bool is_line(const net::HttpRequest& request);

    // GET with ?bytes=N, 0 without it: N bytes that nothing on the way can compress. 400 for
    // another number, 429 while the bucket lacks them. The caller has checked the link.
    net::HttpAnswer answer(const net::HttpRequest& request, TimePoint now);
    // POST with a body of this size: 204 if it may come, else 413 or 429.
    net::HttpAnswer take_body(std::uint64_t bytes, TimePoint now);

private:
    bool take(std::uint64_t bytes, TimePoint now);

    session::TokenBucket bytes_{max_bytes_per_second, max_bytes_at_once};
};

}  // namespace theatron::host
