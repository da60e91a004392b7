// SPDX-License-Identifier: Apache-2.0
// The extension module theatron._theatron, from which the package `theatron` takes all its names.
#include "base/error.h"
#include "bindings.h"
#include "shown_text.h"

PYBIND11_MODULE(_theatron, module) {
    using namespace theatron;
    module.doc() = "Theatron's recordings, cameras and codecs on numpy arrays.";
    module.attr("__version__") = THEATRON_VERSION;
    // Kept for ever: at the end of a program Python is gone before static objects are.
    static PyObject* const error =
        pybind11::exception<Error>(module, "Error", PyExc_RuntimeError).release().ptr();
    pybind11::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const Error& e) {
            PyErr_SetObject(error, python::shown_text(e.what()).ptr());
        }
    });
    python::bind_calibration(module);
    python::bind_frames(module);
    python::bind_readers(module);
    python::bind_recording(module);
    python::bind_depth_codecs(module);
    python::bind_color_codecs(module);
    python::bind_session(module);
    python::bind_sending(module);
}
