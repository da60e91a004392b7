// SPDX-License-Identifier: Apache-2.0
#include "render/gl.h"

#include <algorithm>
#include <cstdlib>
#include <list>
#include <regex>

#ifdef __EMSCRIPTEN__
#include <emscripten/html5.h>
#endif

#include "base/error.h"
#include "render/shader_source.h"

namespace theatron::render {
namespace {

ShaderPart find_part(std::string_view name) {
    if (name.starts_with("#define "))
        return {"definition", name};
    for (const ShaderFile& file : embedded_shaders())
        if (file.name == name)
            return {file.name, file.text};
    throw Error("There is no shader file " + std::string(name) + " in this build.");
}

// Desktop GL has one precision alone, and its older drivers do not take these lines.
constexpr std::string_view es_preamble =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler2DShadow;\n"
    "precision highp sampler2DArray;\n"
    "precision highp usampler2D;\n"
    "precision highp samplerCube;\n";
constexpr std::string_view desktop_preamble = "#version 420 core\n";

// The first lines of a shader for the current context.
std::string_view preamble() {
#ifdef __EMSCRIPTEN__
    return es_preamble;
#else
    return epoxy_is_desktop_gl() ? desktop_preamble : es_preamble;
#endif
}

int count_lines(std::string_view text) {
    return int(std::count(text.begin(), text.end(), '\n'));
}

// The file and line of a line of the whole source, as make_source put it together.
std::string place_of(int line, const std::vector<ShaderPart>& parts) {
    line -= count_lines(preamble());
    for (const ShaderPart& part : parts) {
        const int lines = count_lines(part.text) + 1;
        if (line <= lines)
            return std::string(part.name) + ":" + std::to_string(line);
        line -= lines;
    }
    return "end of file";
}

std::string make_source(const std::vector<ShaderPart>& parts) {
    std::string source(preamble());
    for (const ShaderPart& part : parts)
        source.append(part.text) += '\n';
    return source;
}

// Drivers name a place as "0:17" or "0(17)", meaning line 17 of the whole source: not
// all of them heed #line. Puts our file and line there.
std::string with_file_names(const std::string& log, const std::vector<ShaderPart>& parts) {
    static const std::regex place(R"((^|\s)0[:(](\d+)\)?)");
    std::string text;
    auto from = log.cbegin();
    for (std::sregex_iterator it(log.begin(), log.end(), place), end; it != end; ++it) {
        text.append(from, log.cbegin() + it->position());
        text += (*it)[1].str() + place_of(std::atoi((*it)[2].str().c_str()), parts);
        from = log.cbegin() + it->position() + it->length();
    }
    return text.append(from, log.cend());
}

template <class GetLength, class GetLog>
std::string info_log(GLuint object, GetLength get_length, GetLog get_log) {
    GLint length = 0;
    get_length(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length > 0 ? length : 1), '\0');
    GLsizei used = 0;
    get_log(object, GLsizei(log.size()), &used, log.data());
    log.resize(std::size_t(used));
    return log;
}

GLuint begin_shader(GLenum kind, const std::vector<ShaderPart>& parts) {
    const std::string source = make_source(parts);
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    return shader;
}

// Empty where the shader compiles.
std::string compile_problem(GLuint shader, const std::vector<ShaderPart>& parts) {
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return {};
    const std::string log = info_log(
        shader, [](auto... a) { glGetShaderiv(a...); },
        [](auto... a) { glGetShaderInfoLog(a...); });
    return "The shader " + std::string(parts.back().name) +
           " does not compile on this driver: " + with_file_names(log, parts);
}

}  // namespace

GLuint compile_shader(GLenum kind, const std::vector<ShaderPart>& parts) {
    const GLuint shader = begin_shader(kind, parts);
    const std::string problem = compile_problem(shader, parts);
    if (problem.empty())
        return shader;
    glDeleteShader(shader);
    throw Error(problem);
}

namespace {
constexpr GLenum completion_status = 0x91B1;  // of KHR_parallel_shader_compile
}

// A program whose shaders and linking are on their way, and their parts for messages.
struct Program::Begun {
    std::vector<std::string_view> vertex, fragment;  // names of files
    GlObject<ProgramKind> program;
    std::vector<std::pair<GLuint, std::vector<ShaderPart>>> shaders;

