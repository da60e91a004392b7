// SPDX-License-Identifier: Apache-2.0
// The messages between a browser's page and its decoding workers, as bytes: the first of them is
// the kind. Both sides are the same program of the same build. Damage is refused with a Status.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/status.h"
#include "receive/receiver.h"

namespace theatron::client {

// To a worker: these cameras are its own. `anew`: no earlier decoder is kept.
struct WorkerCameras {
    std::uint64_t generation = 0;
    bool anew = false;
    std::vector<wire::Camera> cameras;

    static void fields(auto& m, auto&& field) {
        field(m.generation);
        field(m.anew);
        field(m.cameras);
    }
};

struct WorkerSettings {
    std::vector<wire::StreamSetting> settings;

    static void fields(auto& m, auto&& field) { field(m.settings); }
};

// One whole media message. WorkerDone returns its number.
struct WorkerMedia {
    std::uint64_t number = 0;
    Duration session_offset{};  // session time less the page's steady clock
    ByteView message;

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.session_offset);
        field(m.message);
    }
};

// Asks for WorkerFigures; with `reset`, of the time from now on; with `forgets_ages`, their ages
// alone are.
struct WorkerFiguresWanted {
    Duration session_offset{};
    bool reset = false, forgets_ages = false;

    static void fields(auto& m, auto&& field) {
        field(m.session_offset);
        field(m.reset);
        field(m.forgets_ages);
    }
};

// From the first of them on, a worker hands on only the next frame of each camera for each of them.
struct WorkerFramesWanted {
    static void fields(auto&, auto&&) {}
};

// From a worker. `generation` is that of its cameras.
struct WorkerFrame {
    std::uint64_t generation = 0;
    CameraId camera{};
    FrameNumber number = 0;
    TimePoint moment;
    FrameTimes times;
    Size depth_size, color_size;  // color_size is empty without colour
    bool same_color = false;      // colour is that of the camera's frame before
    bool past = false;            // as in CameraFrame
    ByteView depth;               // rows of 16 bits per pixel
    ByteView color;               // rows of 3 bytes per pixel; empty with same_color

    static void fields(auto& m, auto&& field) {
        field(m.generation);
        field(m.camera);
        field(m.number);
        field(m.moment);
        for (TimePoint FrameTimes::*point :
             {&FrameTimes::captured, &FrameTimes::delivered, &FrameTimes::filtered,
              &FrameTimes::encoded, &FrameTimes::sent, &FrameTimes::received, &FrameTimes::decoded})
            field(m.times.*point);
        for (auto* size : {&m.depth_size, &m.color_size}) {
            field(size->width);
            field(size->height);
        }
        field(m.same_color);
        field(m.past);
        field(m.depth);
        field(m.color);
    }
};

struct WorkerNeedsKey {
    std::uint64_t generation = 0;
    StreamId stream{};
    SettingId setting{};

    static void fields(auto& m, auto&& field) {
        field(m.generation);
        field(m.stream);
        field(m.setting);
    }
};

struct WorkerDone {
    std::uint64_t number = 0;

    static void fields(auto& m, auto&& field) { field(m.number); }
};

// One sentence.
struct WorkerProblem {
    std::uint64_t generation = 0;
    std::string text;

    static void fields(auto& m, auto&& field) {
        field(m.generation);
        field(m.text);
    }
};

struct WorkerFigures {
    std::uint64_t generation = 0;
    std::vector<receive::StreamFigures> figures;

    static void fields(auto& m, auto&& field) {
        field(m.generation);
        field(m.figures);
    }
};

using ToWorker = std::variant<WorkerCameras, WorkerSettings, WorkerMedia, WorkerFiguresWanted,
                              WorkerFramesWanted>;
using FromWorker =
    std::variant<WorkerFrame, WorkerNeedsKey, WorkerDone, WorkerProblem, WorkerFigures>;

Bytes encode(const ToWorker& message);
Bytes encode(const FromWorker& message);
// The views of a message point into `bytes`.
Result<ToWorker> decode_to_worker(ByteView bytes);
Result<FromWorker> decode_from_worker(ByteView bytes);

}  // namespace theatron::client
