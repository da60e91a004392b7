// SPDX-License-Identifier: Apache-2.0
// Limits of a link, and of each person who comes by it, on whichever connections: a new connection
// costs nothing, so limits of a connection alone hold nobody back.
//
// Pure; time is passed in. People are told apart by the id of their program (wire::Join::person);
// those without one count as one person of their link.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "base/bytes.h"
#include "base/time.h"
#include "session/remembered_people.h"
#include "session/request_budget.h"

namespace theatron::session {

class LinkBudgets {
public:
    using Limit = RequestBudget::Limit;
    // People who come by one link for the first time. As many come at once as can be in by it.
    static constexpr Limit newcomers{1, 64};
    // Those who come back, by one link and each of them: a person has several programs, and a
    // network that breaks brings all of them at once.
    static constexpr Limit returns{8, 128};
    static constexpr Limit own_returns{1, 20};
    // The share of a link for those who were here for `settles_after` without a break, so that
    // others who come and go by the same link do not keep them out.
    static constexpr Limit settled_returns{64, 512};
    static constexpr Duration settles_after = std::chrono::seconds(10);
    // Cameras that are offered, by one link and by each person.
    static constexpr Limit offers{4, 128};
    static constexpr Limit own_offers{2, 40};
    // Time for which somebody who was here may come back.
    static constexpr Duration remembered = std::chrono::minutes(10);
    // People of one link that are remembered.
    static constexpr std::size_t max_people = 1024;
    // After a flood its person is kept out for `flood_pause`, and the link has `flood_cost`
    // newcomers less.
    static constexpr Duration flood_pause = std::chrono::seconds(10);
    static constexpr double flood_cost = 10;

    enum class Answer : std::uint8_t { granted, too_often, after_flood };
    // The person comes by this link.
    Answer join(const std::string& link, const Bytes& person, TimePoint now);
    // The person offers this number of cameras. False: too often.
    bool offer(const std::string& link, const Bytes& person, std::size_t cameras, TimePoint now);
    // Has sent far too many requests, for which its connection ends.
    void note_flood(const std::string& link, const Bytes& person, TimePoint now);
    // The person is here. To be called now and then while it is.
    void note_here(const std::string& link, const Bytes& person, TimePoint now);

private:
    struct Person {
        TokenBucket returns{own_returns.per_second, own_returns.at_once};
        TokenBucket offers{own_offers.per_second, own_offers.at_once};
        std::optional<TimePoint> kept_out_until;
        TimePoint came;  // the last time
        bool has_settled = false;
    };
    struct Link {
        TokenBucket newcomers{LinkBudgets::newcomers.per_second, LinkBudgets::newcomers.at_once};
        TokenBucket returns{LinkBudgets::returns.per_second, LinkBudgets::returns.at_once};
        TokenBucket settled{settled_returns.per_second, settled_returns.at_once};
        TokenBucket offers{LinkBudgets::offers.per_second, LinkBudgets::offers.at_once};
        RememberedPeople<Person> people{max_people};
    };

    std::map<std::string, Link> links_;
};

}  // namespace theatron::session
