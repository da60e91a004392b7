// SPDX-License-Identifier: Apache-2.0
// Pictures of a case, without a session: a slice with the outlines of the parts that it cuts, and
// the parts from a side. Pure functions.
#pragma once

#include "cases/case_folder.h"
#include "image/image.h"
#include "medical/slice.h"
#include "medical/window.h"

namespace theatron::cases {

// The slice in greys, the parts' outlines in their colours, the letters of the patient's directions
// at the edges and a scale bar. `series` is a number of one of the case's series.
ColorImage picture_of_slice(const LoadedCase& loaded, std::size_t series,
                            const medical::SlicePlane& plane, medical::Window window);

// The side of the patient from which parts are seen; `corner` is the front, turned a little to the
// patient's left and tilted a little. Up is the head; the front in pictures from above and below.
enum class PartsView : std::uint8_t { corner, front, back, left, right, above, below };

// All parts whose opacity is above 0, without perspective. Parts with an opacity below 1 are drawn
// over the others.
ColorImage picture_of_parts(const LoadedCase& loaded, Size size,
                            PartsView view = PartsView::corner);

}  // namespace theatron::cases
