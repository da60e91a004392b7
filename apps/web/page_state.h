// SPDX-License-Identifier: Apache-2.0
// The content of the page's panels, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "client/participant.h"
#include "viewer/viewer.h"

namespace theatron::web {

// `facts` are the viewer's; `address` is shown until the host's name is known.
nlohmann::json page_state(const viewer::Viewer& viewer, const viewer::Facts& facts,
                          const client::Participant& participant, const std::string& address);

// The same without what depends on a view of the room: "pictures" and "ear".
nlohmann::json state_of(const viewer::Facts& facts, const client::Participant& participant,
                        const std::string& address);

}  // namespace theatron::web
