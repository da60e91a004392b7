// SPDX-License-Identifier: Apache-2.0
#include "viewer/facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "pace/drawing_watch.h"
#include "viewer/age_text.h"
#include "viewer/picture_dot.h"
#include "viewer/still_cover.h"
#include "viewer/trust_panel.h"
#include "wire/condition_text.h"
#include "wire/sentence.h"

namespace theatron::viewer {
namespace {

std::string frames(double per_second) {
    return say(Phrase::frames_a_second, std::to_string(std::lround(per_second)));
}

std::string megabits(double per_second) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.1f Mbit/s", per_second);
    return decimal(text);
}

std::string first_sentence(const std::string& text) {
    return text.substr(0, std::min(text.find(". "), text.size()));
}

Phrase count_of(const client::CameraFigures& camera) {
    switch (camera.camera.state.condition) {
        case wire::CameraCondition::live:
            switch (camera.played) {
                case client::CameraFigures::Played::no:
                    return Phrase::live_count;
                case client::CameraFigures::Played::paused:
                    return Phrase::paused_count;
                default:
                    return Phrase::recording_count;
            }
        case wire::CameraCondition::stale:
            return Phrase::stale_count;
        case wire::CameraCondition::ended:
            return Phrase::ended_count;
        case wire::CameraCondition::failed:
            break;
    }
    return Phrase::failed_count;
}

// "2 live", "1 live, 1 stale", or "2 recording".
window::Fact cameras_fact(const std::vector<client::CameraFigures>& cameras) {
    std::string text;
    bool trouble = false;
    for (const Phrase state : {Phrase::live_count, Phrase::recording_count, Phrase::paused_count,
                               Phrase::stale_count, Phrase::ended_count, Phrase::failed_count}) {
        const auto count = std::count_if(cameras.begin(), cameras.end(), [&](const auto& camera) {
            return count_of(camera) == state;
        });
        if (count == 0)
            continue;
        text += (text.empty() ? "" : ", ") + say(state, std::to_string(count));
        trouble = trouble || state != Phrase::live_count;
    }
    const auto relayed = std::count_if(cameras.begin(), cameras.end(),
                                       [](const auto& camera) { return camera.relayed; });
    if (relayed > 0)
        text += ", " + say(Phrase::relayed_count, std::to_string(relayed));
    return {say(Phrase::cameras), text.empty() ? say(Phrase::none) : text, trouble};
}

// "cameras together, 12 pictures alone".
window::Fact moment_fact(const Facts& facts) {
    // Pictures of one moment are exposed within a fraction of a frame's time.
    constexpr double together_ms = 4;
    std::string text =
        *facts.skew_ms < together_ms
            ? say(Phrase::cameras_together)
            : say(Phrase::cameras_apart, std::to_string(std::lround(*facts.skew_ms)));
    if (const std::uint64_t unpaired = facts.received.moments.unpaired; unpaired > 0)
        text = say(Phrase::cameras_unpaired, text, std::to_string(unpaired));
    return {say(Phrase::one_moment), text};
}

// A live camera with a problem that its picture does not show: it was moved, or plays damage.
void add_problems(const std::vector<client::CameraFigures>& cameras,
                  std::vector<window::Fact>& line) {
    for (const client::CameraFigures& one : cameras) {
        const wire::CameraState& state = one.camera.state;
        if (state.condition == wire::CameraCondition::live && !state.problem.empty())
            line.push_back({say(Phrase::camera_named, one.camera.description.name),
                            first_sentence(wire::sentence(state.problem)), true});
    }
}

// The one text that all cameras have, "several" if they differ, "none" if there is none.
template <class TextOf>
std::string common(const std::vector<client::CameraFigures>& cameras, const TextOf& text_of) {
    std::string text;
    for (const auto& camera : cameras) {
        const std::string value = text_of(camera);
        if (value.empty() || value == text)
            continue;
        if (!text.empty())
            return say(Phrase::several);
        text = value;
    }
    return text.empty() ? say(Phrase::nothing_chosen) : text;
}

// "h264 (lossy)" where a camera's newest depth image is not exact everywhere.
window::Fact depth_fact(const std::vector<client::CameraFigures>& cameras) {
    const std::string codec = common(cameras, [](const auto& c) { return c.depth.codec; });
    const bool lossy = std::any_of(cameras.begin(), cameras.end(), [](const auto& c) {
        return c.depth.frames > 0 && c.depth.exact == receive::Exactness::nowhere;
    });
    return {say(Phrase::depth_fact), lossy ? say(Phrase::lossy_codec, codec) : codec, lossy};
}

// "blend (auto)", "mesh, set by host, coarser".
std::string drawing_text(const Facts& facts) {
    std::string text = facts.way.renderer;
    if (facts.renderer_chosen_by == Facts::ChosenBy::program)
        text = say(Phrase::drawn_automatically, text);
    if (facts.renderer_chosen_by == Facts::ChosenBy::host)
        text = say(Phrase::drawn_as_host_says, text);
    if (facts.way.scale < 1 || facts.way.depth_step > 1)
        text = say(Phrase::drawn_coarser, text);
    return text;
}

// Frames come much faster than this machine draws them.
bool drawing_is_slow(const Facts& facts) {
    constexpr double slow_fps = 10;
    const double received = facts.received.live_frames_per_second();
    const double wanted = std::min(received, facts.most_drawn_per_second.value_or(received));
    return facts.has_picture && facts.drawn_per_second < slow_fps &&
           facts.drawn_per_second < wanted / 2;
}

// The one that the keys decide on, and the number of the others.
std::string visitors_text(const std::vector<wire::Visitor>& visitors) {
    return say(visitors.size() > 1 ? Phrase::visitor_and_more : Phrase::visitor,
               visitors.front().name, wire::spoken(visitors.front()),
               std::to_string(visitors.size() - 1));
}

// Facts on the cameras' pictures.
void add_pictures(const Facts& facts,
                  const std::function<std::string(const std::string&)>& filter_name,
                  std::vector<window::Fact>& line) {
    const auto& [status, cameras, recordings, moments] = facts.received;
    line.push_back({say(Phrase::dropped), std::to_string(facts.received.dropped())});
    if (status.delivery.level > 0)
        line.push_back({say(Phrase::sent), wire::sent_part(status.delivery, language()), true});
    line.push_back(depth_fact(cameras));
    line.push_back(
        {say(Phrase::color_fact), common(cameras, [](const auto& c) { return c.color.codec; })});
    const std::string filter = common(cameras, [](const auto& c) { return c.camera.state.filter; });
    line.push_back({say(Phrase::filter),
                    filter_name(filter == say(Phrase::nothing_chosen) ? std::string() : filter)});
}

std::vector<window::Fact> line_of(
    const Facts& facts, const std::string& address,
    const std::function<std::string(const std::string&)>& filter_name) {
    using Phase = client::Participant::Phase;
    const auto& [status, cameras, recordings, moments] = facts.received;
    std::vector<window::Fact> line;
    line.push_back({say(Phrase::host), status.host_name.empty() ? address : status.host_name});
    const window::Fact age{say(Phrase::age_of_picture),
                           facts.age_ms ? age_text(*facts.age_ms) : say(Phrase::unknown),
                           facts.age_ms && *facts.age_ms > old_picture_ms};
    if (!facts.visitors.empty())
        line.push_back({say(Phrase::at_the_door), visitors_text(facts.visitors), true});
    if (status.phase == Phase::joined) {
        // Visible to everybody, first of all.
        if (!recordings.empty())
            line.push_back({say(Phrase::recording), client::recorded_text(facts.received), true});
        if (const auto voice = recorded_voice_fact(facts.voices); voice && !recordings.empty())
            line.push_back(*voice);
        if (status.standing.muted || status.standing.role != wire::Role::expert)
            line.push_back({say(Phrase::you),
                            status.standing.muted
                                ? say(Phrase::role_and_muted, wire::spoken(status.standing.role))
                                : wire::spoken(status.standing.role)});
        if (const auto microphone = microphone_fact(facts.voices, status.standing))
            line.push_back(*microphone);
        if (facts.own_face == OwnFace::seen)
            line.push_back({say(Phrase::webcam), say(Phrase::webcam_is_seen), true});
        if (facts.own_face == OwnFace::opening)
            line.push_back({say(Phrase::webcam), say(Phrase::webcam_opens)});
        if (!facts.played.empty() && facts.past.empty())
            line.push_back({say(Phrase::not_live), facts.played, true});
        // No camera's present state beside pictures of the past.
        line.push_back(facts.past.empty() ? cameras_fact(cameras)
                                          : window::Fact{say(Phrase::cameras), facts.past, true});
        if (facts.skew_ms && facts.past.empty())
            line.push_back(moment_fact(facts));
        add_problems(cameras, line);
        if (facts.has_picture && !cameras.empty())
            line.push_back(age);
        if (!cameras.empty())
            line.push_back(
                {say(Phrase::received), frames(facts.received.live_frames_per_second())});
        line.push_back({say(Phrase::drawn),
                        facts.drawing_rests
                            ? say(Phrase::decoding_comes_first, frames(facts.drawn_per_second))
                            : frames(facts.drawn_per_second),
                        drawing_is_slow(facts)});
        line.push_back({say(Phrase::data), megabits(facts.received.mbit_per_second())});
        if (!cameras.empty())
            add_pictures(facts, filter_name, line);
    } else {
        const bool is_waiting = status.phase == Phase::waiting;
        const bool is_connecting = status.phase == Phase::connecting;
        line.push_back({say(Phrase::connection),
                        say(is_waiting      ? Phrase::is_waiting
                            : is_connecting ? Phrase::is_connecting
                                            : Phrase::none),
                        !is_waiting && !is_connecting});
        if (facts.has_picture)
            line.push_back(age);
    }
    line.push_back({say(Phrase::drawing), drawing_text(facts)});
    line.push_back({say(Phrase::help), "F1"});
    // The last one: it comes and goes with the mouse, and no other fact moves.
    if (!facts.pointed.empty())
        line.push_back({say(Phrase::under_mouse), facts.pointed});
    return line;
}

// Over a picture that no longer shows the present, although it is not marked as not live. In other
// phases the message is there.
std::string cover_of(const Facts& facts) {
    if (facts.received.status.phase != client::Participant::Phase::joined || !facts.has_picture ||
        !facts.past.empty() || facts.frozen)
        return {};
    constexpr TimePoint now{};  // the ages are those of the figures
    if (const auto still = all_still(shown_cameras(facts.received.cameras, now), now))
        return still_text(still);
    if (facts.played.empty() && facts.age_ms && *facts.age_ms >= to_ms(pace::still_after))
        return say(Phrase::this_picture_is_old, age_text(*facts.age_ms));
    return {};
}

// Warnings about conditions that the picture itself does not show.
std::string warning_of(const Facts& facts) {
    // In other phases the message says it.
    if (facts.received.status.phase != client::Participant::Phase::joined || !facts.has_picture)
        return {};
    if (!facts.past.empty())
        return say(facts.frozen ? Phrase::past_frozen : Phrase::past_end_key, facts.past);
    if (facts.frozen)
        return facts.age_ms ? say(Phrase::frozen_and_old, age_text(*facts.age_ms))
                            : say(Phrase::frozen_by_you);
    if (facts.age_ms && *facts.age_ms >= to_ms(pace::still_after))
        return say(Phrase::this_picture_is_old, age_text(*facts.age_ms));
    if (const std::string text = not_live_text(facts.received); !text.empty())
        return text;
    return slow_text(facts);
}

struct Message {
    std::string text, detail;
};

Message message_of(const Facts& facts, const std::string& address) {
    const client::Participant::Status& status = facts.received.status;
    const auto with_age = [&](const std::string& text) {
        return facts.has_picture && facts.age_ms && *facts.age_ms >= 1000
                   ? say(Phrase::old_picture_and, age_text(*facts.age_ms), text)
                   : text;
    };
    const auto with_key = [&] { return say(Phrase::press_esc, status.problem); };
    switch (status.phase) {
        case client::Participant::Phase::joined:
            if (!facts.has_picture)
                return {say(Phrase::waits_for_picture), ""};
            return {};
        case client::Participant::Phase::connecting:
            return {say(Phrase::connecting), address};
        case client::Participant::Phase::waiting:
            return {say(Phrase::waits_at_door), say(Phrase::room_decides)};
        case client::Participant::Phase::lost:
            return {say(status.joins > 0 ? Phrase::lost_connection : Phrase::no_connection_yet),
                    with_age(status.joins > 0 ? say(Phrase::comes_back_by_itself, status.problem)
                                              : status.problem)};
        case client::Participant::Phase::refused:
            return {say(Phrase::host_refuses), with_key()};
        case client::Participant::Phase::ended:
            return {say(Phrase::session_is_over), with_age(with_key())};
    }
    return {};
}

// A window with a bar shows little else unless asked: the dot and the offers say it.
void make_calm(const Facts& facts, window::OverlayContent& content) {
    const auto& status = facts.received.status;
    const std::string slow = slow_text(facts);
    DotFacts dot;
    dot.phase = status.phase;
    dot.has_picture = facts.has_picture;
    dot.age_ms = facts.age_ms;
    dot.is_of_another_time = facts.is_of_another_time();
    dot.is_missing_a_camera = !not_live_text(facts.received).empty();
    dot.is_late = !slow.empty() || status.delivery.level > 0;
    dot.unrest = facts.unrest;
    content.tools = facts.tools;
    content.tools->dot = picture_dot(dot);
    content.tools->dot.command = facts.tools->dot.command;
    if (!slow.empty() && content.warning == slow)
        content.tools->dot.hint = std::exchange(content.warning, "");
    if (content.message.empty() && !facts.help)
        content.offers = facts.offers;
    // The offer to return to the present begins with the same words.
    if (!facts.past.empty() && !facts.frozen && !content.offers.empty())
        content.warning.clear();
    const Phrase said_elsewhere[] = {
        Phrase::age_of_picture, Phrase::at_the_door, Phrase::drawn,     Phrase::sent,
        Phrase::depth_fact,     Phrase::microphone,  Phrase::connection};
    if (!facts.line)
        std::erase_if(content.facts, [&](const window::Fact& fact) {
            return std::any_of(std::begin(said_elsewhere), std::end(said_elsewhere),
                               [&](Phrase label) { return fact.label == say(label); });
        });
}

}  // namespace

