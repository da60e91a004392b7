// SPDX-License-Identifier: Apache-2.0
#include "page_state.h"

#include "session/room_bytes.h"
#include "wire/condition_text.h"

namespace theatron::web {
namespace {

using nlohmann::json;

json to_json(const xr::OverlayContent& overlay) {
    json facts = json::array(), panels = json::array();
    for (const xr::Fact& fact : overlay.facts)
        facts.push_back({{"label", fact.label}, {"value", fact.value}, {"warning", fact.warning}});
    for (const xr::Panel& panel : overlay.panels) {
        json rows = json::array();
        for (const xr::PanelRow& row : panel.rows) {
            json buttons = json::array();
            for (const xr::PanelButton& button : row.buttons)
                buttons.push_back({{"label", button.label}, {"command", button.command}});
            rows.push_back({{"text", row.text}, {"detail", row.detail}, {"buttons", buttons}});
        }
        panels.push_back({{"title", panel.title}, {"rows", rows}});
    }
    return {
        {"facts", facts},           {"message", overlay.message},
        {"detail", overlay.detail}, {"warning", overlay.warning},
        {"notice", overlay.notice}, {"panels", panels},
    };
}

json camera_json(const client::CameraFigures& figures) {
    const auto& [camera, depth, color] = figures;
    return {{"name", camera.description.name},
            {"state", wire::text_of(camera.state.condition)},
            {"depth", depth.codec},
            {"color", color.codec},
            {"depth_frames", depth.frames},
            {"color_frames", color.frames},
            {"dropped", figures.dropped()},
            {"fps", depth.frames_per_second},
            {"mbit_per_second", figures.mbit_per_second()},
            {"age_ms", depth.age_now_ms},
            {"age_p50_ms", depth.age_p50_ms}};
}

// Everybody in the room with a name, oneself included.
json people_json(const client::Participant::Room& room) {
    json people = json::array();
    for (const auto& [id, object] : room.objects)
        if (object.kind == session::ObjectKind::person)
            if (const auto facts = session::decode_person(object.properties))
                people.push_back({{"name", facts->name}, {"self", object.creator == room.self}});
    return people;
}

}  // namespace

json page_state(viewer::Viewer& viewer, const client::Participant& participant,
                const std::string& address, TimePoint now) {
    const viewer::Facts facts = viewer.facts(now);
    const auto overlay =
        viewer::overlay_of(facts, address, [](const std::string& filter) { return filter; });
    json cameras = json::array();
    for (const client::CameraFigures& camera : facts.received.cameras)
        cameras.push_back(camera_json(camera));
    const client::Participant::Room room = participant.room();
    std::size_t bricks = 0;
    for (const auto& [id, object] : room.objects)
        bricks += object.kind == session::ObjectKind::brick;
    const auto& status = facts.received.status;
    return {{"phase", client::text_of(status.phase)},
            {"problem", status.problem},
            {"host", status.host_name},
            {"joins", status.joins},
            {"has_picture", facts.has_picture},
            {"pictures", viewer.pictures()},
            {"drawn_per_second", facts.drawn_per_second},
            {"renderer", facts.way.renderer},
            {"overlay", to_json(overlay)},
            {"cameras", cameras},
            {"people", people_json(room)},
            {"bricks", bricks}};
}

}  // namespace theatron::web
