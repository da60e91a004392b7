// SPDX-License-Identifier: Apache-2.0
// Text from files and other machines as Python's: bytes that are not UTF-8 become U+FFFD.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

namespace theatron::python {

// Needs Python's lock.
inline pybind11::str shown_text(std::string_view text) {
    PyObject* const object =
        PyUnicode_DecodeUTF8(text.data(), pybind11::ssize_t(text.size()), "replace");
    if (!object)
        throw pybind11::error_already_set();
    return pybind11::reinterpret_steal<pybind11::str>(object);
}

}  // namespace theatron::python
