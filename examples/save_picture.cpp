// SPDX-License-Identifier: Apache-2.0
// Joins a session and saves what its first camera sees as a picture:
//   save_picture 'LINK' picture.png
#include <cstdio>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "client/participant.h"
#include "files/png_file.h"
#include "viewer/offscreen_view_native.h"

using namespace theatron;

namespace {

void save_picture(const char* link, const char* file) {
    client::Participant::Options options;
    options.link = net::parse_link(link);
    options.name = "example";
    client::Participant participant(options);  // joins at once, on a thread of its own

    viewer::OffscreenView view;
    const TimePoint deadline = steady_now() + 20s;
    const viewer::ViewChoice choice{CameraId{0}, 0, 0};
    while (!view.can_draw(choice)) {
        const auto status = participant.status();
        if (status.phase == client::Participant::Phase::refused || steady_now() > deadline)
            throw Error("No picture came. " + status.problem);
        participant.wait_for_frame(100ms);
        view.take(participant);
    }
    const ColorImage picture = view.picture({choice, {1280, 720}, "mesh", {}});
    files::write_png(file, picture.view());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s LINK FILE.png\n", argv[0]);
        return 2;
    }
    try {
        save_picture(argv[1], argv[2]);
        std::printf("Saved %s.\n", argv[2]);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
