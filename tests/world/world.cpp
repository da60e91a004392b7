// SPDX-License-Identifier: Apache-2.0
#include "world/world.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "session/room_bytes.h"
#include "world/asio.h"

namespace theatron::world {

Person::Person(World& world, std::string name)
    : world_(world), name_(std::move(name)), path_(Network::instance().path(name_)) {
    options.keeps_room = true;
    options.shows_chat = true;
}

void Person::join(wire::Role role) {
    join(world_.link(role));
}

void Person::join(const std::string& link) {
    leave();
    client::Participant::Options own = options;
    own.link = net::parse_link(link);
    own.link.host = name_;  // the World's network knows the machine by it
    own.name = name_;
    own.remark = own.written = [this](const std::string& text) { said_.push_back(text); };
    participant_ = std::make_unique<client::Participant>(std::move(own));
}

void Person::leave() {
    participant_.reset();
}

bool Person::is_in() const {
    return participant_ && participant_->status().phase == client::Participant::Phase::joined &&
           number_of(name_) != ParticipantId{};
}

session::RoomObjects Person::objects(session::ObjectKind kind) const {
    session::RoomObjects found = room().objects;
    std::erase_if(found, [&](const auto& entry) { return entry.second.kind != kind; });
    return found;
}

std::vector<std::string> Person::sees() const {
    std::vector<std::string> names;
    for (const auto& [id, object] : objects(session::ObjectKind::person))
        if (const auto facts = session::decode_person(object.properties))
            names.push_back(facts->name);
    std::sort(names.begin(), names.end());
    return names;
}

ParticipantId Person::number_of(const std::string& person) const {
    for (const auto& [id, object] : objects(session::ObjectKind::person))
        if (const auto facts = session::decode_person(object.properties);
            facts && facts->name == person)
            return object.creator;
    return {};
}

bool Person::was_told(const std::string& part) const {
    return std::any_of(said_.begin(), said_.end(), [&](const std::string& text) {
        return text.find(part) != std::string::npos;
    });
}

World::World(unsigned seed) {
    schedule_.begin();
    Network::instance().begin(seed);
    // Where programs keep who their person is.
    setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
}

World::~World() {
    people_.clear();
    end_host();
    schedule_.begin();
}

host::Host& World::host() {
    if (host_)
        return *host_;
    host::HostOptions own = options;
    own.state = folder_.path() / "state";
    own.listen = {"127.0.0.1", port_};
    own.link_host = "host.test";
    const int running = Loop::running();
    host_ = std::make_unique<host::Host>(own, capture::Progress());
    Loop::wait_for_running(running + 1);
    port_ = host_->port();
    return *host_;
}

void World::end_host() {
    host_.reset();
}

void World::restart_host() {
    end_host();
    (void)host();
}

std::string World::link(wire::Role role) const {
    return host_->link(role);
}

std::unique_ptr<host::Host> World::further_session(const std::string& name) {
    host::SessionOptions own;
    own.name = name;
    own.state = folder_.path() / ("session " + name);
    return std::make_unique<host::Host>(own, *host_, capture::Progress());
}

Person& World::person(const std::string& name) {
    for (const auto& person : people_)
        if (person->name() == name)
            return *person;
    people_.push_back(std::make_unique<Person>(*this, name));
    return *people_.back();
}

Person& World::joined(const std::string& name, wire::Role role) {
    (void)host();
    Person& person = this->person(name);
    person.join(role);
    EXPECT_TRUE(until([&] { return person.is_in(); })) << name << " does not come in";
    return person;
}

bool World::until(const std::function<bool()>& condition, Duration patience) {
    const TimePoint then = now() + patience;
    while (!condition())
        if (!schedule_.step(then))
            return condition();
    return true;
}

}  // namespace theatron::world
