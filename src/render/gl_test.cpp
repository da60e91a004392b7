// SPDX-License-Identifier: Apache-2.0
#include "render/gl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

using ::testing::HasSubstr;

TEST(Gl, AShaderErrorNamesFileAndLine) {
    OffscreenContext context(tested_gl());  // of its own, so that others see no errors
    try {
        compile_shader(GL_VERTEX_SHADER,
                       {{"library.glsl", "float one() {\n  return 1.0;\n}\n"},
                        {"broken.vert", "void main() {\n\n  gl_Position = none;\n}\n"}});
        FAIL() << "compiled";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("broken.vert does not compile"));
        EXPECT_THAT(error.what(), HasSubstr("broken.vert:3"));
    }
}

TEST(Gl, TheContextIsOfTheKindThatWasAskedFor) {
    const std::string version = test_context().version();
    EXPECT_EQ(version.find("OpenGL ES") == std::string::npos, tested_gl() == GlKind::desktop_core)
        << version;
    EXPECT_EQ(epoxy_is_desktop_gl(), tested_gl() == GlKind::desktop_core);
}

TEST(Gl, ErrorsOfTheDriverAreCounted) {
    OffscreenContext context(tested_gl());  // of its own, so that others see no errors
    EXPECT_EQ(context.errors(), 0);
    glEnable(GL_RGBA8);  // no such switch
    EXPECT_EQ(context.errors(), 1);
    EXPECT_THAT(context.first_error(), HasSubstr("glEnable"));
    EXPECT_EQ(glGetError(), GLenum(GL_INVALID_ENUM));
}

TEST(Gl, ObjectsAreDeletedWithTheirOwner) {
    test_context();
    GLuint name = 0;
    {
        Texture texture;
        name = texture.name();
        glBindTexture(GL_TEXTURE_2D, name);
        Texture moved = std::move(texture);
        EXPECT_EQ(moved.name(), name);
        EXPECT_TRUE(glIsTexture(name));
    }
    EXPECT_FALSE(glIsTexture(name));
}

}  // namespace
}  // namespace theatron::render
