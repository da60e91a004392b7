// SPDX-License-Identifier: Apache-2.0
// Draws the golden scene in a browser and prints each renderer's picture: a line
// "picture NAME WIDTH HEIGHT HEX", and "problem ..." for each failure.
#include <GLES3/gl3.h>
#include <emscripten/html5.h>

#include <cstdio>
#include <string>

#include "base/error.h"
#include "render/ball_scene.h"
#include "render/render_target.h"
#include "render/scene_passes.h"

using namespace theatron;
using namespace theatron::render;

// Shaders of the lit scene: that they compile and raise no error. Pictures are tested natively.
void draw_lit_scene() {
    const SceneMesh ball(make_sphere_mesh(0.3, 12)), floor(make_box_mesh({-2, -1, -2}, {2, 0, 2}));
    SceneFrame frame;
    frame.objects = {{&floor, {}, {{0.5, 0.5, 0.5}, 0, 0.5, 1, 1}, true},
                     {&ball, {}, {}},
                     {&ball, {Quat{}, {0.5, 0, 0}}, {{0.8, 0.1, 0.1}, 0, 0.4, 0.5}}};
    const SceneTexture texture({16, 8});
    frame.objects.push_back({&ball, {Quat{}, {-0.5, 0, 0}}, {}});
    frame.objects.back().look.texture = &texture;
    const SceneLineMesh line({{{-0.5, 0, 0.5}, {0.5, 0, 0.5}, 0.002, 0.002}});
    frame.lines = {{&line, {}, {230, 159, 0}}};
    ScenePasses passes;
    const RenderTarget target(golden_picture_size);
    target.clear({});
    for (const SceneQuality quality : {SceneQuality::low, SceneQuality::high}) {
        frame.quality = quality;
        passes.prepare(frame, golden_view(), golden_picture_size);
        passes.draw_opaque(frame, golden_view(), target.target());
        passes.draw_translucent(frame, golden_view(), target.target());
    }
}

void report_errors(const std::string& what) {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        std::printf("problem %s raises GL error 0x%x\n", what.c_str(), error);
}

// Prints the picture of a golden scene, as hexadecimal digits.
void draw_golden(const std::string& name, const std::string& renderer, void (*show)(CloudSet&)) {
    try {
        CloudSet scene;
        show(scene);
        const ColorImage drawn = scene.render(golden_view(), golden_picture_size, renderer).color;
        std::string line = "picture " + name + " " + std::to_string(drawn.size.width) + " " +
                           std::to_string(drawn.size.height) + " ";
        const auto put = [&line](unsigned value) {
            line += "0123456789abcdef"[value / 16];
            line += "0123456789abcdef"[value % 16];
        };
        for (const Rgb p : drawn.pixels) {
            put(p.r);
            put(p.g);
            put(p.b);
        }
        std::puts(line.c_str());
    } catch (const Error& e) {
        std::printf("problem %s\n", e.what());
    }
    report_errors(name);
}

int main() {
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    const auto context = emscripten_webgl_create_context("#canvas", &attributes);
    if (context <= 0 ||
        emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS) {
        std::puts("problem no WebGL 2");
        return 0;
    }
    std::printf("driver %s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    for (const std::string& renderer : renderer_names()) {
        draw_golden(renderer, renderer, show_golden_scene);
        draw_golden("mixed_" + renderer, renderer, show_mixed_golden_scene);
    }
    try {
        draw_lit_scene();
    } catch (const Error& e) {
        std::printf("problem %s\n", e.what());
    }
    report_errors("the lit scene");
    return 0;
}
