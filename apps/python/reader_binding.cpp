// SPDX-License-Identifier: Apache-2.0
// Frames, Losses, and the functions that open folders and cameras.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <charconv>

#include "base/error.h"
#include "base/options.h"
#include "bindings.h"
#include "capture/camera.h"
#include "frames_iterator.h"
#include "shown_text.h"

namespace theatron::python {
namespace {

namespace py = pybind11;

// These are read by a child process of the program `theatron`, which Python is not.
constexpr const char* kinds_of_the_program[] = {"mkv", "video", "x11", "v4l2", "rtsp"};

std::unique_ptr<FramesIterator> open_folder(const std::filesystem::path& folder, double fps,
                                            int invalid, double start, std::optional<double> stop) {
    // Without std::to_string, whose six digits turn 29.97003 into another rate.
    char rate[32] = {};
    std::to_chars(rate, rate + sizeof rate - 1, fps);
    const std::string text = "folder:" + std::filesystem::absolute(folder).string() +
                             ",fps=" + rate + ",invalid=" + std::to_string(invalid);
    std::unique_ptr<FrameReader> reader;
    {
        const py::gil_scoped_release released;
        reader = read_folder(Options::parse(text));
    }
    return std::make_unique<FramesIterator>(std::move(reader), start, stop);
}

std::unique_ptr<FramesIterator> open_camera(const std::string& specification, bool every) {
    const std::string kind = Options::parse(specification).kind();
    for (const char* other : kinds_of_the_program)
        if (kind == other)
            throw Error("The camera '" + kind +
                        "' can be opened by the program only: record it with "
                        "'theatron record', and open the recording.");
    std::unique_ptr<FrameReader> reader;
    {
        const py::gil_scoped_release released;
        reader = read_camera(capture::open_camera(specification), every);
    }
    return std::make_unique<FramesIterator>(std::move(reader), 0, std::nullopt);
}

std::string losses_text(const capture::PictureLosses& l) {
    return "Losses(damaged_depth=" + std::to_string(l.damaged_depth) +
           ", undecodable_depth=" + std::to_string(l.undecodable_depth) +
           ", damaged_color=" + std::to_string(l.damaged_color) +
           ", undecodable_color=" + std::to_string(l.undecodable_color) + ")";
}

}  // namespace

void bind_readers(py::module_& module) {
    using Losses = capture::PictureLosses;
    py::class_<Losses>(module, "Losses", "Counts of pictures that were left out.")
        .def_readonly("damaged_depth", &Losses::damaged_depth)
        .def_readonly("undecodable_depth", &Losses::undecodable_depth)
        .def_readonly("damaged_color", &Losses::damaged_color)
        .def_readonly("undecodable_color", &Losses::undecodable_color)
        .def("__bool__", [](const Losses& l) { return l.depth() + l.color() > 0; })
        .def("__repr__", &losses_text);

    py::class_<FramesIterator>(module, "Frames", "An iterator of frames, in order.")
        .def("__iter__", [](py::object self) { return self; })
        .def("__next__", &FramesIterator::next)
        .def("seek", &FramesIterator::seek, py::arg("seconds"),
             "The next frame is the first one that is not before this time.")
        .def_property_readonly("losses", &FramesIterator::losses,
                               "Pictures that were left out, as `theatron inspect --verify` counts "
                               "them.")
        .def_property_readonly(
            "problem_at_end",
            [](const FramesIterator& self) { return shown_text(self.problem_at_end()); },
            "What is missing at the end, one sentence; empty: nothing.")
        .def("close", &FramesIterator::close, "Closes the file or the camera.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](FramesIterator& self, const py::args&) { self.close(); });

    module.def("open_folder", &open_folder, py::arg("folder"), py::kw_only(), py::arg("fps") = 30.0,
               py::arg("invalid") = 0, py::arg("start") = 0.0, py::arg("stop") = py::none(),
               "The frames of a folder of pictures, as fast as they can be read.");
    module.def(
        "open_camera", &open_camera, py::arg("specification"), py::kw_only(),
        py::arg("every") = false,
        "The frames of a camera, such as 'synthetic:surgeon' or 'k4a:0', when they are due.");
    module.def("camera_kinds", &capture::camera_kinds,
               "The kinds of camera with their options, one line each.");
}

}  // namespace theatron::python
