// SPDX-License-Identifier: Apache-2.0
#include "dlib_landmarks.h"

#include <dlib/image_processing.h>
#include <dlib/image_processing/frontal_face_detector.h>

#include <exception>

namespace theatron::landmarks {
namespace {

constexpr unsigned long landmark_count = 68;

dlib::array2d<dlib::rgb_pixel> picture_of(const Photo& photo) {
    dlib::array2d<dlib::rgb_pixel> picture(photo.height, photo.width);
    const unsigned char* color = photo.colors.data();
    for (int y = 0; y < photo.height; ++y)
        for (int x = 0; x < photo.width; ++x, color += 3)
            picture[y][x] = {color[0], color[1], color[2]};
    return picture;
}

}  // namespace

Outcome find(const Photo& photo, const std::string& file, Found& found) {
    dlib::shape_predictor model;
    try {
        dlib::deserialize(file) >> model;
    } catch (const std::exception&) {
        return Outcome::no_model;
    }
    if (model.num_parts() != landmark_count)
        return Outcome::no_model;
    const auto picture = picture_of(photo);
    dlib::frontal_face_detector finder = dlib::get_frontal_face_detector();
    dlib::rectangle largest;
    for (const dlib::rectangle& face : finder(picture)) {
        ++found.faces;
        if (face.area() > largest.area())
            largest = face;
    }
    if (largest.is_empty())
        return Outcome::no_face;
    const dlib::full_object_detection landmarks = model(picture, largest);
    for (unsigned long i = 0; i < landmark_count; ++i)
        found.points.emplace_back(landmarks.part(i).x(), landmarks.part(i).y());
    return Outcome::found;
}

}  // namespace theatron::landmarks
