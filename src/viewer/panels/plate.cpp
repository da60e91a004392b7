// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels/plate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "phrases/phrase.h"
#include "room/facing.h"

namespace theatron::viewer {
namespace {

constexpr double letter_m = 0.0105;        // the height of a capital
constexpr double letter_width_m = 0.0084;  // of most letters at most
constexpr double margin_m = 0.012, gap_m = 0.006;
constexpr double text_above_m = 0.002, button_above_m = 0.001;
constexpr Vec3 plain_color{0.018, 0.024, 0.030}, button_color{0.045, 0.060, 0.075},
    chosen_color{0.10, 0.30, 0.42};
constexpr Rgb text_color{235, 240, 240}, detail_color{160, 170, 175};

std::size_t letters_of(const std::string& text) {
    return std::size_t(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

double width_of(const std::string& text) {
    return letter_width_m * double(letters_of(text));
}

// Words in lines of a width.
std::vector<std::string> lines_of(const std::string& text, double width_m) {
    std::vector<std::string> lines(1);
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!lines.back().empty() && width_of(lines.back() + " " + word) > width_m)
            lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
        if (end < text.size() && text[end] == '\n')
            lines.emplace_back();
        begin = end + 1;
    }
    return lines;
}

// Buttons at the right of the text where they have room there, else below it.
void add_row(const window::PanelRow& row, double width_m, std::vector<PlateRow>& rows) {
    const double inner_m = width_m - 2 * margin_m;
    for (const std::string& line : lines_of(row.text, inner_m))
        if (!row.text.empty())
            rows.push_back({line, false, {}});
    double buttons_m = 0;
    for (const window::PanelButton& button : row.buttons)
        buttons_m += width_of(button.label) + 2 * margin_m + gap_m;
    const bool is_beside = !row.text.empty() && !row.buttons.empty() &&
                           width_of(rows.back().text) + margin_m + buttons_m <= inner_m;
    double at_m = is_beside ? width_m - margin_m - buttons_m : width_m;
    for (const window::PanelButton& button : row.buttons) {
        const double wide_m =
            std::min(width_of(button.label) + 2 * margin_m, width_m - 2 * margin_m);
        if (at_m + wide_m > width_m - margin_m + 1e-9) {
            rows.emplace_back();
            at_m = margin_m;
        }
        rows.back().buttons.push_back({button.label, at_m, wide_m, button.command});
        at_m += wide_m + gap_m;
    }
    if (!row.detail.empty())
        for (std::string& line : lines_of(row.detail, inner_m))
            rows.push_back({std::move(line), true, {}});
}

}  // namespace

std::vector<PlateRow> plate_rows(const std::vector<window::Panel>& panels, double width_m,
                                 std::size_t& first) {
    std::vector<PlateRow> rows, shown;
    for (const window::Panel& panel : panels) {
        if (&panel == &panels.front())
            add_row({panel.title, "", {{say(Phrase::close), close_plate}}}, width_m, shown);
        else
            rows.push_back({panel.title, true, {}});
        for (const window::PanelRow& row : panel.rows)
            add_row(row, width_m, rows);
    }
    const bool is_long = shown.size() + rows.size() > most_plate_rows;
    const std::size_t last_turn = rows.empty() ? 0 : (rows.size() - 1) / rows_in_turn;
    first = is_long ? std::min(first, last_turn * rows_in_turn) : 0;
    const std::size_t end = is_long ? std::min(first + rows_in_turn, rows.size()) : rows.size();
    shown.insert(shown.end(), rows.begin() + std::ptrdiff_t(first),
                 rows.begin() + std::ptrdiff_t(end));
    if (is_long)
        add_row({say(Phrase::amount_of, std::to_string(first / rows_in_turn + 1),
                     std::to_string(last_turn + 1)),
                 "",
                 {{say(Phrase::before), earlier_rows}, {say(Phrase::next), later_rows}}},
                width_m, shown);
    return shown;
}

void Plate::place(Vec3 place, Vec3 eye) {
    room_from_plate_ = room::facing(place, eye);
    room_from_plate_.translation = room_from_plate_ * Vec3{-width_m_ / 2, -height(), 0};
}

std::optional<Plate::Hit> Plate::pick(const render::PickRay& ray) const {
    if (!shown_)
        return std::nullopt;
    const Pose plate_from_room = inverse(room_from_plate_);
    const Vec3 from = plate_from_room * ray.from;
    const Vec3 along = rotate(plate_from_room.rotation, normalized(ray.direction));
    if (along.z <= 0 || from.z >= 0)
        return std::nullopt;  // from behind
    const double distance = -from.z / along.z;
    const Vec3 at = from + along * distance;
    if (at.x < 0 || at.x >= width_m_ || at.y < 0 || at.y >= height())
        return std::nullopt;
    for (const PlateButton& button : rows_[std::size_t(at.y / row_m)].buttons)
        if (at.x >= button.left_m && at.x < button.left_m + button.width_m)
            return Hit{button.command, distance};
    return Hit{no_command, distance};
}

const render::SceneMesh& Plate::mesh(double width_m, double height_m) const {
    const std::pair key{int(std::lround(width_m * 1000)), int(std::lround(height_m * 1000))};
    const auto found = meshes_.find(key);
    return found != meshes_.end()
               ? found->second
               : meshes_.emplace(key, render::SceneMesh(render::make_panel_mesh(width_m, height_m)))
                     .first->second;
}

void Plate::add_to(render::SceneFrame& frame) const {
    if (!shown_)
        return;
    const auto add_area = [&](double left_m, double wide_m, double high_m, double y, double above,
                              Vec3 color) {
        render::SurfaceLook look;
        look.base_color = color;
        look.unlit = true;
        render::SceneObject object{&mesh(wide_m, high_m),
                                   room_from_plate_ * Pose{{}, {left_m + wide_m / 2, y, -above}},
                                   look};
        object.casts_shadow = false;
        frame.objects.push_back(object);
    };
    const auto add_text = [&](const std::string& text, double left_m, double y, Rgb color) {
        frame.texts.push_back(
            {text, room_from_plate_ * Pose{{}, {left_m, y + letter_m / 2, -text_above_m}}, letter_m,
             color});
    };
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const PlateRow& row = rows_[i];
        const double y = row_m * (double(i) + 0.5);
        // A row that is one button is its own ground.
        const bool is_button = row.buttons.size() == 1 && row.buttons[0].width_m >= width_m_;
        add_area(0, width_m_, is_button ? row_m * 0.94 : row_m, y, 0,
                 is_button && chosen_ == row.buttons[0].command ? chosen_color : plain_color);
        if (!row.text.empty())
            add_text(row.text, margin_m, y, row.is_detail ? detail_color : text_color);
        for (const PlateButton& button : row.buttons) {
            if (!is_button)
                add_area(button.left_m, button.width_m, row_m * 0.8, y, button_above_m,
                         chosen_ == button.command ? chosen_color : button_color);
            add_text(button.text, button.left_m + margin_m, y, text_color);
        }
    }
}

}  // namespace theatron::viewer
