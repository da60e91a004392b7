// SPDX-License-Identifier: Apache-2.0
// The extension module theatron._theatron, from which the package `theatron` takes all its names.
#include "base/error.h"
#include "bindings.h"

PYBIND11_MODULE(_theatron, module) {
    using namespace theatron;
    module.doc() = "Theatron's recordings, cameras and codecs on numpy arrays.";
    module.attr("__version__") = THEATRON_VERSION;
    pybind11::register_exception<Error>(module, "Error", PyExc_RuntimeError);
    python::bind_calibration(module);
    python::bind_frames(module);
    python::bind_readers(module);
    python::bind_recording(module);
    python::bind_depth_codecs(module);
    python::bind_color_codecs(module);
    python::bind_session(module);
    python::bind_sending(module);
}
