// SPDX-License-Identifier: Apache-2.0
// The frame that Python sees.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "image/image.h"
#include "taken_frame.h"

namespace theatron::python {

struct FrameObject {
    TakenFrame taken;
    // The pixels of a JPEG picture once somebody has asked for them; null: it is damaged.
    bool is_decoded = false;
    std::shared_ptr<ColorImage> decoded;
};

// A datetime in UTC; None for the epoch, which stands for an unknown time. Needs Python's lock.
pybind11::object time_of_day(UtcTime time);

}  // namespace theatron::python
