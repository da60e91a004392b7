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
    c.methods = {call, pcl, ours};
    return c;
}

}  // namespace theatron::bench
