// SPDX-License-Identifier: Apache-2.0
#include "viewer/playing.h"

#include <algorithm>
#include <cstdio>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

// The host's answer comes within this time; until then the bar shows what was asked for.
constexpr Duration answered_within = std::chrono::milliseconds(700);

}  // namespace

Duration position_at(const wire::Playback& playback, TimePoint session_time) {
    const Duration since =
        playback.paused ? Duration(0) : std::max(session_time - playback.at, Duration(0));
    return std::clamp(playback.position + since, Duration(0), playback.length);
}

std::string clock_text(Duration position) {
    const auto seconds = position / std::chrono::seconds(1);
    char text[32];
    if (seconds < 3600)
        std::snprintf(text, sizeof(text), "%d:%02d", int(seconds / 60), int(seconds % 60));
    else
        std::snprintf(text, sizeof(text), "%d:%02d:%02d", int(seconds / 3600),
                      int(seconds / 60 % 60), int(seconds % 60));
    return text;
}

std::string playback_text(const wire::Playback& playback, TimePoint session_time) {
    return say(!playback.paused      ? Phrase::plays_recording
               : playback.by.empty() ? Phrase::recording_at_end
                                     : Phrase::recording_paused,
               clock_text(position_at(playback, session_time)), clock_text(playback.length),
               playback.by);
}

bool Playing::carry_out(const PlayStep& play, client::Participant& participant, TimePoint now) {
    const auto playback = participant.playback();
    if (!playback)
        return false;
    using What = PlayStep::What;
    const Duration here = position_at(*playback, participant.session_time(now));
    switch (play.what) {
        case What::toggle:
            participant.play(playback->paused ? wire::PlayAction::resume : wire::PlayAction::pause);
            break;
        case What::back:
            seek(participant, here - step, now);
            break;
        case What::forward:
            seek(participant, here + step, now);
            break;
        case What::slide:
            break;
    }
    return true;
}

void Playing::seek(client::Participant& participant, Duration position, TimePoint now) {
    asked_ = std::max(position, Duration(0));
    asked_at_ = now;
    participant.play(wire::PlayAction::seek, asked_);
}

void Playing::slide(double position) {
    wanted_ = seconds_to_duration(position);
}

void Playing::on_tick(client::Participant& participant, TimePoint now) {
    if (wanted_ && now - asked_at_ >= seek_every)
        seek(participant, *std::exchange(wanted_, std::nullopt), now);
}

std::optional<window::PanelRow> Playing::bar(const client::Participant& participant, bool may_play,
                                             TimePoint now, RoomPanel& panel) const {
    const auto playback = participant.playback();
    if (!playback)
        return std::nullopt;
    const auto button = [&](const std::string& label, PlayStep::What what) {
        return panel.button(label, PlayStep{what});
    };
    Duration here = position_at(*playback, participant.session_time(now));
    if (wanted_ ||
        (playback->at < participant.session_time(asked_at_) && now - asked_at_ < answered_within))
        here = std::min(wanted_.value_or(asked_), playback->length);
    window::PanelRow bar{
        say(Phrase::bar_recording, clock_text(here), clock_text(playback->length)),
        playback->paused && !playback->by.empty() ? say(Phrase::paused_by, playback->by) : "",
        {}};
    if (playback->paused && playback->by.empty())
        bar.detail = say(Phrase::at_its_end);
    bar.slider =
        window::PanelSlider{to_seconds(here), 0, std::max(to_seconds(playback->length), 0.001), -1};
    if (!may_play)
        return bar;
    using What = PlayStep::What;
    bar.buttons = {button(say(playback->paused ? Phrase::play : Phrase::pause), What::toggle),
                   button("-5 s", What::back), button("+5 s", What::forward)};
    bar.slider->command = panel.add(PlayStep{What::slide});
    return bar;
}

}  // namespace theatron::viewer
