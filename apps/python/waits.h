// SPDX-License-Identifier: Apache-2.0
// Waiting that Ctrl-C ends.
#pragma once

#include <pybind11/pybind11.h>

namespace theatron::python {

// Calls `is_done`, which waits for a moment, without Python's lock until it returns true.
template <class IsDone>
void wait_until(IsDone is_done) {
    while (true) {
        {
            const pybind11::gil_scoped_release released;
            if (is_done())
                return;
        }
        if (PyErr_CheckSignals() != 0)
            throw pybind11::error_already_set();
    }
}

}  // namespace theatron::python
