// SPDX-License-Identifier: Apache-2.0
// Pointing and drawing on the plain picture of one camera, with mouse or finger: what its depth
// camera measured below the pointer is pointed at or drawn on.
//
// Pure. Not thread safe.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "phrases/phrase.h"
#include "session/mark.h"
#include "viewer/flat/flat_picture.h"
#include "viewer/tools/mark_draft.h"
#include "viewer/tools/tool.h"
#include "window/window_input.h"

namespace theatron::viewer {

class FlatTools {
public:
    // One that makes marks; another one: the pointer draws nothing.
    void choose(ToolKind kind);
    ToolKind chosen() const { return chosen_; }
    // The person points or draws, so that a surface is needed.
    bool are_used() const { return points_ || draft_.has_value(); }

    // Drops the mark that is being drawn. False: none is.
    bool give_up();
    // Ends what is drawn with the button down: the next picture shows another place there.
    void lift();
    // `picture`: that the person sees; null: none. `measures`: its camera has depth, although none
    // may have come yet.
    void on_input(const window::WindowInput& input, const FlatPicture* picture, bool measures);

    // The ray to the place that the person points at; it begins on the camera's line.
    const std::optional<render::PickRay>& pointing() const { return pointing_; }
    const std::optional<Vec3>& pointed() const { return pointed_; }
    // The mark that is being drawn, without its author.
    const session::Mark* drawn() const {
        return draft_ && draft_->is_open() ? &draft_->mark() : nullptr;
    }
    // The marks that were completed since the last call.
    std::vector<session::Mark> take_marks() { return std::exchange(made_, {}); }
    // Tells the person the next step. Given once.
    std::optional<Phrase> take_advice() { return std::exchange(advice_, std::nullopt); }

private:
    void point(const window::WindowInput& input, const FlatPicture* picture, bool measures);
    void draw(const window::WindowInput& input, const FlatPicture* picture, bool measures);

    ToolKind chosen_ = ToolKind::none;
    bool points_ = false;
    bool misses_ = false;  // points where nothing was measured
    std::optional<render::PickRay> pointing_;
    std::optional<Vec3> pointed_;
    std::optional<MarkDraft> draft_;  // of the chosen tool
    Vec2 pointer_;                    // that drew last
    std::vector<session::Mark> made_;
    std::optional<Phrase> advice_;
};

}  // namespace theatron::viewer
