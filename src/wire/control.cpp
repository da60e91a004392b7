// SPDX-License-Identifier: Apache-2.0
#include "wire/control.h"

#include <flatbuffers/flatbuffers.h>

#include <type_traits>
#include <utility>

#include "base/outside_text.h"
#include "control_generated.h"
#include "wire/clear_objects.h"
#include "wire/sentence.h"

namespace theatron::wire {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;
using flatbuffers::Table;
using flatbuffers::Vector;
using flatbuffers::voffset_t;

// Where a table keeps its first field, and how far the next one is from it.
constexpr voffset_t first_slot = 2 * sizeof(voffset_t);
constexpr voffset_t next_slot = sizeof(voffset_t);

// A struct that is a table of its own.
template <class T>
concept IsTable = requires(T& value) {
    T::fields(value, [](auto&&...) {});
};

// The number by which a table holds a value.
template <class T>
requires std::is_arithmetic_v<T> T to_number(T value) {
    return value;
}
std::uint8_t to_number(bool value) {
    return std::uint8_t(value);
}
template <class T>
requires std::is_enum_v<T>
auto to_number(T value) {
    return std::underlying_type_t<T>(value);
}
std::int64_t to_number(TimePoint time) {
    return to_us(time);
}
std::int64_t to_number(Duration duration) {
    return duration.count();
}

template <class T>
using Number = decltype(to_number(std::declval<T>()));

template <class T>
T from_number(Number<T> number) {
    if constexpr (std::is_same_v<T, TimePoint>)
        return from_us(number);
    else
        return T(number);
}

// From struct to table. A table's texts and lists come before the table.

template <class Message>
Offset<Table> pack(Builder& b, const Message& message);

Offset<void> pack_part(Builder& b, const std::string& text) {
    return b.CreateString(text).Union();
}

Offset<void> pack_part(Builder& b, const Bytes& bytes) {
    return b.CreateVector(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())
        .Union();
}

Offset<void> pack_part(Builder& b, const std::vector<std::string>& texts) {
    return b.CreateVectorOfStrings(texts).Union();
}

template <class Id>
requires std::is_enum_v<Id> Offset<void> pack_part(Builder& b, const std::vector<Id>& ids) {
    std::vector<Number<Id>> numbers;
    for (const Id id : ids)
        numbers.push_back(to_number(id));
    return b.CreateVector(numbers).Union();
}

template <class Element>
Offset<void> pack_part(Builder& b, const std::vector<Element>& list) {
    std::vector<Offset<Table>> tables;
    for (const Element& element : list)
        tables.push_back(pack(b, element));
    return b.CreateVector(tables).Union();
}

struct PackParts {
    Builder& b;
    std::vector<Offset<void>>& parts;
    template <class T>
    void operator()(const T& value) {
        if constexpr (IsTable<T>)
            parts.push_back(pack(b, value).Union());
    }
    template <class T>
    void operator()(const T& value, std::size_t) {
        parts.push_back(pack_part(b, value));
    }
};

struct PackFields {
    Builder& b;
    const Offset<void>* part;
    voffset_t slot = first_slot;
    template <class T>
    void operator()(const T& value) {
        if constexpr (IsTable<T>)
            b.AddOffset(slot, *part++);
        else
            b.AddElement(slot, to_number(value), Number<T>());
        slot = voffset_t(slot + next_slot);
    }
    template <class T>
    void operator()(const T&, std::size_t) {
        b.AddOffset(slot, *part++);
        slot = voffset_t(slot + next_slot);
    }
};

template <class Message>
Offset<Table> pack(Builder& b, const Message& message) {
    std::vector<Offset<void>> parts;
    Message::fields(message, PackParts{b, parts});
    const auto start = b.StartTable();
    Message::fields(message, PackFields{b, parts.data()});
    return Offset<Table>(b.EndTable(start));
}

// From table to struct. Texts and lists may be absent. Tables may share texts and lists, so each
// field has a limit of its own: the size of the message limits nothing.

template <class Message>
bool is_sound(const Message&) {
    return true;
}
bool is_sound(const StreamSetting& setting) {
    return setting.setting != SettingId{};
}
bool is_sound(const Delivery& delivery) {
    return delivery.one_frame_of > 0;
}
bool is_sound(const Join& join) {
    return join.person.empty() || join.person.size() == person_id_size;
}
bool is_sound(const CameraState& state) {
    return state.condition <= CameraCondition::failed;
}
bool is_sound(const OfferedCamera& camera) {
    return camera.kind <= CameraKind::screen;
}
bool is_sound(const Camera& camera) {
    return camera.kind <= CameraKind::face;
}
bool is_sound(const Manage& decision) {
    return decision.action >= ManageAction::admit && decision.action <= ManageAction::lower_hand &&
           is_of_person(decision.role);
}
bool is_sound(const Play& play) {
    return play.action >= PlayAction::pause && play.action <= PlayAction::seek;
}
bool is_sound(const LookBack& wish) {
    return wish.ago >= Duration(0);
}
bool is_sound(const Playback& playback) {
    return playback.position >= Duration(0) && playback.length >= Duration(0);
}
bool is_sound(const Standing& standing) {
    return is_known(standing.role);
}
bool is_sound(const Visitor& visitor) {
    return is_known(visitor.role);
}
bool is_sound(const RequestContent& request) {
    return request.hash.size() == content_hash_size && request.count <= max_content_request;
}
bool is_sound(const AskPatient& question) {
    return question.of_case.size() == content_hash_size;
}
bool is_sound(const OfferedCase& offered) {
    return offered.hash.size() == content_hash_size;
}
bool is_sound(const Content& content) {
    return content.hash.size() == content_hash_size;
}
bool is_sound(const Patient& patient) {
    return patient.of_case.empty() || patient.of_case.size() == content_hash_size;
}
bool is_sound(const AskedPatient& answer) {
    return answer.patient.of_case.size() == content_hash_size;
}
bool is_sound(const OfferRelay& offer) {
    return offer.port == 0 || offer.fingerprint.size() == fingerprint_size;
}
bool is_sound(const RelayGrant& grant) {
    return grant.fingerprint.size() == fingerprint_size &&
           grant.secret.size() == relay_secret_size &&
           (grant.key.empty() || grant.key.size() == media_key_size);
}
bool is_sound(const RelayReceiver& receiver) {
    return receiver.secret.size() == relay_secret_size &&
           (receiver.layers.empty() || receiver.layers.size() == receiver.settings.size());
}
bool is_sound(const RelayLink& link) {
    return link.round_trip >= Duration(0) && link.delay >= Duration(0);
}
bool is_sound(const StudyStep& step) {
    return step.kind <= StudyKind::over && step.step_size > 0 && step.lowest <= step.highest &&
           step.watch >= Duration(0) && step.limit >= Duration(0);
}
bool is_sound(const StudyReply& reply) {
    return reply.action >= StudyAction::answer && reply.action <= StudyAction::stop;
}
bool is_sound(const SetCondition& condition) {
    return condition.latency >= Duration(0) && condition.latency <= max_added_latency;
}
bool is_sound(const Managed& answer) {
    return answer.refusal <= last_manage_refusal;
}

// False if the table has a value that its kind does not allow.
template <class Message>
bool unpack(const Table& table, Message& message);

bool unpack_part(const Table& table, voffset_t slot, std::size_t limit, std::string& text) {
    if (const auto* part = table.GetPointer<const flatbuffers::String*>(slot))
        text = clean_text(part->string_view(), limit);
    return true;
}

bool unpack_part(const Table& table, voffset_t slot, std::size_t limit,
                 std::vector<std::string>& texts) {
    const auto* part = table.GetPointer<const Vector<Offset<flatbuffers::String>>*>(slot);
    if (!part)
        return true;
    if (part->size() > limit)
        return false;
    for (const auto* text : *part)
        texts.push_back(clean_text(text->string_view(), max_sentence));
    return true;
}

bool unpack_part(const Table& table, voffset_t slot, std::size_t limit, Bytes& bytes) {
    const auto* part = table.GetPointer<const Vector<std::uint8_t>*>(slot);
    if (!part)
        return true;
    if (part->size() > limit)
        return false;
    const auto view = std::as_bytes(std::span(part->data(), part->size()));
    bytes.assign(view.begin(), view.end());
    return true;
}

template <class Id>
requires std::is_enum_v<Id>
bool unpack_part(const Table& table, voffset_t slot, std::size_t limit, std::vector<Id>& ids) {
    const auto* part = table.GetPointer<const Vector<Number<Id>>*>(slot);
    if (!part)
        return true;
    if (part->size() > limit)
        return false;
    for (const Number<Id> number : *part)
        ids.push_back(Id(number));
    return true;
}

template <class Element>
bool unpack_part(const Table& table, voffset_t slot, std::size_t limit,
                 std::vector<Element>& list) {
    const auto* part = table.GetPointer<const Vector<Offset<Table>>*>(slot);
    if (!part)
        return true;
    if (part->size() > limit)
        return false;
    list.resize(part->size());
    for (flatbuffers::uoffset_t i = 0; i < part->size(); ++i)
        if (!unpack(*part->Get(i), list[i]))
            return false;
    return true;
}

struct UnpackFields {
    const Table& table;
    bool& sound;
    voffset_t slot = first_slot;
    template <class T>
    requires IsTable<T>
    void operator()(T& value) {
        if (const auto* part = table.GetPointer<const Table*>(slot))
            sound = sound && unpack(*part, value);
        slot = voffset_t(slot + next_slot);
    }
    template <class T>
    void operator()(T& value) {
        value = from_number<T>(table.GetField<Number<T>>(slot, Number<T>()));
        slot = voffset_t(slot + next_slot);
    }
    template <class T>
    void operator()(T& value, std::size_t limit) {
        sound = sound && unpack_part(table, slot, limit, value);
        slot = voffset_t(slot + next_slot);
    }
};

template <class Message>
bool unpack(const Table& table, Message& message) {
    bool sound = true;
    Message::fields(message, UnpackFields{table, sound});
    return sound && is_sound(message);
}

// A message is a table with a union: its kind, the number of the alternative from 1, and its body.

constexpr voffset_t kind_slot = first_slot;
constexpr voffset_t body_slot = first_slot + next_slot;

template <class Union>
Bytes encode_union(const Union& message) {
    Builder builder;
    const auto body = std::visit([&](const auto& m) { return pack(builder, m); }, message);
    const auto start = builder.StartTable();
    builder.AddElement(kind_slot, std::uint8_t(message.index() + 1), std::uint8_t());
    builder.AddOffset(body_slot, body);
    builder.Finish(Offset<Table>(builder.EndTable(start)));
    const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
    return {bytes.begin(), bytes.end()};
}

template <class Union, std::size_t alternative = 0>
Result<Union> unpack_union(std::size_t index, const Table& body) {
    if constexpr (alternative == std::variant_size_v<Union>) {
        return Status::unsupported;
    } else {
        if (index != alternative)
            return unpack_union<Union, alternative + 1>(index, body);
        std::variant_alternative_t<alternative, Union> message;
        if (!unpack(body, message))
            return Status::malformed;
        return Union(std::move(message));
    }
}

// `Root` is the generated class of the table that holds the union; it verifies the bytes.
template <class Union, class Root>
Result<Union> decode_union(ByteView bytes) {
    // FlatBuffers wants aligned memory; a message is small, so it is copied.
    std::vector<std::uint64_t> aligned((bytes.size() + 7) / 8);
    if (!bytes.empty())
        std::memcpy(aligned.data(), bytes.data(), bytes.size());
    const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
    flatbuffers::Verifier verifier(data, bytes.size(), 16, 4096);
    if (!verifier.VerifyBuffer<Root>(nullptr))
        return Status::malformed;

    const auto* root = reinterpret_cast<const Table*>(flatbuffers::GetRoot<Root>(data));
    const auto kind = root->GetField<std::uint8_t>(kind_slot, 0);
    const auto* body = root->GetPointer<const Table*>(body_slot);
    if (kind == 0)
        return Status::malformed;
    // The body of a kind that the schema does not know was not verified either.
    if (!body || kind > std::variant_size_v<Union>)
        return Status::unsupported;
    return unpack_union<Union>(kind - 1u, *body);
}

static_assert(int(fbs::ToHostBody::MAX) == std::variant_size_v<ToHost>);
static_assert(int(fbs::ToParticipantBody::MAX) == std::variant_size_v<ToParticipant>);
// The same in every protocol.
static_assert(int(fbs::ToHostBody::Join) == 1 && int(fbs::ToParticipantBody::Refused) == 7);

}  // namespace

