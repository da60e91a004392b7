// SPDX-License-Identifier: Apache-2.0
// CameraModel and Calibration.
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "capture/folder_calibration.h"
#include "geometry/calibration.h"
#include "geometry/ray_table.h"

namespace theatron::python {
namespace {

constexpr std::size_t distortion_coefficients = 8;

// In OpenCV's order.
std::array<double, distortion_coefficients> distortion_of(const CameraModel& m) {
    return {m.k[0], m.k[1], m.p1, m.p2, m.k[2], m.k[3], m.k[4], m.k[5]};
}

CameraModel make_model(int width, int height, double fx, double fy, double cx, double cy,
                       const std::vector<double>& distortion, double max_radius) {
    CameraModel model{.size = {width, height}, .fx = fx, .fy = fy, .cx = cx, .cy = cy};
    if (distortion.size() > distortion_coefficients)
        throw py::value_error(
            "distortion has at most 8 coefficients, in OpenCV's order: k1, k2, p1, p2, k3 to k6.");
    std::array<double, distortion_coefficients> d{};
    std::copy(distortion.begin(), distortion.end(), d.begin());
    model.k = {d[0], d[1], d[4], d[5], d[6], d[7]};
    model.p1 = d[2];
    model.p2 = d[3];
    model.max_radius = max_radius;
    return model;
}

py::array_t<double> matrix_of(const CameraModel& m) {
    py::array_t<double> array({3, 3});
    auto k = array.mutable_unchecked<2>();
    const double values[3][3] = {{m.fx, 0, m.cx}, {0, m.fy, m.cy}, {0, 0, 1}};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            k(row, column) = values[row][column];
    return array;
}

// Pixels outside of the lens are not a number.
py::array_t<float> rays_of(const CameraModel& model) {
    Image<Ray> rays;
    {
        const py::gil_scoped_release released;
        rays = make_ray_table(model);
        for (Ray& ray : rays.pixels)
            if (ray.x == no_ray)
                ray = {std::nanf(""), std::nanf("")};
    }
    py::array_t<float> array({model.size.height, model.size.width, 2});
    std::memcpy(array.mutable_data(), rays.pixels.data(), rays.pixels.size() * sizeof(Ray));
    return array;
}

std::optional<CameraModel> model_or_none(const CameraModel& model) {
    return model.size == Size{} ? std::nullopt : std::optional(model);
}

std::string model_text(const CameraModel& m) {
    char text[160];
    std::snprintf(text, sizeof(text), "CameraModel(%dx%d, fx=%g, fy=%g, cx=%g, cy=%g)",
                  m.size.width, m.size.height, m.fx, m.fy, m.cx, m.cy);
    return text;
}

// Throws ValueError if recordings and hosts would refuse it.
Calibration checked(Calibration calibration) {
    const auto read = decode_calibration(encode_calibration(calibration));
    if (!read)
        throw py::value_error("No camera can have this calibration: it is " +
                              std::string(to_text(read.error())) +
                              ". Sizes, focal lengths in pixels and the depth unit must be "
                              "positive, and all numbers finite.");
    return calibration;
}

Calibration make_calibration(const CameraModel& depth, const std::optional<CameraModel>& color,
                             const py::object& color_from_depth, double depth_unit_mm,
                             const py::object& room_from_camera,
                             std::optional<double> depth_offset_mm) {
    Calibration c;
    c.depth = depth;
    c.color = color.value_or(CameraModel{});
    if (!color_from_depth.is_none())
        c.color_from_depth = pose_argument(color_from_depth, "color_from_depth");
    c.depth_unit_mm = depth_unit_mm;
    if (!room_from_camera.is_none()) {
        c.room_from_camera = pose_argument(room_from_camera, "room_from_camera");
        c.registered = true;
    }
    c.depth_offset_mm = depth_offset_mm;
    return checked(c);
}

std::optional<py::tuple> gain_of(const Calibration& c) {
    if (!c.color_gain)
        return std::nullopt;
    return py::make_tuple(c.color_gain->x, c.color_gain->y, c.color_gain->z);
}

}  // namespace

void bind_calibration(py::module_& module) {
    py::class_<CameraModel>(
        module, "CameraModel",
        "A pinhole camera with OpenCV's rational distortion. Pixel coordinates: "
        "the centre of the top left pixel is (0, 0).")
        .def(py::init(&make_model), py::arg("width"), py::arg("height"), py::arg("fx"),
             py::arg("fy"), py::arg("cx"), py::arg("cy"),
             py::arg("distortion") = std::vector<double>{}, py::arg("max_radius") = 0.0)
        .def_property_readonly("width", [](const CameraModel& m) { return m.size.width; })
        .def_property_readonly("height", [](const CameraModel& m) { return m.size.height; })
        .def_readonly("fx", &CameraModel::fx)
        .def_readonly("fy", &CameraModel::fy)
        .def_readonly("cx", &CameraModel::cx)
        .def_readonly("cy", &CameraModel::cy)
        .def_readonly("max_radius", &CameraModel::max_radius)
        .def_property_readonly("distortion",
                               [](const CameraModel& m) {
                                   const auto d = distortion_of(m);
                                   return py::array_t<double>(py::ssize_t(d.size()), d.data());
                               })
        .def_property_readonly("matrix", &matrix_of)
        .def(
            "rays", &rays_of,
            "Directions (x/z, y/z) of all pixels, float32 of shape (height, width, 2); NaN outside "
            "of the lens.")
        .def("__eq__", [](const CameraModel& a, const CameraModel& b) { return a == b; })
        .def("__repr__", &model_text);

    py::class_<Calibration>(module, "Calibration",
                            "The lenses of a camera, the place of its colour camera, and its place "
                            "in the room. Lengths are metres.")
        .def(py::init(&make_calibration), py::arg("depth"), py::arg("color") = py::none(),
             py::arg("color_from_depth") = py::none(), py::arg("depth_unit_mm") = 1.0,
             py::arg("room_from_camera") = py::none(), py::arg("depth_offset_mm") = py::none())
        .def_property_readonly("depth", [](const Calibration& c) { return model_or_none(c.depth); })
        .def_property_readonly("color", [](const Calibration& c) { return model_or_none(c.color); })
        .def_property_readonly("color_from_depth",
                               [](const Calibration& c) { return array_of(c.color_from_depth); })
        .def_property_readonly("room_from_camera",
                               [](const Calibration& c) { return array_of(c.room_from_camera); })
        .def_readonly("depth_unit_mm", &Calibration::depth_unit_mm)
        .def_readonly("depth_offset_mm", &Calibration::depth_offset_mm)
        .def_readonly("registered", &Calibration::registered)
        .def_readonly("person", &Calibration::person)
        .def_property_readonly("color_gain", &gain_of)
        .def("to_json", &capture::write_folder_calibration,
             "The text of a calibration.json beside a folder of pictures.")
        .def("__eq__", [](const Calibration& a, const Calibration& b) { return a == b; })
        .def("__repr__", [](const Calibration& c) {
            return "Calibration(depth=" + (c.depth.size == Size{} ? "None" : model_text(c.depth)) +
                   ", color=" + (c.color.size == Size{} ? "None" : model_text(c.color)) + ")";
        });
}

}  // namespace theatron::python
