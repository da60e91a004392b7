// SPDX-License-Identifier: Apache-2.0
// The menu of a person with a headset: a panel at the left wrist whose rows the other hand's ray
// chooses.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/pick.h"
#include "room/people.h"

namespace theatron::viewer {

enum class MenuAction {
    microphone,  // opens or closes it
    leave,       // the headset, not the session
    recentre,
    seat,  // sitting people see from the height of standing ones, or no longer do
    drawing,
    turn_left,
    turn_right,
    new_brick,
    place_table,  // with the real room around
    go_to_person,
    live,  // ends looking back
};

struct MenuRow {
    MenuAction action{};
    std::string text;
    ParticipantId person{};  // of go_to_person
    bool operator==(const MenuRow&) const = default;
};

struct MenuFacts {
    bool microphone_open = false, muted = false;
    bool seated = false;
    bool real_room = false;
    std::string drawing;
    std::vector<room::RoomPerson> people;  // the others
    std::string past = {};                 // as in Facts
};

// At most `most_menu_people` rows name people; the last one's text says how many more there are.
inline constexpr std::size_t most_menu_people = 6;
std::vector<MenuRow> menu_rows(const MenuFacts& facts);

// Use from one thread; add_to() with the same GL context current.
class WristMenu {
public:
    static constexpr double width_m = 0.28, row_m = 0.03;

    void show(bool shown) { shown_ = shown; }
    bool is_shown() const { return shown_; }

    // Its rows, and the middle of its lower edge in the room, from where it faces the eye.
    void set(std::vector<MenuRow> rows, Vec3 place, Vec3 eye);
    const std::vector<MenuRow>& rows() const { return rows_; }

    // Where a ray meets the panel.
    struct Hit {
        std::size_t row = 0;
        double distance_m = 0;
    };
    std::optional<Hit> pick(const render::PickRay& ray) const;

    // `chosen` is the row under the ray.
    void add_to(render::SceneFrame& frame, std::optional<std::size_t> chosen) const;

private:
    double height() const { return row_m * double(rows_.size()); }

    bool shown_ = false;
    std::vector<MenuRow> rows_;
    Pose room_from_panel_;  // of its upper left corner: x right, y down, z away from the reader
    mutable std::unique_ptr<render::SceneMesh> row_mesh_;
};

}  // namespace theatron::viewer
