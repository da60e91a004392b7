// SPDX-License-Identifier: Apache-2.0
// A comparison for tests. Nothing in it has been measured.
#pragma once

#include "compare.h"

namespace theatron::bench {

// Two places; a video call, PCL's codec, which has a reason in place of figures, and Theatron.
inline Compared given_comparison() {
    const CompareLink slow{20, 20};
    Compared c;
    c.processor = "Some <Processor>";
    c.cores = 2;
    c.gl_renderer = "llvmpipe";
    c.cameras = 2;
    c.frames = 30;
    c.depth = {640, 576};
    c.color = {1280, 720};
    c.picture = {16, 8};
    c.links = {slow};
    c.places = {"at the foot of the table", "a step to the left"};
    c.truth = {ColorImage({16, 8}), ColorImage({16, 8})};
    c.close_up_truth = ColorImage({16, 8});
    c.close_up_width_m = 0.5;
    c.near_wound_m = 0.2;
    c.near_wound = Image<std::uint8_t>({16, 8});
    const CompareSights sights{Image<Seen>({16, 8}), Image<float>({16, 8})};
    CompareMethod call{.id = video_call_id, .name = "Video call", .ran = "one camera"};
    call.is_video = true;
    call.plain = "One picture";
    call.cameras = 1;
    call.mbit_per_camera = 2.04;
    call.rate_setting_mbit = 2.5;
    call.sender_ms = 9.34;
    call.receiver_ms = 2.15;
    call.links = {{slow, 30, 34.8, 37.1}};
    call.own_view = CompareOwnView{31.1, 0.961};
    call.expert_reason = "It has no other picture.";
    call.pictures = {ColorImage({16, 8})};
    call.close_up = CompareCloseUp{ColorImage({8, 4}), {}, {}, {}};
    call.sights = sights;
    call.wound = {{40, 0, 60, 0, 3.2}, {50, 0, 50, 0, 3.3}, {}};
    call.sender_of_all_ms = 9.34;
    call.drawing_ms = 1.25;
    call.drawn_on = "llvmpipe";
    CompareMethod pcl{.id = pcl_id, .name = "A point cloud codec", .plain = "Points", .ran = "PCL"};
    pcl.reason = "This build has no PCL.";
    CompareMethod ours{.id = theatron_id, .name = "Theatron", .plain = "Ours", .ran = "strata"};
    ours.cameras = 2;
    ours.mbit_per_camera = 15.48;
    ours.sender_ms = 6.2;
    ours.receiver_ms = 3;
    ours.links = {{slow, 19, 99.2, 128.2}};
    ours.expert = CompareLikeness{20.91, 0.7725, 3.26, 17.43, 15.23, 4.31};
    ours.from_place = {{21.5, 0.78, 2.5, 17, 16, 3}, {19.4, 0.76, 4.5, 18, 17, 4}};
    ours.pictures = {ColorImage({16, 8}), ColorImage({16, 8})};
    ours.close_up = CompareCloseUp{ColorImage({16, 8}), CompareLikeness{22, 0.8, 6.7, 8.9, 1, 2},
                                   CompareCauses{1.5, 0.3, 0.1, 0.1}, CompareCauses{20, 9, 1, 2}};
    ours.sights = sights;
    ours.wound = {{62, 2, 36, 0, 3.4}, {70, 20, 10, 0, 3.5}, CompareCauses{30, 4, 3, 1}};
    ours.sender_of_all_ms = 12.4;
    ours.receiver_of_all_ms = 6.1;
    ours.drawing_ms = 250.5;
    ours.drawn_on = "llvmpipe";
    c.methods = {call, pcl, ours};
    return c;
}

}  // namespace theatron::bench
