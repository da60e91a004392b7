// SPDX-License-Identifier: Apache-2.0
// Scenes whose exact depth is known, as an Azure Kinect would measure them, for
// timing filters and for saying what they do to the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "image/image.h"

namespace theatron::bench {

// Both in millimetres, frame by frame at 30 frames a second.
struct FilterClip {
    std::string name;
    Size size;
    std::vector<DepthImage> measured;
    std::vector<Image<float>> exact;  // 0 where there is nothing, or the sensor never measures
};

// A wall, a table and a person who rocks; dark spots leave small holes.
FilterClip rocking_person(int frames);

// The same, standing still.
FilterClip still_room(int frames);

// Boards in front of a wall, each on its way towards the camera or away from it.
struct Board {
    int left, top, right, bottom;  // pixels
    double mm_per_s;               // positive: away
};
std::vector<Board> moving_boards();
FilterClip boards_moving(int frames);

// An upright board that crosses the picture, so many pixels a frame.
struct CrossingBoard {
    double left_at_start, width, pixels_per_frame;
    int top, bottom;
    double board_mm, wall_mm;
    double left(int frame) const { return left_at_start + pixels_per_frame * frame; }
    double right(int frame) const { return left(frame) + width; }
};
CrossingBoard crossing_board(double pixels_per_frame);
FilterClip board_crossing(const CrossingBoard& board, int frames);

// The generated operating room as its sensor measures it; rendered once and kept,
// which takes minutes.
std::vector<DepthImage> operating_room_frames(int frames, const capture::Progress& progress);

// The same with and without the sensor's errors.
FilterClip operating_room_clip(int frames, const capture::Progress& progress);

}  // namespace theatron::bench
