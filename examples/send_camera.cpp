// SPDX-License-Identifier: Apache-2.0
// Sends a camera of this machine into a session that another machine hosts:
//   send_camera 'LINK' folder:DIR,loop=1      (the host's link for those who may send)
#include <csignal>
#include <cstdio>

#include "base/error.h"
#include "capture/mkv_reader.h"
#include "publish/camera_publisher.h"

using namespace theatron;

namespace {

// Until SIGINT or SIGTERM, which are blocked, or until the session refuses or ends.
void send_camera(const char* link, const char* camera, const sigset_t& stop) {
    client::Participant::Options options;
    options.link = net::parse_link(link);
    publish::CameraPublisher publisher({camera}, "", {});
    options.name = "example";
    options.sends_only = true;
    options.publishing = publisher.events();
    client::Participant participant(options);  // joins at once, on a thread of its own
    const publish::Publishing publishing(publisher, participant);
    const timespec half_a_second{0, 500'000'000};
    while (sigtimedwait(&stop, nullptr, &half_a_second) < 0) {
        const client::Participant::Status status = participant.status();
        if (!status.publish_problem.empty())
            throw Error(status.publish_problem);
        if (status.phase == client::Participant::Phase::refused)
            throw Error(status.problem);
        if (status.phase == client::Participant::Phase::ended)
            return;
    }
}

}  // namespace

int main(int argc, char** argv) {
    sandbox::run_as_child(argc, argv, capture::foreign_readers);  // see publish_camera.cpp
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s LINK CAMERA\n", argv[0]);
        return 2;
    }
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGINT);
    sigaddset(&stop, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &stop, nullptr);
    try {
        send_camera(argv[1], argv[2], stop);
        return 0;
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
