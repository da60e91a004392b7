// SPDX-License-Identifier: Apache-2.0
// The panel that tells of each camera how far its picture can be trusted: its age, what was lost on
// the way, and what filters and codecs did to it. Pure.
#pragma once

#include <functional>
#include <string>

#include "client/participant_figures.h"
#include "window/overlay_content.h"

namespace theatron::viewer {

// "lossless" where depth is what the sensor gave; "lossless after filters"; "lossless in the region
// of interest only"; "lossy"; empty before the first picture.
std::string exactness_text(const client::CameraFigures& camera);

// `filter_name` as in overlay_of().
window::Panel trust_panel(const client::ParticipantFigures& figures,
                          const std::function<std::string(const std::string&)>& filter_name);

// "Camera left is NOT LIVE: 12 s old", of the cameras that sent pictures and no longer do; empty:
// all are live.
std::string not_live_text(const client::ParticipantFigures& figures);

}  // namespace theatron::viewer
