// SPDX-License-Identifier: Apache-2.0
#include "xr/overlay_native.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "xr/imgui_fonts_native.h"
#include "xr/overlay_pictures_native.h"
#include "xr/panel_colors_native.h"
#include "xr/window_input.h"

namespace theatron::xr {
namespace {

// Windows narrower than this, in half text heights, show one row of facts.
constexpr float small_window_units = 80;

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
    float facts(const std::vector<Fact>& facts) const;
    void message(const std::string& message, const std::string& detail, float bottom) const;
    float notice(const std::string& words, ImU32 color, float top) const;
    void help(float bottom) const;
    void panels(const std::vector<Panel>& panels, float bottom);

    // Rows that are scrolled out above, of the panel with this title.
    std::map<std::string, double> scrolled;

    struct Area {
        ImVec2 from, to;
        bool has(ImVec2 place) const {
            return place.x >= from.x && place.x < to.x && place.y >= from.y && place.y < to.y;
        }
    };
    std::vector<Area> panel_areas;
    std::vector<std::string> panel_titles;  // of each of them
    std::vector<std::pair<Area, int>> buttons;
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

// From the left, in as many rows as they need. Returns their height.
float Overlay::Parts::facts(const std::vector<Fact>& facts) const {
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
        return 0;
    const float height = y + row + 0.5f * unit, top = window.y - height;
    list->AddRectFilled({0, top}, window, colors::bar);
    for (const auto& [fact, place] : places) {
        const ImVec2 at{place.x, top + place.y + 0.5f * unit};
        text(small, at, colors::label, fact->label);
        text(normal, {at.x, at.y + small->FontSize}, fact->warning ? colors::warning : colors::text,
             fact->value);
    }
    return height;
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

// Returns where the next may begin.
float Overlay::Parts::notice(const std::string& words, ImU32 color, float top) const {
    if (words.empty())
        return top;
    const float wrap = window.x * 0.8f, padding = unit;
    const ImVec2 size = measure(normal, words, wrap);
    const ImVec2 from{(window.x - size.x) / 2, top + padding};
    list->AddRectFilled({from.x - 2 * padding, from.y - padding},
                        {from.x + size.x + 2 * padding, from.y + size.y + padding}, colors::panel,
                        unit);
    text(normal, from, color, words, wrap);
    return from.y + size.y + 2 * padding;
}

void Overlay::Parts::help(float bottom) const {
    const float row = normal->FontSize + 0.9f * unit, gap = 3 * unit, padding = 2.5f * unit;
    float keys = 0, meanings = 0;
    for (const KeyHelp& line : key_help()) {
        keys = std::max(keys, measure(normal, line.keys).x);
        meanings = std::max(meanings, measure(normal, line.meaning).x);
    }
    const float width = keys + gap + meanings;
    const float height = row * float(key_help().size()) - 0.9f * unit;
    // Smaller where the window is small: all lines must be readable.
    const float scale = std::min(
        {1.0f, window.x / (width + 2 * padding), (window.y - bottom) / (height + 2 * padding)});
    const ImVec2 half{scale * (width / 2 + padding), scale * (height / 2 + padding)};
    const ImVec2 middle{window.x / 2, (window.y - bottom) / 2};
    list->AddRectFilled({middle.x - half.x, middle.y - half.y},
                        {middle.x + half.x, middle.y + half.y}, colors::panel, scale * unit);
    const ImVec2 from{middle.x - scale * width / 2, middle.y - scale * height / 2};
    float y = from.y;
    for (const KeyHelp& line : key_help()) {
        text(normal, {from.x, y}, colors::key, line.keys, 0, scale);
        text(normal, {from.x + scale * (keys + gap), y}, colors::text, line.meaning, 0, scale);
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

// Rows that do not fit above `bottom` are left out, and a last line says how many. The mouse wheel
// shows them.
void Overlay::Parts::panels(const std::vector<Panel>& shown, float bottom) {
    const float padding = 1.4f * unit, gap = 0.7f * unit, left = 1.5f * unit;
    const float button_height = normal->FontSize + gap, slider_width = 22 * unit;
    float top = 1.5f * unit;
    const auto button_width = [&](const PanelButton& button) {
        return measure(small, button.label).x + 2 * gap;
    };
    for (const Panel& panel : shown) {
        float width = measure(normal, panel.title).x;
        for (const PanelRow& row : panel.rows) {
            float buttons_width = 0;
            for (const PanelButton& button : row.buttons)
                buttons_width += button_width(button) + gap;
            if (row.slider)
                buttons_width += slider_width + 2 * gap;
            width = std::max({width, measure(normal, row.text).x + buttons_width + 2 * padding,
                              measure(small, row.detail).x});
        }
        width = std::min(width, window.x - 2 * (left + padding));
        const auto row_height = [&](const PanelRow& row) {
            const auto lines = std::count(row.detail.begin(), row.detail.end(), '\n') + 1;
            return button_height + (row.detail.empty() ? 0 : float(lines) * small->FontSize) + gap;
        };
        const float room = window.y - bottom - top - 2 * padding - normal->FontSize - gap;
        const auto fits = [&](float height) { return height + small->FontSize <= room; };
        // The first row as far down as the wheel wants, and the last rows fill the panel.
        std::size_t last_first = panel.rows.size();
        for (float height = 0; last_first > 0; --last_first) {
            height += row_height(panel.rows[last_first - 1]);
            if (!fits(height))
                break;
        }
        double& wanted = scrolled[panel.title];
        wanted = std::clamp(wanted, 0.0, double(last_first));
        const auto first = std::size_t(std::lround(wanted));
        float height = 0;
        std::size_t end = first;
        while (end < panel.rows.size() && fits(height + row_height(panel.rows[end])))
            height += row_height(panel.rows[end++]);
        const std::size_t left_out = panel.rows.size() - (end - first);
        const Area area{
            {left, top},
            {left + width + 2 * padding, top + 2 * padding + normal->FontSize + gap + height +
                                             (left_out > 0 ? small->FontSize : 0)}};
        panel_areas.push_back(area);
        panel_titles.push_back(panel.title);
        list->AddRectFilled(area.from, area.to, colors::panel, unit);
        list->PushClipRect(area.from, area.to);
        float y = top + padding;
        text(small, {left + padding, y}, colors::label, panel.title);
        y += normal->FontSize + gap;
        for (std::size_t i = first; i < end; ++i) {
            const PanelRow& row = panel.rows[i];
            float x = area.to.x - padding;
            for (auto button = row.buttons.rbegin(); button != row.buttons.rend(); ++button) {
                const float wide = button_width(*button);
                const Area place{{x - wide, y}, {x, y + button_height}};
                list->AddRectFilled(place.from, place.to, colors::button, 0.5f * unit);
                text(small, {place.from.x + gap, y + (button_height - small->FontSize) / 2},
                     colors::key, button->label);
                buttons.push_back({place, button->command});
                x -= wide + gap;
            }
            if (row.slider) {
                x -= gap;
                slider(*row.slider, {{x - slider_width, y}, {x, y + button_height}});
                x -= slider_width + gap;
            }
            list->PushClipRect({left + padding, y}, {x, y + row_height(row)}, true);
            text(normal, {left + padding, y + gap / 2}, colors::text, row.text);
            list->PopClipRect();
            if (!row.detail.empty())
                text(small, {left + padding, y + button_height}, colors::label, row.detail);
            y += row_height(row);
        }
        if (left_out > 0)
            text(small, {left + padding, y}, colors::label,
                 std::to_string(left_out) + " more: mouse wheel");
        list->PopClipRect();
        top = area.to.y + unit;
    }
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

std::optional<int> Overlay::command_at(Vec2 place) const {
    const ImVec2 pixel = parts_->pixel_at(place);
    for (const auto& [area, command] : parts_->buttons)
        if (area.has(pixel))
            return command;
    return parts_->pictures.command_at(pixel);
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

    float bottom = p.facts(content.facts);
    p.panel_areas.clear();
    p.panel_titles.clear();
    p.buttons.clear();
    p.sliders.clear();
    if (content.rectangle) {
        const auto [from, to] = *content.rectangle;
        p.list->AddRect(p.pixel_at({std::min(from.x, to.x), std::min(from.y, to.y)}),
                        p.pixel_at({std::max(from.x, to.x), std::max(from.y, to.y)}),
                        colors::warning, 0, 0, 0.2f * p.unit);
    }
    if (content.bar)
        bottom = p.bar(*content.bar, bottom);
    p.pictures.draw(*p.list, *p.small, p.unit, {p.window.x, p.window.y - bottom}, content.pictures);
    p.panels(content.panels, bottom);
    if (!content.message.empty())
        p.message(content.message, content.detail, bottom);
    if (content.help)
        p.help(bottom);
    const float below = p.notice(content.warning, colors::warning, 1.5f * p.unit);
    p.notice(content.notice, colors::text, below);

    ImGui::Render();
    p.pass.draw(*ImGui::GetDrawData());
}

}  // namespace theatron::xr
