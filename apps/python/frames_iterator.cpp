// SPDX-License-Identifier: Apache-2.0
#include "frames_iterator.h"

#include <cmath>

namespace theatron::python {
namespace {

namespace py = pybind11;

constexpr double longest_seconds = 1e9;

double checked(double seconds, const char* name) {
    if (!(seconds >= 0 && seconds <= longest_seconds))
        throw py::value_error(std::string(name) + " is a time in seconds, 0 or more.");
    return seconds;
}

}  // namespace

FramesIterator::FramesIterator(std::unique_ptr<FrameReader> reader, double start,
                               std::optional<double> stop)
    : reader_(std::move(reader)) {
    if (stop)
        stop_ = checked(*stop, "stop");
    if (checked(start, "start") > 0)
        seek(start);
}

FrameObject FramesIterator::next() {
    FrameObject frame;
    while (true) {
        FrameReader::Answer answer = FrameReader::Answer::end;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            if (reader_)
                answer = reader_->next(frame.taken);
        }
        if (answer == FrameReader::Answer::frame && frame.taken.seconds < stop_)
            return frame;
        if (answer != FrameReader::Answer::nothing)
            throw py::stop_iteration();
        // Ctrl-C, while no frame comes.
        if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
    }
}

void FramesIterator::seek(double seconds) {
    const Duration time = seconds_to_duration(checked(seconds, "seconds"));
    const py::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    if (reader_)
        reader_->seek(time);
}

capture::PictureLosses FramesIterator::losses() const {
    const py::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    return reader_ ? reader_->losses() : losses_;
}

std::string FramesIterator::problem_at_end() const {
    const py::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    return reader_ ? reader_->problem_at_end() : "";
}

void FramesIterator::close() {
    const py::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    if (!reader_)
        return;
    losses_ = reader_->losses();
    reader_.reset();
}

}  // namespace theatron::python
