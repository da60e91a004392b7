// SPDX-License-Identifier: Apache-2.0
// The iterator of Python over the frames of a reader.
#pragma once

#include <pybind11/pybind11.h>

#include <limits>
#include <memory>
#include <mutex>

#include "frame_object.h"
#include "frame_reader.h"

namespace theatron::python {

// From several threads of Python; they share its frames.
class FramesIterator {
public:
    // `stop`: frames from this time on are not given, in seconds.
    FramesIterator(std::unique_ptr<FrameReader> reader, double start, std::optional<double> stop);
    // Needs Python's lock.
    ~FramesIterator() { close(); }
    FramesIterator(const FramesIterator&) = delete;
    FramesIterator& operator=(const FramesIterator&) = delete;

    // Needs Python's lock, which is released while it waits and decodes. Throws StopIteration
    // (pybind11::stop_iteration) at the end.
    FrameObject next();
    // Throws ValueError unless `seconds` is 0 or more.
    void seek(double seconds);
    capture::PictureLosses losses() const;
    std::string problem_at_end() const;
    // No frame follows.
    void close();

private:
    mutable std::mutex mutex_;  // never taken with Python's lock; guards the reader
    std::unique_ptr<FrameReader> reader_;
    double stop_ = std::numeric_limits<double>::infinity();
    capture::PictureLosses losses_;  // when it was closed
};

}  // namespace theatron::python
