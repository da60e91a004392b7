// SPDX-License-Identifier: Apache-2.0
// The region of interest of a camera as text, on the command line and on the
// host's standard input: "0=120:80:200:160" is a box (x, y, width, height) in the
// depth image of the first camera, "table=10:10:200:20:90:150" a polygon (x, y of
// each corner) of the camera named table, in pixels as they are sent.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codec/strata_region.h"

namespace theatron::app {

// A box from four numbers or a polygon from six or more; throws Error otherwise.
codec::strata::Polygon parse_polygon(std::string_view numbers);

struct RegionText {
    std::string camera;  // its number or name
    codec::strata::Polygon polygon;
};
// "CAMERA=NUMBERS"; throws Error with one sentence if it is not.
RegionText parse_region(const std::string& text);

}  // namespace theatron::app
