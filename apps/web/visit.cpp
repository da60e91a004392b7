// SPDX-License-Identifier: Apache-2.0
#include "visit.h"
#include "phrases/phrase.h"

#include <GLES3/gl3.h>
#include <emscripten/emscripten.h>

#include <cstdio>
#include <utility>

#include "base/error.h"
#include "base/hex_text.h"
#include "base/steady_clock.h"
#include "render/gl_driver.h"
#include "video/depth_codecs.h"

// Gives a packet of another's voice to the page. The program is one module of JavaScript.
EM_JS(void, theatron_give_voice, (unsigned speaker, const void* packet, int size),
      { Module.on_voice(speaker, HEAPU8.slice(packet, packet + size)); });
// The framebuffer of the headset's pictures, which page/headset.js sets, by a name of GL. The
// program is one module of JavaScript.
EM_JS(unsigned, theatron_headset_framebuffer, (unsigned name), {
    const framebuffer = Module.headset_framebuffer;
    if (!framebuffer)
        return 0;
    name = name || GL.getNewId(GL.framebuffers);
    GL.framebuffers[name] = framebuffer;
    framebuffer.name = name;
    return name;
});

// Emscripten 3.1 never gives a name of GL twice, and its tables of objects keep a place for each
// name of any kind: they would grow with each visit. The first free place of a table is taken
// instead.
EM_JS(void, theatron_reuse_gl_names, (), {
    GL.getNewId = function(table) {
        if (!table.length)
            table.push(null);  // 0 is no name
        const free = table.indexOf(null, 1);
        const name = free < 0 ? table.length : free;
        GL.counter = Math.max(GL.counter, name + 1);  // above all names
        return name;
    };
});

