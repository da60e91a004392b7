// SPDX-License-Identifier: Apache-2.0
// The lattice target as a drawing at true scale, to be printed, cut or milled.
#pragma once

#include <string>

#include "registration/lattice_target.h"

namespace theatron::registration {

// SVG in millimetres: cut lines, and a note with the sizes, the side of the front and a check of
// the scale. The drawing shows the front.
std::string svg_drawing(const LatticeTarget& target);

// DXF (R12, millimetres): closed polylines on layer CUT, the note on layer NOTE.
std::string dxf_drawing(const LatticeTarget& target);

}  // namespace theatron::registration
