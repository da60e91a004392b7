// SPDX-License-Identifier: Apache-2.0
// References of lossless temporal codecs: the depth itself.
#pragma once

#include "codec/depth_codec.h"
#include "codec/rows.h"

namespace theatron::codec {

// The depth of a reference; a view without pixels if there is none.
inline DepthView view_of(const Reference* reference) {
    return reference == nullptr || reference->depth.empty() ? DepthView{} : reference->depth.view();
}

// Copies `depth` to `next` unless that is null. Its memory is reused.
inline void remember(DepthView depth, Reference* next) {
    if (next == nullptr)
        return;
    next->depth.resize(depth.size);
    copy_rows(depth, next->depth.view());
}

}  // namespace theatron::codec
