// SPDX-License-Identifier: Apache-2.0
// Decides after the end of a participant's connection on another attempt, or none. Pure.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/time.h"
#include "wire/text.h"

namespace theatron::client {

class Attempts {
public:
    // `is_page`: the program came from the host with its page, and is made new by loading that
    // again, not by an update. `return_patience`: how long a host is waited for that said that it
    // may return; nullopt: for ever.
    explicit Attempts(bool is_page = false, std::optional<Duration> return_patience = std::nullopt)
        : is_page_(is_page), return_patience_(return_patience) {}

    // Waiting before another attempt: soon at first, then patiently. After a refusal, patiently.
    static constexpr Duration first_wait = std::chrono::milliseconds(200);
    static constexpr Duration longest_wait = std::chrono::seconds(2);

    // The host has taken this participant in, or lets it wait for admission.
    void came_in() {
        was_in_ = true;
        wait_ = first_wait;
        waited_for_return_ = {};
    }
    bool was_in() const { return was_in_; }

    struct End {
        wire::Text refusal, goodbye;  // of the host; empty: it said none
        std::string why;              // one sentence, for an end without them
        bool final = false;           // as net::Client::End::final
    };
    enum class Next : std::uint8_t { again, refused, ended };
    struct Judged {
        Next next{};
        std::string why;
        Duration wait{};  // until another attempt
        // A page that is of no use until it is loaded again; `why` says so.
        bool is_outdated = false;
    };
    // A refusal that is not for good (wire::is_for_good()) is final only for somebody who was never
    // in. A goodbye is final, but that of a host that may return: its sentence is the first reason,
    // then that of each attempt that failed.
    Judged after(const End& end);

private:
    const bool is_page_;
    bool was_in_ = false;
    Duration wait_ = first_wait;
    const std::optional<Duration> return_patience_;
    Duration waited_for_return_{};
};

}  // namespace theatron::client
