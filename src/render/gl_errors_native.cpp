// SPDX-License-Identifier: Apache-2.0
#include "render/gl_errors_native.h"

#include <epoxy/gl.h>

namespace theatron::render {
namespace {

void report(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
            const void* errors) {
    if (type == GL_DEBUG_TYPE_ERROR)
        static_cast<GlErrors*>(const_cast<void*>(errors))->add(message);
}

}  // namespace

void GlErrors::watch() {
    const bool has_debug = epoxy_gl_version() >= (epoxy_is_desktop_gl() ? 43 : 32) ||
                           epoxy_has_gl_extension("GL_KHR_debug");
    if (!has_debug)
        return;
    glEnable(GL_DEBUG_OUTPUT);
    // So that a debugger stops at the call that was wrong.
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(report, this);
}

void GlErrors::add(const char* message) {
    if (count_++ == 0)
        first_ = message;
}

}  // namespace theatron::render
