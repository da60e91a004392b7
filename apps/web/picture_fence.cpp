// SPDX-License-Identifier: Apache-2.0
#include "picture_fence.h"

#include <emscripten/emscripten.h>

// Not by glFenceSync(): Emscripten 3.1 keeps a place in its tables for each object that was ever
// made, which is one for each picture.
EM_JS(void, theatron_begin_fence, (),
      { Module.fence = GLctx.fenceSync(GLctx.SYNC_GPU_COMMANDS_COMPLETE, 0); });
// Without a fence, as when the context is lost, nothing is waited for.
EM_JS(int, theatron_is_fence_passed, (), {
    return !Module.fence ||
           !Object.is(GLctx.clientWaitSync(Module.fence, 0, 0), GLctx.TIMEOUT_EXPIRED);
});
EM_JS(void, theatron_drop_fence, (), {
    GLctx.deleteSync(Module.fence);
    Module.fence = null;
});

namespace theatron::web {

void PictureFence::begin() {
    drop();
    theatron_begin_fence();
    waits_ = true;
}

bool PictureFence::take_passed() {
    if (!waits_ || theatron_is_fence_passed() == 0)
        return false;
    drop();
    return true;
}

void PictureFence::drop() {
    if (waits_)
        theatron_drop_fence();
    waits_ = false;
}

}  // namespace theatron::web
