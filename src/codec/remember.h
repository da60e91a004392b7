// SPDX-License-Identifier: Apache-2.0
// What lossless temporal codecs do with references.
#pragma once

#include "codec/depth_codec.h"
#include "codec/rows.h"

namespace theatron::codec {

// The depth of a reference; without pixels if there is none.
inline DepthView view_of(const Reference* reference) {
    return reference == nullptr || reference->depth.empty() ? DepthView{} : reference->depth.view();
}

// Keeps `depth` in `next`, if that is wanted. The memory in it is used again.
inline void remember(DepthView depth, Reference* next) {
    if (next == nullptr)
        return;
    next->depth.resize(depth.size);
    copy_rows(depth, next->depth.view());
}

}  // namespace theatron::codec
