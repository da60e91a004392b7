// SPDX-License-Identifier: Apache-2.0
#include "viewer/slice_texts.h"

#include <cstdio>
#include <utility>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

constexpr Phrase orientation_names[] = {Phrase::slice_axial, Phrase::slice_coronal,
                                        Phrase::slice_sagittal};

std::string number(const char* format, double value) {
    char text[60];
    std::snprintf(text, sizeof(text), format, value);
    return decimal(text);
}

}  // namespace

SliceTexts slice_texts(const medical::SlicePlane& plane, const session::CaseScreen& shown,
                       std::string case_name, std::string series) {
    return {medical::edge_letters(plane),
            std::move(case_name),
            std::move(series),
            say(Phrase::slice_place, say(orientation_names[shown.orientation]),
                number("%.1f", shown.position_mm)),
            say(Phrase::slice_window, number("%.0f", shown.center), number("%.0f", shown.width)),
            say(Phrase::slice_notice)};
}

}  // namespace theatron::viewer
