// SPDX-License-Identifier: Apache-2.0
#include "viewer/facts.h"

#include <algorithm>

#include "viewer/age_text.h"
#include "viewer/trust_panel.h"
#include "wire/condition_text.h"

namespace theatron::viewer {
namespace {

std::string rounded(double value, int digits, const char* unit) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.*f %s", digits, value, unit);
    return text;
}

std::string first_sentence(const std::string& text) {
    return text.substr(0, std::min(text.find(". "), text.size()));
}

// "2 live", "1 live, 1 stale", or "2 recording".
xr::Fact cameras_fact(const std::vector<client::CameraFigures>& cameras) {
    std::string text;
    bool trouble = false;
    for (const std::string_view state :
         {"live", "recording", "paused", "stale", "ended", "failed"}) {
        const auto count = std::count_if(cameras.begin(), cameras.end(), [&](const auto& camera) {
            return client::state_text(camera) == state;
        });
        if (count == 0)
            continue;
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(state);
        trouble = trouble || state != "live";
    }
    const auto direct = std::count_if(cameras.begin(), cameras.end(),
                                      [](const auto& camera) { return camera.direct; });
    if (direct > 0)
        text += ", " + std::to_string(direct) + " direct";
    return {"Cameras", text.empty() ? "none" : text, trouble};
}

// A live camera with a problem that its picture does not show: it was moved, or plays damage.
void add_problems(const std::vector<client::CameraFigures>& cameras, std::vector<xr::Fact>& line) {
    for (const client::CameraFigures& one : cameras) {
        const wire::CameraState& state = one.camera.state;
        if (state.condition == wire::CameraCondition::live && !state.problem.empty())
            line.push_back({"Camera " + one.camera.description.name,
                            first_sentence(wire::english(state.problem)), true});
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
            return "several";
        text = value;
    }
    return text.empty() ? "none" : text;
}

// "h264 (lossy)" where a camera's newest depth image is not exact everywhere.
xr::Fact depth_fact(const std::vector<client::CameraFigures>& cameras) {
    const std::string codec = common(cameras, [](const auto& c) { return c.depth.codec; });
    const bool lossy = std::any_of(cameras.begin(), cameras.end(), [](const auto& c) {
        return c.depth.frames > 0 && c.depth.exact == receive::Exactness::nowhere;
    });
    return {"Depth", codec + (lossy ? " (lossy)" : ""), lossy};
}

// "blend (auto)", "mesh, set by host, coarser".
std::string drawing_text(const Facts& facts) {
    std::string text = facts.way.renderer;
    if (facts.renderer_chosen_by == Facts::ChosenBy::program)
        text += " (auto)";
    if (facts.renderer_chosen_by == Facts::ChosenBy::host)
        text += ", set by host";
    if (facts.way.scale < 1 || facts.way.depth_step > 1)
        text += ", coarser";
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
    const std::string others =
        visitors.size() > 1 ? " and " + std::to_string(visitors.size() - 1) + " more" : "";
    return visitors.front().name + " (" + wire::text_of(visitors.front().role) + ")" + others +
           ": Y lets in, U refuses";
}

// Facts on the cameras' pictures.
void add_pictures(const Facts& facts,
                  const std::function<std::string(const std::string&)>& filter_name,
                  std::vector<xr::Fact>& line) {
    const auto& [status, cameras, recordings] = facts.received;
    line.push_back({"Dropped", std::to_string(facts.received.dropped())});
    if (status.delivery.level > 0)
        line.push_back({"Sent", wire::sent_part(status.delivery), true});
    line.push_back(depth_fact(cameras));
    line.push_back({"Colour", common(cameras, [](const auto& c) { return c.color.codec; })});
    const std::string filter = common(cameras, [](const auto& c) { return c.camera.state.filter; });
    line.push_back({"Filter", filter_name(filter == "none" ? std::string() : filter)});
}

std::vector<xr::Fact> line_of(const Facts& facts, const std::string& address,
                              const std::function<std::string(const std::string&)>& filter_name) {
    using Phase = client::Participant::Phase;
    const auto& [status, cameras, recordings] = facts.received;
    std::vector<xr::Fact> line;
    line.push_back({"Host", status.host_name.empty() ? address : status.host_name});
    const xr::Fact age{"Age of picture", facts.age_ms ? age_text(*facts.age_ms) : "unknown",
                       facts.age_ms && *facts.age_ms > old_picture_ms};
    if (!facts.visitors.empty())
        line.push_back({"At the door", visitors_text(facts.visitors), true});
    if (status.phase == Phase::joined) {
        // Visible to everybody, first of all.
        if (!recordings.empty())
            line.push_back({"Recording", client::recorded_text(facts.received), true});
        if (const auto voice = recorded_voice_fact(facts.voices); voice && !recordings.empty())
            line.push_back(*voice);
        if (status.standing.muted || status.standing.role != wire::Role::expert)
            line.push_back({"You", wire::text_of(status.standing.role) +
                                       std::string(status.standing.muted ? ", muted" : "")});
        if (const auto microphone = microphone_fact(facts.voices, status.standing))
            line.push_back(*microphone);
        if (facts.own_face == OwnFace::seen)
            line.push_back({"Webcam", "you are seen", true});
        if (facts.own_face == OwnFace::opening)
            line.push_back({"Webcam", "is being opened"});
        if (!facts.played.empty() && facts.past.empty())
            line.push_back({"Not live", facts.played, true});
        // No camera's present state beside pictures of the past.
        line.push_back(facts.past.empty() ? cameras_fact(cameras)
                                          : xr::Fact{"Cameras", facts.past, true});
        add_problems(cameras, line);
        if (facts.has_picture && !cameras.empty())
            line.push_back(age);
        if (!cameras.empty())
            line.push_back(
                {"Received", rounded(facts.received.live_frames_per_second(), 0, "fps")});
        line.push_back(
            {"Drawn", rounded(facts.drawn_per_second, 0, "fps"), drawing_is_slow(facts)});
        line.push_back({"Data", rounded(facts.received.mbit_per_second(), 1, "Mbit/s")});
        if (!cameras.empty())
            add_pictures(facts, filter_name, line);
    } else {
        const bool is_waiting = status.phase == Phase::waiting;
        const bool is_connecting = status.phase == Phase::connecting;
        line.push_back({"Connection",
                        is_waiting      ? "waiting"
                        : is_connecting ? "connecting"
                                        : "none",
                        !is_waiting && !is_connecting});
        if (facts.has_picture)
            line.push_back(age);
    }
    line.push_back({"Drawing", drawing_text(facts)});
    line.push_back({"Help", "F1"});
    // The last one: it comes and goes with the mouse, and no other fact moves.
    if (!facts.pointed.empty())
        line.push_back({"Under the mouse", facts.pointed});
    return line;
}

// Warnings about conditions that the picture itself does not show.
std::string warning_of(const Facts& facts) {
    constexpr double repeated_ms = 2000;
    // In other phases the message says it.
    if (facts.received.status.phase != client::Participant::Phase::joined || !facts.has_picture)
        return {};
    if (!facts.past.empty())
        return facts.past + (facts.frozen ? ", frozen. Space: go on; " : ". ") + "End: live again";
    if (facts.frozen)
        return "Frozen by you" +
               (facts.age_ms ? ": this picture is " + age_text(*facts.age_ms) + " old" : "") +
               ". Space: live again";
    if (facts.age_ms && *facts.age_ms >= repeated_ms)
        return "This picture is " + age_text(*facts.age_ms) + " old";
    if (const std::string text = not_live_text(facts.received); !text.empty())
        return text;
    if (drawing_is_slow(facts))
        return facts.renderer_chosen_by == Facts::ChosenBy::person && !facts.most_drawn_per_second
                   ? "This computer draws too slowly; press M until \"auto\" appears"
                   : "This computer draws too slowly; the connection is not the cause";
    return {};
}

struct Message {
    std::string text, detail;
};

Message message_of(const Facts& facts, const std::string& address) {
    const client::Participant::Status& status = facts.received.status;
    const std::string old = facts.has_picture && facts.age_ms && *facts.age_ms >= 1000
                                ? "This picture is " + age_text(*facts.age_ms) + " old. "
                                : "";
    switch (status.phase) {
        case client::Participant::Phase::joined:
            if (!facts.has_picture)
                return {"Waiting for the first picture…", ""};
            return {};
        case client::Participant::Phase::connecting:
            return {"Connecting…", address};
        case client::Participant::Phase::waiting:
            return {"Waiting to be let in…", "The operating room decides. Esc: leave."};
        case client::Participant::Phase::lost:
            return {status.joins > 0 ? "Connection lost, trying again…"
                                     : "No connection yet, trying again…",
                    old + status.problem};
        case client::Participant::Phase::refused:
            return {"The host does not let you in", status.problem + " Press Esc to leave."};
        case client::Participant::Phase::ended:
            return {"The session is over", old + status.problem + " Press Esc to leave."};
    }
    return {};
}

}  // namespace

xr::OverlayContent overlay_of(const Facts& facts, const std::string& address,
                              const std::function<std::string(const std::string&)>& filter_name) {
    xr::OverlayContent content;
    content.facts = line_of(facts, address, filter_name);
    // A hidden line still shows facts that need attention.
    if (!facts.line)
        std::erase_if(content.facts, [](const xr::Fact& fact) { return !fact.warning; });
    const Message message = message_of(facts, address);
    content.message = message.text;
    content.detail = message.detail;
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
    return content;
}

}  // namespace theatron::viewer
