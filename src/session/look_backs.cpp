// SPDX-License-Identifier: Apache-2.0
#include "session/look_backs.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

void LookBacks::keep(const wire::MediaHeader& header, ByteView message, TimePoint now) {
    const ActiveSetting* kept = is_possible() ? streams_.kept_setting(header.stream) : nullptr;
    if (kept && kept->id == header.setting && past_.add(header, message, kept->codec, now))
        streams_.request_key(header.stream, header.setting);
}

void LookBacks::clear() {
    while (!lookers_.empty())
        end(lookers_.begin()->first);
    past_.clear();
}

bool LookBacks::is_shown(ParticipantId id, const Past::Picture& picture) const {
    const CameraStreams* camera =
        picture.message ? streams_.cameras().find(camera_of(picture.header.stream)) : nullptr;
    return camera && camera->is_for(id, false, false);
}

wire::ManageRefusal LookBacks::begin(ParticipantId id, Duration ago, TimePoint now) {
    if (ago < least) {
        end(id);
        return wire::ManageRefusal::none;
    }
    const auto start = past_.start(now - std::min(ago, past_.reach()));
    if (!start)
        return wire::ManageRefusal::nothing_kept;
    Looker looker;
    looker.next = *start;
    const TimePoint from = past_.find(*start)->at;
    looker.behind = now - from;
    // The first picture of each stream, so that all of them change at once.
    std::map<StreamId, Past::Position> first;
    for (Past::Position at = *start; at < past_.end(); ++at) {
        const Past::Picture& picture = *past_.find(at);
        if (picture.at > from + 2 * Past::key_every)
            break;
        if (is_shown(id, picture))
            first.try_emplace(picture.header.stream, at);
    }
    if (first.empty())
        return wire::ManageRefusal::nothing_kept;
    Looker& now_looking = lookers_[id];
    give_numbers_back(now_looking);
    now_looking = std::move(looker);
    std::vector<Past::Position> pictures;
    for (const auto& [stream, at] : first)
        pictures.push_back(at);
    announce(id, now_looking, pictures);
    return wire::ManageRefusal::none;
}

// Tells the participant the settings of these pictures.
void LookBacks::announce(ParticipantId id, Looker& looker,
                         const std::vector<Past::Position>& pictures) {
    wire::Settings message;
    for (const Past::Position at : pictures) {
        const Past::Picture& picture = *past_.find(at);
        Shown& shown = looker.shown[picture.header.stream];
        if (shown.number != SettingId{})
            streams_.give_number_back(shown.number);
        shown = {streams_.take_number(), picture.header.setting, picture.codec, false};
        looker.cameras.insert(camera_of(picture.header.stream));
        message.settings.push_back({picture.header.stream, shown.number, shown.codec, true});
    }
    // Before the message: cameras that are no longer looked back at get their present settings.
    streams_.look_back(id, looker.cameras);
    actions_.push_back(action::Send{id, std::move(message)});
}

void LookBacks::give_numbers_back(Looker& looker) {
    for (const auto& [stream, shown] : looker.shown)
        streams_.give_number_back(shown.number);
    looker.shown.clear();
}

void LookBacks::end(ParticipantId id) {
    const auto found = lookers_.find(id);
    if (found == lookers_.end())
        return;
    leave(id);
    streams_.look_back(id, {});
}

void LookBacks::leave(ParticipantId id) {
    if (const auto found = lookers_.find(id); found != lookers_.end()) {
        give_numbers_back(found->second);
        lookers_.erase(found);
    }
}

// The bound of bytes may drop pictures that were not shown yet: then it goes on with the oldest.
void LookBacks::follow_bounds(Looker& looker, TimePoint now) const {
    if (looker.next >= past_.begin())
        return;
    looker.next = past_.begin();
    for (auto& [stream, shown] : looker.shown)
        shown.has_begun = false;
    if (const Past::Picture* oldest = past_.find(looker.next))
        looker.behind = std::min(looker.behind, now - oldest->at);
}

std::vector<LookBacks::Due> LookBacks::take_due(TimePoint now) {
    past_.on_time(now);
    std::vector<Due> due;
    for (auto& [id, looker] : lookers_) {
        follow_bounds(looker, now);
        for (; const Past::Picture* picture = past_.find(looker.next); ++looker.next) {
            if (picture->at + looker.behind > now)
                break;
            if (!is_shown(id, *picture))
                continue;
            const auto known = looker.shown.find(picture->header.stream);
            // The kept setting has changed, or another camera had come.
            if (known == looker.shown.end() || known->second.original != picture->header.setting ||
                known->second.codec != picture->codec)
                announce(id, looker, {looker.next});
            Shown& shown = looker.shown.at(picture->header.stream);
            shown.has_begun = shown.has_begun || picture->header.key;
            if (!shown.has_begun)
                continue;
            wire::MediaHeader header = picture->header;
            header.setting = shown.number;
            auto message = std::make_shared<Bytes>(*picture->message);
            wire::write_media_header(header, message->data());
            due.push_back({id, header, std::move(message)});
        }
    }
    return due;
}

std::optional<TimePoint> LookBacks::due() const {
    std::optional<TimePoint> first;
    for (const auto& [id, looker] : lookers_)
        if (const Past::Picture* next = past_.find(std::max(looker.next, past_.begin())))
            first = std::min(first.value_or(TimePoint::max()), next->at + looker.behind);
    return first;
}

}  // namespace theatron::session
