// SPDX-License-Identifier: Apache-2.0
// The texts around a slice of a case's images: sides, case, place, greys and their purpose. Pure.
#pragma once

#include <string>

#include "medical/slice.h"
#include "session/case_objects.h"

namespace theatron::viewer {

struct SliceTexts {
    medical::EdgeLetters letters;
    std::string case_name, series;
    std::string plane;   // "axial 110.0 mm"
    std::string window;  // "L 40  W 400"
    std::string notice;  // "Not for diagnosis"
};

// `plane` is that of the picture which is shown: the letters are of its own directions.
SliceTexts slice_texts(const medical::SlicePlane& plane, const session::CaseScreen& shown,
                       std::string case_name, std::string series);

}  // namespace theatron::viewer
