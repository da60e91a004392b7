// SPDX-License-Identifier: Apache-2.0
#include "ffmpeg/ffmpeg.h"

#include <dlfcn.h>

extern "C" {
#include <libavcodec/version_major.h>
#include <libavformat/version_major.h>
#include <libavutil/version.h>
#include <libswscale/version_major.h>
}

#include "base/lasting_error.h"
#include "ffmpeg/entries.h"

namespace theatron::ffmpeg {
namespace {

// The version whose headers this program was compiled with: structures differ between versions.
std::string file_name(const char* library, int version) {
    return std::string(library) + ".so." + std::to_string(version);
}

class Library {
public:
    explicit Library(std::string name)
        : name_(std::move(name)), handle_(dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!handle_)
            problem_ = "FFmpeg's library " + name_ +
                       " is missing (on Debian 12: apt install libavformat59 libswscale6).";
    }

    void find(const char* function, void*& entry) {
        if (!problem_.empty())
            return;
        if (void* const found = dlsym(handle_, function))
            entry = found;
        else
            problem_ = "FFmpeg's library " + name_ + " has no function " + function +
                       "; install that of Debian 12 (libavformat59, libswscale6).";
    }

    const std::string& problem() const { return problem_; }

private:
    std::string name_, problem_;
    void* handle_;  // for the life of the process
};

std::string load() {
    Library avutil(file_name("libavutil", LIBAVUTIL_VERSION_MAJOR));
    Library avcodec(file_name("libavcodec", LIBAVCODEC_VERSION_MAJOR));
    Library avformat(file_name("libavformat", LIBAVFORMAT_VERSION_MAJOR));
    Library swscale(file_name("libswscale", LIBSWSCALE_VERSION_MAJOR));
#define THEATRON_FIND(library, name) library.find(#name, theatron_entry_##name);
#define THEATRON_FIND_AVUTIL(name) THEATRON_FIND(avutil, name)
#define THEATRON_FIND_AVCODEC(name) THEATRON_FIND(avcodec, name)
#define THEATRON_FIND_AVFORMAT(name) THEATRON_FIND(avformat, name)
#define THEATRON_FIND_SWSCALE(name) THEATRON_FIND(swscale, name)
    THEATRON_AVUTIL_FUNCTIONS(THEATRON_FIND_AVUTIL)
    THEATRON_AVCODEC_FUNCTIONS(THEATRON_FIND_AVCODEC)
    THEATRON_AVFORMAT_FUNCTIONS(THEATRON_FIND_AVFORMAT)
    THEATRON_SWSCALE_FUNCTIONS(THEATRON_FIND_SWSCALE)
    for (const Library* library : {&avutil, &avcodec, &avformat, &swscale})
        if (!library->problem().empty())
            return library->problem();
    return {};
}

}  // namespace

const std::string& problem() {
    static const std::string found = load();
    return found;
}

const char* needed_by(const char* user) {
    if (!problem().empty())
        throw LastingError(problem());
    return user;
}

void load_if_there() {
    (void)problem();
}

}  // namespace theatron::ffmpeg
