// SPDX-License-Identifier: Apache-2.0
// Sentences for people on what is damaged, missing or foreign in a recording, each with its cause.
// They begin with a small letter and have no full stop.
#pragma once

#include <string>
#include <vector>

#include "record/recording_file.h"

namespace theatron::record {

// For example "it was not closed: 2.5 s may be missing"; empty if it was closed.
std::string end_of(const Segment& segment);
// For example "it stopped early: the disk was full"; empty if writing did not fail.
std::string early_end_of(const Segment& segment);
// For example "it is not complete: the host did not come back"; empty if nothing was noted.
std::string lacks_of(const Segment& segment);
// One line on missing and damaged parts, as far as the index shows them; empty if there are none.
std::string losses_of(const Segment& segment);
// Everything about a segment and its file; empty if both are as they were recorded.
std::vector<std::string> remarks_on(const Segment& segment);
// Everything about the files of a recording, without what is in its segments.
std::vector<std::string> remarks_on_files(const RecordingFile& recording);

}  // namespace theatron::record
