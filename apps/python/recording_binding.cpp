// SPDX-License-Identifier: Apache-2.0
// Recording: a file that `theatron record` made, with its cameras and its room.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "capture/recorded_room.h"
#include "export/room_of_recording.h"
#include "export/verify_recording.h"
#include "frames_iterator.h"
#include "record/remarks.h"
#include "shown_text.h"

namespace theatron::python {
namespace {

// From several threads of Python.
class Recording {
public:
    explicit Recording(const std::filesystem::path& file)
        : file_(file.string()), recording_(record::RecordingFile::open(file)) {}

    const std::string& file() const { return file_; }
    const record::RecordingFile& content() const { return *recording_; }
    std::shared_ptr<const record::RecordingFile> shared() const { return recording_; }

    // The room at this time as a JSON line, or after a line's time the next one that differs.
    std::string room_at(Duration time) {
        const std::lock_guard lock(mutex_);
        if (!room_)
            room_.emplace(recording_);
        room_->go_to(time);
        return exporting::room_line(*room_, time);
    }

private:
    const std::string file_;
    const std::shared_ptr<const record::RecordingFile> recording_;
    std::mutex mutex_;  // never taken with Python's lock; guards the room
    std::optional<capture::RecordedRoom> room_;
};

// One entry of Recording.cameras.
struct RecordedCameraInfo {
    int number = 0;
    std::string name;
    double fps = 0;
    std::size_t frames = 0;
    std::string depth_codec;
    std::optional<std::string> color_codec;
    Calibration calibration;  // the first one
};

py::object from_json(const std::string& text) {
    return py::module_::import("json").attr("loads")(py::bytes(text));
}

// The moments at which the room changed.
class RoomIterator {
public:
    explicit RoomIterator(std::shared_ptr<const record::RecordingFile> recording)
        : room_(std::move(recording)) {}

    py::object next() {
        std::string line;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            while (line.empty()) {
                const auto time = room_.next();
                if (!time)
                    break;
                if (room_.go_to(*time))
                    line = exporting::room_line(room_, *time);
            }
        }
        if (line.empty())
            throw py::stop_iteration();
        return from_json(line);
    }

private:
    std::mutex mutex_;  // never taken with Python's lock
    capture::RecordedRoom room_;
};

std::vector<RecordedCameraInfo> cameras_of(const Recording& self) {
    std::vector<RecordedCameraInfo> cameras;
    for (const record::CameraContent& camera : self.content().cameras()) {
        const auto calibration = decode_calibration(camera.calibration);
        cameras.push_back({int(cameras.size()), camera.name, camera.frames_per_second,
                           camera.depth.frames.size(), camera.depth.codec,
                           camera.color.present ? std::optional(camera.color.codec) : std::nullopt,
                           calibration ? *calibration : Calibration{}});
    }
    return cameras;
}

// The sentences of `theatron inspect`.
py::list remarks_of(const Recording& self) {
    py::list remarks;
    for (const record::Segment& segment : self.content().segments())
        for (const std::string& remark : record::remarks_on(segment))
            remarks.append(shown_text(remark));
    for (const std::string& remark : record::remarks_on_files(self.content()))
        remarks.append(shown_text(remark));
    return remarks;
}

std::unique_ptr<FramesIterator> frames_of(const Recording& self, int camera, double start,
                                          std::optional<double> stop) {
    if (camera < 0)
        throw py::value_error("Cameras count from 0, so there is no camera " +
                              std::to_string(camera) + ".");
    std::unique_ptr<FrameReader> reader;
    {
        const py::gil_scoped_release released;
        reader = read_recording(self.shared(), std::size_t(camera), self.file());
    }
    return std::make_unique<FramesIterator>(std::move(reader), start, stop);
}

py::object room_of(Recording& self, double seconds) {
    if (!self.content().room().present)
        return py::none();
    if (!(seconds >= 0 && seconds <= 1e9))
        throw py::value_error("seconds is a time in seconds, 0 or more.");
    std::string line;
    {
        const py::gil_scoped_release released;
        line = self.room_at(seconds_to_duration(seconds));
    }
    return from_json(line);
}

py::dict dict_of(const exporting::VerifiedPictures& p) {
    py::dict dict;
    dict["pictures"] = p.pictures;
    dict["damaged"] = p.damaged;
    dict["undecodable"] = p.undecodable;
    dict["missing"] = p.missing;
    dict["gaps"] = p.gaps;
    return dict;
}

py::dict verified(const Recording& self) {
    exporting::Verification found;
    {
        const py::gil_scoped_release released;
        found = exporting::verify(self.shared(), self.file(), [](std::string_view, double) {
            const py::gil_scoped_acquire acquired;
            if (PyErr_CheckSignals() != 0)
                throw py::error_already_set();
        });
    }
    py::list cameras;
    for (const auto& minutes : found.cameras) {
        py::list list;
        for (const auto& [minute, pictures] : minutes) {
            py::dict one;
            one["minute"] = minute;
            one["depth"] = dict_of(pictures.depth);
            one["color"] = dict_of(pictures.color);
            list.append(one);
        }
        cameras.append(list);
    }
    py::dict dict;
    dict["damaged"] = found.damaged;
    dict["cameras"] = cameras;
    return dict;
}

void bind_camera_info(py::module_& module) {
    using Info = RecordedCameraInfo;
    py::class_<Info>(module, "RecordedCamera", "A camera of a recording.")
        .def_readonly("number", &Info::number)
        .def_property_readonly("name", [](const Info& c) { return shown_text(c.name); })
        .def_readonly("fps", &Info::fps)
        .def_readonly("frames", &Info::frames)
        .def_property_readonly("depth_codec",
                               [](const Info& c) { return shown_text(c.depth_codec); })
        .def_property_readonly("color_codec",
                               [](const Info& c) {
                                   return c.color_codec ? std::optional(shown_text(*c.color_codec))
                                                        : std::nullopt;
                               })
        .def_readonly("calibration", &Info::calibration)
        .def("__repr__", [](const Info& c) {
            return shown_text("RecordedCamera(number=" + std::to_string(c.number) + ", name='" +
                              c.name + "', frames=" + std::to_string(c.frames) + ")");
        });
}

}  // namespace

