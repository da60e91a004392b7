// SPDX-License-Identifier: Apache-2.0
// Depth through the zstd library: the pixels as they are, or, with `delta`, the
// planes of planes.h. The bytes are specified in docs/formats/depth_zstd.md.
#pragma once

#include <memory>

#include "codec/depth_codec.h"

namespace theatron::codec {

// Whether this build has the library.
bool has_zstd();

// `level` is 1 to 19. Null without the library.
std::unique_ptr<DepthCodec> make_zstd(int level, bool delta);

}  // namespace theatron::codec
