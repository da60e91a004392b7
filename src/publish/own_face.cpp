// SPDX-License-Identifier: Apache-2.0
#include "publish/own_face.h"

#include <chrono>
#include <utility>
#include <vector>

namespace theatron::publish {

OwnFace::OwnFace(std::string device) : device_(std::move(device)) {}

OwnFace::~OwnFace() {
    end();
    close();
}

std::shared_ptr<CameraPublisher> OwnFace::publisher() const {
    const std::lock_guard lock(mutex_);
    return publisher_;
}

client::Participant::Publishing OwnFace::events() {
    client::Participant::Publishing events;
    events.published = [this](const std::vector<CameraId>& numbers) {
        if (const auto current = publisher())
            current->events().published(numbers);
    };
    events.encode = [this](const std::vector<wire::StreamSetting>& settings) {
        if (const auto current = publisher())
            current->events().encode(settings);
    };
    events.encode_key = [this](StreamId stream, SettingId setting) {
        if (const auto current = publisher())
            current->events().encode_key(stream, setting);
    };
    return events;
}

void OwnFace::begin(client::Participant& participant) {
    participant_ = &participant;
    if (const auto current = publisher())
        current->begin(participant);
}

void OwnFace::end() {
    if (const auto current = publisher())
        current->end();
    participant_ = nullptr;
}

void OwnFace::show(bool shown) {
    wanted_ = shown;
    if (!shown)
        return close();
    if (publisher() || opening_.valid())
        return;
    opening_ = std::async(std::launch::async, [device = device_] {
        return std::make_shared<CameraPublisher>(std::vector{"face:" + device}, "",
                                                 capture::Progress(),
                                                 Sharing{false, wire::CameraKind::face});
    });
}

// A camera that is still being opened is closed by on_tick().
void OwnFace::close() {
    std::shared_ptr<CameraPublisher> closing;
    {
        const std::lock_guard lock(mutex_);
        closing.swap(publisher_);
    }
    if (closing)
        closing->end();
}

void OwnFace::on_tick() {
    if (!opening_.valid() ||
        opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    std::shared_ptr<CameraPublisher> opened;
    try {
        opened = opening_.get();
    } catch (const std::exception& error) {
        if (std::exchange(wanted_, false))
            problem_ = std::string("You are not seen: ") + error.what();
        return;
    }
    if (!wanted_)
        return;
    {
        const std::lock_guard lock(mutex_);
        publisher_ = opened;
    }
    if (participant_)
        opened->begin(*participant_);
}

OwnFace::State OwnFace::state() const {
    if (!wanted_)
        return State::off;
    const auto current = publisher();
    if (!current)
        return State::opening;
    return current->figures().front().number ? State::seen : State::offered;
}

std::string OwnFace::take_problem() {
    return std::exchange(problem_, {});
}

const char* text_of(OwnFace::State state) {
    switch (state) {
        case OwnFace::State::off:
            return "off";
        case OwnFace::State::opening:
            return "opening";
        case OwnFace::State::offered:
            return "offered";
        case OwnFace::State::seen:
            return "seen";
    }
    return "unknown";
}

}  // namespace theatron::publish
