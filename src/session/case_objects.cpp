// SPDX-License-Identifier: Apache-2.0
#include "session/case_objects.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include "base/shown_name.h"

namespace theatron::session {
namespace {

// A screen with a picture or a presenter has a tag of its own, which older programs leave out.
constexpr std::uint8_t organ_tag = 1, part_tag = 2, screen_tag = 3, full_screen_tag = 4,
                       name_tag = 6;  // 5: a shared screen
constexpr std::uint16_t no_picture = 0xffff;
constexpr double max_position_mm = 1e5, max_value = 1e9;
// The screen's middle, seen from that of the organ.
constexpr Vec3 screen_from_organ{0.48, 0.12, -0.1};

bool is_full(const CaseScreen& screen) {
    return screen.picture || screen.presenter != ParticipantId{};
}

std::uint8_t tag_of(const CaseObject& object) {
    if (const auto* screen = std::get_if<CaseScreen>(&object))
        return is_full(*screen) ? full_screen_tag : screen_tag;
    if (std::holds_alternative<CaseName>(object))
        return name_tag;
    return std::holds_alternative<CaseOrgan>(object) ? organ_tag : part_tag;
}

std::optional<CaseObject> read(ByteView properties) {
    ByteReader in(properties);
    const auto tag = in.get<std::uint8_t>();
    const auto id = to_content_hash(in.get_bytes(ContentHash::size));
    if (!id)
        return std::nullopt;
    std::optional<CaseObject> object;
    if (tag == organ_tag) {
        CaseOrgan organ{*id};
        organ.explosion = in.get<std::uint8_t>();
        const auto cut = in.get<std::uint8_t>();
        if (cut > 1)
            return std::nullopt;
        organ.cut = cut == 1;
        object = organ;
    } else if (tag == part_tag) {
        CasePart part{*id};
        part.part = in.get<std::uint16_t>();
        const auto shown = in.get<std::uint8_t>();
        part.opacity = in.get<std::uint8_t>();
        if (shown > 1 || part.part >= CaseFacts::max_parts)
            return std::nullopt;
        part.shown = shown == 1;
        object = part;
    } else if (tag == screen_tag || tag == full_screen_tag) {
        CaseScreen screen{*id};
        screen.series = in.get<std::uint8_t>();
        screen.orientation = in.get<std::uint8_t>();
        screen.position_mm = in.get_f64();
        screen.center = in.get_f64();
        screen.width = in.get_f64();
        if (tag == full_screen_tag) {
            const auto picture = in.get<std::uint16_t>();
            if (picture != no_picture)
                screen.picture = picture;
            screen.presenter = ParticipantId(in.get<std::uint32_t>());
            // A screen has one form.
            if (!is_full(screen))
                return std::nullopt;
        }
        // A comparison with nan is false.
        if (screen.series >= CaseFacts::max_series ||
            screen.picture.value_or(0) >= CaseFacts::max_pictures ||
            screen.orientation >= CaseScreen::orientations ||
            !(std::abs(screen.position_mm) <= max_position_mm) ||
            !(std::abs(screen.center) <= max_value) ||
            !(screen.width > 0 && screen.width <= max_value))
            return std::nullopt;
        object = screen;
    } else if (tag == name_tag) {
        const ByteView bytes = in.get_bytes(in.get<std::uint16_t>());
        const std::string name(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        // A name has one form, too.
        if (name.empty() || clean_name(name, CaseName::max_characters) != name)
            return std::nullopt;
        object = CaseName{*id, name};
    }
    if (!in.ok() || !in.rest().empty())
        return std::nullopt;
    return object;
}

}  // namespace

Bytes encode_case_object(const CaseObject& object) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(tag_of(object));
    std::visit(
        [&](const auto& o) {
            using T = std::decay_t<decltype(o)>;
            out.put_bytes(o.of_case.bytes);
            if constexpr (std::is_same_v<T, CaseOrgan>) {
                out.put(o.explosion);
                out.put(std::uint8_t(o.cut));
            } else if constexpr (std::is_same_v<T, CasePart>) {
                out.put(o.part);
                out.put(std::uint8_t(o.shown));
                out.put(o.opacity);
            } else if constexpr (std::is_same_v<T, CaseName>) {
                out.put(std::uint16_t(o.name.size()));
                out.put_bytes(as_bytes(o.name));
            } else {
                out.put(o.series);
                out.put(o.orientation);
                out.put_f64(o.position_mm);
                out.put_f64(o.center);
                out.put_f64(o.width);
                if (!is_full(o))
                    return;
                out.put(o.picture.value_or(no_picture));
                out.put(std::uint32_t(o.presenter));
            }
        },
        object);
    return bytes;
}

std::optional<CaseObject> decode_case_object(ObjectKind kind, ByteView properties) {
    auto object = read(properties);
    if (!object || std::holds_alternative<CaseScreen>(*object) != (kind == ObjectKind::screen) ||
        (kind != ObjectKind::organ && kind != ObjectKind::screen))
        return std::nullopt;
    return object;
}

bool may_become(ObjectKind kind, ByteView before, ByteView after) {
    const auto was = decode_case_object(kind, before), will = decode_case_object(kind, after);
    if (!was || !will || was->index() != will->index())
        return false;
    const auto id = [](const CaseObject& object) {
        return std::visit([](const auto& o) { return o.of_case; }, object);
    };
    const auto* part = std::get_if<CasePart>(&*was);
    if (std::holds_alternative<CaseName>(*was))
        return *was == *will;
    return id(*was) == id(*will) && (!part || part->part == std::get<CasePart>(*will).part);
}

bool may_change(ParticipantId by, bool manages, const CaseScreen& before, const CaseScreen& after) {
    const bool is_free = before.presenter == ParticipantId{} || before.presenter == by || manages;
    return is_free && (after.presenter == ParticipantId{} || after.presenter == by ||
                       after.presenter == before.presenter);
}

std::optional<CaseInRoom> case_in_room(const RoomObjects& objects) {
    std::optional<CaseInRoom> found;
    for (const auto& [id, object] : objects)
        if (const auto organ = decode_as<CaseOrgan>(object.kind, object.properties);
            organ && (!found || (is_recorded(found->organ_id) && !is_recorded(id))))
            found = CaseInRoom{id, *organ, object, {}, std::nullopt, {}};
    if (!found)
        return std::nullopt;
    for (const auto& [id, object] : objects) {
        if (is_recorded(id) != is_recorded(found->organ_id))
            continue;
        if (const auto part = decode_as<CasePart>(object.kind, object.properties);
            part && part->of_case == found->organ.of_case)
            found->parts.push_back({id, *part, object});
        if (const auto screen = decode_as<CaseScreen>(object.kind, object.properties);
            screen && screen->of_case == found->organ.of_case)
            found->screen = CaseInRoom::Screen{id, *screen, object};
        if (auto named = decode_as<CaseName>(object.kind, object.properties);
            named && named->of_case == found->organ.of_case)
            found->name = std::move(named->name);
    }
    return found;
}

const CaseInRoom::Part* CaseInRoom::find(ObjectId id) const {
    for (const Part& part : parts)
        if (part.id == id)
            return &part;
    return nullptr;
}

ScaledPose part_in_room(const RoomObject& organ, const Pose& organ_from_part) {
    return {{organ.room_from_object.rotation * organ_from_part.rotation,
             organ.room_from_object * (organ_from_part.translation * organ.scale)},
            organ.scale};
}

Pose part_in_organ(const RoomObject& organ, const Pose& room_from_part) {
    Pose organ_from_part = inverse(organ.room_from_object) * room_from_part;
    organ_from_part.translation = organ_from_part.translation * (1 / organ.scale);
    return organ_from_part;
}

std::vector<RoomObject> case_objects(const CaseFacts& facts, const Pose& place) {
    std::vector<RoomObject> objects;
    const auto add = [&](ObjectKind kind, const Pose& pose, const CaseObject& object) {
        objects.push_back({kind, {}, {}, {}, pose, 1, encode_case_object(object)});
    };
    add(ObjectKind::organ, place, CaseOrgan{facts.id});
    for (std::size_t i = 0; i < facts.opacities.size() && i < CaseFacts::max_parts; ++i)
        add(ObjectKind::organ, {}, CasePart{facts.id, std::uint16_t(i), true, facts.opacities[i]});
    if (const std::string name = clean_name(facts.name, CaseName::max_characters); !name.empty())
        add(ObjectKind::organ, {}, CaseName{facts.id, name});
    if (facts.screen)
        add(ObjectKind::screen, place * Pose{{}, screen_from_organ}, *facts.screen);
    return objects;
}

}  // namespace theatron::session
