// SPDX-License-Identifier: Apache-2.0
// GL objects that delete themselves, and programs from our shader files.
//
// Only sources that draw include this header (this folder and the passes of xr/): it
// brings in the GL types.
// The common subset of OpenGL ES 3.0 and WebGL 2 is used throughout, which desktop core
// profiles also have; natively libepoxy finds the functions, in the browser Emscripten maps
// them to WebGL.
#pragma once

#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <epoxy/gl.h>
#endif

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/view.h"

namespace theatron::render {

// Owns one GL name. Empty (0) only after being moved from.
template <class Kind>
class GlObject {
public:
    GlObject() : name_(Kind::make()) {}
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_ != 0)
            Kind::destroy(name_);
    }
    GLuint name() const { return name_; }

private:
    GLuint name_;
};

struct TextureKind {
    static GLuint make() {
        GLuint name = 0;
        glGenTextures(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct BufferKind {
    static GLuint make() {
        GLuint name = 0;
        glGenBuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayKind {
    static GLuint make() {
        GLuint name = 0;
        glGenVertexArrays(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct FramebufferKind {
    static GLuint make() {
        GLuint name = 0;
        glGenFramebuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramKind {
    static GLuint make() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

using Texture = GlObject<TextureKind>;
using Buffer = GlObject<BufferKind>;
using VertexArray = GlObject<VertexArrayKind>;
using Framebuffer = GlObject<FramebufferKind>;

// One shader made of several files, each seen by the compiler after the other. Instead of a
// file's name a line "#define ..." may stand.
using ShaderFiles = std::initializer_list<std::string_view>;

// A linked program. Uniform blocks and samplers are bound by the caller.
class Program {
public:
    // Throws Error with file, line and the driver's message if a shader does
    // not compile or the two do not link.
    Program(ShaderFiles vertex, ShaderFiles fragment);

    GLuint name() const { return program_.name(); }
    // -1 if the shaders do not use it, which GL's setters ignore.
    GLint uniform(const char* uniform_name) const;
    void use() const { glUseProgram(program_.name()); }
    // Makes the program current and sets one of its samplers to a texture unit.
    void set_sampler(const char* uniform_name, int unit) const;
    void bind_block(const char* block_name, unsigned binding) const;

private:
    struct Begun;
    friend class BegunPrograms;
    explicit Program(Begun begun);
    GlObject<ProgramKind> program_;
};

// Programs that are begun without waiting for the driver, which may compile them beside. The next
// Program of the same files takes the begun one over. At most one object of this class at a time.
class BegunPrograms {
public:
    BegunPrograms();
    ~BegunPrograms();
    BegunPrograms(const BegunPrograms&) = delete;
    BegunPrograms& operator=(const BegunPrograms&) = delete;

    void begin(ShaderFiles vertex, ShaderFiles fragment);
    // False while the driver still works on one, if it can tell. Does not wait for the driver.
    bool are_ready() const;

private:
    friend class Program;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Compiles one shader of the given kind from parts with a name and a text each.
// For Program, and for tests of its messages.
struct ShaderPart {
    std::string_view name;
    std::string_view text;
};
GLuint compile_shader(GLenum kind, const std::vector<ShaderPart>& parts);

// A texture, left bound to the active texture unit; its content is undefined.
Texture make_texture(GLenum format, Size size, GLint filter);
// None: the unit reads black.
void bind_texture(int unit, const Texture* texture);
// An array of textures of one size, left bound to the active texture unit.
Texture make_texture_array(GLenum format, Size size, int layers, GLint filter);
// Sets the filter of the bound texture, and clamps it at its edges.
void set_sampling(GLenum target, GLint filter);

}  // namespace theatron::render
