// SPDX-License-Identifier: Apache-2.0
// Renderer choices as text: on the command line, and in a host's commands to participants.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/renderer_choice.h"
#include "wire/control.h"

namespace theatron::viewer {

// "blend" for two cameras and more, "mesh" for one; in a window simpler where that is too slow.
inline constexpr const char* automatic = "auto";

// All that may be chosen: render::renderer_names() and "auto".
std::vector<std::string> renderer_choices();
// Throws Error that names the choices if this is none of them.
void check_renderer_choice(const std::string& name);
// The renderer of a choice for this number of cameras, if drawing time does not matter.
std::string renderer_for(const std::string& choice, std::size_t cameras);

// Applies the host's command if it names an existing renderer. Otherwise nothing changes, and the
// return value is a sentence for the participant; empty on success.
std::string follow_host(session::RendererChoice& choice, const wire::SetRenderer& word);

// A host's command: "blend", "2 mesh", "Dr. A mesh lock", "all auto", "all free".
struct RendererText {
    std::string who;  // number or name of a participant; empty: all
    wire::SetRenderer word;
};
// Throws Error with one sentence if it is not understood.
RendererText parse_renderer(const std::string& text);

}  // namespace theatron::viewer
