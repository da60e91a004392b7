// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include <array>
#include <cmath>

namespace theatron::python {
namespace {

std::string shape_text(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    return text + (array.ndim() == 1 ? ",)" : ")");
}

std::string found_text(const py::object& given) {
    if (!py::isinstance<py::array>(given))
        return "a " + std::string(py::str(py::type::of(given).attr("__name__")));
    const py::array array(given);
    return std::string(py::str(array.dtype())) + " of shape " + shape_text(array);
}

// A caller's array of this type, with these dimensions; rows and columns up to max_side.
template <class T>
py::array_t<T, py::array::c_style> image_argument(const py::object& given, py::ssize_t dimensions,
                                                  const char* wanted) {
    const bool fits = py::isinstance<py::array_t<T>>(given) &&
                      py::array(given).ndim() == dimensions &&
                      (dimensions == 2 || py::array(given).shape(2) == 3);
    if (!fits)
        throw py::value_error(std::string(wanted) + ", but it is " + found_text(given) + ".");
    py::array_t<T, py::array::c_style> array(given);
    const py::ssize_t height = array.shape(0), width = array.shape(1);
    if (height < 1 || width < 1 || height > max_side || width > max_side)
        throw py::value_error("A picture has 1 to " + std::to_string(max_side) +
                              " rows and columns, but this one is of shape " + shape_text(array) +
                              ".");
    return array;
}

// Deletes a reference to the owner.
py::capsule capsule_of(std::shared_ptr<const void> owner) {
    auto held = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
    py::capsule capsule(held.get(), [](void* pointer) {
        delete static_cast<std::shared_ptr<const void>*>(pointer);
    });
    held.release();
    return capsule;
}

void set_writeable(const py::array& array, bool writeable) {
    if (!writeable)
        array.attr("setflags")(py::arg("write") = false);
}

}  // namespace

DepthArray depth_argument(const py::object& given) {
    return image_argument<std::uint16_t>(
        given, 2, "Depth must be an array of uint16 of shape (height, width)");
}

ColorArray color_argument(const py::object& given) {
    return image_argument<std::uint8_t>(
        given, 3, "Colour must be an array of uint8 of shape (height, width, 3)");
}

DepthView view_of(const DepthArray& array) {
    return {array.data(), {int(array.shape(1)), int(array.shape(0))}};
}

ColorView view_of(const ColorArray& array) {
    return {reinterpret_cast<const Rgb*>(array.data()), {int(array.shape(1)), int(array.shape(0))}};
}

py::array array_of(DepthView view, std::shared_ptr<const void> owner, bool writeable) {
    constexpr py::ssize_t pixel = sizeof(std::uint16_t);
    const py::array_t<std::uint16_t> array(
        std::array<py::ssize_t, 2>{view.size.height, view.size.width},
        std::array<py::ssize_t, 2>{view.stride * pixel, pixel}, view.pixels,
        capsule_of(std::move(owner)));
    set_writeable(array, writeable);
    return array;
}

py::array array_of(ColorView view, std::shared_ptr<const void> owner, bool writeable) {
    constexpr py::ssize_t pixel = sizeof(Rgb);
    const py::array_t<std::uint8_t> array(
        std::array<py::ssize_t, 3>{view.size.height, view.size.width, 3},
        std::array<py::ssize_t, 3>{view.stride * pixel, pixel, 1},
        reinterpret_cast<const std::uint8_t*>(view.pixels), capsule_of(std::move(owner)));
    set_writeable(array, writeable);
    return array;
}

py::array_t<double> array_of(const Pose& a_from_b) {
    py::array_t<double> array({4, 4});
    auto m = array.mutable_unchecked<2>();
    const Mat3 rotation = matrix_from_quat(a_from_b.rotation);
    const Vec3& t = a_from_b.translation;
    const double translation[] = {t.x, t.y, t.z};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            m(row, column) = rotation.m[row][column];
        m(row, 3) = translation[row];
    }
    for (int column = 0; column < 4; ++column)
        m(3, column) = column == 3;
    return array;
}

Pose pose_argument(const py::object& given, const std::string& name) {
    const auto array =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!array) {
        PyErr_Clear();
        throw py::value_error(name + " must be a 4 x 4 matrix of numbers.");
    }
    if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
        throw py::value_error(name + " must be a 4 x 4 matrix, but its shape is " +
                              shape_text(array) + ".");
    const auto m = array.unchecked<2>();
    Mat3 rotation;
    constexpr double tolerance = 1e-4;
    bool is_rigid = true;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            rotation.m[row][column] = m(row, column);
            double product = 0;
            for (int k = 0; k < 3; ++k)
                product += m(row, k) * m(column, k);
            is_rigid &= std::abs(product - (row == column)) < tolerance;
        }
    const double determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
                               m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
                               m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
    for (int column = 0; column < 4; ++column)
        is_rigid &= std::abs(m(3, column) - (column == 3)) < tolerance &&
                    (column == 3 || std::isfinite(m(column, 3)));
    if (!is_rigid || determinant < 0)
        throw py::value_error(name +
                              " must be a rotation and a translation in metres, with 0, 0, 0, 1 as "
                              "its last row.");
    return {normalized(quat_from_matrix(rotation)), {m(0, 3), m(1, 3), m(2, 3)}};
}

}  // namespace theatron::python
