// SPDX-License-Identifier: Apache-2.0
// The tools for marks: a stroke, an arrow, a pin or a distance (mark_draft.h) on the surface that
// the pointer's ray meets.
#pragma once

#include "viewer/tools/mark_draft.h"
#include "viewer/tools/tool.h"

namespace theatron::viewer {

class MarkTool : public Tool {
public:
    explicit MarkTool(session::MarkKind kind) : draft_(kind) {}

    bool on_pointer(const Pointer& pointer, const ToolScene& scene) override;
    bool follows_pointer() const override { return draft_.is_open(); }
    std::optional<Phrase> take_advice() override { return draft_.take_advice(); }
    void end(Meeting& meeting) override;

private:
    MarkDraft draft_;
    render::PickRay ray_;  // that drew last
};

}  // namespace theatron::viewer
