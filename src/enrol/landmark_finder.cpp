// SPDX-License-Identifier: Apache-2.0
#include "enrol/landmark_finder.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/descriptor.h"
#include "base/error.h"
#include "base/steady_clock.h"
#include "face/face_fit.h"
#include "image/image.h"
#include "sandbox/spawn_plan.h"

namespace theatron::enrol {
namespace {

namespace fs = std::filesystem;

constexpr const char* program_name = "theatron-landmarks";
// Its exit codes, as apps/landmarks/main.cpp has them.
constexpr int no_face = 3, no_model = 4;
// More pixels a side take longer and find nothing more in a portrait.
constexpr int longest_side = 1280;
constexpr std::size_t most_answer_bytes = 16 * 1024;
constexpr Duration usual_patience = std::chrono::seconds(60);

fs::path usual_program() {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    const fs::path built = folder / program_name;
    return fs::exists(built, error) ? built
                                    : folder.parent_path() / "libexec/theatron" / program_name;
}

// Each pixel is one of the photo's: the finder looks at coarse edges.
ColorImage smaller(ColorView photo, double share) {
    ColorImage out(
        {std::max(1, int(photo.size.width * share)), std::max(1, int(photo.size.height * share))});
    for (int y = 0; y < out.size.height; ++y) {
        const Rgb* from = photo.row(std::min(int((y + 0.5) / share), photo.size.height - 1));
        for (int x = 0; x < out.size.width; ++x)
            out.view().row(y)[x] = from[std::min(int((x + 0.5) / share), photo.size.width - 1)];
    }
    return out;
}

bool write_all(int descriptor, const void* bytes, std::size_t count) {
    const char* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(descriptor, at, count);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        at += written;
        count -= std::size_t(written);
    }
    return true;
}

// The picture as a PPM file in memory, to be read from its beginning. Throws Error.
Descriptor picture_file(const ColorImage& picture) {
    Descriptor file(memfd_create("photo", MFD_CLOEXEC));
    const std::string head = "P6\n" + std::to_string(picture.size.width) + " " +
                             std::to_string(picture.size.height) + "\n255\n";
    if (!file.is_open() || !write_all(file.get(), head.data(), head.size()) ||
        !write_all(file.get(), picture.pixels.data(), picture.pixels.size() * sizeof(Rgb)) ||
        lseek(file.get(), 0, SEEK_SET) != 0)
        throw Error("The photo cannot be given to " + std::string(program_name) + ": " +
                    std::system_category().message(errno) + ".");
    return file;
}

// All that the program writes until it closes its output, at most most_answer_bytes, within
// `patience`; nullopt: it did not close it.
std::optional<std::string> read_answer(int output, Duration patience) {
    const TimePoint end = steady_now() + patience;
    std::string answer;
    char part[4096];
    while (answer.size() <= most_answer_bytes) {
        pollfd waits{output, POLLIN, 0};
        const auto left = std::max<std::int64_t>(0, (end - steady_now()).count() / 1000);
        const int ready = poll(&waits, 1, int(left));
        if (ready == 0)
            return std::nullopt;
        const ssize_t count = ready < 0 ? -1 : read(output, part, sizeof(part));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return answer;
        answer.append(part, std::size_t(count));
    }
    return std::nullopt;
}

int exit_code(pid_t child) {
    int state = 0;
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

}  // namespace

LandmarkFinder::LandmarkFinder(fs::path model)
    : LandmarkFinder(usual_program(), std::move(model), usual_patience) {}

LandmarkFinder::LandmarkFinder(fs::path program, fs::path model, Duration patience)
    : program_(std::move(program)), model_(std::move(model)), patience_(patience) {}

std::string LandmarkFinder::problem() const {
    std::error_code error;
    if (!fs::exists(program_, error))
        return "This build of Theatron does not find landmarks: it was built without dlib "
               "(Debian's package libdlib-dev).";
    if (!fs::exists(model_, error))
        return "The model that finds landmarks, '" + model_.string() +
               "', is not there; Debian's package libdlib-data has it. It learned from photos "
               "whose licence excludes commercial use.";
    return {};
}

FoundLandmarks LandmarkFinder::find(ColorView photo) const {
    if (std::string none = problem(); !none.empty())
        return {std::nullopt, 0, std::move(none)};
    const double share =
        std::min(1.0, double(longest_side) / std::max(photo.size.width, photo.size.height));
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return {std::nullopt, 0, "Too many files are open to look for landmarks."};
    const Descriptor output(ends[0]);
    Descriptor input(ends[1]);
    pid_t child = 0;
    try {
        const Descriptor picture = picture_file(smaller(photo, share));
        sandbox::SpawnPlan plan(program_name);
        plan.move(picture.get(), STDIN_FILENO);
        plan.move(input.get(), STDOUT_FILENO);
        plan.close_from(STDERR_FILENO + 1);
        child = plan.start(program_.c_str(), {program_name, model_.string()}, environ);
    } catch (const Error& error) {
        return {std::nullopt, 0, error.what()};
    }
    input.close();
    const auto answer = read_answer(output.get(), patience_);
    if (!answer)
        kill(child, SIGKILL);
    const int code = exit_code(child);
    if (!answer)
        return {std::nullopt, 0, std::string(program_name) + " did not end; it was ended."};
    if (code == no_face)
        return {std::nullopt, 0, "No face was found in the photo.", true};
    if (code == no_model)
        return {std::nullopt, 0, "'" + model_.string() + "' is no model of 68 landmarks."};
    // A line with the number of faces, then the landmarks of the largest one.
    int faces = 0, end_of_line = 0;
    const bool is_counted =
        std::sscanf(answer->c_str(), "faces: %3d\n%n", &faces, &end_of_line) == 1;
    auto landmarks = face::parse_pts(std::string_view(*answer).substr(std::size_t(end_of_line)));
    if (code != 0 || !is_counted || !landmarks)
        return {std::nullopt, 0, std::string(program_name) + " failed."};
    for (Vec2& point : *landmarks)
        point = {point.x / share, point.y / share};
    return {*landmarks, faces, {}, true};
}

}  // namespace theatron::enrol
