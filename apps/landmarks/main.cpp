// SPDX-License-Identifier: Apache-2.0
// theatron-landmarks MODEL < photo.ppm
//
// Writes "faces: " and their number, then the landmarks of the largest one as a .pts file.
// Theatron starts it (src/enrol/landmark_finder.h). Exit codes: 3 no face, 4 no model, 1 anything
// else.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "dlib_landmarks.h"

namespace {

using namespace theatron::landmarks;

constexpr int failed = 1, no_face = 3, no_model = 4;
constexpr int max_side = 8192;

bool read_photo(Photo& photo) {
    if (std::scanf("P6 %d %d 255", &photo.width, &photo.height) != 2 || std::getchar() != '\n' ||
        photo.width < 1 || photo.height < 1 || photo.width > max_side || photo.height > max_side)
        return false;
    photo.colors.resize(std::size_t(3) * std::size_t(photo.width) * std::size_t(photo.height));
    return std::fread(photo.colors.data(), 1, photo.colors.size(), stdin) == photo.colors.size();
}

int run(const char* model) {
    Photo photo;
    if (!read_photo(photo))
        return failed;
    Found found;
    switch (find(photo, model, found)) {
        case Outcome::no_face:
            return no_face;
        case Outcome::no_model:
            return no_model;
        case Outcome::found:
            break;
    }
    std::printf("faces: %d\nversion: 1\nn_points: %zu\n{\n", std::min(found.faces, 999),
                found.points.size());
    for (const auto& [x, y] : found.points)
        std::printf("%ld %ld\n", x, y);
    std::printf("}\n");
    return std::fflush(stdout) == 0 ? 0 : failed;
}

}  // namespace

int main(int count, char** words) {
    // A photo of a person stays in no crash dump.
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    if (count != 2) {
        std::fputs("usage: theatron-landmarks MODEL < photo.ppm\n", stderr);
        return failed;
    }
    try {
        return run(words[1]);
    } catch (const std::exception&) {
        return failed;
    }
}
