// SPDX-License-Identifier: Apache-2.0
// The renderer of a participant: the newest choice of the person or of the host. While the host has
// locked it, the person cannot change it.
//
// A pure state machine.
#pragma once

#include <string>
#include <utility>

#include "wire/control.h"

namespace theatron::session {

// As the renderer of wire::SetRenderer: the newest choice that was not locked, of the person or of
// the host.
inline constexpr const char* own_renderer = "own";

class RendererChoice {
public:
    // `renderer`: the person's choice at the beginning.
    explicit RendererChoice(std::string renderer) : renderer_(std::move(renderer)) {}

    // The person chooses another one. False, without effect, while it is locked.
    bool choose(const std::string& renderer) {
        if (locked_)
            return false;
        renderer_ = own_ = renderer;
        return true;
    }
    // Applies a command of the host.
    void follow(const wire::SetRenderer& word) {
        if (word.renderer == own_renderer)
            renderer_ = own_;
        else if (!word.renderer.empty())
            renderer_ = word.renderer;
        if (!word.locked && !word.renderer.empty())
            own_ = renderer_;
        locked_ = word.locked;
    }

    const std::string& renderer() const { return renderer_; }
    bool locked() const { return locked_; }

private:
    std::string renderer_, own_ = renderer_;
    bool locked_ = false;
};

}  // namespace theatron::session
