// SPDX-License-Identifier: Apache-2.0
// Those whose connections ended a short while ago: what was decided when they joined holds when
// they come back. Pure; time is passed in.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::session {

class AdmissionMemory {
public:
    // From the last message of a connection.
    static constexpr Duration kept_for = std::chrono::minutes(10);
    // Those who are remembered, of all links and of one. Beyond that the one that was there for the
    // shortest time is forgotten: many who come and go do not hide one who stayed.
    static constexpr std::size_t max_kept = 256, max_kept_of_one_link = 64;

    // A person, the link by which it came, and its purpose there.
    struct Who {
        Bytes person;
        std::string token;
        bool records = false;
        bool operator==(const Who&) const = default;
    };
    struct Left {
        Who who;
        TimePoint since, until;  // it was there, over all of its connections
    };

    // Somebody without an id is not remembered.
    void note(const Left& left);
    // Null if it is not remembered, or too long ago.
    const Left* find(const Who& who, TimePoint now) const;
    void forget_all() { left_.clear(); }

private:
    void make_room(const std::string& token);

    std::vector<Left> left_;
};

}  // namespace theatron::session
