// SPDX-License-Identifier: Apache-2.0
// The GL context of this folder's tests. Where there is none the tests fail and
// say what to install: a renderer that nobody has seen drawing is not tested.
#pragma once

#include "render/offscreen_context_native.h"

namespace theatron::render {

// Made once, as a driver's start takes most of the tests' time, and current on return.
inline OffscreenContext& test_context() {
    static OffscreenContext context;
    context.make_current();
    return context;
}

}  // namespace theatron::render
