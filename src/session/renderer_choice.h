// SPDX-License-Identifier: Apache-2.0
// How a participant draws: what the person chose, and what the host said. The last word holds;
// while the host has locked it, that is the host's.
//
// A pure state machine.
#pragma once

#include <string>

#include "wire/control.h"

namespace theatron::session {

class RendererChoice {
public:
    // What the person wants from the beginning.
    explicit RendererChoice(std::string renderer) : renderer_(std::move(renderer)) {}

    // The person wants another one. False, and nothing changes, while it is locked.
    bool choose(const std::string& renderer) {
        if (locked_)
            return false;
        renderer_ = renderer;
        return true;
    }
    // The host has spoken.
    void follow(const wire::SetRenderer& word) {
        if (!word.renderer.empty())
            renderer_ = word.renderer;
        locked_ = word.locked;
    }

    const std::string& renderer() const { return renderer_; }
    bool locked() const { return locked_; }

private:
    std::string renderer_;
    bool locked_ = false;
};

}  // namespace theatron::session