void bind_recording(py::module_& module) {
    bind_camera_info(module);
    py::class_<RoomIterator>(module, "RoomChanges", "An iterator of the room's moments.")
        .def("__iter__", [](py::object self) { return self; })
        .def("__next__", &RoomIterator::next);
    py::class_<Recording, std::shared_ptr<Recording>>(
        module, "Recording", "A recording with all its segments; name the first of its files.")
        .def(py::init([](const std::filesystem::path& file) {
                 const py::gil_scoped_release released;
                 return std::make_shared<Recording>(file);
             }),
             py::arg("file"))
        .def_property_readonly("file",
                               [](const Recording& self) { return shown_text(self.file()); })
        .def_property_readonly("cameras", &cameras_of)
        .def_property_readonly(
            "seconds", [](const Recording& self) { return to_seconds(self.content().duration()); })
        .def_property_readonly("begin",
                               [](const Recording& self) {
                                   return time_of_day(self.content().segments().front().begin_utc);
                               })
        .def_property_readonly("complete",
                               [](const Recording& self) { return self.content().complete(); })
        .def_property_readonly("remarks", &remarks_of,
                               "What `theatron inspect` says of damage and missing parts.")
        .def("frames", &frames_of, py::arg("camera") = 0, py::kw_only(), py::arg("start") = 0.0,
             py::arg("stop") = py::none(), "The frames of a camera, from `start` to before `stop`.")
        .def("room", &room_of, py::arg("seconds"),
             "The room at this time: people, objects and poses; None if it was not recorded.")
        .def(
            "room_changes",
            [](const Recording& self) { return std::make_unique<RoomIterator>(self.shared()); },
            "The room at each moment at which it changed, as `theatron export --room` writes it.")
        .def("verify", &verified, "Decodes every picture, as `theatron inspect --verify` does.")
        .def("__repr__",
             [](const Recording& self) { return shown_text("Recording('" + self.file() + "')"); });
}

}  // namespace theatron::python
