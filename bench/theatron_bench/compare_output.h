// SPDX-License-Identifier: Apache-2.0
// The comparison for people at a terminal and for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare.h"

namespace theatron::bench {

// A table, with what ran and each reason below it. Lines end with \n.
std::string compare_text(const Compared& compared);

// {here:{processor,cores,cores_of_others,gl_renderer}, cameras, frames, pictures_per_s, depth,
// color and picture: {width,height}, places:[],
// near_wound_m, close_up_width_m,
// methods:[{id,name,plain,ran,reason,cameras,mbit_of_all,mbit_per_camera,sender_ms,receiver_ms,
// sender_of_all_ms,receiver_of_all_ms,drawing_ms,drawn_on,
// wound:{near and whole:{rightly_percent,wrongly_percent,hidden_percent,finely_percent,detail_mm},
// lost:{no_camera_percent,sensor_percent,filters_percent,drawing_percent}},
// links:[{mbit,latency_ms,pictures_per_s,delay_ms:{mean,p95}}], own_view:{psnr_db,ssim},
// expert and close_up:{psnr_db,ssim,holes_percent,undrawn_percent,undrawn_unseen_percent,
// see_through_percent},expert_reason}]}. Null stands for what is not there: figures of a method
// that could not be measured, own_view, expert, close_up, wound, drawing, reasons.
nlohmann::json compare_json(const Compared& compared);

// The input and the machine, one sentence each.
std::vector<std::string> compare_remarks(const Compared& compared);

// Sentences on what no figure of the comparison says, for people who decide.
std::vector<std::string> compare_limits();

// Sentences on single figures and methods, for people who check.
std::vector<std::string> compare_notes();

// "20 Mbit/s, 20 ms".
std::string link_text(const CompareLink& link);

}  // namespace theatron::bench
