// SPDX-License-Identifier: Apache-2.0
// Hosts a session with one camera of this machine and prints the link with which others join:
//   publish_camera folder:DIR,loop=1
#include <csignal>
#include <cstdio>

#include "base/error.h"
#include "capture/mkv_reader.h"
#include "host/host.h"

using namespace theatron;

int main(int argc, char** argv) {
    // Foreign recordings are read by a child process of this program.
    sandbox::run_as_child(argc, argv, capture::foreign_readers);
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s CAMERA   (for example folder:DIR,loop=1)\n", argv[0]);
        return 2;
    }
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGINT);
    sigaddset(&stop, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &stop, nullptr);
    try {
        host::HostOptions options;
        options.cameras = {argv[1]};
        options.listen = {"127.0.0.1", 0};  // any free port
        options.name = "one camera";
        host::Host host(options, {});  // works on threads of its own
        std::printf("%s\n", host.link().c_str());
        std::fflush(stdout);
        int signal = 0;
        sigwait(&stop, &signal);
        return 0;
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
