// SPDX-License-Identifier: Apache-2.0
// A picture of a measured latency.
#pragma once

#include <string>

#include "photon/latency.h"

namespace theatron::photon {

// SVG: on the left each change with its latency, over the film's time; on the right how many have
// which latency; the mean with its interval through both. `latency` has no problem; `title` is
// plain text. The picture has its own background, for light and dark pages.
std::string latency_svg(const FilmLatency& latency, const std::string& title);

}  // namespace theatron::photon