std::string slow_text(const Facts& facts) {
    if (!drawing_is_slow(facts))
        return {};
    return say(facts.renderer_chosen_by == Facts::ChosenBy::person && !facts.most_drawn_per_second
                   ? Phrase::slow_press_m
                   : Phrase::slow_not_connection);
}

std::string filter_text(const std::string& filter) {
    return filter.empty()        ? say(Phrase::nothing_chosen)
           : filter == "default" ? say(Phrase::usual)
                                 : filter;
}

window::OverlayContent overlay_of(
    const Facts& facts, const std::string& address,
    const std::function<std::string(const std::string&)>& filter_name) {
    window::OverlayContent content;
    content.facts = line_of(facts, address, filter_name);
    // A hidden line still shows facts that need attention.
    if (!facts.line)
        std::erase_if(content.facts, [](const window::Fact& fact) { return !fact.warning; });
    const Message message = message_of(facts, address);
    content.message = message.text;
    content.detail = message.detail;
    content.cover = cover_of(facts);
    if (content.cover.empty())
        content.warning = warning_of(facts);
    if (message.text.empty())
        content.notice = facts.notice;
    content.help = facts.help;
    // The help covers them.
    if (message.text.empty() && !facts.help) {
        content.panels = facts.panels;
        content.pictures = facts.pictures;
        content.bar = facts.bar;
        content.rectangle = facts.rectangle;
        if (facts.trust)
            content.panels.push_back(trust_panel(facts.received, filter_name));
    }
    if (facts.tools)
        make_calm(facts, content);
    return content;
}

}  // namespace theatron::viewer
