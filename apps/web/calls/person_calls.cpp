// SPDX-License-Identifier: Apache-2.0
// The functions that page/page.js, page/face.js and page/screen.js call for the person's voice,
// face and screen.
#include <emscripten/emscripten.h>

#include "visit.h"
#include "voice/packet.h"

using namespace theatron;
using theatron::web::page;

extern "C" {

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
        offer = client::PictureSender::face({width, height}, pictures_per_s);
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
// Offers a screen of this name and size to all, or with width 0 withdraws it.
EMSCRIPTEN_KEEPALIVE void theatron_show_screen(const char* name, int width, int height,
                                               double pictures_per_s) {
    if (!page().participant())
        return;
    std::optional<wire::OfferedCamera> offer;
    if (width > 0)
        offer = client::PictureSender::screen(name, {width, height}, pictures_per_s);
    page().participant()->show_screen(std::move(offer));
}
// A picture of the screen, a JPEG in theatron_memory(), and its age in microseconds.
EMSCRIPTEN_KEEPALIVE void theatron_send_screen(double age_us) {
    client::Participant* participant = page().participant();
    if (participant)
        page().screen.send(*participant, page().bytes,
                           participant->now() - Duration(std::int64_t(age_us)));
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

}  // extern "C"