namespace theatron::web {
namespace {

viewer::Viewer::Options viewer_options(const client::Participant::Options& join, double scale) {
    viewer::Viewer::Options options;
    options.depth_codec = join.depth_codec;
    options.color_codec = join.color_codec;
    options.shows_people = true;
    options.shows_facts = false;  // so that no age flickers over hands and instruments
    options.room.in_steps = true;
    options.scale = scale;
    options.has_gpu = !render::is_software(render::driver_name());
    return options;
}

client::Participant::Options with_faces(client::Participant::Options join,
                                        client::PictureSender& face) {
    join.takes_faces = true;
    join.takes_own_faces = true;
    join.face = face.events();
    return join;
}

// For the next picture, a little before it may begin.
void want_frames(Visit& visit, TimePoint now) {
    constexpr Duration longest_way = 20ms;
    if (!visit.viewer.rests_at(now + longest_way))
        visit.participant.want_frames();
}

}  // namespace

Visit::Visit(client::Participant::Options join, std::string host_address, PageColor asked,
             double scale)
    : address(std::move(host_address)),
      color(std::move(asked)),
      options(viewer_options(join, scale)),
      participant(with_faces(std::move(join), face)),
      viewer(options, participant) {
    // The page has all panels at any time, and shows one of them.
    constexpr Size any{16, 9};
    window::WindowInput input;
    input.keys.push_back({window::Action::show_case});
    viewer.on_input(input, std::nullopt, any, steady_now());
}

Page& page() {
    static auto* const only = new Page;
    return *only;
}

void open_context() {
    if (page().context != 0)
        return;
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = attributes.depth = attributes.antialias = EM_FALSE;
    // Each extension is a question to the browser's graphics process, and none is used by itself.
    attributes.enableExtensionsByDefault = EM_FALSE;
    attributes.powerPreference = EM_WEBGL_POWER_PREFERENCE_HIGH_PERFORMANCE;
    const auto context = emscripten_webgl_create_context("#view", &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        throw Error(say(Phrase::no_webgl));
    theatron_reuse_gl_names();
    page().context = context;
}

client::Participant::Options join_options(const net::Link& link, const char* name,
                                          const char* person, const PageColor& color) {
    client::Participant::Options options;
    options.link = link;
    options.name = name;
    options.is_page = true;
    options.color_codec = color.codec();
    options.keeps_room = options.keeps_cases = options.shows_patient = true;
    options.knows_studies = true;
    options.shows_chat = true;
    options.screen = page().screen.events();
    // The page made the digits itself.
    options.person = bytes_of_hex(person).value_or(Bytes());
    options.voice = [](ParticipantId speaker, ByteView packet) {
        theatron_give_voice(unsigned(speaker), packet.data(), int(packet.size()));
    };
    options.run = page().run;
    options.chat = page().chat;
    options.raises_hand = std::exchange(page().hand_raised, false);
    options.written = [](const std::string& text) {
        if (page().visit)
            page().visit->viewer.note(text, steady_now());
        if (page().flat)
            page().flat->view.note(text, steady_now());
    };
    options.remark = [shown = options.written](const std::string& text) {
        std::puts(text.c_str());
        shown(text);
    };
    return options;
}

std::string ask_for_depth(client::Participant::Options& options, const std::string& wish) {
    if (wish.empty())
        return "";
    const codec::ParsedDepthSetting parsed = video::parse_depth_setting(wish);
    if (parsed.problem.empty())
        options.depth_codec = parsed.setting.text;
    return parsed.problem;
}

void follow_color(Visit& visit, const client::ParticipantFigures& figures, TimePoint now) {
    if (visit.viewer.color_codec() != visit.color.codec())
        visit.color.choose(visit.viewer.color_codec());
    (void)visit.color.observe(figures, now);
    if (visit.viewer.color_codec() != visit.color.codec())
        visit.viewer.choose_color_codec(visit.color.codec());
}

void follow_color(FlatVisit& visit, const client::ParticipantFigures& figures, TimePoint now) {
    if (visit.color.observe(figures, now))
        visit.view.set_color(visit.color.codec());
}

bool finish_drawing(Visit& visit) {
    if (!visit.drawing.take_passed())
        return false;
    const TimePoint now = steady_now();
    const TimePoint worked_until = visit.options.has_gpu ? visit.drawing_submitted : now;
    visit.viewer.on_presented(visit.drawing_began, worked_until - visit.drawing_began, now);
    want_frames(visit, now);
    return true;
}

bool draw(Visit& visit, Size size) {
    if (visit.drawing.is_waiting())
        return false;
    const TimePoint now = steady_now();
    want_frames(visit, now);
    const window::WindowInput input = page().input.take();
    visit.viewer.on_input(
        input, input.grabbed ? visit.picture.distance_at(*input.grabbed) : std::nullopt, size, now);
    const bool changed = visit.viewer.step(size, now);
    // The picture follows in the next event.
    const bool made_cameras = visit.viewer.take_made_cameras();
    if ((!changed && !input.redraw) || made_cameras)
        return false;
    if (changed)
        visit.viewer.draw(size, visit.picture.begin(size, visit.viewer.way().scale), now);
    visit.picture.show(size);
    if (changed) {
        visit.drawing.begin();
        visit.drawing_began = now;
    }
    glFlush();
    visit.drawing_submitted = steady_now();
    return true;
}

void draw_headset(Visit& visit, xr::HeadsetFrame frame, bool real_room) {
    const TimePoint now = steady_now();
    // The window's size does not matter here.
    constexpr Size any{16, 9};
    page().input = {};
    visit.participant.want_frames();
    visit.viewer.on_headset(frame, now);
    (void)visit.viewer.step(any, now);
    const unsigned framebuffer = page().headset_framebuffer =
        theatron_headset_framebuffer(page().headset_framebuffer);
    for (xr::HeadsetEye& eye : frame.eyes)
        eye.framebuffer = framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    if (real_room)
        glClearColor(0, 0, 0, 0);
    else
        glClearColor(0.09f, 0.10f, 0.12f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    visit.viewer.draw_headset(frame, now);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    // While the GPU is behind, one picture in several is measured.
    if (!visit.drawing.is_waiting()) {
        visit.drawing.begin();
        visit.drawing_began = now;
        visit.drawing_submitted = steady_now();
    }
    glFlush();
}

}  // namespace theatron::web
