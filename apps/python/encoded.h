// SPDX-License-Identifier: Apache-2.0
// Encoded pictures as Python keeps them.
#pragma once

#include <pybind11/pybind11.h>

#include "base/bytes.h"
#include "base/ids.h"
#include "codec/depth_stream.h"

namespace theatron::python {

struct EncodedDepthObject {
    pybind11::bytes data;
    codec::FrameLink link;
};

struct EncodedColorObject {
    pybind11::bytes data;
    bool key = true;
};

// Valid while `data` is. Needs Python's lock.
inline ByteView view_of(const pybind11::bytes& data) {
    const std::string_view text = data;
    return as_bytes(text);
}

inline pybind11::bytes bytes_of(ByteView data) {
    return pybind11::bytes(reinterpret_cast<const char*>(data.data()), data.size());
}

}  // namespace theatron::python
