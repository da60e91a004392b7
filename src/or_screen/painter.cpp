// SPDX-License-Identifier: Apache-2.0
#include "or_screen/painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/utf8.h"
#include "phrases/phrase.h"
#include "window/imgui_pass_native.h"
#include "window/panel_colors_native.h"

namespace theatron::or_screen {
namespace {

namespace colors = window::colors;

constexpr ImU32 shade_color = colors::with_opacity(colors::shade, 190);
constexpr ImU32 outline_color = IM_COL32(0, 0, 0, 170);
constexpr ImU32 slice_ink = IM_COL32(255, 220, 90, 255);  // as in the room

// A person's colour as the ground of a card, dark enough for white letters.
ImU32 tinted(Rgb c) {
    const auto mix = [](int ground, int tint) { return ground + (tint - ground) * 26 / 100; };
    return IM_COL32(mix(colors::card_ground.r, c.r), mix(colors::card_ground.g, c.g),
                    mix(colors::card_ground.b, c.b), 255);
}

ImVec2 from(const Rect& rect) {
    return {float(rect.x), float(rect.y)};
}
ImVec2 to(const Rect& rect) {
    return {float(rect.right()), float(rect.bottom())};
}

// The place of a picture's pixel whose picture fills `area`.
ImVec2 place_in(const Rect& area, Size picture, Vec2 pixel) {
    return {float(area.x + (pixel.x + 0.5) / picture.width * area.width),
            float(area.y + (pixel.y + 0.5) / picture.height * area.height)};
}

// The place of these shares of an area's width and height.
ImVec2 place_at(const Rect& area, Vec2 share) {
    return {float(area.x + share.x * area.width), float(area.y + share.y * area.height)};
}

}  // namespace

ImVec2 Painter::measure(const ImFont* font, const std::string& words, float wrap) const {
    return font->CalcTextSizeA(font->FontSize, 1e9f, wrap, words.c_str());
}

std::string Painter::shortened(const ImFont* font, const std::string& words, float width) const {
    if (measure(font, words).x <= width)
        return words;
    std::string part = words;
    const std::string dots = "\u2026";
    while (!part.empty() && measure(font, part + dots).x > width)
        drop_last_character(part);
    while (!part.empty() && part.back() == ' ')
        part.pop_back();
    return part + dots;
}

std::vector<std::string> Painter::in_lines(const ImFont* font, const std::string& words,
                                           float width) const {
    if (measure(font, words).x <= width)
        return {words};
    // Names of cases often differ in their ends.
    for (std::size_t end = words.rfind(' '); end != std::string::npos && end > 0;
         end = words.rfind(' ', end - 1))
        if (measure(font, words.substr(0, end)).x <= width)
            return {words.substr(0, end), shortened(font, words.substr(end + 1), width)};
    return {shortened(font, words, width)};
}

void Painter::text(const ImFont* font, ImVec2 place, ImU32 color, const std::string& words,
                   float wrap, float scale) {
    list_.AddText(font, scale * font->FontSize, {std::round(place.x), std::round(place.y)}, color,
                  words.c_str(), nullptr, wrap);
}

void Painter::centred(const ImFont* font, const Rect& rect, ImU32 color, const std::string& words,
                      float scale) {
    // A text of the whole width is not cut because its size was rounded.
    constexpr float rounding = 1;
    const std::string fits =
        shortened(font, words, (float(rect.width) - letter_) / scale + rounding);
    const ImVec2 whole = measure(font, fits), size{scale * whole.x, scale * whole.y};
    text(font,
         {float(rect.x + (rect.width - size.x) / 2), float(rect.y + (rect.height - size.y) / 2)},
         color, fits, 0, scale);
}

void Painter::ground(Size screen) {
    list_.AddRectFilled({0, 0}, {float(screen.width), float(screen.height)}, colors::ground);
}

void Painter::label(ImVec2 at, Rgb color, const std::string& initials, ImU32 words_color,
                    const std::string& words, const Rect& area) {
    const float padding = 0.3f * letter_, height = 1.44f * letter_;
    const ImVec2 letters = measure(fonts_.small, initials);
    const float side = initials.empty() ? 0 : std::max(letters.x + 2 * padding, 1.8f * letter_);
    const std::string fits = shortened(fonts_.small, words, float(area.width) - side - letter_);
    const ImVec2 text_size = measure(fonts_.small, fits);
    const float width = side + (fits.empty() ? 0 : text_size.x + 2 * padding);
    const Rect place = label_place({at.x, at.y}, {width, height}, 0.85 * letter_, area, there_);
    there_.push_back(place);
    const float middle = float(place.y) + height / 2;
    if (!fits.empty()) {
        list_.AddRectFilled(from(place), to(place), shade_color, 0.35f * letter_);
        text(fonts_.small, {float(place.x) + side + padding, middle - text_size.y / 2}, words_color,
             fits);
    }
    if (!initials.empty())
        badge({float(place.x) + side / 2, middle}, color, initials);
}

// Open in its middle: what is pointed at stays visible. Dashed where it is not sure that the place
// is seen.
void Painter::ring(ImVec2 at, ImU32 color, Sight sight) {
    const float radius = 0.62f * letter_, thick = 0.16f * letter_;
    constexpr int dashes = 8;
    const bool is_whole = sight == Sight::visible;
    const auto draw = [&](ImU32 with, float width) {
        if (is_whole) {
            list_.AddCircle(at, radius, with, 48, width);
            return;
        }
        for (int i = 0; i < dashes; ++i) {
            const float begin = 2 * std::numbers::pi_v<float> * float(i) / dashes;
            list_.PathArcTo(at, radius, begin, begin + std::numbers::pi_v<float> / dashes, 8);
            list_.PathStroke(with, 0, width);
        }
    };
    draw(outline_color, 2 * thick);
    draw(color, thick);
    if (is_whole) {
        list_.AddCircleFilled(at, 0.14f * letter_, outline_color);
        list_.AddCircleFilled(at, 0.09f * letter_, color);
    }
}

void Painter::badge(ImVec2 middle, Rgb color, const std::string& initials) {
    const ImVec2 size = measure(fonts_.small, initials);
    const float half = std::max(size.x / 2 + 0.3f * letter_, 0.9f * letter_);
    const ImVec2 low{middle.x - half, middle.y - 0.72f * letter_},
        high{middle.x + half, middle.y + 0.72f * letter_};
    const float rounding = 0.35f * letter_, edge = 0.08f * letter_;
    list_.AddRectFilled({low.x - edge, low.y - edge}, {high.x + edge, high.y + edge}, outline_color,
                        rounding);
    list_.AddRectFilled(low, high, colors::with_opacity(color), rounding);
    text(fonts_.small, {middle.x - size.x / 2, middle.y - size.y / 2}, colors::ink, initials);
}

void Painter::pointers(const std::vector<PointerMark>& pointers, const Rect& area, Size picture) {
    const double radius = 0.8 * letter_;
    for (const PointerMark& one : pointers) {
        const ImVec2 at = place_in(area, picture, one.place.pixel);
        ring(at, colors::with_opacity(one.color), one.place.sight);
        there_.push_back({at.x - radius, at.y - radius, 2 * radius, 2 * radius});
    }
    for (const PointerMark& one : pointers)
        label(place_in(area, picture, one.place.pixel), one.color, one.initials, colors::warning,
              one.place.sight == Sight::hidden ? say(Phrase::screen_hidden) : std::string(), area);
}

void Painter::mark(const PictureMark& mark, const Rect& area, Size picture) {
    const float thick = 0.14f * letter_;
    const auto at = [&](std::size_t i) { return place_in(area, picture, mark.points[i].pixel); };
    const auto is_shown = [&](std::size_t i) { return mark.points[i].sight != Sight::outside; };
    const auto color_at = [&](std::size_t i) {
        return colors::with_opacity(mark.color, mark.points[i].sight == Sight::hidden ? 70 : 255);
    };
    for (std::size_t i = 1; i < mark.points.size(); ++i)
        if (is_shown(i - 1) && is_shown(i)) {
            list_.AddLine(at(i - 1), at(i), outline_color, 1.8f * thick);
            list_.AddLine(at(i - 1), at(i), color_at(i), thick);
        }
    const std::size_t last = mark.points.size() - 1;
    if (mark.kind == session::MarkKind::pin || mark.kind == session::MarkKind::distance)
        for (const std::size_t i : {std::size_t(0), last})
            if (is_shown(i)) {
                list_.AddCircleFilled(at(i), 0.3f * letter_, outline_color);
                list_.AddCircleFilled(at(i), 0.22f * letter_, color_at(i));
            }
    if (mark.kind == session::MarkKind::arrow && last > 0 && is_shown(0) && is_shown(last)) {
        const ImVec2 tail = at(0), tip = at(last);
        const float length = std::max(std::hypot(tip.x - tail.x, tip.y - tail.y), 1.0f);
        const ImVec2 ahead{(tip.x - tail.x) / length, (tip.y - tail.y) / length};
        const float back = 0.7f * letter_, half = 0.35f * letter_;
        const ImVec2 foot{tip.x - ahead.x * back, tip.y - ahead.y * back};
        list_.AddTriangleFilled(tip, {foot.x - ahead.y * half, foot.y + ahead.x * half},
                                {foot.x + ahead.y * half, foot.y - ahead.x * half}, color_at(last));
    }
}

void Painter::camera(const Content& content, const Rect& rect,
                     const render::PictureTexture* picture) {
    const float rounding = 0.25f * letter_;
    if (!picture || picture->size().area() == 0) {
        list_.AddRectFilled(from(rect), to(rect), colors::card, rounding);
        if (content.message.empty())
            centred(fonts_.name, rect, colors::label, say(Phrase::screen_no_camera));
        return written(content.written, rect);
    }
    // An old picture must not be taken for the present.
    const bool is_old = !content.warning.empty();
    const ImU32 tint = is_old ? IM_COL32(110, 110, 110, 255) : IM_COL32(255, 255, 255, 255);
    list_.AddImageRounded(window::texture_of(picture->texture()), from(rect), to(rect), {0, 0},
                          {1, 1}, tint, rounding);
    list_.PushClipRect(from(rect), to(rect), true);
    there_.clear();
    for (const PictureMark& one : content.marks)
        mark(one, rect, content.picture);
    pointers(content.pointers, rect, content.picture);
    for (const PictureMark& one : content.marks) {
        const PicturePlace& end = one.points.back();
        if (!one.label.empty() && end.sight != Sight::outside && end.sight != Sight::hidden)
            label(place_in(rect, content.picture, end.pixel), one.color, "",
                  colors::with_opacity(one.color), one.label, rect);
    }
    if (const std::string& words = is_old ? content.warning : content.playback; !words.empty()) {
        const Rect bar{rect.x, rect.y, rect.width, 2.4 * letter_};
        list_.AddRectFilled(from(bar), to(bar), colors::warning, rounding,
                            ImDrawFlags_RoundCornersTop);
        centred(fonts_.name, bar, IM_COL32(20, 14, 4, 255), words);
    }
    written(content.written, rect);
    list_.PopClipRect();
}

// At the lower edge: a message alone has two lines, of several each has one.
void Painter::written(const std::vector<std::string>& messages, const Rect& rect) {
    if (messages.empty())
        return;
    const float padding = 0.6f * letter_, wrap = float(rect.width) - 2 * padding;
    // Words that are broken leave some of both lines free.
    const float most = messages.size() == 1 ? 1.7f * wrap : wrap;
    std::string words;
    for (const std::string& message : messages)
        words += (words.empty() ? "" : "\n") + shortened(fonts_.small, message, most);
    const float height =
        fonts_.small->CalcTextSizeA(fonts_.small->FontSize, 1e9f, wrap, words.c_str()).y;
    const ImVec2 corner{float(rect.x), to(rect).y - height - 2 * padding};
    list_.AddRectFilled(corner, to(rect), colors::dense_veil, 0.25f * letter_,
                        ImDrawFlags_RoundCornersBottom);
    list_.AddText(fonts_.small, fonts_.small->FontSize, {corner.x + padding, corner.y + padding},
                  colors::text, words.c_str(), nullptr, wrap);
}

// The camera at the left, recordings in the middle, the age at the right.
void Painter::caption(const Content& content, const Rect& rect) {
    const ImFont* font = fonts_.small;
    const float y = float(rect.y + (rect.height - font->FontSize) / 2), between = letter_;
    const std::string age = content.age.empty() ? "" : content.age + " old";
    const float age_width = measure(font, age).x;
    text(font, {to(rect).x - age_width, y}, content.age_warns ? colors::warning : colors::label,
         age);
    const float room = float(rect.width) - age_width - between;
    const std::string name = content.camera.empty() ? "" : "Camera " + content.camera;
    const std::string camera = shortened(font, name, content.recorded.empty() ? room : room / 2);
    text(font, {float(rect.x), y}, colors::label, camera);
    if (content.recorded.empty())
        return;
    const float left = float(rect.x) + measure(font, camera).x + between, dot = 0.32f * letter_;
    list_.AddCircleFilled({left + dot, float(rect.y + rect.height / 2)}, dot,
                          IM_COL32(226, 74, 66, 255));
    const float begin = left + 3 * dot;
    text(font, {begin, y}, colors::text,
         shortened(font, content.recorded, to(rect).x - age_width - between - begin));
}

void Painter::room(const Content& content, const Rect& rect, const render::Texture* picture) {
    const float rounding = 0.25f * letter_;
    if (!picture) {
        list_.AddRectFilled(from(rect), to(rect), colors::card, rounding);
        return;
    }
    list_.AddImageRounded(window::texture_of(*picture), from(rect), to(rect), {0, 1}, {1, 0},
                          IM_COL32(255, 255, 255, 255), rounding);
    list_.PushClipRect(from(rect), to(rect), true);
    there_.clear();
    for (const HeadMark& head : content.heads) {
        const ImVec2 at = place_at(rect, head.place);
        // Above the head, or where no other initials stand.
        const double side = (head.speaks ? 3.0 : 2.2) * letter_;
        const Rect place = label_place({at.x, at.y - side}, {side, side}, -side / 2, rect, there_);
        there_.push_back(place);
        const ImVec2 middle{float(place.x + side / 2), float(place.y + side / 2)};
        if (head.speaks)
            list_.AddCircle(middle, 1.4f * letter_, colors::with_opacity(head.color), 48,
                            0.12f * letter_);
        badge(middle, head.color, head.initials);
    }
    list_.PopClipRect();
}

void Painter::monitor(const Content& content, const Rect& rect,
                      const render::PictureTexture* slice) {
    list_.AddRectFilled(from(rect), to(rect), IM_COL32(0, 0, 0, 255), 0.25f * letter_);
    if (!content.slice || !slice || slice->size().area() == 0)
        return;
    const viewer::SliceTexts& texts = *content.slice;
    std::vector<std::string> lines =
        in_lines(fonts_.small, texts.case_name, float(rect.width) - letter_);
    const std::size_t of_name = lines.size();
    lines.insert(lines.end(), {texts.plane, texts.window, texts.notice});
    double widest = 0;
    for (std::size_t i = of_name; i < lines.size(); ++i)
        widest = std::max<double>(widest, measure(fonts_.small, lines[i]).x);
    const auto scale = float(scale_to_fit(widest, rect.width - letter_));
    const MonitorPlaces places = monitor_places(rect, slice->size(), lines.size(), letter_);
    list_.AddImage(window::texture_of(slice->texture()), from(places.picture), to(places.picture));
    there_.clear();
    const auto put = [&](const std::string& letters, Vec2 towards) {
        const Rect place = letters_place(places.letters, towards, letters.size(), letter_);
        there_.push_back(place);
        list_.AddRectFilled(from(place), to(place), shade_color, 0.35f * letter_);
        const ImVec2 size = measure(fonts_.small, letters);
        text(fonts_.small,
             {float(place.x + (place.width - size.x) / 2),
              float(place.y + (place.height - size.y) / 2)},
             slice_ink, letters);
    };
    pointers(content.slice_pointers, places.picture, slice->size());
    put(texts.letters.left, {-1, 0});
    put(texts.letters.right, {1, 0});
    put(texts.letters.top, {0, -1});
    put(texts.letters.bottom, {0, 1});
    for (std::size_t i = 0; i < lines.size(); ++i)
        centred(fonts_.small, places.lines[i], i < of_name ? colors::text : colors::label, lines[i],
                i < of_name ? 1 : scale);
}

void Painter::card(const PersonCard& card, bool two_lines, const Rect& rect) {
    const float rounding = 0.4f * letter_, padding = 0.5f * letter_, side = 2.4f * letter_;
    const ImU32 color = colors::with_opacity(card.color);
    list_.AddRectFilled(from(rect), to(rect), card.speaks ? tinted(card.color) : colors::card,
                        rounding);
    list_.AddRectFilled(from(rect), {from(rect).x + side, to(rect).y}, color, rounding,
                        ImDrawFlags_RoundCornersLeft);
    const ImVec2 initials = measure(fonts_.small, card.initials);
    const float middle = from(rect).y + float(rect.height) / 2;
    text(fonts_.small, {from(rect).x + (side - initials.x) / 2, middle - initials.y / 2},
         colors::ink, card.initials);
    const float left = from(rect).x + side + padding;
    const float name_middle = two_lines ? from(rect).y + 1.35f * letter_ : middle;
    float right = to(rect).x - padding;
    if (card.speaks) {
        list_.AddRect(from(rect), to(rect), color, rounding, 0, 0.12f * letter_);
        // The bars of a level meter, which stay as they are.
        const float width = 0.22f * letter_;
        right -= 5 * width;
        for (int i = 0; i < 3; ++i) {
            const float x = right + 2 * width * float(i);
            const float half = letter_ * (i == 1 ? 0.75f : 0.42f);
            list_.AddRectFilled({x, name_middle - half}, {x + width, name_middle + half}, color,
                                width / 2);
        }
        right -= padding;
    }
    // A long name in smaller letters; that it is recorded is never cut off.
    const std::string behind = card.is_recorded ? " (recorded)" : "";
    const ImFont* font =
        measure(fonts_.name, card.name + behind).x <= right - left ? fonts_.name : fonts_.small;
    const float name_width = right - left - (behind.empty() ? 0 : measure(font, behind).x);
    text(font, {left, name_middle - font->FontSize / 2}, colors::text,
         shortened(font, card.name, name_width) + behind);
    if (!two_lines)
        return;
    text(fonts_.small, {left, from(rect).y + 3 * letter_ - fonts_.small->FontSize / 2},
         card.warns ? colors::warning : colors::label,
         shortened(fonts_.small, card.state, to(rect).x - padding - left));
}

void Painter::note_card(const std::string& words, const Rect& rect) {
    list_.AddRectFilled(from(rect), to(rect), colors::card, 0.4f * letter_);
    centred(fonts_.small, rect, colors::label, words);
}

void Painter::message(const Content& content, Size screen, Vec2 by) {
    const ImVec2 size{float(screen.width), float(screen.height)};
    list_.AddRectFilled({0, 0}, size, colors::dense_veil);
    const float wrap = 0.8f * size.x;
    const ImVec2 words = measure(fonts_.large, content.message, wrap),
                 more = measure(fonts_.small, content.detail, wrap);
    const float top = (size.y - words.y - letter_ - more.y) / 2 + float(by.y);
    text(fonts_.large, {(size.x - words.x) / 2 + float(by.x), top}, colors::text, content.message,
         wrap);
    text(fonts_.small, {(size.x - more.x) / 2 + float(by.x), top + words.y + letter_},
         colors::label, content.detail, wrap);
}

}  // namespace theatron::or_screen
