// SPDX-License-Identifier: Apache-2.0
#include "bench_grabs.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"

namespace theatron::bench {
namespace {

using client::Participant;
namespace request = session::request;

constexpr Duration patience = std::chrono::seconds(10), lost_after = std::chrono::seconds(1);
// Moves for each grab or release: a host answers 40 requests a second.
constexpr std::uint32_t moves_per_grab = 6;
constexpr double step_m = 1.0 / 1024, range_m = 8;

Pose place_of(std::uint32_t number) {
    return {{}, {std::fmod(number * step_m, range_m), 1, 0}};
}

template <class Condition>
void wait_until(Condition condition) {
    for (const TimePoint end = steady_now() + patience; !condition();) {
        if (steady_now() > end)
            throw Error("The objects of the room did not come to both participants.");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

nlohmann::json percentiles(const std::vector<double>& values) {
    if (values.empty())
        return {{"count", 0}};
    return {{"p50", percentile(values, 0.5)},
            {"p95", percentile(values, 0.95)},
            {"p99", percentile(values, 0.99)},
            {"max", percentile(values, 1)},
            {"count", values.size()}};
}

}  // namespace

void Grabs::prepare_actor(Participant::Options& options) {
    options.keeps_room = true;
    options.room_changed = [this] { on_actor(); };
}

void Grabs::prepare_partner(Participant::Options& options) {
    options.keeps_room = true;
    options.room_changed = [this] { on_partner(); };
}

session::ObjectId Grabs::create(Participant& owner, std::uint8_t color) {
    wait_until([&] { return !owner.room().objects.empty(); });
    // A brick of 2 x 2 studs (docs/formats/room.md).
    const Bytes properties{std::byte{2}, std::byte{2}, std::byte{color}};
    owner.ask_room(request::Create{session::ObjectKind::brick, place_of(0), 1, properties});
    session::ObjectId found{};
    wait_until([&] {
        for (const Participant* one : {actor_, partner_}) {
            found = {};
            for (const auto& [id, object] : one->room().objects)
                if (object.properties == properties)
                    found = id;
            if (found == session::ObjectId{})
                return false;
        }
        return true;
    });
    return found;
}

void Grabs::hold(Participant& owner, session::ObjectId object) {
    owner.ask_room(request::Grab{object});
    wait_until([&] {
        for (const Participant* one : {actor_, partner_})
            if (one->room().objects.at(object).grip.holder != owner.room_self())
                return false;
        return true;
    });
}

void Grabs::begin(Participant& actor, Participant& partner) {
    actor_ = &actor;
    partner_ = &partner;
    moved_ = create(actor, 1);
    answer_ = create(partner, 2);
    grabbed_ = create(actor, 3);
    hold(actor, moved_);
    hold(partner, answer_);
    running_ = true;
}

void Grabs::act() {
    const TimePoint now = steady_now();
    std::unique_lock lock(mutex_);
    if (waiting_ != Waiting::nothing && now - acted_ < lost_after)
        return;
    lost_ += waiting_ != Waiting::nothing;
    ++number_;
    acted_ = now;
    if (number_ % moves_per_grab != 0) {
        waiting_ = Waiting::move;
        const Pose place = place_of(number_);
        lock.unlock();
        (void)actor_->move_object(moved_, place, 1);
        return;
    }
    waiting_ = Waiting::grab;
    if (grip_ == 0) {
        grip_ = actor_->ask_room(request::Grab{grabbed_});
    } else {
        actor_->ask_room(request::Release{grabbed_, grip_, place_of(0), 1});
        grip_ = 0;
    }
}

// The effect of the action has come.
void Grabs::finish(std::vector<double>& times) {
    times.push_back(to_ms(steady_now() - acted_));
    waiting_ = Waiting::nothing;
}

void Grabs::on_partner() {
    if (!running_)
        return;
    const auto room = partner_->room();
    std::unique_lock lock(mutex_);
    const bool is_held = room.objects.at(grabbed_).grip.holder != ParticipantId{};
    if (waiting_ == Waiting::grab && is_held == (grip_ != 0))
        return finish(grab_ms_);
    const Pose place = place_of(number_);
    if (waiting_ != Waiting::move || room.objects.at(moved_).room_from_object != place)
        return;
    finish(move_ms_);
    waiting_ = Waiting::answer;
    lock.unlock();
    (void)partner_->move_object(answer_, place, 1);
}

void Grabs::on_actor() {
    if (!running_)
        return;
    const auto room = actor_->room();
    const std::lock_guard lock(mutex_);
    if (waiting_ == Waiting::answer &&
        room.objects.at(answer_).room_from_object == place_of(number_))
        finish(back_ms_);
}

void Grabs::reset() {
    const std::lock_guard lock(mutex_);
    for (auto* times : {&move_ms_, &back_ms_, &grab_ms_})
        times->clear();
    lost_ = 0;
}

nlohmann::json Grabs::result() const {
    const std::lock_guard lock(mutex_);
    return {{"move_ms", percentiles(move_ms_)},
            {"there_and_back_ms", percentiles(back_ms_)},
            {"grab_ms", percentiles(grab_ms_)},
            {"lost", lost_}};
}

}  // namespace theatron::bench
