// SPDX-License-Identifier: Apache-2.0
#include "page_state.h"

#include <algorithm>
#include <utility>

#include "client/decoder_pool_web.h"
#include "phrases/phrase.h"
#include "session/permissions.h"
#include "session/room_bytes.h"
#include "session/room_text.h"
#include "visit.h"

namespace theatron::web {
namespace {

using nlohmann::json;

// The page shows one kind at a time. The panel of the case has the case's name.
const char* kind_of(const window::Panel& panel) {
    constexpr std::pair<Phrase, const char*> kinds[] = {
        {Phrase::people, "people"},        {Phrase::places, "places"},
        {Phrase::at_the_door, "door"},     {Phrase::calls_you, "call"},
        {Phrase::screens, "screens"},      {Phrase::sound, "sound"},
        {Phrase::cameras, "cameras"},      {Phrase::look_back_alone, "past"},
        {Phrase::marks, "marks"},          {Phrase::study, "study"},
        {Phrase::shared_screen, "shared"},
    };
    for (const auto& [title, kind] : kinds)
        if (panel.title == say(title))
            return kind;
    return "case";
}

// The facts that a page shows also while it hides the others; "": none of them.
const char* kind_of(const window::Fact& fact) {
    return fact.label == say(Phrase::recording)     ? "recording"
           : fact.label == say(Phrase::at_the_door) ? "door"
           : fact.label == say(Phrase::not_live)    ? "not_live"
                                                    : "";
}

json to_json(const window::OverlayContent& overlay) {
    json facts = json::array(), panels = json::array();
    for (const window::Fact& fact : overlay.facts)
        facts.push_back({{"label", fact.label},
                         {"value", fact.value},
                         {"warning", fact.warning},
                         {"kind", kind_of(fact)}});
    for (const window::Panel& panel : overlay.panels) {
        json rows = json::array();
        for (const window::PanelRow& row : panel.rows) {
            json buttons = json::array();
            for (const window::PanelButton& button : row.buttons)
                buttons.push_back({{"label", button.label},
                                   {"command", button.command},
                                   {"leads_away", button.leads_away}});
            rows.push_back({{"text", row.text}, {"detail", row.detail}, {"buttons", buttons}});
            if (row.subject)
                rows.back()["subject"] = *row.subject;
        }
        panels.push_back({{"title", panel.title},
                          {"kind", kind_of(panel)},
                          {"keyboard", panel.keyboard},
                          {"rows", rows}});
    }
    return {
        {"facts", facts},           {"message", overlay.message},
        {"detail", overlay.detail}, {"warning", overlay.warning},
        {"notice", overlay.notice}, {"panels", panels},
        {"cover", overlay.cover},
    };
}

// A camera that stands still for a moment, or goes on: under load that happens all the time.
bool is_of_camera(const std::string& notice, const client::Participant& participant) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    return std::any_of(cameras.begin(), cameras.end(), [&](const auto& camera) {
        return viewer::is_of_unrest(notice, camera.description.name);
    });
}

// Null before the first frame since the session's time is known.
json age_json(double age_ms) {
    return age_ms == 0 ? json() : json(age_ms);
}

json camera_json(const client::CameraFigures& figures) {
    const auto& [camera, depth, color, relayed, played] = figures;
    const receive::StreamFigures* const seen = figures.seen();
    return {{"name", camera.description.name},
            {"state", client::state_text(figures)},
            {"depth", depth.codec},
            {"color", color.codec},
            {"depth_frames", depth.frames},
            {"color_frames", color.frames},
            {"dropped", figures.dropped()},
            {"is_asked_for", seen != nullptr},
            {"frames", seen ? seen->frames : 0},
            {"fps", seen ? seen->frames_per_second : 0},
            {"mbit_per_second", figures.mbit_per_second()},
            {"age_ms", seen && seen->has_come ? age_json(seen->age_now_ms) : json()},
            {"age_p50_ms", age_json(depth.age_p50_ms)},
            {"age_p95_ms", age_json(depth.age_p95_ms)},
            {"age_p99_ms", age_json(depth.age_p99_ms)},
            {"color_fps", color.frames_per_second},
            {"color_age_p50_ms", age_json(color.age_p50_ms)},
            {"depth_decode_ms", depth.decode_ms},
            {"color_decode_ms", color.decode_ms},
            {"decoder_failures", color.decoder_failures}};
}

json to_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

// Everybody in the room with a name, oneself included; `head` in metres, of those who told it.
json people_json(const client::Participant::Room& room, const client::Participant& participant) {
    json people = json::array();
    const auto poses = participant.poses();
    for (const auto& [id, object] : room.objects)
        if (object.kind == session::ObjectKind::person)
            if (const auto facts = session::decode_person(object.properties)) {
                people.push_back({{"id", unsigned(object.creator)},
                                  {"name", facts->name},
                                  {"self", object.creator == room.self}});
                const auto pose = poses.find(object.creator);
                if (pose != poses.end() && pose->second.head)
                    people.back()["head"] = pose->second.head->position;
            }
    return people;
}

// The names of the others who have raised a hand.
json hands_json(const client::Participant& participant) {
    json names = json::array();
    for (const auto& [person, name] : participant.raised_hands())
        if (person != participant.room_self())
            names.push_back(name);
    return names;
}

json ear_json(const Pose& room_from_eye) {
    const Pose turn{room_from_eye.rotation, {}};
    return {{"position", to_json(room_from_eye.translation)},
            {"ahead", to_json(turn * Vec3{0, 0, 1})},
            {"up", to_json(turn * Vec3{0, -1, 0})}};
}

}  // namespace

