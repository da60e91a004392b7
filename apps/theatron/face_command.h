// SPDX-License-Identifier: Apache-2.0
// The parts of `theatron face`.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "enrol/landmark_finder.h"
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

struct FaceModelImport {
    std::string folder, out;
    bool overwrite = false;
};
void run_face_model_import(const FaceModelImport& wanted);

struct FaceModelShow {
    std::string model, out;  // no model: the generated head
};
void run_face_model_show(const FaceModelShow& wanted);

struct FacePhotos {
    std::string folder, model;
    unsigned long long seed = 1;
    double noise_px = 1;
};
void run_face_photos(const FacePhotos& wanted);

// The window in which photos are taken and marked.
struct FaceWindow {
    bool mark = false;
    std::string language = "en", size = "1280x720", landmark_model = enrol::usual_landmark_model;
};

struct FaceEnrol {
    struct Photo {
        std::string picture, landmarks;
    };
    std::array<Photo, face::emotion_count> photos;
    std::string camera;  // takes the photos, if it is not empty
    FaceWindow window;
    std::string model, out, passphrase_file;
    std::optional<double> eyes_apart_mm;
    double view_degrees = 65;
    bool overwrite = false, json = false;
};
void run_face_enrol(const FaceEnrol& wanted);

struct FaceLandmarks {
    std::string photo, out, emotion = "neutral";
    FaceWindow window;
    bool overwrite = false;
};
void run_face_landmarks(const FaceLandmarks& wanted);

struct FaceShow {
    std::string face, out, passphrase_file;
};
void run_face_show(const FaceShow& wanted);

// A face that is replaced or deleted by a link to it would stay. Throws Error.
void refuse_link_to_face(const std::string& file);

void run_face_delete(const std::string& face);

// Heads, photos and a person's own face.
void add_own_face_commands(CLI::App& face);

}  // namespace theatron::app
