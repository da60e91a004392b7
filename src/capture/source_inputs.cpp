// SPDX-License-Identifier: Apache-2.0
#include "capture/source_inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <memory>

#include "base/error.h"
#include "base/steady_clock.h"
#include "capture/readable_file.h"

namespace theatron::capture {
namespace {

constexpr Duration connect_patience = 5s;

// 0, or why the connection failed.
int connect_until(int descriptor, const addrinfo& to, TimePoint end) {
    if (connect(descriptor, to.ai_addr, to.ai_addrlen) == 0)
        return 0;
    if (errno != EINPROGRESS)
        return errno;
    pollfd ready{descriptor, POLLOUT, 0};
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_now());
    if (poll(&ready, 1, int(std::max<std::int64_t>(0, ms.count()))) <= 0)
        return ETIMEDOUT;
    int error = 0;
    socklen_t size = sizeof(error);
    getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
}

}  // namespace

SourceInput::~SourceInput() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

SourceInput connect_to(const std::string& host, int port, const std::string& subject) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
        error != 0)
        throw Error("There is no host for " + subject + ": " + gai_strerror(error) + ".");
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, freeaddrinfo);
    const TimePoint end = steady_now() + connect_patience;
    int error = ETIMEDOUT;
    for (const addrinfo* one = found; one && steady_now() < end; one = one->ai_next) {
        SourceInput socket(::socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        if (socket.descriptor() < 0)
            continue;
        error = connect_until(socket.descriptor(), *one, end);
        if (error != 0)
            continue;
        const int yes = 1;
        setsockopt(socket.descriptor(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
        setsockopt(socket.descriptor(), SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof(yes));
        return socket;
    }
    throw Error("Cannot connect to " + subject + ": " + std::strerror(error) + ".");
}

SourceInput open_video_device(const std::filesystem::path& path) {
    SourceInput device(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
    if (device.descriptor() < 0 && (errno == ENOENT || errno == ENOTDIR || errno == ENXIO))
        throw Error("There is no video device " + quoted(path) + ".");
    if (device.descriptor() < 0)
        throw Error("Cannot open the video device " + quoted(path) + ": " + std::strerror(errno) +
                    ".");
    struct stat info {};
    v4l2_capability able{};
    if (fstat(device.descriptor(), &info) != 0 || !S_ISCHR(info.st_mode) ||
        ioctl(device.descriptor(), VIDIOC_QUERYCAP, &able) != 0)
        throw Error(quoted(path) + " is no video device.");
    const unsigned abilities =
        able.capabilities & V4L2_CAP_DEVICE_CAPS ? able.device_caps : able.capabilities;
    if (!(abilities & V4L2_CAP_VIDEO_CAPTURE) || !(abilities & V4L2_CAP_STREAMING))
        throw Error("The video device " + quoted(path) +
                    " gives no pictures; another number of the same device may.");
    return device;
}

}  // namespace theatron::capture