Refused refused(Text reason) {
    std::string sentence = english(reason);
    return {std::move(sentence), std::move(reason)};
}

std::string spoken(const Visitor& visitor) {
    return spoken(visitor.role) + (visitor.records ? ", " + say(Phrase::records) : "");
}

std::string sent_part(const Delivery& delivery) {
    return sent_part(delivery, Language::english);
}

std::string sent_part(const Delivery& delivery, Language which) {
    std::vector<Text> parts;
    if (delivery.one_frame_of == 2)
        parts.push_back({TextCode::half_of_frames});
    else if (delivery.one_frame_of == 4)
        parts.push_back({TextCode::quarter_of_frames});
    else if (delivery.one_frame_of != 1)
        parts.push_back({TextCode::one_frame_of, {std::to_string(delivery.one_frame_of)}});
    if (!delivery.color_codec.empty())
        parts.push_back({TextCode::coarser_color, {delivery.color_codec}});
    if (delivery.lossy_outside_region)
        parts.push_back({TextCode::loss_outside_region});
    if (parts.empty())
        parts.push_back({TextCode::everything_is_sent});
    std::string result;
    for (const Text& part : parts)
        result += (result.empty() ? "" : ", ") + sentence(part, which);
    return result;
}

Bytes encode(const ToHost& message) {
    return encode_union(message);
}

Bytes encode(const ToParticipant& message) {
    return encode_union(message);
}

Result<ToHost> decode_to_host(ByteView bytes) {
    return decode_union<ToHost, fbs::ToHost>(bytes);
}

Result<ToParticipant> decode_to_participant(ByteView bytes) {
    return decode_union<ToParticipant, fbs::ToParticipant>(bytes);
}

}  // namespace theatron::wire
