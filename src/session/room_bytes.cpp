// SPDX-License-Identifier: Apache-2.0
#include "session/room_bytes.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include "base/outside_text.h"
#include "wire/control.h"

namespace theatron::session {
namespace {

// Bits of a person's second byte.
constexpr std::uint8_t records_bit = 1, muted_bit = 2, voice_recorded_bit = 4, hand_raised_bit = 8;

enum class RequestKind : std::uint8_t {
    create = 1,
    remove,
    grab,
    release,
    hand_over,
    set_properties,
    clear_marks
};

void put_place(ByteWriter& out, const Pose& pose, double scale) {
    const Quat& q = pose.rotation;
    const Vec3& p = pose.translation;
    for (const double value : {q.w, q.x, q.y, q.z, p.x, p.y, p.z, scale})
        out.put_f64(value);
}

// False if a number is not finite.
bool get_place(ByteReader& in, Pose& pose, double& scale) {
    Quat& q = pose.rotation;
    Vec3& p = pose.translation;
    bool finite = true;
    for (double* value : {&q.w, &q.x, &q.y, &q.z, &p.x, &p.y, &p.z, &scale}) {
        *value = in.get_f64();
        finite = finite && std::isfinite(*value);
    }
    return finite;
}

void put_properties(ByteWriter& out, const Bytes& properties) {
    out.put(std::uint16_t(properties.size()));
    out.put_bytes(properties);
}

Bytes get_properties(ByteReader& in) {
    const ByteView bytes = in.get_bytes(in.get<std::uint16_t>());
    return {bytes.begin(), bytes.end()};
}

void put(ByteWriter& out, const request::Create& request) {
    out.put(std::uint8_t(RequestKind::create));
    out.put(std::uint8_t(request.kind));
    put_place(out, request.room_from_object, request.scale);
    put_properties(out, request.properties);
}
void put(ByteWriter& out, const request::Remove& request) {
    out.put(std::uint8_t(RequestKind::remove));
    out.put(std::uint32_t(request.object));
}
void put(ByteWriter& out, const request::Grab& request) {
    out.put(std::uint8_t(RequestKind::grab));
    out.put(std::uint32_t(request.object));
}
void put(ByteWriter& out, const request::Release& request) {
    out.put(std::uint8_t(RequestKind::release));
    out.put(std::uint32_t(request.object));
    out.put(request.grip);
    put_place(out, request.room_from_object, request.scale);
}
void put(ByteWriter& out, const request::HandOver& request) {
    out.put(std::uint8_t(RequestKind::hand_over));
    out.put(std::uint32_t(request.object));
    out.put(request.grip);
    out.put(std::uint32_t(request.to));
}
void put(ByteWriter& out, const request::SetProperties& request) {
    out.put(std::uint8_t(RequestKind::set_properties));
    out.put(std::uint32_t(request.object));
    put_properties(out, request.properties);
}

void put(ByteWriter& out, const request::ClearMarks& request) {
    out.put(std::uint8_t(RequestKind::clear_marks));
    out.put(std::uint8_t(request.of_all));
}

ObjectId get_object(ByteReader& in) {
    return ObjectId(in.get<std::uint32_t>());
}

// Sets `finite` to false if a number is not finite.
Result<Request> get_request(ByteReader& in, bool& finite) {
    switch (RequestKind(in.get<std::uint8_t>())) {
        case RequestKind::create: {
            request::Create r;
            r.kind = ObjectKind(in.get<std::uint8_t>());
            finite = get_place(in, r.room_from_object, r.scale);
            r.properties = get_properties(in);
            return Request(std::move(r));
        }
        case RequestKind::remove:
            return Request(request::Remove{get_object(in)});
        case RequestKind::grab:
            return Request(request::Grab{get_object(in)});
        case RequestKind::release: {
            request::Release r;
            r.object = get_object(in);
            r.grip = in.get<std::uint32_t>();
            finite = get_place(in, r.room_from_object, r.scale);
            return Request(r);
        }
        case RequestKind::hand_over: {
            request::HandOver r;
            r.object = get_object(in);
            r.grip = in.get<std::uint32_t>();
            r.to = ParticipantId(in.get<std::uint32_t>());
            return Request(r);
        }
        case RequestKind::set_properties: {
            request::SetProperties r;
            r.object = get_object(in);
            r.properties = get_properties(in);
            return Request(std::move(r));
        }
        case RequestKind::clear_marks: {
            const auto of_all = in.get<std::uint8_t>();
            if (of_all > 1)
                return Status::malformed;
            return Request(request::ClearMarks{of_all == 1});
        }
    }
    return Status::malformed;
}

}  // namespace

void append_object(ObjectId id, const RoomObject& object, Bytes& bytes) {
    ByteWriter out(bytes);
    out.put(std::uint32_t(id));
    out.put(std::uint8_t(object.kind));
    out.put(std::uint32_t(object.creator));
    out.put(std::uint32_t(object.grip.holder));
    out.put(object.grip.number);
    out.put(to_us(object.moved_at));
    put_place(out, object.room_from_object, object.scale);
    put_properties(out, object.properties);
}

Bytes encode_objects(const RoomObjects& objects) {
    Bytes bytes;
    for (const auto& [id, object] : objects)
        append_object(id, object, bytes);
    return bytes;
}

Result<RoomObjects> decode_objects(ByteView bytes, std::size_t max_objects) {
    RoomObjects objects;
    ByteReader in(bytes);
    while (!in.rest().empty()) {
        const ObjectId id = get_object(in);
        RoomObject object;
        object.kind = ObjectKind(in.get<std::uint8_t>());
        object.creator = ParticipantId(in.get<std::uint32_t>());
        object.grip.holder = ParticipantId(in.get<std::uint32_t>());
        object.grip.number = in.get<std::uint32_t>();
        object.moved_at = from_us(in.get<std::int64_t>());
        const bool finite = get_place(in, object.room_from_object, object.scale);
        object.properties = get_properties(in);
        if (!in.ok() || !finite || !is_known(object.kind) || objects.size() == max_objects ||
            !objects.emplace(id, std::move(object)).second)
            return Status::malformed;
    }
    return objects;
}

Bytes encode_request(const Request& request) {
    Bytes bytes;
    ByteWriter out(bytes);
    std::visit([&](const auto& wanted) { put(out, wanted); }, request);
    return bytes;
}

Result<Request> decode_request(ByteView bytes) {
    ByteReader in(bytes);
    bool finite = true;
    Result<Request> request = get_request(in, finite);
    if (!in.ok() || !in.rest().empty() || !finite)
        return Status::malformed;
    return request;
}

Bytes encode_object_pose(const ObjectPose& pose) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(std::uint32_t(pose.grip.holder));
    out.put(pose.grip.number);
    out.put(to_us(pose.at));
    put_place(out, pose.room_from_object, pose.scale);
    return bytes;
}

