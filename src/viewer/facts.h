// SPDX-License-Identifier: Apache-2.0
// Facts about a viewer's picture, and their texts for the desktop.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/participant_figures.h"
#include "pace/drawing_pace.h"
#include "viewer/own_face.h"
#include "viewer/voices.h"
#include "window/overlay_content.h"

namespace theatron::viewer {

struct Facts {
    client::ParticipantFigures received;
    std::vector<wire::Visitor> visitors;  // who wait for this operator
    bool has_picture = false;
    std::optional<double> age_ms;  // current age of the presented picture
    // The skew of the live cameras that are drawn together (same_moment.h); nullopt: fewer than
    // two.
    std::optional<double> skew_ms = {};
    double drawn_per_second = 0;
    bool drawing_rests = false;                        // so that frames are decoded
    std::optional<double> most_drawn_per_second = {};  // by choice; empty: as many as come
    pace::DrawingWay way;
    enum class ChosenBy { person, program, host } renderer_chosen_by = ChosenBy::person;
    std::string notice;  // a recent event; empty: none
    bool help = false;
    std::vector<window::Panel> panels;             // of people and places, while they are shown
    bool line = true;                              // of facts, at the bottom
    std::vector<window::OverlayPicture> pictures;  // of the cameras, while they are shown
    bool frozen = false;                           // the clouds, by the person at the window
    std::string pointed;                           // the place under the mouse; empty: none
    Voices voices;
    std::optional<window::PanelRow> bar = {};             // of the recording that the host plays
    std::optional<std::pair<Vec2, Vec2>> rectangle = {};  // that is being drawn over the picture
    OwnFace own_face = OwnFace::none;
    // The moment that is shown, while it is not the present (looking_back.h); else empty.
    std::string past = {};
    // The recording that the host plays and where it is (playing.h); else empty.
    std::string played = {};
    bool trust = false;  // the panel of trust_panel.h is shown, too
    // A window with a bar of buttons has these; overlay_of() then says in the dot and in offers
    // what it would say in facts and warnings.
    std::optional<window::ToolBar> tools = {};
    std::vector<window::PanelRow> offers = {};  // notices with buttons
    std::size_t unrest = 0;                     // CameraUnrest::count()

    // The present is not what is seen: it is frozen, looked back at, or played.
    bool is_of_another_time() const { return frozen || !past.empty() || !played.empty(); }
};

// The warning that this computer draws too slowly; empty: it does not.
std::string slow_text(const Facts& facts);

// A filter as its host or shown_filter() names it, in the person's language where that has a word
// for it; empty: there is none.
std::string filter_text(const std::string& filter);

// `address` is shown until the host's name is known. `filter_name` turns a filter's spelling into
// a text for people.
window::OverlayContent overlay_of(
    const Facts& facts, const std::string& address,
    const std::function<std::string(const std::string&)>& filter_name);

}  // namespace theatron::viewer
