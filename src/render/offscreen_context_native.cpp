// SPDX-License-Identifier: Apache-2.0
#include "render/offscreen_context_native.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "base/error.h"
#include "render/gl_errors_native.h"

namespace theatron::render {

struct OffscreenContext::Parts {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLenum api = EGL_OPENGL_ES_API;  // each has a current context of its own
    GlErrors errors;
};

OffscreenContext::OffscreenContext(GlKind kind) : parts_(std::make_unique<Parts>()) {
    const std::string advice =
        " Install Mesa's EGL (libegl1, libegl-mesa0, libgl1-mesa-dri) or a graphics driver.";
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base"))
        throw Error("EGL cannot draw without a window here." + advice);
    parts_->display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (parts_->display == EGL_NO_DISPLAY || !eglInitialize(parts_->display, nullptr, nullptr)) {
        // Drivers other than Mesa may draw without a surface on their usual display.
        parts_->display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        if (parts_->display == EGL_NO_DISPLAY || !eglInitialize(parts_->display, nullptr, nullptr))
            throw Error("EGL finds no display to draw on." + advice);
    }

    const bool desktop = kind == GlKind::desktop_core;
    const std::string name = desktop ? "OpenGL with a core profile" : "OpenGL ES 3";
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, desktop ? EGL_OPENGL_BIT : EGL_OPENGL_ES3_BIT,
                             EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    parts_->api = desktop ? EGL_OPENGL_API : EGL_OPENGL_ES_API;
    eglBindAPI(parts_->api);
    if (!eglChooseConfig(parts_->display, wanted, &config, 1, &found) || found == 0)
        throw Error("EGL offers no " + name + " without a window." + advice);
    const EGLint es_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_OPENGL_DEBUG,
                                    EGL_TRUE, EGL_NONE};
    // Textures of fixed size and what our shaders unpack came with 4.2; drivers give the newest
    // version that fits.
    const EGLint core_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                      4,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      2,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_CONTEXT_OPENGL_DEBUG,
                                      EGL_TRUE,
                                      EGL_NONE};
    parts_->context = eglCreateContext(parts_->display, config, EGL_NO_CONTEXT,
                                       desktop ? core_attributes : es_attributes);
    if (parts_->context == EGL_NO_CONTEXT)
        throw Error("EGL refuses to make a context of " + name + "." + advice);
    make_current();
    parts_->errors.watch();
}

OffscreenContext::~OffscreenContext() {
    release();
    eglDestroyContext(parts_->display, parts_->context);
    // The display stays initialised: it belongs to the whole process.
}

void OffscreenContext::make_current() {
    eglBindAPI(parts_->api);
    if (!eglMakeCurrent(parts_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, parts_->context))
        throw Error("The OpenGL context cannot be used on this thread.");
}

void OffscreenContext::release() {
    eglBindAPI(parts_->api);
    eglMakeCurrent(parts_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

std::string OffscreenContext::version() const {
    return reinterpret_cast<const char*>(glGetString(GL_VERSION));
}

std::string OffscreenContext::renderer_name() const {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

int OffscreenContext::errors() const {
    return parts_->errors.count();
}

std::string OffscreenContext::first_error() const {
    return parts_->errors.first();
}

}  // namespace theatron::render
