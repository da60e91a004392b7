// SPDX-License-Identifier: Apache-2.0
#include "viewer/looking_back.h"

#include <algorithm>
#include <optional>

#include "phrases/phrase.h"
#include "viewer/age_text.h"

namespace theatron::viewer {
namespace {

// The host's answer comes within this time.
constexpr Duration looked_back_within = std::chrono::seconds(1);

}  // namespace

std::set<CameraId> of_another_moment(const std::map<CameraId, receive::CameraFramePtr>& frames,
                                     const std::set<CameraId>& looking) {
    std::set<CameraId> past, present;
    for (const auto& [camera, frame] : frames)
        (frame->past ? past : present).insert(camera);
    if (past.empty() || present.empty())
        return {};
    return looking.empty() ? past : present;
}

std::string past_text(const std::map<CameraId, receive::CameraFramePtr>& frames,
                      const std::set<CameraId>& looking,
                      const std::map<CameraId, std::string>& names, TimePoint session_time) {
    std::string left_out;
    for (const CameraId camera : of_another_moment(frames, looking))
        if (const auto name = names.find(camera); !looking.contains(camera) && name != names.end())
            left_out += (left_out.empty() ? "" : ", ") + name->second;
    std::optional<TimePoint> oldest;
    for (const auto& [camera, frame] : frames)
        if (frame->past)
            oldest = std::min(oldest.value_or(frame->times.captured), frame->times.captured);
    if (!oldest)
        return looking.empty() ? "" : say(Phrase::looks_back);
    if (looking.empty() && !left_out.empty())
        return say(Phrase::camera_not_yet_live, left_out);
    const std::string age = age_text(std::max(to_ms(session_time - *oldest), 0.0));
    return left_out.empty() ? say(Phrase::past_ago, age)
                            : say(Phrase::past_ago_without, age, left_out);
}

Duration LookingBack::here(const client::Participant& participant, TimePoint now) const {
    const bool is_answered = now - asked_at_ > looked_back_within;
    return is_answered && !participant.looks_back() ? Duration(0) : asked_;
}

Duration LookingBack::further(const client::Participant& participant, TimePoint now) const {
    return std::min(here(participant, now) + step, farthest);
}

Duration LookingBack::nearer(const client::Participant& participant, TimePoint now) const {
    return std::max(here(participant, now) - step, Duration(0));
}

bool LookingBack::go(Duration ago, client::Participant& participant, TimePoint now) {
    if (participant.look_back(ago) == 0)
        return false;
    asked_ = ago;
    asked_at_ = now;
    return true;
}

void LookingBack::add_panel(const std::string& past, bool knows_objects,
                            const client::Participant& participant, TimePoint now,
                            RoomPanel& panel) const {
    using std::chrono::seconds;
    const auto button = [&](const std::string& label, Duration ago) {
        return panel.button(label, LookBackTo{ago});
    };
    window::PanelRow row{past.empty() ? say(Phrase::the_present) : past,
                         past.empty()    ? ""
                         : knows_objects ? say(Phrase::people_are_of_now)
                                         : say(Phrase::objects_are_unknown),
                         {}};
    if (past.empty())
        for (const int ago : {10, 30, 60})
            row.buttons.push_back(
                button(say(Phrase::seconds_ago, std::to_string(ago)), seconds(ago)));
    else
        row.buttons = {button(say(Phrase::live), Duration(0)),
                       button("-10 s", further(participant, now)),
                       button("+10 s", nearer(participant, now))};
    panel.panels.push_back({say(Phrase::look_back_alone), {std::move(row)}});
}

}  // namespace theatron::viewer
