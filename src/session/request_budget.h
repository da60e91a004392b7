// SPDX-License-Identifier: Apache-2.0
// Rate limits for a participant's requests. Each kind of request has a bucket of tokens that fills
// with time. A request beyond it is not queued: the caller drops it, or keeps only the newest one
// of its kind for later. Far too many requests end the connection.
//
// Pure; time is passed in.
#pragma once

#include <array>
#include <cstdint>

#include "base/time.h"

namespace theatron::session {

// Up to `most` tokens; `per_second` more each second. Full at first.
class TokenBucket {
public:
    constexpr TokenBucket(double per_second, double most)
        : per_second_(per_second), most_(most), tokens_(most) {}

    // Takes this number of tokens if they are there. Time that runs backwards adds none.
    bool take(TimePoint now, double tokens = 1);
    // Takes this number in any case: those that are missing must fill first. At most one bucket of
    // them is missing.
    void owe(double tokens, TimePoint now);
    // Sets another limit. A larger bucket gets its additional tokens at once.
    void set_limit(double per_second, double most);

private:
    void fill(TimePoint now);

    double per_second_, most_, tokens_;
    TimePoint filled_;
    bool began_ = false;
};

class RequestBudget {
public:
    enum class Kind : std::uint8_t {
        codecs,    // other codecs
        delivery,  // another goal
        key,       // a key frame
        ping,
        report,
        publish,  // cameras that come or leave
        state,    // the condition of a camera
        room,     // a change of the room, a reply to a study
        manage,   // a decision of an operator
        other,    // unknown and unexpected messages
        content,  // a part of a case
        chat,     // a text to all others
    };
    static constexpr std::size_t kinds = 12;

    struct Limit {
        double per_second = 0;
        double at_once = 0;
    };
    // The limit of key requests is for each stream; a viewer repeats one after 700 ms, a recorder
    // sends one every 1.5 s.
    static constexpr std::array<Limit, kinds> limits{{{2, 5},
                                                      {2, 5},
                                                      {1, 4},
                                                      {20, 40},
                                                      {20, 40},
                                                      {2, 20},
                                                      {20, 80},
                                                      {40, 200},
                                                      {10, 40},
                                                      {5, 20},
                                                      {200, 400},
                                                      {1, 10}}};
    // Requests beyond the limits, of all kinds together, before the connection is ended.
    static constexpr Limit patience{50, 1000};

    // `streams`: number of streams in the session.
    explicit RequestBudget(std::size_t streams);
    // Streams have come or gone.
    void set_streams(std::size_t streams);

    enum class Answer : std::uint8_t { granted, too_often, flood };
    // A request has come.
    Answer ask(Kind kind, TimePoint now);
    // True if a request that was kept for later is granted now.
    bool grant_later(Kind kind, TimePoint now) { return bucket(kind).take(now); }

    // Requests that were not granted when they came.
    std::uint64_t refused() const { return refused_; }

private:
    TokenBucket& bucket(Kind kind) { return buckets_[std::size_t(kind)]; }

    std::array<TokenBucket, kinds> buckets_;
    TokenBucket patience_{patience.per_second, patience.at_once};
    std::uint64_t refused_ = 0;
};

}  // namespace theatron::session
