// SPDX-License-Identifier: Apache-2.0
#include "window/tool_icons_native.h"

#include <initializer_list>

namespace theatron::window {
namespace {

constexpr float units = 24, pi = 3.14159265f;

// Lines in the units of the drawing.
class Pen {
public:
    Pen(ImDrawList& list, ImVec2 corner, float side, float stroke, ImU32 color)
        : list_(list), corner_(corner), scale_(side / units), stroke_(stroke), color_(color) {}

    ImVec2 at(ImVec2 place) const {
        return {corner_.x + scale_ * place.x, corner_.y + scale_ * place.y};
    }
    void line(std::initializer_list<ImVec2> places, bool is_closed = false) {
        for (const ImVec2 place : places)
            list_.PathLineTo(at(place));
        stroke(is_closed);
    }
    // From the angle `from` to `to`, in half turns from the right, clockwise.
    void arc(ImVec2 middle, float radius, float from, float to) {
        list_.PathArcTo(at(middle), scale_ * radius, pi * from, pi * to, 20);
        stroke(false);
    }
    void ring(ImVec2 middle, float radius) {
        list_.AddCircle(at(middle), scale_ * radius, color_, 24, stroke_);
    }
    void spot(ImVec2 middle, float radius) {
        list_.AddCircleFilled(at(middle), scale_ * radius, color_, 20);
    }
    void box(ImVec2 from, ImVec2 to, float rounding) {
        list_.AddRect(at(from), at(to), color_, scale_ * rounding, 0, stroke_);
    }

private:
    void stroke(bool is_closed) {
        list_.PathStroke(color_, is_closed ? ImDrawFlags_Closed : ImDrawFlags_None, stroke_);
    }

    ImDrawList& list_;
    ImVec2 corner_;
    float scale_, stroke_;
    ImU32 color_;
};

}  // namespace

void draw_icon(ImDrawList& list, ToolIcon icon, ImVec2 corner, float side, float stroke,
               ImU32 color) {
    Pen pen(list, corner, side, stroke, color);
    switch (icon) {
        case ToolIcon::microphone:
            pen.box({9, 3}, {15, 14.5f}, 3);
            pen.arc({12, 11.5f}, 6, 0, 1);
            pen.line({{12, 17.5f}, {12, 21}});
            pen.line({{8.5f, 21}, {15.5f, 21}});
            break;
        case ToolIcon::webcam:
            pen.box({3, 6.5f}, {15.5f, 17.5f}, 2);
            pen.line({{15.5f, 11}, {21, 8}, {21, 16}, {15.5f, 13}});
            break;
        case ToolIcon::point:
            pen.line({{4, 4}, {9.5f, 19}, {11.8f, 12.8f}, {18, 10.5f}}, true);
            pen.line({{13.5f, 14.5f}, {19, 20}});
            break;
        case ToolIcon::draw:
            pen.line({{4, 20}, {5.2f, 15.3f}, {16, 4.5f}, {19.5f, 8}, {8.7f, 18.8f}}, true);
            pen.line({{13.3f, 7.2f}, {16.8f, 10.7f}});
            break;
        case ToolIcon::patient_case:
            pen.line({{7, 5}, {5.5f, 5}, {5.5f, 21}, {18.5f, 21}, {18.5f, 5}, {17, 5}});
            pen.box({9, 3.5f}, {15, 7}, 0.5f);
            pen.line({{12, 11}, {12, 17}});
            pen.line({{9, 14}, {15, 14}});
            break;
        case ToolIcon::people:
            pen.ring({9, 8.2f}, 3.2f);
            pen.arc({9, 20}, 6, 1, 2);
            pen.arc({15.5f, 8.2f}, 3.1f, -0.5f, 0.5f);
            pen.arc({15, 20}, 6, 1.65f, 2);
            break;
        case ToolIcon::leave:
            pen.line({{10, 4}, {5, 4}, {5, 20}, {10, 20}});
            pen.line({{10, 12}, {20.5f, 12}});
            pen.line({{16.5f, 8}, {20.5f, 12}, {16.5f, 16}});
            break;
        case ToolIcon::more:
            for (const float x : {5.5f, 12.0f, 18.5f})
                pen.spot({x, 12}, 1.7f);
            break;
    }
}

void draw_cross(ImDrawList& list, ImVec2 corner, float side, float stroke, ImU32 color,
                ImU32 ground) {
    constexpr float from = 3.5f, to = 20.5f;
    Pen(list, corner, side, 3 * stroke, ground).line({{from, from}, {to, to}});
    Pen(list, corner, side, 1.25f * stroke, color).line({{from, from}, {to, to}});
}

void draw_dot(ImDrawList& list, PictureDot::Level level, ImVec2 corner, float side, ImU32 color) {
    const Pen pen(list, corner, side, 0, color);
    switch (level) {
        case PictureDot::Level::good:
            list.AddCircleFilled(pen.at({12, 12}), side * 7 / units, color, 24);
            break;
        case PictureDot::Level::slow:
            list.AddTriangleFilled(pen.at({12, 3.5f}), pen.at({21.5f, 20}), pen.at({2.5f, 20}),
                                   color);
            break;
        case PictureDot::Level::bad:
            list.AddRectFilled(pen.at({5, 5}), pen.at({19, 19}), color);
            break;
    }
}

}  // namespace theatron::window