Result<ObjectPose> decode_object_pose(ObjectId object, ByteView bytes) {
    ByteReader in(bytes);
    ObjectPose pose;
    pose.object = object;
    pose.grip.holder = ParticipantId(in.get<std::uint32_t>());
    pose.grip.number = in.get<std::uint32_t>();
    pose.at = from_us(in.get<std::int64_t>());
    const bool finite = get_place(in, pose.room_from_object, pose.scale);
    if (!in.ok() || !in.rest().empty() || !finite)
        return Status::malformed;
    return pose;
}

Bytes encode_person(const PersonFacts& facts) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(std::uint8_t(facts.role));
    out.put(std::uint8_t((facts.records ? records_bit : 0) | (facts.muted ? muted_bit : 0) |
                         (facts.voice_recorded ? voice_recorded_bit : 0) |
                         (facts.hand_raised ? hand_raised_bit : 0)));
    out.put_bytes(as_bytes(facts.name));
    return bytes;
}

Result<PersonFacts> decode_person(ByteView properties) {
    ByteReader in(properties);
    PersonFacts facts;
    facts.role = Role(in.get<std::uint8_t>());
    if (!wire::is_known(facts.role))
        facts.role = Role::observer;
    const auto flags = in.get<std::uint8_t>();
    facts.records = (flags & records_bit) != 0;
    facts.muted = (flags & muted_bit) != 0;
    facts.voice_recorded = (flags & voice_recorded_bit) != 0;
    facts.hand_raised = (flags & hand_raised_bit) != 0;
    if (!in.ok())
        return Status::malformed;
    const auto* text = reinterpret_cast<const char*>(in.rest().data());
    facts.name = clean_text({text, in.rest().size()}, wire::max_name);
    return facts;
}

}  // namespace theatron::session
