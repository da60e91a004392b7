// SPDX-License-Identifier: Apache-2.0
// Scenes with known exact depth, as measured by an Azure Kinect, to measure the time and
// accuracy of filters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "image/image.h"

namespace theatron::bench {

// Measured and exact depth in millimetres, at 30 frames a second.
struct FilterClip {
    std::string name;
    Size size;
    std::vector<DepthImage> measured;
    std::vector<Image<float>> exact;  // 0 without surface, or if the sensor never measures there
};

// A wall, a table and a person who rocks; dark spots leave small holes.
FilterClip rocking_person(int frames);

// The same without motion.
FilterClip still_room(int frames);

// Boards in front of a wall, each moving towards the camera or away from it.
struct Board {
    int left, top, right, bottom;  // pixels
    double mm_per_s;               // positive: away
};
std::vector<Board> moving_boards();
FilterClip boards_moving(int frames);

// An upright board that moves across the picture at `pixels_per_frame`.
struct CrossingBoard {
    double left_at_start, width, pixels_per_frame;
    int top, bottom;
    double board_mm, wall_mm;
    double left(int frame) const { return left_at_start + pixels_per_frame * frame; }
    double right(int frame) const { return left(frame) + width; }
};
CrossingBoard crossing_board(double pixels_per_frame);
FilterClip board_crossing(const CrossingBoard& board, int frames);

// The same scene as measured by a stereo or structured-light camera like the first Kinect:
// distances of whole steps of an eighth of a pixel of disparity (2.9 mm at one metre, growing with
// the square of the distance), with a noise of `noise_steps` from pixel to pixel. Holes stay.
FilterClip seen_in_stereo(FilterClip clip, double noise_steps = 0.4);

// The generated operating room as measured by its sensor. Rendered once, which takes minutes,
// and cached.
std::vector<DepthImage> operating_room_frames(int frames, const capture::Progress& progress);

// The same room with measured and exact depth.
FilterClip operating_room_clip(int frames, const capture::Progress& progress);

}  // namespace theatron::bench
