// SPDX-License-Identifier: Apache-2.0
// theatron-landmarks MODEL < photo.ppm > face.pts
//
// The 68 landmarks of the largest face in a photo, by dlib: its finder of faces (histograms of
// oriented gradients) and its model of landmarks (Kazemi and Sullivan, CVPR 2014). Theatron starts it
// (src/enrol/landmark_finder.h). Exit codes: 3 no face, 4 no model, 1 anything else.
#include <dlib/image_processing.h>
#include <dlib/image_processing/frontal_face_detector.h>
#include <sys/resource.h>

#include <cstdio>
#include <exception>

namespace {

constexpr int no_face = 3, no_model = 4, failed = 1;
constexpr int max_side = 8192;
constexpr unsigned long landmark_count = 68;

bool read_photo(dlib::array2d<dlib::rgb_pixel>& photo) {
    int width = 0, height = 0;
    if (std::scanf("P6 %d %d 255", &width, &height) != 2 || std::getchar() != '\n' || width < 1 ||
        height < 1 || width > max_side || height > max_side)
        return false;
    photo.set_size(height, width);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            unsigned char color[3];
            if (std::fread(color, 1, sizeof(color), stdin) != sizeof(color))
                return false;
            photo[y][x] = {color[0], color[1], color[2]};
        }
    return true;
}

int run(const char* file) {
    dlib::array2d<dlib::rgb_pixel> photo;
    if (!read_photo(photo))
        return failed;
    dlib::shape_predictor model;
    try {
        dlib::deserialize(file) >> model;
    } catch (const std::exception&) {
        return no_model;
    }
    if (model.num_parts() != landmark_count)
        return no_model;
    dlib::frontal_face_detector finder = dlib::get_frontal_face_detector();
    dlib::rectangle largest;
    for (const dlib::rectangle& face : finder(photo))
        if (face.area() > largest.area())
            largest = face;
    if (largest.is_empty())
        return no_face;
    const dlib::full_object_detection found = model(photo, largest);
    std::printf("version: 1\nn_points: %lu\n{\n", landmark_count);
    for (unsigned long i = 0; i < landmark_count; ++i)
        std::printf("%ld %ld\n", found.part(i).x(), found.part(i).y());
    std::printf("}\n");
    return std::fflush(stdout) == 0 ? 0 : failed;
}

}  // namespace

int main(int count, char** words) {
    // A photo of a person stays in no crash dump.
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    if (count != 2) {
        std::fputs("usage: theatron-landmarks MODEL < photo.ppm > face.pts\n", stderr);
        return failed;
    }
    try {
        return run(words[1]);
    } catch (const std::exception&) {
        return failed;
    }
}
