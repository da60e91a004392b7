// SPDX-License-Identifier: Apache-2.0
#include "viewer/looking_back.h"

#include <algorithm>
#include <optional>

#include "viewer/age_text.h"

namespace theatron::viewer {
namespace {

// The host's answer comes within this time.
constexpr Duration looked_back_within = std::chrono::seconds(1);

}  // namespace

std::string past_text(const std::map<CameraId, receive::CameraFramePtr>& frames,
                      const std::set<CameraId>& looking,
                      const std::map<CameraId, std::string>& names, TimePoint session_time) {
    std::optional<TimePoint> oldest;
    std::string live;
    for (const auto& [camera, frame] : frames) {
        if (frame->past)
            oldest = std::min(oldest.value_or(frame->times.captured), frame->times.captured);
        else if (const auto name = names.find(camera);
                 !looking.contains(camera) && name != names.end())
            live += (live.empty() ? "" : ", ") + name->second;
    }
    if (!oldest && looking.empty())
        return "";
    const std::string ago = oldest ? age_text(std::max(to_ms(session_time - *oldest), 0.0)) + " ago"
                                   : "looking back...";
    return "NOT LIVE: " + ago + (live.empty() ? "" : " (live: camera " + live + ")");
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

void LookingBack::add_panel(const std::string& past, const client::Participant& participant,
                            TimePoint now, RoomPanel& panel) const {
    using std::chrono::seconds;
    const auto button = [&](const char* label, Duration ago) {
        panel.commands.push_back(LookBackTo{ago});
        return xr::PanelButton{label, int(panel.commands.size()) - 1};
    };
    xr::PanelRow row{past.empty() ? "The present" : past,
                     past.empty() ? "" : "People and voices are of now",
                     {}};
    if (past.empty())
        row.buttons = {button("10 s ago", seconds(10)), button("30 s ago", seconds(30)),
                       button("60 s ago", seconds(60))};
    else
        row.buttons = {button("Live", Duration(0)), button("-10 s", further(participant, now)),
                       button("+10 s", nearer(participant, now))};
    panel.panels.push_back({"Look back (you alone)", {std::move(row)}});
}

}  // namespace theatron::viewer
