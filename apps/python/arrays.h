// SPDX-License-Identifier: Apache-2.0
// Images and poses as numpy arrays, and arrays of a caller as images. All functions need Python's
// lock, and throw ValueError (pybind11::value_error) with one sentence on an array that does not
// fit.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>

#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::python {

namespace py = pybind11;

// A caller's depth, contiguous: uint16 of shape (height, width). A copy only where rows have gaps.
using DepthArray = py::array_t<std::uint16_t, py::array::c_style>;
DepthArray depth_argument(const py::object& given);
DepthView view_of(const DepthArray& array);

// A caller's colour: uint8 of shape (height, width, 3), red, green, blue.
using ColorArray = py::array_t<std::uint8_t, py::array::c_style>;
ColorArray color_argument(const py::object& given);
ColorView view_of(const ColorArray& array);

// Arrays over memory that `owner` keeps alive.
py::array array_of(DepthView view, std::shared_ptr<const void> owner, bool writeable);
py::array array_of(ColorView view, std::shared_ptr<const void> owner, bool writeable);

// 4 x 4 float64 matrices that multiply points of frame b to frame a.
py::array_t<double> array_of(const Pose& a_from_b);
// `name` is the argument's, for sentences. The upper left 3 x 3 must be a rotation.
Pose pose_argument(const py::object& given, const std::string& name);

}  // namespace theatron::python
