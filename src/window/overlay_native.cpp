// SPDX-License-Identifier: Apache-2.0
#include "window/overlay_native.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "phrases/phrase.h"
#include "window/imgui_fonts_native.h"
#include "window/overlay_pictures_native.h"
#include "window/panel_colors_native.h"
#include "window/panel_heights.h"
#include "window/tool_icons_native.h"
#include "window/window_input.h"

namespace theatron::window {
namespace {

// Windows narrower than this, in half text heights, show one row of facts.
constexpr float small_window_units = 80;
// Share of the window's width that panels take at most beside pictures.
constexpr float panels_beside_pictures = 0.5f;
// A text is not broken because its own width was rounded.
constexpr float rounding = 1;
// In half text heights.
constexpr float panel_padding = 1.4f, slider_units = 22;
// A panel has this width whatever its texts say, so that its buttons stay in their places; it is
// wider only for its buttons. Longer texts have several lines.
constexpr float panel_units = 33, least_text_units = 12, slider_text_units = 21;
// Height and least width of buttons in a panel with large ones: in pixels, and in half text
// heights.
constexpr float least_large_button = 32, large_button_units = 3.6f;
// Least size of the bar's labels, as a factor of other small texts.
constexpr float least_label_scale = 0.6f;

}  // namespace

struct Overlay::Parts {
    ImGuiContext* context = nullptr;
    ImGuiPass pass;
    double text_pixels = 0;  // for which the fonts are made
    ImFont* small = nullptr;
    ImFont* normal = nullptr;
    ImFont* large = nullptr;

    Parts() : context(ImGui::CreateContext()) {
        ImGui::GetIO().IniFilename = nullptr;  // nothing is remembered in files
    }
    ~Parts() { ImGui::DestroyContext(context); }

    void make_fonts(double pixels);
    ImVec2 measure(ImFont* font, const std::string& text, float wrap = 0) const {
        return font->CalcTextSizeA(font->FontSize, 1e9f, wrap, text.c_str());
    }
    void text(ImFont* font, ImVec2 place, ImU32 color, const std::string& words, float wrap = 0,
              float scale = 1) const {
        list->AddText(font, font->FontSize * scale, {std::round(place.x), std::round(place.y)},
                      color, words.c_str(), nullptr, wrap);
    }

    // Each draws its part; all use the state that draw() has set up.
    float facts(const std::vector<Fact>& facts, float bottom) const;
    void message(const std::string& message, const std::string& detail, float bottom) const;
    float notice_end(const std::string& words, float top) const;
    std::optional<float> middle_of(float width, float from, float to) const;
    float notice_width(const std::string& words) const;
    float notice(const std::string& words, ImU32 color, float top, float middle, float wrap) const;
    float offer_width(const PanelRow& offer) const;
    float offer_height() const { return normal->FontSize + 4 * unit; }
    void offer(const PanelRow& offer, float top, float middle);
    void help(float top, float bottom) const;
    float tool_bar(const ToolBar& bar, std::optional<std::size_t> hovered);
    void hint(const std::string& words, const BarCell& cell) const;
    void focus_ring(std::size_t control) const;

    // Rows that are scrolled out above, of the panel with this title.
    std::map<std::string, double> scrolled;

    struct Area {
        ImVec2 from, to;
        bool has(ImVec2 place) const {
            return place.x >= from.x && place.x < to.x && place.y >= from.y && place.y < to.y;
        }
    };
    // 0: no larger than its text.
    float least_button(const Panel& panel) const {
        return panel.large ? std::max(least_large_button, large_button_units * unit) : 0;
    }
    float button_width(const PanelButton& button, float least = 0) const;
    float controls_width(const PanelRow& row, float least = 0) const;
    float wanted_width(const Panel& panel) const;
    float panels(const std::vector<Panel>& panels, const Area& free);
    // The row of the panel that has the control which got the keyboard since the last picture.
    std::optional<std::size_t> focused_row(const Panel& panel) const;
    // Buttons of rows that are scrolled out: the keyboard reaches them, the mouse does not.
    void hide_buttons(const PanelRow& row);
    std::vector<Area> panel_areas;
    std::vector<std::string> panel_titles;  // of each of them
    std::vector<std::pair<Area, int>> buttons;
    std::optional<std::size_t> keyboard_begin;  // in `buttons`
    // The panel to which the keyboard comes first.
    std::uint64_t keyboard = 0;  // its number in the last picture
    std::string keyboard_title;  // empty: there is none
    std::size_t keyboard_rows = 0, keyboard_left_out = 0;
    std::optional<std::size_t> focused;  // control that has the keyboard
    bool focus_moved = false;            // since the last picture
    std::vector<std::pair<Area, PanelSlider>> sliders;
    void slider(const PanelSlider& slider, const Area& place);
    float bar(const PanelRow& row, float bottom);
    OverlayPictures pictures;
    ImVec2 pixel_at(Vec2 place) const {
        return {float(place.x) * window.x, float(place.y) * window.y};
    }

