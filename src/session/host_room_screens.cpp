// SPDX-License-Identifier: Apache-2.0
// Shared screens in the host's room: their places, and what participants may do with them.
#include <algorithm>
#include <utility>

#include "session/host_room.h"
#include "session/screen_places.h"

namespace theatron::session {
namespace {

ObjectId object_of(const Request& request) {
    return std::visit(
        [](const auto& wanted) {
            if constexpr (requires { wanted.object; })
                return wanted.object;
            return ObjectId{};
        },
        request);
}

}  // namespace

HostRoom::ChosenPlace HostRoom::place_screen(const ScreenOffer& offer,
                                             const std::vector<ChosenPlace>& further) const {
    std::vector<ScreenPlace> others;
    for (const ChosenPlace& one : further)
        others.push_back(one.place);
    for (const auto& [id, object] : state_.objects())
        if (const auto screen = decode_shared_screen(object.kind, object.properties);
            screen && screen->camera)
            others.push_back(place_of(object, *screen));
    ScreenPlace place = screen_place(offer.calibration);
    place.width_m = clamped_screen_width(place.width_m);
    const Size picture = offer.calibration.color.size;
    const auto set_width = [&](double width_m) {
        place.width_m = width_m;
        place.height_m = width_m * picture.height / picture.width;
    };
    set_width(place.width_m);
    const auto kept = find_kept(offer, further);
    if (kept) {
        const RoomObject& before = state_.objects().at(*kept);
        set_width(before.scale);
        place.room_from_screen = before.room_from_object;
        if (std::none_of(others.begin(), others.end(),
                         [&](const ScreenPlace& other) { return overlap(place, other); }))
            return {place, kept};
    } else if (offer.calibration.registered) {
        return {place, kept};
    }
    place.room_from_screen =
        free_screen_place(place.width_m, place.height_m, others).value_or(usual_screen_place);
    return {place, kept};
}

void HostRoom::add_screen(CameraId camera, const ScreenOffer& offer, const ChosenPlace& chosen) {
    SharedScreen screen;
    if (chosen.kept) {
        const RoomObject& before = state_.objects().at(*chosen.kept);
        screen = *decode_shared_screen(before.kind, before.properties);
    }
    screen.camera = camera;
    screen.picture = offer.calibration.color.size;
    screen.publisher = offer.publisher_name;
    screen.name = offer.name;
    RoomObject object;
    object.kind = ObjectKind::screen;
    object.creator = offer.publisher;
    object.room_from_object = chosen.place.room_from_screen;
    object.scale = chosen.place.width_m;
    object.properties = encode_shared_screen(screen);
    // A calibration may have a picture or a place beyond the limits of objects; then the screen
    // stays where it is.
    if (!decode_shared_screen(object.kind, object.properties))
        return;
    const auto change = state_.put(chosen.kept, std::move(object));
    if (!change)
        return;
    tell(*change);
    sharers_[change->object] = offer.person;
    for (const auto& [id, member] : members_)
        if (!members_.contains(offer.publisher) && !offer.person.empty() &&
            member.person == offer.person)
            return take_own_screens(id);
}

void HostRoom::take_own_screens(ParticipantId id) {
    const Bytes& person = members_.at(id).person;
    std::vector<ObjectId> own;
    for (const auto& [screen, sharer] : sharers_) {
        const auto found = state_.objects().find(screen);
        if (person.empty() || sharer != person || found == state_.objects().end() ||
            members_.contains(found->second.creator))
            continue;
        const auto shown = decode_shared_screen(found->second.kind, found->second.properties);
        if (shown && shown->camera)
            own.push_back(screen);
    }
    for (const ObjectChange& change : state_.set_creator(own, id))
        tell(change);
}

void HostRoom::remove_screen(CameraId camera) {
    for (const auto& [id, object] : state_.objects()) {
        auto screen = decode_shared_screen(object.kind, object.properties);
        if (!screen || screen->camera != camera)
            continue;
        screen->camera.reset();
        RoomObject away = object;
        away.grip = {};
        away.properties = encode_shared_screen(*screen);
        if (const auto change = state_.put(id, std::move(away)))
            tell(*change);
        return drop_oldest_kept();
    }
}

// Objects are in the order of their age.
void HostRoom::drop_oldest_kept() {
    std::vector<ObjectId> away;
    for (const auto& [id, object] : state_.objects())
        if (const auto screen = decode_shared_screen(object.kind, object.properties);
            screen && !screen->camera)
            away.push_back(id);
    if (away.size() <= max_kept_screens)
        return;
    away.resize(away.size() - max_kept_screens);
    for (const ObjectChange& change : state_.remove(away))
        tell(change);
}

void HostRoom::forget_sources() {
    const RoomObjects objects = state_.objects();
    for (const auto& [id, object] : objects) {
        if (!is_shared_screen(object))
            continue;
        auto screen = decode_shared_screen(object.kind, object.properties);
        if (!screen || !is_screen_width(object.scale)) {
            (void)state_.remove({id});
            continue;
        }
        screen->camera.reset();
        RoomObject away = object;
        away.creator = {};
        away.properties = encode_shared_screen(*screen);
        if (!state_.put(id, std::move(away)))
            (void)state_.remove({id});
    }
    drop_oldest_kept();
}

// Objects are in the order of their age. The screen of a person whom nobody knows any more may be
// that of anybody with the same names.
std::optional<ObjectId> HostRoom::find_kept(const ScreenOffer& offer,
                                            const std::vector<ChosenPlace>& further) const {
    const auto is_taken = [&](ObjectId id) {
        return std::any_of(further.begin(), further.end(),
                           [&](const ChosenPlace& one) { return one.kept == id; });
    };
    std::optional<ObjectId> of_nobody;
    for (const auto& [id, object] : state_.objects()) {
        const auto screen = decode_shared_screen(object.kind, object.properties);
        if (!screen || screen->camera || screen->publisher != offer.publisher_name ||
            screen->name != offer.name || is_taken(id))
            continue;
        const auto sharer = sharers_.find(id);
        const bool is_known = sharer != sharers_.end() && !sharer->second.empty();
        if (is_known && sharer->second == offer.person)
            return id;
        if (!of_nobody && (!is_known || offer.person.empty()))
            of_nobody = id;
    }
    return of_nobody;
}

void HostRoom::take_restored_sharers() {
    for (const auto& [id, object] : state_.objects())
        if (is_shared_screen(object))
            if (auto sharer = authors_.extract(id))
                sharers_.insert(std::move(sharer));
}

bool HostRoom::is_sharer(ParticipantId id, ObjectId screen) const {
    if (state_.objects().at(screen).creator == id)
        return true;
    const auto sharer = sharers_.find(screen);
    return sharer != sharers_.end() && !sharer->second.empty() &&
           sharer->second == members_.at(id).person;
}

std::optional<CameraId> HostRoom::camera_of_removed(const Request& request) const {
    const auto* remove = std::get_if<request::Remove>(&request);
    const auto screen = remove ? shared_screen_of(state_.objects(), remove->object) : std::nullopt;
    return screen ? screen->camera : std::nullopt;
}

// nullopt: the request is decided as that on any object.
std::optional<RoomState::Decision> HostRoom::decide_on_screen(ParticipantId id,
                                                              const Request& request) {
    const ObjectId named = object_of(request);
    const auto found = state_.objects().find(named);
    if (found == state_.objects().end() || !is_shared_screen(found->second))
        return std::nullopt;
    const auto refused = [](Refusal refusal) { return RoomState::Decision{refusal, {}}; };
    const RoomObject& object = found->second;
    const auto before = decode_shared_screen(object.kind, object.properties);
    const bool may_decide = is_sharer(id, named) || may(members_.at(id).role, Right::manage);
    if (!before || !before->camera)
        return refused(Refusal::no_such_object);
    if (std::holds_alternative<request::Grab>(request) && before->pinned)
        return refused(Refusal::pinned);
    if (const auto* change = std::get_if<request::SetProperties>(&request)) {
        auto after = decode_shared_screen(ObjectKind::screen, change->properties);
        if (!after)
            return refused(Refusal::malformed);
        SharedScreen same = *before;
        same.pinned = after->pinned;
        if (*after != same)
            return refused(Refusal::malformed);
        if (!may_decide)
            return refused(Refusal::of_sharer);
    }
    if (std::holds_alternative<request::Remove>(request)) {
        if (!may_decide)
            return refused(Refusal::of_sharer);
        // The host's own cameras do not end.
        if (object.creator == ParticipantId{})
            return refused(Refusal::role);
        sharers_.erase(named);
        // Also out of somebody's hand.
        return RoomState::Decision{Refusal::none, state_.remove({named})};
    }
    return std::nullopt;
}

}  // namespace theatron::session
