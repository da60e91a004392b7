// SPDX-License-Identifier: Apache-2.0
#include "render/gl_driver.h"

#include "render/gl.h"

#ifdef __EMSCRIPTEN__
#include <emscripten/html5.h>
#endif

namespace theatron::render {

std::string driver_name() {
    GLenum which = GL_RENDERER;
#ifdef __EMSCRIPTEN__
    // GL_RENDERER is the same for all drivers there.
    constexpr GLenum unmasked_renderer = 0x9246;
    if (emscripten_webgl_enable_extension(emscripten_webgl_get_current_context(),
                                          "WEBGL_debug_renderer_info"))
        which = unmasked_renderer;
#endif
    const auto* const name = reinterpret_cast<const char*>(glGetString(which));
    return name ? name : "";
}

bool is_software(std::string_view driver_name) {
    for (const std::string_view software :
         {"llvmpipe", "softpipe", "SwiftShader", "swrast", "Microsoft Basic Render"})
        if (driver_name.find(software) != std::string_view::npos)
            return true;
    return false;
}

}  // namespace theatron::render
