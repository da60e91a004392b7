// SPDX-License-Identifier: Apache-2.0
// The parts of `theatron face`.
#pragma once

#include <string>
#include <vector>

#include "visit/face_files.h"

namespace theatron::app {

struct FaceTrain {
    std::string source = "xr_fb", out;
    std::vector<std::string> own;  // recordings
    unsigned long long seed = 1;
    bool overwrite = false, json = false;
};
void run_face_train(const FaceTrain& wanted);

struct FaceTest {
    std::string model;
    std::vector<std::string> recordings;
    bool json = false;
};
void run_face_test(const FaceTest& wanted);

struct FaceListen {
    visit::FacePort at;
    std::string model;
    double seconds = 0;  // 0: until Ctrl-C
    bool json = false;
};
void run_face_listen(const FaceListen& wanted);

struct FaceRecord {
    visit::FacePort at;
    std::string source = "unified", out;
    int rounds = 3;
    double take_s = 4;
    bool overwrite = false;
};
void run_face_record(const FaceRecord& wanted);

struct FaceAct {
    visit::FacePort to;
    std::string source = "xr_fb";
    double seconds = 0, rate_hz = 60;
};
void run_face_act(const FaceAct& wanted);

}  // namespace theatron::app
