// SPDX-License-Identifier: Apache-2.0
#include "viewer/wrist_menu.h"

#include <utility>

#include "phrases/phrase.h"
#include "room/facing.h"

namespace theatron::viewer {
namespace {

constexpr double row_letter_m = 0.0105, text_from_left_m = 0.012, above_panel_m = 0.001;

}  // namespace

std::vector<MenuRow> menu_rows(const MenuFacts& facts) {
    std::vector<MenuRow> rows;
    if (!facts.past.empty())
        rows.push_back({MenuAction::live, say(Phrase::menu_live), {}});
    rows.push_back({MenuAction::microphone,
                    say(facts.muted             ? Phrase::menu_muted
                        : facts.microphone_open ? Phrase::menu_close_microphone
                                                : Phrase::menu_speak),
                    {}});
    if (facts.real_room) {
        rows.push_back({MenuAction::place_table, say(Phrase::menu_place_table), {}});
    } else {
        rows.push_back({MenuAction::recentre, say(Phrase::menu_recentre), {}});
        rows.push_back(
            {MenuAction::seat, say(facts.seated ? Phrase::menu_stand : Phrase::menu_sit), {}});
        rows.push_back({MenuAction::turn_left, say(Phrase::menu_turn_left), {}});
        rows.push_back({MenuAction::turn_right, say(Phrase::menu_turn_right), {}});
    }
    rows.push_back({MenuAction::new_brick, say(Phrase::menu_new_brick), {}});
    rows.push_back({MenuAction::drawing, say(Phrase::menu_drawing, facts.drawing), {}});
    std::size_t shown = 0;
    for (const room::RoomPerson& person : facts.people) {
        if (shown++ == most_menu_people)
            break;
        const std::string row =
            facts.real_room ? person.name : say(Phrase::menu_go_to, person.name);
        rows.push_back({MenuAction::go_to_person, person.calls ? say(Phrase::menu_calls, row) : row,
                        person.id});
    }
    if (facts.people.size() > most_menu_people)
        rows.back().text = say(Phrase::menu_more, rows.back().text,
                               std::to_string(facts.people.size() - most_menu_people));
    rows.push_back({MenuAction::leave, say(Phrase::menu_leave), {}});
    return rows;
}

void WristMenu::set(std::vector<MenuRow> rows, Vec3 place, Vec3 eye) {
    rows_ = std::move(rows);
    room_from_panel_ = room::facing(place, eye);
    room_from_panel_.translation = room_from_panel_ * Vec3{-width_m / 2, -height(), 0};
}

std::optional<WristMenu::Hit> WristMenu::pick(const render::PickRay& ray) const {
    if (!shown_)
        return std::nullopt;
    const Pose panel_from_room = inverse(room_from_panel_);
    const Vec3 from = panel_from_room * ray.from;
    const Vec3 along = rotate(panel_from_room.rotation, normalized(ray.direction));
    if (along.z <= 0 || from.z >= 0)
        return std::nullopt;  // from behind
    const double distance = -from.z / along.z;
    const Vec3 at = from + along * distance;
    if (at.x < 0 || at.x >= width_m || at.y < 0 || at.y >= height())
        return std::nullopt;
    return Hit{std::size_t(at.y / row_m), distance};
}

void WristMenu::add_to(render::SceneFrame& frame, std::optional<std::size_t> chosen) const {
    if (!shown_)
        return;
    if (!row_mesh_)
        row_mesh_ =
            std::make_unique<render::SceneMesh>(render::make_panel_mesh(width_m, row_m * 0.94));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        render::SurfaceLook look;
        look.base_color = chosen == i ? Vec3{0.10, 0.30, 0.42} : Vec3{0.018, 0.024, 0.030};
        look.unlit = true;
        const Pose row = room_from_panel_ * Pose{{}, {width_m / 2, row_m * (double(i) + 0.5), 0}};
        render::SceneObject object{row_mesh_.get(), row, look};
        object.casts_shadow = false;
        frame.objects.push_back(object);
        frame.texts.push_back(
            {rows_[i].text,
             room_from_panel_ *
                 Pose{{},
                      {text_from_left_m, row_m * (double(i) + 0.5) + row_letter_m / 2,
                       -above_panel_m}},
             row_letter_m,
             {235, 240, 240}});
    }
}

}  // namespace theatron::viewer
