// SPDX-License-Identifier: Apache-2.0
// The tools for marks: a stroke, an arrow, a pin or a distance that is drawn onto the surface which
// the pointer's ray meets, from the press to the release.
#pragma once

#include "viewer/tools/tool.h"

namespace theatron::viewer {

class MarkTool : public Tool {
public:
    explicit MarkTool(session::MarkKind kind) : kind_(kind) {}

    bool on_pointer(const Pointer& pointer, const ToolScene& scene) override;
    void end(Meeting& meeting) override;

private:
    struct Draft {
        SurfacePoint first, last;
        session::Mark mark;
    };
    void begin(const SurfacePoint& at, const Meeting& meeting);
    void go_on(const SurfacePoint& at, const Meeting& meeting);
    bool is_worth_keeping() const;

    session::MarkKind kind_;
    std::optional<Draft> draft_;
};

}  // namespace theatron::viewer
