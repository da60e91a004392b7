// SPDX-License-Identifier: Apache-2.0
// The parts of the comparison's page, as HTML. Methods that could not be measured are in none of
// them; compare_page.cpp says of them why.
#pragma once

#include <string>

#include "compare.h"

namespace theatron::bench {

// From <!doctype> to <body>.
const char* compare_page_head();
// The dialog that shows a picture large, with its script; </body> and </html>.
const char* compare_page_end();

// A heading and a row of pictures for the close-up and for each place of the expert: the exact
// picture and that of each method that has one.
std::string compare_pictures(const Compared& compared);

// Costs and figures of each method; empty if none was measured.
std::string compare_table(const Compared& compared);

// The text with spaces that do not break between a figure and its unit.
std::string kept_together(const std::string& text);
// Where bytes of the research system stand: that its depth is sent without loss here.
const char* paper_caveat();
// "15.5".
std::string tenths_text(double value);
// "19".
std::string whole_text(double value);
// "20 cm": across the region close to the wound.
std::string near_wound_text(const Compared& compared);
// "Of the 20 cm around the wound 64.0 % are shown rightly, ... 3.2 mm a pixel."
std::string shares_text(const Compared& compared, const CompareShares& near);
// "a line of 20 Mbit/s".
std::string line_text(const CompareLink& link);

}  // namespace theatron::bench