    // Asks for nothing: each question waits for the driver, which in a browser is another process.
    Begun(ShaderFiles vertex_files, ShaderFiles fragment_files)
        : vertex(vertex_files), fragment(fragment_files) {
        for (const auto& [kind, files] :
             {std::pair{GLenum(GL_VERTEX_SHADER), vertex}, {GL_FRAGMENT_SHADER, fragment}}) {
            std::vector<ShaderPart> parts;
            for (const std::string_view file : files)
                parts.push_back(find_part(file));
            shaders.emplace_back(begin_shader(kind, parts), parts);
            glAttachShader(program.name(), shaders.back().first);
        }
        glLinkProgram(program.name());
    }
    Begun(Begun&& other) noexcept
        : vertex(std::move(other.vertex)),
          fragment(std::move(other.fragment)),
          program(std::move(other.program)),
          shaders(std::exchange(other.shaders, {})) {}
    Begun& operator=(Begun&&) = delete;
    // The shaders live on as long as the program. They are not deleted earlier: a browser's client
    // knows no deleted shader.
    ~Begun() {
        for (const auto& [shader, parts] : shaders)
            glDeleteShader(shader);
    }

    bool is_of(ShaderFiles vertex_files, ShaderFiles fragment_files) const {
        return std::equal(vertex.begin(), vertex.end(), vertex_files.begin(), vertex_files.end()) &&
               std::equal(fragment.begin(), fragment.end(), fragment_files.begin(),
                          fragment_files.end());
    }

    // Throws Error where it is not linked.
    GlObject<ProgramKind> take_linked() {
        if (const std::string why = problem(); !why.empty())
            throw Error(why);
        return std::move(program);
    }

private:
    // Empty where the program is linked.
    std::string problem() const {
        GLint linked = 0;
        glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
        if (linked)
            return {};
        for (const auto& [shader, parts] : shaders)
            if (std::string problem = compile_problem(shader, parts); !problem.empty())
                return problem;
        return "The shaders " + std::string(vertex.back()) + " and " +
               std::string(fragment.back()) + " do not fit together on this driver: " +
               info_log(
                   program.name(), [](auto... a) { glGetProgramiv(a...); },
                   [](auto... a) { glGetProgramInfoLog(a...); });
    }
};

struct BegunPrograms::Impl {
    std::list<Program::Begun> programs;
    bool tells_completion = false;

    // Null where there is none.
    static Impl*& only() {
        static Impl* only = nullptr;
        return only;
    }
    static Program::Begun take(ShaderFiles vertex, ShaderFiles fragment) {
        if (only())
            for (auto at = only()->programs.begin(); at != only()->programs.end(); ++at)
                if (at->is_of(vertex, fragment)) {
                    Program::Begun begun = std::move(*at);
                    only()->programs.erase(at);
                    return begun;
                }
        return {vertex, fragment};
    }
};

BegunPrograms::BegunPrograms() : impl_(std::make_unique<Impl>()) {
    Impl::only() = impl_.get();
#ifdef __EMSCRIPTEN__
    impl_->tells_completion = emscripten_webgl_enable_extension(
        emscripten_webgl_get_current_context(), "KHR_parallel_shader_compile");
#endif
}

BegunPrograms::~BegunPrograms() {
    Impl::only() = nullptr;
}

void BegunPrograms::begin(ShaderFiles vertex, ShaderFiles fragment) {
    impl_->programs.emplace_back(vertex, fragment);
}

bool BegunPrograms::are_ready() const {
    if (!impl_->tells_completion)
        return true;
    return std::all_of(impl_->programs.begin(), impl_->programs.end(), [](const auto& begun) {
        GLint complete = 0;
        glGetProgramiv(begun.program.name(), completion_status, &complete);
        return complete != 0;
    });
}

Program::Program(ShaderFiles vertex, ShaderFiles fragment)
    : Program(BegunPrograms::Impl::take(vertex, fragment)) {}

Program::Program(Begun begun) : program_(begun.take_linked()) {}

GLint Program::uniform(const char* uniform_name) const {
    return glGetUniformLocation(name(), uniform_name);
}

void Program::set_sampler(const char* uniform_name, int unit) const {
    use();
    glUniform1i(uniform(uniform_name), unit);
}

void Program::bind_block(const char* block_name, unsigned binding) const {
    const GLuint index = glGetUniformBlockIndex(name(), block_name);
    if (index != GL_INVALID_INDEX)
        glUniformBlockBinding(name(), index, binding);
}

Texture make_texture(GLenum format, Size size, GLint filter) {
    Texture texture;
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, size.width, size.height);
    set_sampling(GL_TEXTURE_2D, filter);
    return texture;
}

void bind_texture(int unit, const Texture* texture) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, texture ? texture->name() : 0);
}

Texture make_texture_array(GLenum format, Size size, int layers, GLint filter) {
    Texture texture;
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, format, size.width, size.height, layers);
    set_sampling(GL_TEXTURE_2D_ARRAY, filter);
    return texture;
}

void set_sampling(GLenum target, GLint filter) {
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace theatron::render
