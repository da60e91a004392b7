// SPDX-License-Identifier: Apache-2.0
// The age of a drawn picture, stage by stage: from the points in time that its frame carries.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "image/frame.h"

namespace theatron::photon {

// A stage ends with a point of FrameTimes and begins with the point before it that is known.
inline constexpr int stage_count = 8;

struct Stage {
    std::string id;    // the point at which it ends, as FrameTimes names it
    std::string name;  // for people
    double mean_ms = 0;
};

class StageSum {
public:
    // Counts pictures whose capture and presentation are known. A point in between that is not
    // known has no stage: its time is in that of the next point.
    void add(const FrameTimes& times);

    int pictures() const { return pictures_; }
    // In the order of time, without stages that no picture had. The means add up to the mean age:
    // a stage that a picture lacks counts as none. Empty without pictures.
    std::vector<Stage> means() const;

private:
    int pictures_ = 0;
    std::array<int, stage_count> counted_{};
    std::array<double, stage_count> sum_ms_{};
};

// A bar of the stages one after the other, with a line of each below it, as SVG with its own
// background. `title` is plain text. There is at least one stage.
std::string stages_svg(const std::vector<Stage>& stages, const std::string& title);

}  // namespace theatron::photon
