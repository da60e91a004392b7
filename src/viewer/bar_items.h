// SPDX-License-Identifier: Apache-2.0
// The items of the bar of buttons, in its order: the window, the page and a headset may show the
// same ones.
//
// Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "phrases/phrase.h"
#include "viewer/own_face.h"
#include "viewer/voices.h"
#include "window/tool_bar.h"
#include "wire/role.h"

namespace theatron::viewer {

struct BarFacts {
    bool joined = true;  // false: at the door, or without a connection
    wire::Role role = wire::Role::expert;
    bool muted = false;                    // by an operator
    std::optional<Microphone> microphone;  // as in Voices
    OwnFace own_face = OwnFace::none;
    bool points = false, draws = false, shows_case = false, shows_people = false,
         shows_more = false;
    bool is_past = false;      // of what is seen: nothing can be drawn or pointed at there
    std::size_t visitors = 0;  // who wait for this operator
    std::size_t hands = 0;     // that others have raised
    std::size_t unseen = 0;    // messages of others
    bool asks_leave = false;   // the next press leaves
};

struct BarItem {
    window::ToolIcon id{};
    Phrase label{}, hint{};  // the hint names the key
    bool pressed = false;
    bool off = false;    // nobody hears or sees the person
    bool alarm = false;  // the person should see it
    std::size_t badge = 0;
};

// Those that this role may use now.
std::vector<BarItem> bar_items(const BarFacts& facts);

}  // namespace theatron::viewer
