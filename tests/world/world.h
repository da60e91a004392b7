// SPDX-License-Identifier: Apache-2.0
// A host and its people in one process, over links that the test delays, cuts and breaks, in a time
// that passes only while the test lets it (docs/testing.md).
//
// The product's own sources are compiled for it; docs/decisions/world.md names the few that have a
// stand-in. Tests speak to the public surface alone: host::Host and client::Participant.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/participant.h"
#include "host/host.h"
#include "testing/temporary_folder.h"
#include "world/network.h"
#include "world/schedule.h"

namespace theatron::world {

class World;

// Somebody at a machine of their own. They are in the session from join() to leave().
class Person {
public:
    Person(World& world, std::string name);

    // With the host's link for this role; who is in already leaves first.
    void join(wire::Role role = wire::Role::expert);
    void join(const std::string& link);
    void leave();
    bool is_here() const { return participant_ != nullptr; }
    // In the session, and the host has answered.
    bool is_in() const;

    const std::string& name() const { return name_; }
    client::Participant& participant() const { return *participant_; }
    client::Participant* operator->() const { return participant_.get(); }
    // This machine's link to the network.
    Path& path() const { return *path_; }

    client::Participant::Room room() const { return participant_->room(); }
    // The objects of one kind.
    session::RoomObjects objects(session::ObjectKind kind) const;
    // The names of the people of the room, as this person sees them, sorted.
    std::vector<std::string> sees() const;
    // The number of a person of this name in the room; {} without one.
    ParticipantId number_of(const std::string& person) const;
    ParticipantId number() const { return participant_->room_self(); }

    // The sentences that the program has said, oldest first.
    const std::deque<std::string>& said() const { return said_; }
    bool was_told(const std::string& part) const;
    // For the next join(). World sets what it needs itself.
    client::Participant::Options options;

private:
    World& world_;
    const std::string name_;
    const std::shared_ptr<Path> path_;
    std::deque<std::string> said_;
    std::unique_ptr<client::Participant> participant_;
};

// One at a time in a process.
class World {
public:
    // All that is random in it follows from the seed.
    explicit World(unsigned seed = 1);
    ~World();

    // For the next host; state and port are the World's.
    host::HostOptions options;
    // Begins it at the first call, and after end_host().
    host::Host& host();
    // Its people are told that the session has ended.
    void end_host();
    void restart_host();
    bool has_host() const { return host_ != nullptr; }
    std::string link(wire::Role role) const;
    // A further session on the host's port, with a state of its own.
    std::unique_ptr<host::Host> further_session(const std::string& name);

    // That person, who has not joined when they are named for the first time.
    Person& person(const std::string& name);
    const std::vector<std::unique_ptr<Person>>& people() const { return people_; }
    // The person, who joins and is in.
    Person& joined(const std::string& name, wire::Role role = wire::Role::expert);

    void advance(Duration time) { schedule_.advance(time); }
    // Lets time pass until the condition, which is looked at after each event, for at most
    // `patience`. Returns the condition.
    bool until(const std::function<bool()>& condition, Duration patience = std::chrono::minutes(5));
    TimePoint now() const { return schedule_.now(); }
    // For files of its tests; removed at its end.
    const std::filesystem::path& folder() const { return folder_.path(); }
    // Events that wait.
    std::size_t events() const { return schedule_.size(); }

private:
    Schedule& schedule_ = Schedule::instance();
    testing::TemporaryFolder folder_;
    std::uint16_t port_ = 0;
    std::unique_ptr<host::Host> host_;
    std::vector<std::unique_ptr<Person>> people_;
};

}  // namespace theatron::world
