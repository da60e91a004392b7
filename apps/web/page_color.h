// SPDX-License-Identifier: Apache-2.0
// The codec of colour that this page asks for: the one of its link, or JPEG and H.264 as
// client/color_preference.h chooses.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "client/color_preference.h"
#include "client/participant_figures.h"

namespace theatron::web {

// For the page's one thread.
class PageColor {
public:
    // `wish`: a codec, or "auto" or "" for a choice by measurements. A codec that is unknown or
    // that this page cannot decode leads to that choice, too, and reason() says so.
    PageColor(const std::string& wish, bool can_h264);

    // That the host is asked for.
    const std::string& codec() const;
    // One sentence for people: the choice and why.
    const std::string& reason() const;

    // A few times a second. True if codec() changed. A chosen codec is left only if the browser's
    // decoder fails.
    bool observe(const client::ParticipantFigures& figures, TimePoint now);
    // The person has chosen this codec; "auto": the choice by measurements again, to which a codec
    // that this page cannot decode leads, too.
    void choose(const std::string& codec);

    // For the panels: "color" and one fact more.
    void add_to(nlohmann::json& state) const;

private:
    bool can_h264_;
    client::ColorPreference preference_;
    std::string chosen_, reason_;  // empty: as preference_ says
    client::DecoderFailures failures_;
};

}  // namespace theatron::web
