// SPDX-License-Identifier: Apache-2.0
// Pictures of a case, without a session: a slice with the outlines of the parts that it cuts, and
// the parts from the front. Pure functions.
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

// All parts that can be seen, from the front and a little from above, without perspective. Parts
// with an opacity below 1 are drawn over the others.
ColorImage picture_of_parts(const LoadedCase& loaded, Size size);

}  // namespace theatron::cases
