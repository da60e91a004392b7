// SPDX-License-Identifier: Apache-2.0
// The functions that page/page.js calls: join, one picture, input, and what the panels show.
//
// The page has one thread; everything but decoding runs in its events. Its decoding workers run the
// same program, of which they call the last two functions alone.
#include <GLES3/gl3.h>
#include <emscripten/emscripten.h>
#include <emscripten/html5.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/hex_text.h"
#include "base/steady_clock.h"
#include "client/decoder_pool_web.h"
#include "client/decoder_worker_web.h"
#include "client/face_sender.h"
#include "codec/depth_stream.h"
#include "flat_view.h"
#include "headset_input.h"
#include "page_color.h"
#include "page_input.h"
#include "page_state.h"
#include "render/gl_driver.h"
#include "voice/packet.h"
#include "xr/input_queue.h"
#include "xr/scaled_picture.h"

// `post_work` is set by page/decoding.js, `post_reply` by page/decoder.js.
EM_JS(void, theatron_post_work, (unsigned worker, const void* data, unsigned size),
      { Module.post_work(worker, HEAPU8.slice(data, data + size)); });
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
EM_JS(void, theatron_post_reply, (const void* data, unsigned size),
      { Module.post_reply(HEAPU8.slice(data, data + size)); });

namespace theatron::web {
namespace {

// A page that joined.
struct Visit {
    Visit(client::Participant::Options join, std::string host_address, PageColor asked)
        : address(std::move(host_address)),
          color(std::move(asked)),
          options(viewer_options(join)),
          participant(with_faces(std::move(join), face)),
          viewer(options, participant) {}
    ~Visit() { glDeleteSync(drawing); }

    static viewer::Viewer::Options viewer_options(const client::Participant::Options& join) {
        viewer::Viewer::Options options;
        options.depth_codec = join.depth_codec;
        options.color_codec = join.color_codec;
        options.shows_people = true;
        options.room.in_steps = true;
        options.has_gpu = !render::is_software(render::driver_name());
        return options;
    }

    // In the 2D view one has no head that the others see.
    static client::Participant::Options with_faces(client::Participant::Options join,
                                                   client::FaceSender& face) {
        join.takes_faces = true;
        join.face = face.events();
        return join;
    }

    std::string address;
    PageColor color;
    viewer::Viewer::Options options;
    client::FaceSender face;
    client::Participant participant;
    viewer::Viewer viewer;
    xr::ScaledPicture picture;
    unsigned headset_framebuffer = 0;  // its name, once it was used
    GLsync drawing = nullptr;          // of a picture that the GPU has not finished
    TimePoint drawing_began;
};

// A page that joined and only shows a camera's picture.
struct FlatVisit {
    FlatVisit(client::Participant::Options join, std::string host_address, PageColor asked)
        : address(std::move(host_address)),
          color(std::move(asked)),
          participant(std::move(join)),
          view(participant) {}

    std::string address;
    PageColor color;
    client::Participant participant;
    FlatView view;
};

// The page's state. Objects of GL must not outlive their context, so nothing is destroyed when the
// page is closed.
struct Page {
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
    std::unique_ptr<Visit> visit;     // this
    std::unique_ptr<FlatVisit> flat;  // or this, or none
    xr::InputQueue input;             // since the last picture
    std::string problem;              // why the visit ended; a sentence
    std::string text;                 // that the last function returned
    Bytes bytes;                      // that the script writes for the next function