json page_state(const viewer::Viewer& viewer, const viewer::Facts& facts,
                const client::Participant& participant, const std::string& address) {
    json state = state_of(facts, participant, address);
    state["draws"] = viewer.is_drawing();
    state["pictures"] = viewer.pictures();
    // The choice of the person, or of the host; the rest of the state has what came of it.
    state["chosen"] = {{"renderer", viewer.renderer_choice().renderer()},
                       {"renderer_locked", viewer.renderer_choice().locked()},
                       {"depth", viewer.depth_codec()},
                       {"scale", viewer.scale()}};
    state["ear"] = ear_json(viewer.told_eye());
    return state;
}

json state_of(const viewer::Facts& facts, const client::Participant& participant,
              const std::string& address) {
    auto overlay = viewer::overlay_of(facts, address, viewer::filter_text);
    const unsigned decoders = client::decoder_pool().count;
    overlay.facts.push_back(
        {say(Phrase::decoding),
         decoders > 0 ? say(Phrase::workers, std::to_string(decoders)) : say(Phrase::in_the_page)});
    json cameras = json::array();
    for (const client::CameraFigures& camera : facts.received.cameras)
        cameras.push_back(camera_json(camera));
    const client::Participant::Room room = participant.room();
    std::size_t bricks = 0;
    for (const auto& [id, object] : room.objects)
        bricks += object.kind == session::ObjectKind::brick;
    const auto& status = facts.received.status;
    const bool asks_consent = participant.asks_voice_consent();
    return {{"phase", client::text_of(status.phase)},
            {"problem", status.problem},
            // True: the page is of no use until it is loaded again.
            {"is_outdated", status.is_outdated},
            {"face_problem", status.face_problem},
            {"host", status.host_name},
            {"joins", status.joins},
            {"has_picture", facts.has_picture},
            // The age of the picture that is shown; null: not known.
            {"age_ms", facts.age_ms ? json(*facts.age_ms) : json()},
            {"is_past", !facts.past.empty()},
            {"is_not_live", facts.is_of_another_time()},
            {"is_slow", !overlay.warning.empty() && overlay.warning == viewer::slow_text(facts)},
            {"is_of_camera", is_of_camera(overlay.notice, participant)},
            // The skew of the cameras that are drawn together; null: fewer than two.
            {"skew_ms", facts.skew_ms ? json(*facts.skew_ms) : json()},
            {"unpaired", facts.received.moments.unpaired},
            {"drawn_per_second", facts.drawn_per_second},
            {"renderer", facts.way.renderer},
            {"depth_step", facts.way.depth_step},
            {"scale", facts.way.scale},
            {"overlay", to_json(overlay)},
            {"decoders", decoders},
            {"cameras", cameras},
            {"people", people_json(room, participant)},
            {"is_heard",
             session::may(status.standing.role, session::Right::speak) && !status.standing.muted},
            {"is_muted", status.standing.muted},
            {"may_speak", session::may(status.standing.role, session::Right::speak)},
            {"may_point", session::may(status.standing.role, session::Right::point)},
            {"may_be_seen", session::may(status.standing.role, session::Right::be_seen)},
            {"may_show_screen", session::may(status.standing.role, session::Right::show_screen)},
            // `has_ended`: by others, since the last state.
            {"screen",
             {{"problem", status.screen_problem},
              {"is_taken", page().screen.is_taken()},
              {"has_ended", page().screen.take_ended()}}},
            {"may_handle", session::may(status.standing.role, session::Right::handle)},
            // Null where the host does not ask.
            {"voice_may_record", asks_consent ? json(participant.voice_may_record()) : json()},
            {"is_recorded", !participant.recordings().empty()},
            {"chat",
             {{"has_chat", participant.has_chat()},
              {"may_write", participant.may_write()},
              // The ages of messages are known once the clock is.
              {"version", 2 * participant.chat_version() + status.clock_known},
              {"hand_raised", participant.hand_raised()},
              {"wants_hand", participant.wants_hand_raised()}}},
            {"hands", hands_json(participant)},
            {"bricks", bricks},
            // Equal for all who see the same room.
            {"room_hash", session::hash_text(room.objects)}};
}

}  // namespace theatron::web
