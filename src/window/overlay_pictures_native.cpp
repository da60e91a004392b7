// SPDX-License-Identifier: Apache-2.0
#include "window/overlay_pictures_native.h"

#include <algorithm>
#include <cmath>

#include "window/imgui_pass_native.h"
#include "window/panel_colors_native.h"

namespace theatron::window {
namespace {

constexpr int columns = 3;
// Height over width of a picture's place.
constexpr float usual_shape = 0.75f;

}  // namespace

void OverlayPictures::draw(ImDrawList& list, ImFont& font, float unit, ImVec2 window, ImVec2 begin,
                           ImVec2 end, const std::vector<OverlayPicture>& pictures) {
    cells_.clear();
    kept_.resize(pictures.size());
    if (pictures.empty())
        return;
    const float text = font.FontSize, padding = 0.5f * unit, bar = text;
    float title_height = text;
    const auto texts = [&] { return title_height + bar + 3 * padding; };
    const bool is_large = pictures.front().large;
    const float shape = is_large ? float(pictures.front().pixels->size.height) /
                                       float(pictures.front().pixels->size.width)
                                 : usual_shape;
    const ImVec2 free{end.x - begin.x, end.y - begin.y};
    // The cells become smaller until all rows fit.
    const auto width_of = [&](int across) {
        const int rows = (int(pictures.size()) + across - 1) / across;
        const float height = std::min(free.y / float(rows) - unit, free.y - 2 * unit);
        const float wanted = (is_large ? 0.9f : columns_width / columns) * window.x;
        return std::max(std::min({wanted, free.x / float(across) - 2 * unit / float(across) - unit,
                                  (height - texts()) / shape}),
                        16.0f);
    };
    // Fewer columns where panels leave little width.
    int across = is_large ? 1 : columns;
    if (!is_large && free.x < columns_width * window.x + float(columns + 1) * unit)
        for (int fewer = columns - 1; fewer > 0; --fewer)
            across = width_of(fewer) > width_of(across) ? fewer : across;
    float width = width_of(across);
    const auto is_too_long = [&](const OverlayPicture& picture) {
        return font.CalcTextSizeA(text, 1e9f, 0, picture.title.c_str()).x > width - 2 * padding;
    };
    if (std::any_of(pictures.begin(), pictures.end(), is_too_long)) {
        title_height = 2 * text;
        width = width_of(across);
    }
    const float height = width * shape + texts();
    const ImVec2 first{
        is_large ? begin.x + (free.x - width) / 2 : end.x - float(across) * (width + unit),
        is_large ? begin.y + (free.y - height) / 2 : begin.y};
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const OverlayPicture& picture = pictures[i];
        if (kept_[i].pixels != picture.pixels)
            kept_[i].texture.set(picture.pixels->view());
        kept_[i].pixels = picture.pixels;
        const ImVec2 from{std::round(first.x + float(int(i) % across) * (width + unit)),
                          std::round(first.y + float(int(i) / across) * (height + unit))};
        const ImVec2 to{from.x + width, from.y + height};
        cells_.push_back({from, to, picture.command});
        list.AddRectFilled(from, to, colors::panel, padding);
        list.PushClipRect(from, to, true);
        list.AddText(&font, text, {from.x + padding, from.y + padding}, colors::text,
                     picture.title.c_str(), nullptr, width - 2 * padding);
        // As large as its place allows, in its own shape.
        const ImVec2 place{width - 2 * padding, height - texts()};
        const auto size =
            ImVec2{float(picture.pixels->size.width), float(picture.pixels->size.height)};
        const float scale = std::min(place.x / size.x, place.y / size.y);
        const ImVec2 corner{from.x + (width - scale * size.x) / 2,
                            from.y + title_height + 2 * padding + (place.y - scale * size.y) / 2};
        list.AddImage(texture_of(kept_[i].texture.texture()), corner,
                      {corner.x + scale * size.x, corner.y + scale * size.y});
        if (!picture.legend.empty()) {
            const auto measure = [&](const std::string& value) {
                return font.CalcTextSizeA(text, 1e9f, 0, value.c_str()).x;
            };
            const float y = to.y - bar - 0.5f * padding;
            const float left = from.x + measure(picture.legend_from) + 2 * padding;
            const float right = to.x - measure(picture.legend_to) - 2 * padding;
            const float step = (right - left) / float(picture.legend.size());
            list.AddText(&font, text, {from.x + padding, y}, colors::label,
                         picture.legend_from.c_str());
            list.AddText(&font, text, {right + padding, y}, colors::label,
                         picture.legend_to.c_str());
            for (std::size_t n = 0; n < picture.legend.size(); ++n) {
                const Rgb c = picture.legend[n];
                list.AddRectFilled({left + float(n) * step, y + 0.25f * bar},
                                   {left + float(n + 1) * step, y + 0.9f * bar},
                                   IM_COL32(c.r, c.g, c.b, 255));
            }
        }
        list.PopClipRect();
    }
}

std::optional<int> OverlayPictures::command_at(ImVec2 pixel) const {
    for (const Cell& cell : cells_)
        if (pixel.x >= cell.from.x && pixel.x < cell.to.x && pixel.y >= cell.from.y &&
            pixel.y < cell.to.y)
            return cell.command;
    return std::nullopt;
}

}  // namespace theatron::window