    client::Participant* participant() const {
        return visit ? &visit->participant : flat ? &flat->participant : nullptr;
    }
};

Page& page() {
    static auto* const only = new Page;
    return *only;
}

// Runs `work`; an exception ends the visit with its sentence.
template <class Work>
void guarded(Work work) {
    try {
        work();
    } catch (const std::exception& e) {
        page().problem = e.what();
        page().visit.reset();
        page().flat.reset();
    }
}

void open_context() {
    if (page().context != 0)
        return;
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = attributes.depth = attributes.antialias = EM_FALSE;
    attributes.powerPreference = EM_WEBGL_POWER_PREFERENCE_HIGH_PERFORMANCE;
    const auto context = emscripten_webgl_create_context("#view", &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        throw Error("This browser has no WebGL 2; use a newer one, or theatron join.");
    page().context = context;
}

// Gives a packet of another's voice to the page. The program is one module of JavaScript.
EM_JS(void, give_voice, (unsigned speaker, const void* packet, int size),
      { Module.on_voice(speaker, HEAPU8.slice(packet, packet + size)); });

client::Participant::Options join_options(const net::Link& link, const char* name,
                                          const char* person, const PageColor& color) {
    client::Participant::Options options;
    options.link = link;
    options.name = name;
    options.color_codec = color.codec();
    options.keeps_room = options.keeps_cases = options.shows_patient = true;
    // The page made the digits itself.
    options.person = bytes_of_hex(person).value_or(Bytes());
    options.voice = [](ParticipantId speaker, ByteView packet) {
        give_voice(unsigned(speaker), packet.data(), int(packet.size()));
    };
    options.remark = [](const std::string& text) {
        std::puts(text.c_str());
        if (page().visit)
            page().visit->viewer.note(text, steady_now());
        if (page().flat)
            page().flat->view.note(text, steady_now());
    };
    return options;
}

void leave() {
    page().visit.reset();
    page().flat.reset();
}

// Follows the person's choice, or else asks for another codec by measurements.
void follow_color(Visit& visit, const client::ParticipantFigures& figures, TimePoint now) {
    if (visit.viewer.color_codec() != visit.color.codec())
        visit.color.choose(visit.viewer.color_codec());
    (void)visit.color.observe(figures, now);
    if (visit.viewer.color_codec() != visit.color.codec())
        visit.viewer.choose_color_codec(visit.color.codec());
}

void follow_color(FlatVisit& visit, const client::ParticipantFigures& figures, TimePoint now) {
    if (visit.color.observe(figures, now))
        visit.participant.choose_codecs("", visit.color.codec());
}

// True once the GPU has finished the last picture. Waiting for it would block the page.
bool finish_drawing(Visit& visit) {
    if (!visit.drawing || glClientWaitSync(visit.drawing, 0, 0) == GL_TIMEOUT_EXPIRED)
        return false;
    glDeleteSync(std::exchange(visit.drawing, nullptr));
    visit.viewer.on_presented(visit.drawing_began, steady_now());
    return true;
}

// Begins a picture if there is a new one and the GPU is free.
void draw(Visit& visit, Size size) {
    if (visit.drawing)
        return;
    const TimePoint now = steady_now();
    const xr::WindowInput input = page().input.take();
    visit.viewer.on_input(
        input, input.grabbed ? visit.picture.distance_at(*input.grabbed) : std::nullopt, size, now);
    const bool changed = visit.viewer.step(size, now);
    if (!changed && !input.redraw)
        return;
    if (changed)
        visit.viewer.draw(size, visit.picture.begin(size, visit.viewer.way().scale), now);
    visit.picture.show(size);
    if (changed) {
        visit.drawing = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        visit.drawing_began = now;
    }
    glFlush();
}

// A picture for a headset, whatever is new: its display needs one each time.
void draw_headset(Visit& visit, const xr::HeadsetFrame& frame, bool real_room) {
    const TimePoint now = steady_now();
    // The window's size does not matter here.
    constexpr Size any{16, 9};
    page().input = {};
    visit.viewer.on_headset(frame, now);
    (void)visit.viewer.step(any, now);
    const unsigned framebuffer = visit.headset_framebuffer =
        theatron_headset_framebuffer(visit.headset_framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    if (real_room)
        glClearColor(0, 0, 0, 0);
    else
        glClearColor(0.09f, 0.10f, 0.12f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    visit.viewer.draw_headset(frame, framebuffer, now);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    // While the GPU is behind, one picture in several is measured.
    if (!visit.drawing) {
        visit.drawing = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        visit.drawing_began = now;
    }
    glFlush();
}

}  // namespace
}  // namespace theatron::web

using namespace theatron;
using theatron::web::page;

extern "C" {

// `port` of the page; `token` as in the link; `person` in hex digits; `color` as PageColor takes
// it. `can_h264`: this page or its workers have decoders of the browser. See problem() for
// failures.
EMSCRIPTEN_KEEPALIVE void theatron_join(const char* host, int port, const char* token,
                                        const char* name, const char* person, const char* color,
                                        int can_h264) {
    page().problem.clear();
    web::leave();
    web::guarded([&] {
        web::open_context();
        const net::Link link{host, std::uint16_t(port), token, ""};
        const web::PageColor asked(color, can_h264 != 0);
        page().visit =
            std::make_unique<web::Visit>(web::join_options(link, name, person, asked),
                                         link.host + ":" + std::to_string(link.port), asked);
    });
}

// The same for the 2D view (flat_view.h), which needs no WebGL.
EMSCRIPTEN_KEEPALIVE void theatron_join_flat(const char* host, int port, const char* token,
                                             const char* name, const char* person,
                                             const char* color, int can_h264) {
    page().problem.clear();
    web::leave();
    web::guarded([&] {
        const net::Link link{host, std::uint16_t(port), token, ""};
        const web::PageColor asked(color, can_h264 != 0);
        page().flat =
            std::make_unique<web::FlatVisit>(web::join_options(link, name, person, asked),
                                             link.host + ":" + std::to_string(link.port), asked);
    });
}

// The 2D view's picture if it is a new one, else null: 4 bytes for each of these pixels.
EMSCRIPTEN_KEEPALIVE const std::byte* theatron_flat_picture() {
    bool is_new = false;
    if (page().flat)
        web::guarded([&] { is_new = page().flat->view.take(steady_now()); });
    return is_new && page().flat ? page().flat->view.pixels().data() : nullptr;
}
EMSCRIPTEN_KEEPALIVE int theatron_flat_width() {
    return page().flat ? page().flat->view.size().width : 0;
}
EMSCRIPTEN_KEEPALIVE int theatron_flat_height() {
    return page().flat ? page().flat->view.size().height : 0;
}
EMSCRIPTEN_KEEPALIVE void theatron_flat_next() {
    if (page().flat)
        page().flat->view.next_camera();
}

EMSCRIPTEN_KEEPALIVE void theatron_leave() {
    web::guarded(web::leave);
}

// In the page's rhythm, with the pixels of the canvas: begins the next picture unless the GPU still
// works on one. 1 while it does.
EMSCRIPTEN_KEEPALIVE int theatron_draw(int width, int height) {
    if (page().visit)
        web::guarded([&] { web::draw(*page().visit, {width, height}); });
    return page().visit && page().visit->drawing;
}

// In the page's rhythm, also while the GPU draws: a step of the work on the room. The clouds come
// first.
EMSCRIPTEN_KEEPALIVE void theatron_prepare() {
    if (page().visit && page().visit->viewer.pictures() > 0)
        web::guarded([] { page().visit->viewer.prepare(); });
}

// 1 if the GPU has finished a picture since the last call.
EMSCRIPTEN_KEEPALIVE int theatron_finish_drawing() {
    bool finished = false;
    if (page().visit)
        web::guarded([&] { finished = web::finish_drawing(*page().visit); });
    return finished ? 1 : 0;
}

// Until theatron_leave_headset() the page draws for a headset, whose display shows this number of
// pictures a second.
EMSCRIPTEN_KEEPALIVE void theatron_enter_headset(int real_room, double pictures_per_s) {
    if (page().visit)
        web::guarded([&] {
            page().visit->viewer.enter_headset(real_room != 0, pictures_per_s, steady_now());
        });
}
// Numbers as in headset_input.h, in theatron_memory().
EMSCRIPTEN_KEEPALIVE void theatron_draw_headset(int real_room) {
    const auto frame = web::read_headset_frame(page().bytes);
    if (page().visit && page().visit->viewer.has_headset() && frame)
        web::guarded([&] { web::draw_headset(*page().visit, *frame, real_room != 0); });
}
// The share of the layer's pixels on each side that the client can draw at the display's rate.
EMSCRIPTEN_KEEPALIVE double theatron_headset_scale() {
    return page().visit ? page().visit->viewer.way().scale : 1;
}
EMSCRIPTEN_KEEPALIVE void theatron_recentre() {
    if (page().visit)
        web::guarded([] { page().visit->viewer.recentre_headset(); });
}
// The person's choice in the headset's menu since the last call: 1: the microphone, 2: to leave
// the headset, 0: nothing.
EMSCRIPTEN_KEEPALIVE int theatron_headset_wish(int microphone_open) {
    if (!page().visit)
        return 0;
    page().visit->viewer.set_microphone_open(microphone_open != 0);
    const auto wish = page().visit->viewer.take_headset_wish();
    return !wish ? 0 : *wish == viewer::MenuAction::microphone ? 1 : 2;
}
EMSCRIPTEN_KEEPALIVE void theatron_leave_headset() {
    if (page().visit)
        web::guarded([] { page().visit->viewer.leave_headset(); });
}

// JSON for the panels: page_state.h, or {"problem": sentence} without a visit.
EMSCRIPTEN_KEEPALIVE const char* theatron_state() {
    nlohmann::json state;
    const TimePoint now = steady_now();
    if (page().visit)
        web::guarded([&] {
            web::Visit& visit = *page().visit;
            viewer::Facts facts = visit.viewer.facts(now);
            web::follow_color(visit, facts.received, now);
            state =
                web::page_state(visit.viewer, std::move(facts), visit.participant, visit.address);
            visit.color.add_to(state);
        });
    if (page().flat)
        web::guarded([&] {
            web::FlatVisit& visit = *page().flat;
            viewer::Facts facts = visit.view.facts(now);
            web::follow_color(visit, facts.received, now);
            state = visit.view.state(std::move(facts), visit.address);
            visit.color.add_to(state);
        });
    if (!page().participant())
        state = {{"phase", "left"}, {"problem", page().problem}};
    page().text = state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return page().text.c_str();
}

// Rates, ages and drops begin anew; for measurements.
EMSCRIPTEN_KEEPALIVE void theatron_reset_figures() {
    if (page().participant())
        page().participant()->reset_figures();
}

// A button of a panel.
EMSCRIPTEN_KEEPALIVE void theatron_command(int command) {
    if (page().visit)
        web::guarded([&] { page().visit->viewer.press(command, steady_now()); });
}

// A frame of the page's microphone: its number, its age in microseconds at the first sample, the
// rest of its header, and an Opus frame of 20 ms.
EMSCRIPTEN_KEEPALIVE void theatron_speak(unsigned number, double age_us, int pauses, int level_db,
                                         const std::byte* opus, int size) {
    if (!page().participant() || size <= 0 || std::size_t(size) > voice::max_opus_size)
        return;
    voice::Packet packet;
    packet.number = number;
    packet.time = page().participant()->now() - Duration(std::int64_t(age_us));
    packet.pauses = pauses != 0;
    packet.level_db = level_db;
    packet.opus = {opus, std::size_t(size)};
    Bytes bytes;
    voice::write_packet(packet, bytes);
    page().participant()->send_voice(bytes);
}

// The person agrees that others record the voice (1), or does not (0), in this visit.
EMSCRIPTEN_KEEPALIVE void theatron_allow_voice_recording(int agrees) {
    if (page().participant())
        page().participant()->allow_voice_recording(agrees != 0);
}
// Offers the picture of the person's face, of this size, or with 0 withdraws it.
EMSCRIPTEN_KEEPALIVE void theatron_show_face(int width, int height, double pictures_per_s) {
    if (!page().visit)
        return;
    std::optional<wire::OfferedCamera> offer;
    if (width > 0)
        offer = client::FaceSender::offer({width, height}, pictures_per_s);
    page().visit->participant.publish_face(std::move(offer));
}
// A picture of the face, a JPEG in theatron_memory(), and its age in microseconds.
EMSCRIPTEN_KEEPALIVE void theatron_send_face(double age_us) {
    if (!page().visit)
        return;
    client::Participant& participant = page().visit->participant;
    page().visit->face.send(participant, page().bytes,
                            participant.now() - Duration(std::int64_t(age_us)));
}
// For the panels: the camera is off (0), being opened (1) or sends (2).
EMSCRIPTEN_KEEPALIVE void theatron_note_face(int state) {
    if (!page().visit)
        return;
    const bool is_seen = state == 2 && page().visit->face.is_taken();
    page().visit->viewer.set_own_face(state == 0 ? viewer::OwnFace::off
                                      : is_seen  ? viewer::OwnFace::seen
                                                 : viewer::OwnFace::opening);
}
// The person's choice in the panels since the last call: 1: to show the face, 2: to hide it, 0:
// none.
EMSCRIPTEN_KEEPALIVE int theatron_face_wish() {
    const auto wish = page().visit ? page().visit->viewer.take_face_wish() : std::nullopt;
    return !wish ? 0 : *wish ? 1 : 2;
}

// Input. Places are shares of the canvas from its upper left corner, ways are shares of its height.
EMSCRIPTEN_KEEPALIVE void theatron_key(const char* key, const char* code) {
    if (const auto press = web::pressed(key, code))
        page().input.press(*press);
}
EMSCRIPTEN_KEEPALIVE void theatron_hold(double right, double up, double ahead, int fast,
                                        int teleport, int points) {
    xr::WindowInput& input = page().input.newest();
    input.steering.fly = {right, up, ahead};
    input.steering.fast = fast != 0;
    input.aims_teleport = teleport != 0;
    input.points = points != 0;
}
EMSCRIPTEN_KEEPALIVE void theatron_point(double x, double y) {
    page().input.newest().pointer = Vec2{x, y};
}
EMSCRIPTEN_KEEPALIVE void theatron_grab(double x, double y, int left) {
    page().input.grab({x, y}, left != 0);
    page().input.newest().pointer = Vec2{x, y};
}
EMSCRIPTEN_KEEPALIVE void theatron_release() {
    page().input.release();
}
EMSCRIPTEN_KEEPALIVE void theatron_drag(double x, double y, int turns) {
    xr::Steering& steering = page().input.newest().steering;
    Vec2& way = turns ? steering.turn : steering.slide;
    way = {way.x + x, way.y + y};
}
EMSCRIPTEN_KEEPALIVE void theatron_wheel(double clicks) {
    page().input.newest().steering.approach += clicks;
}
// The canvas has lost its content.
EMSCRIPTEN_KEEPALIVE void theatron_redraw() {
    page().input.newest().redraw = true;
}

// Decoding workers are ready; before theatron_join().
EMSCRIPTEN_KEEPALIVE void theatron_use_decoders(int count) {
    client::decoder_pool().count = unsigned(count);
    client::decoder_pool().post = [](unsigned worker, ByteView message) {
        theatron_post_work(worker, message.data(), unsigned(message.size()));
    };
}

// Memory that the script fills for the next function.
EMSCRIPTEN_KEEPALIVE void* theatron_memory(int size) {
    page().bytes.resize(std::size_t(size));
    return page().bytes.data();
}

// A decoding worker's reply.
EMSCRIPTEN_KEEPALIVE void theatron_decoded(int worker) {
    if (const auto& on_reply = client::decoder_pool().on_reply)
        web::guarded([&] { on_reply(unsigned(worker), page().bytes); });
}

// In a decoding worker, whose clock has this difference in milliseconds from the page's clock.
EMSCRIPTEN_KEEPALIVE void theatron_begin_decoder(double clock_difference) {
    client::begin_decoder_worker(
        Duration(std::int64_t(clock_difference * 1000)),
        [](ByteView reply) { theatron_post_reply(reply.data(), unsigned(reply.size())); });
}

// For measurements: milliseconds for a key frame of Strata, the fastest of these passes; below 0 if
// it cannot be decoded.
EMSCRIPTEN_KEEPALIVE double theatron_time_strata(int passes) {
    const codec::DepthSetting setting = codec::parse_depth_setting("strata").setting;
    codec::DepthStreamDecoder decoder(setting);
    const Result<Size> size = decoder.read_size(page().bytes);
    if (!size)
        return -1;
    codec::FrameLink key;
    key.key = true;
    DepthImage decoded(*size);
    double fastest = 1e9;
    for (int i = 0; i < passes; ++i) {
        const TimePoint begin = steady_now();
        if (decoder.decode(key, page().bytes, decoded.view()) != Status::ok)
            return -1;
        fastest = std::min(fastest, to_ms(steady_now() - begin));
    }
    return fastest;
}

// In a decoding worker, a message of the page.
EMSCRIPTEN_KEEPALIVE void theatron_decode() {
    client::on_decoder_work(page().bytes);
}

}  // extern "C"

int main() {
    return 0;
}