    ImDrawList* list = nullptr;
    ImVec2 window;
    float unit = 0;  // half the height of a normal text: all gaps are multiples of it
};

void Overlay::Parts::make_fonts(double pixels) {
    const auto fonts = set_fonts(pass, {pixels * 0.8, pixels, pixels * 1.9});
    small = fonts[0], normal = fonts[1], large = fonts[2];
    text_pixels = pixels;
}

// From the left, in as many rows as they need. Returns the height of all that is at the bottom.
float Overlay::Parts::facts(const std::vector<Fact>& facts, float bottom) const {
    const float gap = 2.2f * unit, margin = 1.2f * unit;
    const float row = small->FontSize + normal->FontSize + 0.9f * unit;
    const auto width = [&](const Fact& fact) {
        return std::max(measure(small, fact.label).x, measure(normal, fact.value).x);
    };
    // Where the window is small, only warnings may begin another row than the first.
    const bool is_small = window.x < small_window_units * unit;
    std::vector<std::pair<const Fact*, ImVec2>> places;
    float x = margin, y = 0;
    for (const Fact& fact : facts) {
        if (x > margin && x + width(fact) + margin > window.x) {
            if (is_small && !fact.warning)
                continue;
            x = margin;
            y += row;
        }
        places.push_back({&fact, {x, y}});
        x += width(fact) + gap;
    }
    if (places.empty())
        return bottom;
    const float height = y + row + 0.5f * unit, top = window.y - bottom - height;
    list->AddRectFilled({0, top}, {window.x, window.y - bottom}, colors::bar);
    for (const auto& [fact, place] : places) {
        const ImVec2 at{place.x, top + place.y + 0.5f * unit};
        text(small, at, colors::label, fact->label);
        text(normal, {at.x, at.y + small->FontSize}, fact->warning ? colors::warning : colors::text,
             fact->value);
    }
    return bottom + height;
}

void Overlay::Parts::message(const std::string& message, const std::string& detail,
                             float bottom) const {
    list->AddRectFilled({0, 0}, {window.x, window.y - bottom}, colors::veil);
    const float wrap = window.x * 0.8f;
    const ImVec2 size = measure(large, message, wrap);
    const ImVec2 more = measure(normal, detail, wrap);
    const float width = std::max(size.x, more.x);
    const float height = size.y + (detail.empty() ? 0 : unit + more.y);
    const ImVec2 from{(window.x - width) / 2, (window.y - bottom - height) / 2};
    const float padding = 2.5f * unit;
    list->AddRectFilled({from.x - padding, from.y - padding},
                        {from.x + width + padding, from.y + height + padding}, colors::panel, unit);
    text(large, {(window.x - size.x) / 2, from.y}, colors::text, message, wrap);
    text(normal, {(window.x - more.x) / 2, from.y + size.y + unit}, colors::label, detail, wrap);
}

// Where the next may begin.
float Overlay::Parts::notice_end(const std::string& words, float top) const {
    return words.empty() ? top : top + measure(normal, words, window.x * 0.8f).y + 3 * unit;
}

// Horizontal centre of a part of this width, kept between `from` and `to`; nullopt: it is too
// wide.
std::optional<float> Overlay::Parts::middle_of(float width, float from, float to) const {
    if (width > to - from)
        return std::nullopt;
    return std::clamp(window.x / 2, from + width / 2, to - width / 2);
}

float Overlay::Parts::notice_width(const std::string& words) const {
    return words.empty() ? 0 : measure(normal, words, window.x * 0.8f).x + 6 * unit;
}

float Overlay::Parts::notice(const std::string& words, ImU32 color, float top, float middle,
                             float wrap) const {
    if (words.empty())
        return top;
    const float padding = unit;
    const ImVec2 size = measure(normal, words, wrap);
    const ImVec2 from{middle - size.x / 2, top + padding};
    list->AddRectFilled({from.x - 2 * padding, from.y - padding},
                        {from.x + size.x + 2 * padding, from.y + size.y + padding}, colors::panel,
                        unit);
    text(normal, from, color, words, wrap);
    return top + size.y + 3 * unit;
}

float Overlay::Parts::offer_width(const PanelRow& offer) const {
    return measure(normal, offer.text).x + measure(small, offer.detail).x + controls_width(offer) +
           6 * unit;
}

// A text and its buttons in one line. A text that is too long loses its end.
void Overlay::Parts::offer(const PanelRow& offer, float top, float middle) {
    const float width = std::min(offer_width(offer), window.x), gap = 0.7f * unit;
    const Area area{{middle - width / 2, top}, {middle + width / 2, top + offer_height() - unit}};
    panel_areas.push_back(area);
    panel_titles.emplace_back();
    list->AddRectFilled(area.from, area.to, colors::panel, unit);
    list->AddRect(area.from, area.to, colors::warning, unit, 0, 0.15f * unit);
    const float y = (area.from.y + area.to.y) / 2;
    float x = area.to.x - 2 * unit - controls_width(offer) + gap;
    const float text_end = x - gap;
    for (const PanelButton& button : offer.buttons) {
        const float wide = button_width(button);
        const Area at{{x, area.from.y + gap}, {x + wide, area.to.y - gap}};
        list->AddRectFilled(at.from, at.to, colors::button, 0.5f * unit);
        text(small, {x + gap, y - small->FontSize / 2}, colors::key, button.label);
        buttons.push_back({at, button.command});
        x += wide + gap;
    }
    list->PushClipRect(area.from, {text_end, area.to.y});
    x = area.from.x + 2 * unit;
    text(normal, {x, y - normal->FontSize / 2}, colors::text, offer.text);
    x += measure(normal, offer.text).x + unit;
    text(small, {x, y - small->FontSize / 2}, colors::label, offer.detail);
    list->PopClipRect();
}

// Above a cell of the bar.
void Overlay::Parts::hint(const std::string& words, const BarCell& cell) const {
    if (words.empty())
        return;
    const float wrap = window.x * 0.8f, padding = 0.7f * unit;
    const ImVec2 size = measure(small, words, wrap);
    const float half = size.x / 2 + 2 * padding;
    const float middle = std::clamp(float(cell.left + cell.right) / 2, std::min(half, window.x / 2),
                                    std::max(window.x - half, window.x / 2));
    const ImVec2 from{middle - size.x / 2, float(cell.top) - unit - padding - size.y};
    list->AddRectFilled({from.x - 2 * padding, from.y - padding},
                        {from.x + size.x + 2 * padding, from.y + size.y + padding}, colors::card,
                        0.5f * unit);
    text(small, from, colors::text, words, wrap);
}

void Overlay::Parts::focus_ring(std::size_t control) const {
    if (control >= buttons.size())
        return;
    const Area& area = buttons[control].first;
    const float inset = 0.2f * unit;
    list->AddRect({area.from.x + inset, area.from.y + inset},
                  {area.to.x - inset, area.to.y - inset}, colors::key, 0.5f * unit, 0,
                  0.25f * unit);
}

// Returns the height of all that is at the bottom.
float Overlay::Parts::tool_bar(const ToolBar& bar, std::optional<std::size_t> hovered) {
    const ToolBarLayout layout =
        tool_bar_layout(bar.tools.size(), {int(window.x), int(window.y)}, 2.0 * double(unit));
    list->AddRectFilled({0, float(layout.bar.top)}, window, colors::dense_bar);
    panel_areas.push_back({{0, float(layout.bar.top)}, window});
    panel_titles.emplace_back();
    const float side = 2.6f * unit, stroke = std::max(1.5f, 0.2f * unit);
    // All labels have one size, so that the bar looks of one piece.
    float label_scale = 1;
    for (std::size_t i = 0; i < bar.tools.size(); ++i)
        label_scale = std::min(label_scale, (float(layout.tools[i].width()) - 0.6f * unit) /
                                                measure(small, bar.tools[i].label).x);
    label_scale = std::min(
        label_scale, (float(layout.dot.width()) - 0.6f * unit) / measure(small, bar.dot.words).x);
    const bool has_labels = layout.has_labels && label_scale >= least_label_scale;
    const float content = side + (has_labels ? small->FontSize + 0.2f * unit : 0);
    const auto begin = [&](const BarCell& cell, int command, bool pressed) {
        const Area area{{float(cell.left), float(cell.top)},
                        {float(cell.right), float(cell.bottom)}};
        const float inset = 0.25f * unit;
        const ImU32 ground = pressed                     ? colors::tool_pressed
                             : hovered == buttons.size() ? colors::tool_hovered
                                                         : 0;
        if (ground != 0)
            list->AddRectFilled({area.from.x + inset, area.from.y + inset},
                                {area.to.x - inset, area.to.y - inset}, ground, 0.6f * unit);
        buttons.push_back({area, command});
        return ImVec2{float(cell.left + cell.right) / 2 - side / 2,
                      float(cell.top + cell.bottom) / 2 - content / 2};
    };
    const auto label = [&](const BarCell& cell, ImVec2 corner, const std::string& words,
                           ImU32 color) {
        const float width = label_scale * measure(small, words).x;
        if (has_labels)
            text(small,
                 {float(cell.left + cell.right) / 2 - width / 2, corner.y + side + 0.2f * unit},
                 color, words, 0, label_scale);
    };
    const ImU32 dot_color = bar.dot.level == PictureDot::Level::good   ? colors::good
                            : bar.dot.level == PictureDot::Level::slow ? colors::warning
                                                                       : colors::alarm;
    const ImVec2 dot_at = begin(layout.dot, bar.dot.command, false);
    draw_dot(*list, bar.dot.level, dot_at, side, dot_color);
    label(layout.dot, dot_at, bar.dot.words, colors::text);
    for (std::size_t i = 0; i < bar.tools.size(); ++i) {
        const Tool& tool = bar.tools[i];
        const BarCell& cell = layout.tools[i];
        const ImVec2 at = begin(cell, tool.command, tool.pressed);
        const ImU32 color = tool.alarm ? colors::alarm : colors::text;
        draw_icon(*list, tool.icon, at, side, stroke, color);
        if (tool.crossed)
            draw_cross(*list, at, side, stroke, color, colors::ground);
        if (tool.badge > 0) {
            const std::string number = std::to_string(std::min<std::size_t>(tool.badge, 99));
            const ImVec2 middle{at.x + side, at.y + 0.35f * unit};
            list->AddCircleFilled(middle, unit, colors::warning);
            text(small, {middle.x - measure(small, number).x / 2, middle.y - small->FontSize / 2},
                 colors::ink, number);
        }
        label(cell, at, tool.label, color);
    }
    return float(layout.bar.height());
}

void Overlay::Parts::help(float top, float bottom) const {
    const float row = normal->FontSize + 0.9f * unit, gap = 3 * unit, padding = 2.5f * unit;
    float keys = 0, meanings = 0;
    for (const KeyHelp& line : key_help()) {
        keys = std::max(keys, measure(normal, std::string(line.keys.in(language()))).x);
        meanings = std::max(meanings, measure(normal, std::string(line.meaning.in(language()))).x);
    }
    const float width = keys + gap + meanings;
    const float height = row * float(key_help().size()) - 0.9f * unit;
    // Smaller where the window is small: all lines must be readable.
    const float scale = std::min({1.0f, window.x / (width + 2 * padding),
                                  (window.y - bottom - top) / (height + 2 * padding)});
    const ImVec2 half{scale * (width / 2 + padding), scale * (height / 2 + padding)};
    const ImVec2 middle{window.x / 2, (top + window.y - bottom) / 2};
    list->AddRectFilled({middle.x - half.x, middle.y - half.y},
                        {middle.x + half.x, middle.y + half.y}, colors::panel, scale * unit);
    const ImVec2 from{middle.x - scale * width / 2, middle.y - scale * height / 2};
    float y = from.y;
    for (const KeyHelp& line : key_help()) {
        text(normal, {from.x, y}, colors::key, std::string(line.keys.in(language())), 0, scale);
        text(normal, {from.x + scale * (keys + gap), y}, colors::text,
             std::string(line.meaning.in(language())), 0, scale);
        y += scale * row;
    }
}

void Overlay::Parts::slider(const PanelSlider& slider, const Area& place) {
    const float y = (place.from.y + place.to.y) / 2;
    const auto at = [&](double value) {
        const double share = (value - slider.lowest) / (slider.highest - slider.lowest);
        return place.from.x + float(std::clamp(share, 0.0, 1.0)) * (place.to.x - place.from.x);
    };
    const float thin = 0.2f * unit, knob = 0.65f * unit;
    list->AddRectFilled({place.from.x, y - thin}, {place.to.x, y + thin}, colors::button, thin);
    if (slider.lowest < 0 && slider.highest > 0)
        list->AddRectFilled({at(0) - thin / 2, y - knob}, {at(0) + thin / 2, y + knob},
                            colors::label);
    list->AddCircleFilled({at(slider.value), y}, knob, colors::key);
    sliders.push_back({place, slider});
}

// Returns the height of all that is at the bottom.
float Overlay::Parts::bar(const PanelRow& row, float bottom) {
    const float gap = 0.7f * unit, height = normal->FontSize + 3 * gap;
    const Area area{{0, window.y - bottom - height}, {window.x, window.y - bottom}};
    list->AddRectFilled(area.from, area.to, colors::bar);
    panel_areas.push_back(area);
    panel_titles.emplace_back();
    const float top = area.from.y + gap, middle = area.from.y + height / 2;
    float x = 1.2f * unit;
    for (const PanelButton& button : row.buttons) {
        const float wide = measure(small, button.label).x + 2 * gap;
        const Area place{{x, top}, {x + wide, area.to.y - gap}};
        list->AddRectFilled(place.from, place.to, colors::button, 0.5f * unit);
        text(small, {x + gap, middle - small->FontSize / 2}, colors::key, button.label);
        buttons.push_back({place, button.command});
        x += wide + gap;
    }
    text(normal, {x + gap, middle - normal->FontSize / 2}, colors::text, row.text);
    x += measure(normal, row.text).x + 3 * gap;
    const float right = measure(small, row.detail).x;
    const float end = window.x - 1.2f * unit - (right > 0 ? right + 2 * gap : 0);
    if (row.slider && end - x > 8 * unit)
        slider(*row.slider, {{x + gap, top}, {end, area.to.y - gap}});
    text(small, {window.x - 1.2f * unit - right, middle - small->FontSize / 2}, colors::label,
         row.detail);
    return bottom + height;
}

float Overlay::Parts::button_width(const PanelButton& button, float least) const {
    return std::max(measure(small, button.label).x + 1.4f * unit, least);
}

// The width of a row's slider and buttons, with the gaps.
float Overlay::Parts::controls_width(const PanelRow& row, float least) const {
    float width = row.slider ? slider_units * unit + 1.4f * unit : 0;
    for (const PanelButton& button : row.buttons)
        width += button_width(button, least) + 0.7f * unit;
    return width;
}

// The width of a panel without its edges.
float Overlay::Parts::wanted_width(const Panel& panel) const {
    float width = panel_units * unit;
    for (const PanelRow& row : panel.rows) {
        // The number of a slider changes; its text stays one line.
        const float text_units = row.text.empty() ? 0
                                 : row.slider     ? slider_text_units
                                                  : least_text_units;
        width = std::max(width, controls_width(row, least_button(panel)) + text_units * unit);
    }
    return width;
}

std::optional<std::size_t> Overlay::Parts::focused_row(const Panel& panel) const {
    if (!focus_moved || !focused || *focused < buttons.size())
        return std::nullopt;
    std::size_t control = buttons.size();
    for (std::size_t row = 0; row < panel.rows.size(); ++row) {
        control += panel.rows[row].buttons.size();
        if (*focused < control)
            return row;
    }
    return std::nullopt;
}

void Overlay::Parts::hide_buttons(const PanelRow& row) {
    const Area nowhere{{-2, -2}, {-2, -2}};
    for (const PanelButton& button : row.buttons)
        buttons.push_back({nowhere, button.command});
}

// Rows that do not fit are left out, and a last line says how many; the mouse wheel shows them. A
// panel higher than the others' share of the window is the first to lose rows. Where not all have
// space for a row, the last ones are counted below the others. Returns the right edge of the
// widest panel; 0: there is none.
float Overlay::Parts::panels(const std::vector<Panel>& shown, const Area& free) {
    const float padding = panel_padding * unit, gap = 0.7f * unit, left = free.from.x;
    const float slider_width = slider_units * unit;
    const auto height_of_buttons = [&](const Panel& panel) {
        return std::max(normal->FontSize + gap, least_button(panel));
    };
    const float least_text_width = least_text_units * unit;
    const auto panel_width = [&](const Panel& panel) {
        return std::min(wanted_width(panel), free.to.x - left - 2 * padding);
    };
    // A text that is too long for its place has several lines; where little is left beside the
    // buttons, it stands above them.
    struct RowPlace {
        float text_width, text_height, height;
        bool buttons_below;
    };
    const auto place_of = [&](const Panel& panel, const PanelRow& row, float width) {
        const float button_height =
            row.buttons.empty() ? normal->FontSize + gap : height_of_buttons(panel);
        RowPlace place{width - controls_width(row, least_button(panel)), 0, 0, false};
        const float wanted = measure(normal, row.text).x;
        place.buttons_below = wanted > place.text_width && place.text_width < least_text_width;
        if (place.buttons_below)
            place.text_width = width;
        place.text_height =
            std::max(button_height, measure(normal, row.text, place.text_width + rounding).y + gap);
        const float detail =
            row.detail.empty() ? 0 : measure(small, row.detail, width + rounding).y;
        place.height =
            place.text_height + (place.buttons_below ? button_height + gap : 0) + detail + gap;
        return place;
    };
    const float frame = 2 * padding + normal->FontSize + gap;
    if (shown.empty())
        return 0;
    std::vector<float> heights;
    float highest_row = 0;
    for (const Panel& panel : shown) {
        heights.push_back(frame);
        for (const PanelRow& row : panel.rows) {
            const float height = place_of(panel, row, panel_width(panel)).height;
            heights.back() += height;
            highest_row = std::max(highest_row, height);
        }
    }
    const float gaps = unit * float(shown.size() - 1);
    const float least = frame + highest_row + small->FontSize;
    const float together = free.to.y - free.from.y - gaps;
    // Where there is no space for all, the first ones have what they need.
    const std::vector<float> shares = panel_heights(heights, least, together);
    const bool is_for_all = !shares.empty();
    const float line = small->FontSize + 2 * unit;
    float top = free.from.y, right_edge = 0;
    for (std::size_t n = 0; n < shown.size(); ++n) {
        const Panel& panel = shown[n];
        const bool is_last = n + 1 == shown.size();
        const float height_left = free.to.y - top - (is_last ? 0 : line);
        const float most = is_for_all ? shares[n] : height_left;
        if (!is_for_all && height_left < std::min(least, heights[n])) {
            const std::string more = say(is_last ? Phrase::more_panel : Phrase::more_panels,
                                         std::to_string(shown.size() - n));
            const ImVec2 size = measure(small, more);
            list->AddRectFilled({left, top}, {left + size.x + 2 * padding, top + size.y + unit},
                                colors::panel, unit);
            text(small, {left + padding, top + unit / 2}, colors::warning, more);
            return std::max(right_edge, left + size.x + 2 * padding);
        }
        const float width = panel_width(panel), room = most - frame;
        const auto fits = [&](float height, std::size_t rows) {
            return height + (rows < panel.rows.size() ? small->FontSize : 0) <= room + 1;
        };
        // The first row as far down as the wheel wants, and the last rows fill the panel.
        std::size_t last_first = panel.rows.size();
        for (float height = 0; last_first > 0; --last_first) {
            height += place_of(panel, panel.rows[last_first - 1], width).height;
            if (!fits(height, panel.rows.size() - last_first + 1))
                break;
        }
        double& wanted = scrolled[panel.title];
        if (panel.keyboard != 0 && panel.keyboard != keyboard)
            wanted = 0;  // another step begins with its first row
        wanted = std::clamp(wanted, 0.0, double(last_first));
        float height = 0;
        // Behind the last row that fits below `first`.
        const auto end_below = [&](std::size_t first) {
            height = 0;
            std::size_t end = first;
            for (; end < panel.rows.size(); ++end) {
                const float more = place_of(panel, panel.rows[end], width).height;
                if (!fits(height + more, end + 1 - first))
                    break;
                height += more;
            }
            return end;
        };
        auto first = std::size_t(std::lround(wanted));
        std::size_t end = end_below(first);
        if (const auto row = focused_row(panel)) {
            first = std::min(first, *row);
            for (end = end_below(first); end <= *row && first < last_first; end = end_below(first))
                ++first;
            wanted = double(first);
        }
        const std::size_t left_out = panel.rows.size() - (end - first);
        const Area area{{left, top},
                        {left + width + 2 * padding,
                         top + frame + height + (left_out > 0 ? small->FontSize : 0)}};
        panel_areas.push_back(area);
        panel_titles.push_back(panel.title);
        list->AddRectFilled(area.from, area.to, colors::panel, unit);
        list->PushClipRect(area.from, area.to);
        const float button_height = height_of_buttons(panel), least_width = least_button(panel);
        const std::size_t first_button = buttons.size();
        float y = top + padding;
        text(small, {left + padding, y}, colors::label, panel.title);
        y += normal->FontSize + gap;
        for (std::size_t i = 0; i < first; ++i)
            hide_buttons(panel.rows[i]);
        for (std::size_t i = first; i < end; ++i) {
            const PanelRow& row = panel.rows[i];
            const RowPlace place = place_of(panel, row, width);
            const float beside = place.buttons_below ? y + place.text_height : y;
            float x = area.to.x - padding;
            for (const PanelButton& button : row.buttons)
                x -= button_width(button, least_width) + gap;
            float button_left = x + gap;
            for (const PanelButton& button : row.buttons) {
                const float wide = button_width(button, least_width);
                const Area at{{button_left, beside}, {button_left + wide, beside + button_height}};
                list->AddRectFilled(at.from, at.to, colors::button, 0.5f * unit);
                text(small,
                     {(at.from.x + at.to.x - measure(small, button.label).x) / 2,
                      beside + (button_height - small->FontSize) / 2},
                     colors::key, button.label);
                buttons.push_back({at, button.command});
                button_left += wide + gap;
            }
            if (row.slider) {
                x -= gap;
                slider(*row.slider, {{x - slider_width, beside}, {x, beside + button_height}});
            }
            text(normal, {left + padding, y + gap / 2}, colors::text, row.text,
                 place.text_width + rounding);
            const float below =
                beside + (place.buttons_below ? button_height + gap : place.text_height);
            if (!row.detail.empty())
                text(small, {left + padding, below}, colors::label, row.detail, width + rounding);
            y += place.height;
        }
        for (std::size_t i = end; i < panel.rows.size(); ++i)
            hide_buttons(panel.rows[i]);
        if (panel.keyboard != 0 && keyboard_title.empty()) {
            keyboard = panel.keyboard;
            keyboard_title = panel.title;
            keyboard_rows = end - first;
            keyboard_left_out = left_out;
            if (buttons.size() > first_button)
                keyboard_begin = first_button;
        }
        if (left_out > 0)
            text(small, {left + padding, y}, colors::label,
                 say(panel.keyboard != 0 ? Phrase::more_rows_by_key : Phrase::more_rows,
                     std::to_string(left_out)));
        list->PopClipRect();
        top = area.to.y + unit;
        right_edge = std::max(right_edge, area.to.x);
    }
    return right_edge;
}

bool Overlay::covers(Vec2 place) const {
    const ImVec2 pixel = parts_->pixel_at(place);
    return std::any_of(parts_->panel_areas.begin(), parts_->panel_areas.end(),
                       [&](const Parts::Area& area) { return area.has(pixel); }) ||
           parts_->pictures.command_at(pixel);
}

void Overlay::scroll(Vec2 place, double rows) {
    const ImVec2 pixel = parts_->pixel_at(place);
    for (std::size_t i = 0; i < parts_->panel_areas.size(); ++i)
        if (parts_->panel_areas[i].has(pixel))
            parts_->scrolled[parts_->panel_titles[i]] += rows;
}

bool Overlay::turn_page(int pages) {
    if (parts_->keyboard_title.empty() || parts_->keyboard_left_out == 0)
        return false;
    // The last row of a page is the first one of the next.
    const auto rows = std::max<std::size_t>(parts_->keyboard_rows, 2) - 1;
    parts_->scrolled[parts_->keyboard_title] += pages * double(rows);
    return true;
}

std::optional<int> Overlay::command_at(Vec2 place) const {
    const ImVec2 pixel = parts_->pixel_at(place);
    for (const auto& [area, command] : parts_->buttons)
        if (area.has(pixel))
            return command;
    return parts_->pictures.command_at(pixel);
}

std::size_t Overlay::controls() const {
    return parts_->buttons.size();
}

std::size_t Overlay::keyboard_begin() const {
    return parts_->keyboard_begin.value_or(0);
}

std::optional<std::size_t> Overlay::control_at(Vec2 place) const {
    const ImVec2 pixel = parts_->pixel_at(place);
    for (std::size_t i = 0; i < parts_->buttons.size(); ++i)
        if (parts_->buttons[i].first.has(pixel))
            return i;
    return std::nullopt;
}

int Overlay::command_of(std::size_t control) const {
    return parts_->buttons.at(control).second;
}

std::optional<Overlay::Slider> Overlay::slider_at(Vec2 place) const {
    const ImVec2 pixel = parts_->pixel_at(place);
    for (const auto& [area, slider] : parts_->sliders)
        if (area.has(pixel))
            return Slider{slider.command, area.from.x / parts_->window.x,
                          area.to.x / parts_->window.x, slider.lowest, slider.highest};
    return std::nullopt;
}

Overlay::Overlay() : parts_(std::make_unique<Parts>()) {}
Overlay::~Overlay() = default;

void Overlay::draw(const OverlayContent& content, Size window, double text_pixels) {
    Parts& p = *parts_;
    ImGui::SetCurrentContext(p.context);
    if (p.text_pixels != text_pixels)
        p.make_fonts(text_pixels);
    p.window = {float(window.width), float(window.height)};
    p.unit = float(text_pixels / 2);
    ImGui::GetIO().DisplaySize = p.window;
    ImGui::GetIO().DeltaTime = 1.0f / 60;  // nothing here moves by itself
    ImGui::NewFrame();
    p.list = ImGui::GetForegroundDrawList();

    p.panel_areas.clear();
    p.panel_titles.clear();
    p.buttons.clear();
    p.keyboard_begin.reset();
    p.keyboard_title.clear();
    p.focus_moved = std::exchange(p.focused, content.focused) != content.focused;
    p.sliders.clear();
    float bottom = content.tools ? p.tool_bar(*content.tools, content.hovered) : 0;
    bottom = p.facts(content.facts, bottom);
    if (content.rectangle) {
        const auto [from, to] = *content.rectangle;
        p.list->AddRect(p.pixel_at({std::min(from.x, to.x), std::min(from.y, to.y)}),
                        p.pixel_at({std::max(from.x, to.x), std::max(from.y, to.y)}),
                        colors::warning, 0, 0, 0.2f * p.unit);
    }
    if (content.bar)
        bottom = p.bar(*content.bar, bottom);
    const float margin = 1.5f * p.unit;
    const float widest =
        content.pictures.empty() ? p.window.x - 2 * margin : panels_beside_pictures * p.window.x;
    // Offers and a warning stand at the top beside the panels and pictures. Where they cannot, they
    // stand at the bottom and all else ends above them: nothing that is clicked is covered.
    float panels_right = 0;
    for (const Panel& panel : content.panels)
        panels_right = std::max(panels_right, margin + 2 * panel_padding * p.unit +
                                                  std::min(p.wanted_width(panel), widest));
    const float pictures_left =
        content.pictures.empty()
            ? p.window.x
            : p.window.x - OverlayPictures::columns_width * p.window.x - 4 * p.unit;
    float strips_width = p.notice_width(content.warning),
          strips_height = p.notice_end(content.warning, 0);
    for (const PanelRow& offer : content.offers) {
        strips_width = std::max(strips_width, p.offer_width(offer));
        strips_height += p.offer_height();
    }
    const auto middle = p.middle_of(strips_width, panels_right, pictures_left);
    const float end = p.window.y - bottom - (middle ? 0 : strips_height);
    // The cover lies over the pictures and below the panels.
    p.list->ChannelsSplit(2);
    p.list->ChannelsSetCurrent(1);
    float strip = middle ? margin : end;
    for (const PanelRow& offer : content.offers) {
        p.offer(offer, strip, middle.value_or(p.window.x / 2));
        strip += p.offer_height();
    }
    const float panels_end =
        p.panels(content.panels, {{margin, margin}, {margin + widest, end - p.unit}});
    p.list->ChannelsSetCurrent(0);
    p.pictures.draw(*p.list, *p.small, p.unit, p.window,
                    {panels_end + (panels_end > 0 ? p.unit : 0), p.unit}, {p.window.x, end},
                    content.pictures);
    if (!content.cover.empty() && content.message.empty())
        p.message(content.cover, "", bottom);
    p.list->ChannelsMerge();
    if (!content.message.empty())
        p.message(content.message, content.detail, bottom);
    if (content.help)
        p.help(middle ? margin + strips_height : 0, p.window.y - end);
    const float wrap = p.window.x * 0.8f;
    strip =
        p.notice(content.warning, colors::warning, strip, middle.value_or(p.window.x / 2), wrap);
    // A notice of some seconds has several lines beside a panel.
    const float beside = pictures_left - panels_right - 6 * p.unit;
    const bool has_space = beside > least_text_units * p.unit;
    p.notice(content.notice, colors::text, middle ? strip : margin,
             has_space ? (panels_right + pictures_left) / 2 : p.window.x / 2,
             has_space ? std::min(beside, wrap) : wrap);
    if (content.tools) {
        const ToolBarLayout layout =
            tool_bar_layout(content.tools->tools.size(), window, text_pixels);
        const auto pointed = content.hovered ? content.hovered : content.focused;
        if (pointed && *pointed == 0)
            p.hint(content.tools->dot.hint, layout.dot);
        else if (pointed && *pointed <= content.tools->tools.size())
            p.hint(content.tools->tools[*pointed - 1].hint, layout.tools[*pointed - 1]);
    }
    if (content.focused)
        p.focus_ring(*content.focused);

    ImGui::Render();
    p.pass.draw(*ImGui::GetDrawData());
}

}  // namespace theatron::window
