// SPDX-License-Identifier: Apache-2.0
// Frame: the pictures of one camera at one moment.
#include <pybind11/stl.h>

#include <cstring>

#include "arrays.h"
#include "bindings.h"
#include "frame_object.h"
#include "shown_text.h"

namespace theatron::python {
namespace {

py::array depth_of(const FrameObject& self) {
    return array_of(self.taken.frame->depth.view(), self.taken.frame, self.taken.is_own);
}

// Metres; 0 where nothing was measured.
py::array_t<float> depth_m_of(const FrameObject& self) {
    const DepthImage& depth = self.taken.frame->depth;
    py::array_t<float> array({depth.size.height, depth.size.width});
    float* const out = array.mutable_data();
    const py::gil_scoped_release released;
    const Calibration& calibration = self.taken.camera->calibration();
    for (std::size_t i = 0; i < depth.pixels.size(); ++i)
        out[i] = float(depth_m(calibration, depth.pixels[i]));
    return array;
}

// Pixels of a JPEG picture are decoded at the first call.
py::object color_of(FrameObject& self) {
    const std::shared_ptr<const Frame>& frame = self.taken.frame;
    if (frame->color.empty())
        return py::none();
    if (!frame->color.is_jpeg())
        return array_of(frame->color.pixels.view(), frame, self.taken.is_own);
    if (!self.is_decoded) {
        std::shared_ptr<ColorImage> image;
        {
            const py::gil_scoped_release released;
            image = self.taken.camera->decode(frame->color.jpeg);
        }
        self.decoded = std::move(image);
        self.is_decoded = true;
    }
    if (!self.decoded)
        return py::none();
    return array_of(std::as_const(*self.decoded).view(), self.decoded, true);
}

py::object jpeg_of(const FrameObject& self) {
    const Bytes& jpeg = self.taken.frame->color.jpeg;
    if (jpeg.empty())
        return py::none();
    return py::bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
}

std::vector<ColoredPoint> points_in(const FrameObject& self, bool in_room) {
    const py::gil_scoped_release released;
    return self.taken.camera->points(*self.taken.frame, in_room);
}

py::array_t<float> places_of(const std::vector<ColoredPoint>& points) {
    py::array_t<float> array({py::ssize_t(points.size()), py::ssize_t(3)});
    float* out = array.mutable_data();
    for (const ColoredPoint& p : points) {
        *out++ = p.x;
        *out++ = p.y;
        *out++ = p.z;
    }
    return array;
}

py::tuple cloud_of(const FrameObject& self, bool in_room) {
    const std::vector<ColoredPoint> points = points_in(self, in_room);
    py::array_t<std::uint8_t> colors({py::ssize_t(points.size()), py::ssize_t(3)});
    std::uint8_t* out = colors.mutable_data();
    for (const ColoredPoint& p : points) {
        *out++ = p.color.r;
        *out++ = p.color.g;
        *out++ = p.color.b;
    }
    return py::make_tuple(places_of(points), colors);
}

std::string frame_text(const FrameObject& self) {
    const Size size = self.taken.frame->depth.size;
    char text[120];
    std::snprintf(text, sizeof(text), "Frame(camera=%d, number=%u, seconds=%.6f, depth=%dx%d%s)",
                  self.taken.camera->number(), unsigned(self.taken.frame->number),
                  self.taken.seconds, size.width, size.height,
                  self.taken.frame->color.empty() ? "" : ", color");
    return text;
}

}  // namespace

py::object time_of_day(UtcTime time) {
    if (time == UtcTime{})
        return py::none();
    const py::module_ datetime = py::module_::import("datetime");
    const py::object epoch =
        datetime.attr("datetime")(1970, 1, 1, 0, 0, 0, 0, datetime.attr("timezone").attr("utc"));
    return epoch + datetime.attr("timedelta")(0, 0, time.time_since_epoch().count());
}

void bind_frames(py::module_& module) {
    py::class_<FrameObject>(module, "Frame", "The pictures of one camera at one moment.")
        .def_property_readonly(
            "depth", &depth_of,
            "uint16 of shape (height, width), in calibration.depth_unit_mm; 0: no "
            "measurement.")
        .def("depth_m", &depth_m_of,
             "float32 of shape (height, width): metres along the camera's axis; 0: no measurement.")
        .def_property_readonly("color", &color_of,
                               "uint8 of shape (height, width, 3), sRGB; None: no colour, or a "
                               "damaged picture.")
        .def_property_readonly("jpeg", &jpeg_of,
                               "The colour picture as the camera gave it, or None.")
        .def(
            "points",
            [](const FrameObject& self, bool in_room) {
                return places_of(points_in(self, in_room));
            },
            py::arg("in_room") = false,
            "float32 of shape (n, 3), metres: a point for each measured pixel, row by row.")
        .def("cloud", &cloud_of, py::arg("in_room") = false,
             "The same points, and their colours: uint8 of shape (n, 3).")
        .def_property_readonly("camera",
                               [](const FrameObject& self) { return self.taken.camera->number(); })
        .def_property_readonly(
            "name", [](const FrameObject& self) { return shown_text(self.taken.camera->name()); })
        .def_property_readonly(
            "calibration", [](const FrameObject& self) { return self.taken.camera->calibration(); })
        .def_property_readonly("number",
                               [](const FrameObject& self) { return self.taken.frame->number; })
        .def_property_readonly("seconds",
                               [](const FrameObject& self) { return self.taken.seconds; })
        .def_property_readonly("moment",
                               [](const FrameObject& self) { return self.taken.moment_us; })
        .def_property_readonly("utc",
                               [](const FrameObject& self) { return time_of_day(self.taken.utc); })
        .def("__repr__", &frame_text);
}

}  // namespace theatron::python
