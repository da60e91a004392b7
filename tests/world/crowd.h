// SPDX-License-Identifier: Apache-2.0
// People who do at random what people can do, while their links break and the host is started
// again; and what must hold whenever it is quiet.
#pragma once

#include <map>
#include <random>
#include <string>

#include "world/acts.h"

namespace theatron::world {

class Crowd {
public:
    explicit Crowd(unsigned seed);

    // Minutes of it, in which it is quiet every `quiet_every`. Returns what did not hold, in words;
    // empty: all is well.
    std::string live(Duration time, Duration quiet_every = std::chrono::minutes(5));

    // Whenever it was quiet, all together: a crowd that does nothing proves nothing.
    struct Seen {
        std::size_t people = 0, objects = 0, held = 0;
    };
    const Seen& seen() const { return seen_; }

private:
    struct Member {
        Person* person = nullptr;
        wire::Role role{};
        TimePoint mended_at;  // if its link is cut
    };
    // One thing that somebody does. Nobody waits for the answer.
    void act();
    void act(Member& member);
    void act_in_room(Person& person);
    void act_on_others(Person& person);
    void mend_what_is_due(bool all);
    // Lets everything come to its end, and looks.
    std::string quiet();
    std::string agreement();
    static std::string chat_fault(const Person& person);
    std::string end();

    int number(int below) { return int(random_() % unsigned(below)); }
    Vec3 place() { return {0.1 * number(20), 0.1 * number(20), 0.1 * number(20)}; }

    World world_;
    std::mt19937 random_;
    std::vector<Member> members_;
    int messages_ = 0;  // that people have written
    const std::uint64_t faults_before_;
    Seen seen_;
};

}  // namespace theatron::world
