// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/tool.h"

#include "viewer/tools/mark.h"
#include "viewer/tools/slice.h"

namespace theatron::viewer {
namespace {

std::unique_ptr<Tool> make_tool(ToolKind kind) {
    if (const auto mark = marks_of(kind))
        return std::make_unique<MarkTool>(*mark);
    if (kind == ToolKind::slice || kind == ToolKind::cut)
        return std::make_unique<SliceTool>(kind == ToolKind::cut);
    return nullptr;
}

}  // namespace

const std::vector<ToolRow>& tool_rows() {
    static const std::vector<ToolRow> rows{{Phrase::draw,
                                            false,
                                            {{ToolKind::stroke, Phrase::stroke},
                                             {ToolKind::arrow, Phrase::arrow},
                                             {ToolKind::pin, Phrase::pin},
                                             {ToolKind::distance, Phrase::distance}}},
                                           {Phrase::case_,
                                            true,
                                            {{ToolKind::slice, Phrase::slice},
                                             {ToolKind::cut, Phrase::cut},
                                             {ToolKind::part, Phrase::parts}}}};
    return rows;
}

std::optional<session::MarkKind> marks_of(ToolKind kind) {
    switch (kind) {
        case ToolKind::stroke:
            return session::MarkKind::stroke;
        case ToolKind::arrow:
            return session::MarkKind::arrow;
        case ToolKind::pin:
            return session::MarkKind::pin;
        case ToolKind::distance:
            return session::MarkKind::distance;
        case ToolKind::none:
        case ToolKind::slice:
        case ToolKind::cut:
        case ToolKind::part:
            break;
    }
    return std::nullopt;
}

Phrase name_of(ToolKind kind) {
    for (const ToolRow& row : tool_rows())
        for (const ToolRow::Choice& choice : row.choices)
            if (choice.kind == kind)
                return choice.name;
    return Phrase::hold;
}

void Tools::choose(ToolKind kind, Meeting& meeting) {
    if (tool_)
        tool_->end(meeting);
    chosen_ = kind;
    tool_ = make_tool(kind);
}

std::optional<SurfacePoint> surface_at(const render::PickRay& ray, const render::CameraView& view,
                                       Meeting& meeting, const std::vector<CloudCamera>& cloud) {
    using session::MarkedSurface;
    const auto hit = meeting.pick(ray, view);
    const auto measured = pick_cloud(cloud, ray);
    if (measured && (!hit || measured->distance_m < length(hit->picked.place - ray.from)))
        return SurfacePoint{
            MarkedSurface::cloud, {}, measured->place, measured->normal, measured->measured};
    const auto& open = meeting.case_scene().in_room();
    if (!hit || !open)
        return std::nullopt;
    const bool is_screen = open->screen && hit->object == open->screen->id;
    if (is_screen && !meeting.case_scene().monitor().patient_point(*open, hit->picked.place))
        return std::nullopt;
    if (!is_screen && !open->find(hit->object))
        return std::nullopt;
    return SurfacePoint{is_screen ? MarkedSurface::slice : MarkedSurface::organ, hit->object,
                        hit->picked.place, hit->picked.normal, std::nullopt};
}

}  // namespace theatron::viewer
