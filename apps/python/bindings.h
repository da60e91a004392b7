// SPDX-License-Identifier: Apache-2.0
// The parts of the extension module. theatron/__init__.pyi documents what they define.
#pragma once

#include <pybind11/pybind11.h>

namespace theatron::python {

void bind_calibration(pybind11::module_& module);
void bind_frames(pybind11::module_& module);
void bind_readers(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_depth_codecs(pybind11::module_& module);
void bind_color_codecs(pybind11::module_& module);
void bind_session(pybind11::module_& module);
void bind_sending(pybind11::module_& module);

}  // namespace theatron::python
