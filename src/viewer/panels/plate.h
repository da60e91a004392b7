// SPDX-License-Identifier: Apache-2.0
// A plate in the room with rows of text and buttons, which the rays of hands press: the menu and
// the panels of a person with a headset.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/pick.h"
#include "window/overlay_content.h"

namespace theatron::viewer {

struct PlateButton {
    std::string text;
    double left_m = 0, width_m = 0;  // of the plate
    int command = 0;
};
struct PlateRow {
    std::string text;
    bool is_detail = false;  // darker
    std::vector<PlateButton> buttons;
};

// Use from one thread; add_to() with the same GL context current.
class Plate {
public:
    static constexpr double row_m = 0.03;
    // No button's command: a ray meets the plate beside its buttons.
    static constexpr int no_command = -1;

    explicit Plate(double width_m) : width_m_(width_m) {}

    void show(bool shown) { shown_ = shown; }
    bool is_shown() const { return shown_; }

    void set_rows(std::vector<PlateRow> rows) { rows_ = std::move(rows); }
    // The middle of its lower edge in the room, from where it faces the eye; or of its upper edge.
    void place(Vec3 place, Vec3 eye);
    void place_below(Vec3 place, Vec3 eye) { this->place(place - Vec3{0, height(), 0}, eye); }

    // Where a ray meets the plate from its front.
    struct Hit {
        int command = no_command;
        double distance_m = 0;
    };
    std::optional<Hit> pick(const render::PickRay& ray) const;

    // The button of this command is under a ray.
    void choose(std::optional<int> command) { chosen_ = command; }
    void add_to(render::SceneFrame& frame) const;

private:
    double height() const { return row_m * double(rows_.size()); }
    const render::SceneMesh& mesh(double width_m, double height_m) const;

    const double width_m_;
    bool shown_ = false;
    std::vector<PlateRow> rows_;
    std::optional<int> chosen_;
    Pose room_from_plate_;  // of its upper left corner: x right, y down, z away from the reader
    mutable std::map<std::pair<int, int>, render::SceneMesh> meshes_;  // by millimetres
};

// Commands of the buttons that a plate of panels has itself.
enum PlateCommand { close_plate = -2, earlier_rows = -3, later_rows = -4 };

// The rows of panels on a plate of this width; a button closes it. Where they are too many, those
// from `first` on, with buttons that show others; `first` is kept within them. Pure.
inline constexpr std::size_t most_plate_rows = 18;
inline constexpr std::size_t rows_in_turn = most_plate_rows - 2;  // title and buttons stay
std::vector<PlateRow> plate_rows(const std::vector<window::Panel>& panels, double width_m,
                                 std::size_t& first);

}  // namespace theatron::viewer
