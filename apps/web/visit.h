// SPDX-License-Identifier: Apache-2.0
// The page's visit of a session: the room, or the 2D view, and what draws it.
#pragma once

#include <emscripten/html5.h>

#include <memory>
#include <string>

#include "client/picture_sender.h"
#include "flat_view.h"
#include "page_color.h"
#include "picture_fence.h"
#include "viewer/viewer.h"
#include "window/input_queue.h"
#include "window/scaled_picture.h"

namespace theatron::web {

// A page that joined.
struct Visit {
    // `scale`: of the canvas's pixels to draw, on each side; 0: chosen by drawing time.
    Visit(client::Participant::Options join, std::string host_address, PageColor asked,
          double scale);
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    std::string address;
    PageColor color;
    viewer::Viewer::Options options;
    client::PictureSender face;
    client::Participant participant;
    viewer::Viewer viewer;
    window::ScaledPicture picture;
    PictureFence drawing;  // of the newest picture
    TimePoint drawing_began, drawing_submitted;
};

// A page that joined and only shows a camera's picture.
struct FlatVisit {
    FlatVisit(client::Participant::Options join, std::string host_address, PageColor asked)
        : address(std::move(host_address)),
          color(std::move(asked)),
          participant(FlatView::options(std::move(join))),
          view(participant, color.codec()) {}

    std::string address;
    PageColor color;
    client::Participant participant;
    FlatView view;
};

// The page's state. Objects of GL must not outlive their context, so nothing is destroyed when the
// page is closed.
struct Page {
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
    unsigned headset_framebuffer = 0;  // its name, once it was used
    std::unique_ptr<Visit> visit;      // this
    std::unique_ptr<FlatVisit> flat;   // or this, or none
    window::InputQueue input;          // since the last picture
    client::PictureSender screen;      // that the person shows; outlives a visit
    std::uint64_t run = 0;             // as in wire::Join: both ways of seeing are one stay
    session::MemberChat chat;          // of the ways of seeing so far
    bool hand_raised = false;          // wished for when the last one ended
    std::string problem;               // why the visit ended; a sentence
    std::string text;                  // that the last function returned
    Bytes bytes;                       // that the script writes for the next function

    void leave() {
        if (const client::Participant* left = participant()) {
            chat = left->chat_so_far();
            hand_raised = left->wants_hand_raised();
        }
        visit.reset();
        flat.reset();
    }
    client::Participant* participant() const {
        return visit ? &visit->participant : flat ? &flat->participant : nullptr;
    }
};

Page& page();

// Runs `work`; an exception ends the visit with its sentence.
template <class Work>
void guarded(Work work) {
    try {
        work();
    } catch (const std::exception& e) {
        page().problem = e.what();
        page().leave();
    }
}

// Throws Error if the browser has no WebGL 2.
void open_context();

// `person` in hex digits.
client::Participant::Options join_options(const net::Link& link, const char* name,
                                          const char* person, const PageColor& color);
// Takes over the wish for a depth codec; "": none. Returns one sentence if this page cannot decode
// it, and then leaves the options as they are.
std::string ask_for_depth(client::Participant::Options& options, const std::string& wish);

// Follows the person's choice, or else asks for another codec by measurements.
void follow_color(Visit& visit, const client::ParticipantFigures& figures, TimePoint now);
void follow_color(FlatVisit& visit, const client::ParticipantFigures& figures, TimePoint now);

// Begins a picture if there is a new one and the GPU is free. True if the canvas was drawn.
bool draw(Visit& visit, Size size);
// A picture for a headset, whatever is new: its display needs one each time.
void draw_headset(Visit& visit, xr::HeadsetFrame frame, bool real_room);
// True once the GPU has finished the last picture. Waiting for it would block the page.
bool finish_drawing(Visit& visit);

}  // namespace theatron::web
