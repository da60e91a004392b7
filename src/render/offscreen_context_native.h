// SPDX-License-Identifier: Apache-2.0
// A GL context without a window or a display server, for pictures into files and for
// tests. Works on Mesa's software renderer.
#pragma once

#include <memory>
#include <string>

namespace theatron::render {

// OpenGL ES 3, or OpenGL's core profile as desktop drivers have it.
enum class GlKind { es, desktop_core };

class OffscreenContext {
public:
    // Creates the context and makes it current on this thread. Throws Error, saying
    // what to install, if no EGL can create it.
    explicit OffscreenContext(GlKind kind = GlKind::es);
    // No object of this context may exist any more.
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    // For use on another thread: released by one, made current by the other.
    void make_current();
    void release();

    // The driver's text, for example "OpenGL ES 3.2" or "4.5 (Core Profile)".
    std::string version() const;
    // The driver's name for itself, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer_name() const;
    // GL errors that the driver has reported so far, and the text of the first.
    int errors() const;
    std::string first_error() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::render
