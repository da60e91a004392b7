// SPDX-License-Identifier: Apache-2.0
#include "session/shared_screen.h"

#include <algorithm>

#include "base/outside_text.h"
#include "wire/control.h"

namespace theatron::session {
namespace {

// After those of the objects of a case (case_objects.cpp).
constexpr std::uint8_t shared_screen_tag = 5;
constexpr std::uint16_t no_camera = 0xffff;
constexpr std::uint8_t pinned_bit = 1;

void put_name(ByteWriter& out, const std::string& name) {
    const std::string kept = clean_text(name, wire::max_name);
    out.put(std::uint16_t(kept.size()));
    out.put_bytes(as_bytes(kept));
}

std::string get_name(ByteReader& in) {
    const ByteView bytes = in.get_bytes(in.get<std::uint16_t>());
    return clean_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, wire::max_name);
}

}  // namespace

Bytes encode_shared_screen(const SharedScreen& screen) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(shared_screen_tag);
    out.put(screen.camera ? std::uint16_t(*screen.camera) : no_camera);
    out.put(std::uint8_t(screen.pinned ? pinned_bit : 0));
    out.put(std::uint16_t(screen.picture.width));
    out.put(std::uint16_t(screen.picture.height));
    put_name(out, screen.publisher);
    put_name(out, screen.name);
    return bytes;
}

std::optional<SharedScreen> decode_shared_screen(ObjectKind kind, ByteView properties) {
    ByteReader in(properties);
    if (kind != ObjectKind::screen || in.get<std::uint8_t>() != shared_screen_tag)
        return std::nullopt;
    SharedScreen screen;
    if (const auto camera = in.get<std::uint16_t>(); camera != no_camera)
        screen.camera = CameraId(camera);
    const auto flags = in.get<std::uint8_t>();
    screen.pinned = flags == pinned_bit;
    screen.picture.width = in.get<std::uint16_t>();
    screen.picture.height = in.get<std::uint16_t>();
    screen.publisher = get_name(in);
    screen.name = get_name(in);
    const auto is_side = [](int pixels) { return pixels > 0 && pixels <= SharedScreen::max_side; };
    if (!in.ok() || !in.rest().empty() || flags > pinned_bit || !is_side(screen.picture.width) ||
        !is_side(screen.picture.height))
        return std::nullopt;
    return screen;
}

std::optional<SharedScreen> shared_screen_of(const RoomObjects& objects, ObjectId id) {
    const auto found = objects.find(id);
    return found == objects.end()
               ? std::nullopt
               : decode_shared_screen(found->second.kind, found->second.properties);
}

bool is_shared_screen(const RoomObject& object) {
    return object.kind == ObjectKind::screen && !object.properties.empty() &&
           std::to_integer<std::uint8_t>(object.properties.front()) == shared_screen_tag;
}

bool is_pinned(const RoomObject& object) {
    const auto screen = decode_shared_screen(object.kind, object.properties);
    return screen && screen->pinned;
}

double clamped_screen_width(double width_m) {
    return std::clamp(width_m, least_screen_width_m, largest_screen_width_m);
}

ScreenPlace place_of(const RoomObject& object, const SharedScreen& screen) {
    return {object.room_from_object, object.scale,
            object.scale * screen.picture.height / screen.picture.width};
}

std::optional<ObjectId> find_screen(const RoomObjects& objects, CameraId camera,
                                    const std::string& name) {
    std::optional<ObjectId> replayed;
    for (const auto& [id, object] : objects) {
        const auto screen = decode_shared_screen(object.kind, object.properties);
        if (!screen || !screen->camera)
            continue;
        if (!is_recorded(id) && screen->camera == camera)
            return id;
        if (is_recorded(id) && screen->name == name && !replayed)
            replayed = id;
    }
    return replayed;
}

}  // namespace theatron::session
