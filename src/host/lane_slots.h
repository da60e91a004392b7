// SPDX-License-Identifier: Apache-2.0
// The lanes of a host's cameras, by the cameras' numbers. The lane of a camera that was missing
// when the host began comes later.
#pragma once

#include <atomic>
#include <cassert>
#include <deque>
#include <memory>
#include <vector>

#include "send/camera_lane.h"

namespace theatron::host {

// Setting the number of slots and clear(): while no other thread uses it.
class LaneSlots {
public:
    void set_size(std::size_t cameras) { slots_ = std::deque<Slot>(cameras); }
    void clear() { slots_.clear(); }

    // The number of all cameras, also missing ones. From any thread, as all below.
    std::size_t size() const { return slots_.size(); }
    // Null if the camera is missing or there is no such number.
    send::CameraLane* find(std::size_t camera) const {
        return camera < slots_.size() ? slots_[camera].lane.load(std::memory_order_acquire)
                                      : nullptr;
    }
    // Those that are there, by number.
    std::vector<const send::CameraLane*> all() const {
        std::vector<const send::CameraLane*> lanes;
        for (std::size_t camera = 0; camera < size(); ++camera)
            if (const send::CameraLane* lane = find(camera))
                lanes.push_back(lane);
        return lanes;
    }

    // Once for each camera, from one thread at a time.
    void put(std::size_t camera, std::unique_ptr<send::CameraLane> lane) {
        Slot& slot = slots_[camera];
        assert(!slot.owned);
        slot.owned = std::move(lane);
        slot.lane.store(slot.owned.get(), std::memory_order_release);
    }

private:
    struct Slot {
        std::unique_ptr<send::CameraLane> owned;
        std::atomic<send::CameraLane*> lane{nullptr};
    };
    std::deque<Slot> slots_;  // as its elements cannot be moved
};

}  // namespace theatron::host
