// SPDX-License-Identifier: Apache-2.0
// The picture of a participant's own face: switched on and off while the participant is in the
// session. The camera is open only while it is on.
//
//     publish::OwnFace face("/dev/video0");
//     client::Participant::Options options{...};
//     options.face = face.events();
//     client::Participant participant(options);
//     face.begin(participant);
//     face.show(true);
#pragma once

#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "publish/camera_publisher.h"

namespace theatron::publish {

// All functions but those in events() from one thread.
class OwnFace {
public:
    // `device` as in capture::face_camera_help, without its kind. Nothing is opened.
    explicit OwnFace(std::string device);
    ~OwnFace();
    OwnFace(const OwnFace&) = delete;
    OwnFace& operator=(const OwnFace&) = delete;

    // For Options::face of the participant; valid as long as this.
    client::Participant::Publishing events();
    // `participant` must exist until end() returns.
    void begin(client::Participant& participant);
    void end();

    // Opens the camera in the background, or closes it.
    void show(bool shown);
    bool is_wanted() const { return wanted_; }
    // Several times a second: sends the camera that was opened.
    void on_tick();

    enum class State {
        off,
        opening,
        offered,  // the host has not taken it (yet)
        seen,     // the others get it
    };
    State state() const;
    // Why it went off by itself since the last call: one sentence; empty: it did not.
    std::string take_problem();

private:
    std::shared_ptr<CameraPublisher> publisher() const;
    void close();

    const std::string device_;
    bool wanted_ = false;
    std::string problem_;
    client::Participant* participant_ = nullptr;
    std::future<std::shared_ptr<CameraPublisher>> opening_;

    mutable std::mutex mutex_;  // guards the rest
    std::shared_ptr<CameraPublisher> publisher_;
};

const char* text_of(OwnFace::State state);

// Calls begin(), and end() when it is destroyed.
class FaceShowing {
public:
    FaceShowing(OwnFace& face, client::Participant& participant) : face_(face) {
        face_.begin(participant);
    }
    ~FaceShowing() { face_.end(); }
    FaceShowing(const FaceShowing&) = delete;
    FaceShowing& operator=(const FaceShowing&) = delete;

private:
    OwnFace& face_;
};

}  // namespace theatron::publish
