// SPDX-License-Identifier: Apache-2.0
// The room of a participant's session.
#include <utility>

#include "base/steady_clock.h"
#include "client/participant_shared.h"

namespace theatron::client {

void Participant::on_room_message() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->room.on_message(session_.room());
    }
    tell_room();
    follow_hands();
    if (cases_) {
        session::RoomObjects organs;
        {
            const std::lock_guard lock(shared_->mutex);
            if (shared_->room.known())
                for (const auto& [id, object] : shared_->room.confirmed())
                    if (object.kind == session::ObjectKind::organ)
                        organs.emplace(id, object);
        }
        cases_->on_room(organs);
    }
    if (options_.room_changed)
        options_.room_changed();
}

// Sends the requests and poses that wait.
void Participant::tell_room() {
    std::vector<wire::RoomRequest> requests;
    std::map<session::ObjectId, Bytes> poses;
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->is_telling_room = false;
        requests = shared_->room.take_requests();
        poses = shared_->room.take_poses();
    }
    for (const wire::RoomRequest& request : requests)
        shared_->client->send_control(wire::encode(request));
    for (const auto& [object, body] : poses) {
        const wire::State state{{wire::StateTopic::object, std::uint32_t(object)}, body};
        shared_->client->send_states({&state, 1});
    }
}

// From any thread; the participant's thread asks.
void Participant::tell_content() {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->client && !std::exchange(shared_->is_asking_content, true))
        shared_->client->post([this] { request_content(); });
}

void Participant::request_content() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->is_asking_content = false;
    }
    if (!session_.joined())
        return;
    if (cases_)
        for (const wire::RequestContent& request : cases_->take_requests(steady_now()))
            shared_->client->send_control(wire::encode(request));
    if (faces_)
        for (const wire::RequestContent& request : faces_->take_requests(steady_now()))
            shared_->client->send_control(wire::encode(request));
}

std::vector<wire::OfferedCase> Participant::cases() const {
    return cases_ ? cases_->offered() : std::vector<wire::OfferedCase>();
}

std::optional<OpenCase> Participant::open_case(std::uint64_t& version) const {
    version = 0;
    return cases_ ? cases_->open(version) : std::nullopt;
}

Participant::Room Participant::room() const {
    const std::lock_guard lock(shared_->mutex);
    return {shared_->room.self(), shared_->room.version(), shared_->room.objects()};
}

std::vector<Participant::Recording> Participant::recordings() const {
    const std::lock_guard lock(shared_->mutex);
    std::vector<Recording> recordings;
    if (!shared_->room.known())
        return recordings;
    for (const auto& [id, object] : shared_->room.confirmed())
        if (object.kind == session::ObjectKind::person && !session::is_recorded(id))
            if (const auto facts = session::decode_person(object.properties);
                facts && facts->records)
                recordings.push_back({facts->name, object.moved_at});
    return recordings;
}

std::uint64_t Participant::room_version() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->room.version();
}

ParticipantId Participant::room_self() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->room.self();
}

std::uint32_t Participant::ask_room(const session::Request& request) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client)
        return 0;
    const std::uint32_t number = shared_->room.ask(request);
    if (number != 0 && !std::exchange(shared_->is_telling_room, true))
        shared_->client->post([this] { tell_room(); });
    return number;
}

bool Participant::move_object(session::ObjectId object, const Pose& room_from_object,
                              double scale) {
    const TimePoint at = now();
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || !shared_->room.move(object, room_from_object, scale, at))
        return false;
    if (!std::exchange(shared_->is_telling_room, true))
        shared_->client->post([this] { tell_room(); });
    return true;
}

std::optional<std::pair<std::uint32_t, session::Refusal>> Participant::take_room_refusal() {
    const std::lock_guard lock(shared_->mutex);
    return shared_->room.take_refusal();
}

}  // namespace theatron::client
