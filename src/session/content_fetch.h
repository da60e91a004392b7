// SPDX-License-Identifier: Apache-2.0
// A participant's side of the transfer of content by its hash: asks for what it lacks, one content
// after the other, checks sizes before memory is taken and hashes at the end, and goes on after a
// loss of the connection where it was.
//
// A pure state machine: messages and times are passed in. Safe for untrusted hosts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/content_hash.h"
#include "base/time.h"
#include "wire/control.h"

namespace theatron::session {

class ContentFetch {
public:
    // Without an answer for this time the fetch asks again.
    static constexpr Duration answer_patience = std::chrono::seconds(5);
    // Bytes that were asked for and have not come.
    static constexpr std::uint64_t max_outstanding = 2 * wire::max_content_request;

    using MakeDigest = std::function<std::unique_ptr<ContentDigest>()>;
    explicit ContentFetch(MakeDigest make_digest) : make_digest_(std::move(make_digest)) {}

    struct Wanted {
        ContentHash hash;
        std::uint64_t size = 0;  // bytes, at least 1
        bool exact = true;       // else `size` is the most it may have
    };
    // All content that is wanted from now on, the most urgent first. Any other is forgotten.
    void want(std::vector<Wanted> wanted);

    // Requests of the previous connection are not answered any more.
    void on_connected();

    // Call it after each message and several times a second. At most a few requests at once.
    std::vector<wire::RequestContent> take_requests(TimePoint now);

    struct Complete {
        ContentHash hash;
        Bytes bytes;
    };
    // A piece has come. The content, once it is complete and its hash is right.
    std::optional<Complete> on_content(const wire::Content& piece, TimePoint now);

    enum class Failure {
        not_there,    // the host does not have it
        wrong_size,   // the host sent another size than it announced
        wrong_bytes,  // the hash is another one
    };
    // Content that is wanted and cannot be had from this host. It is not asked for again before
    // retry() or another connection.
    const std::map<ContentHash, Failure>& failures() const { return failures_; }
    void retry() { failures_.clear(); }

    // Counts everything wanted since nothing was.
    struct Progress {
        std::uint64_t got = 0, all = 0;  // bytes
    };
    Progress progress() const;

private:
    struct Current {
        Wanted wanted;
        std::uint64_t size = 0;  // bytes; 0: not known yet
        std::uint64_t asked = 0;
        Bytes bytes;
        std::unique_ptr<ContentDigest> digest;
    };
    void begin_next();
    void fail(Failure failure);

    MakeDigest make_digest_;
    std::vector<Wanted> wanted_;  // not complete
    std::uint64_t done_bytes_ = 0;
    std::optional<Current> current_;
    std::map<ContentHash, Failure> failures_;
    TimePoint heard_;  // the time of the newest piece or request
};

}  // namespace theatron::session
