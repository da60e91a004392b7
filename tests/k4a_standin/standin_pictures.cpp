// SPDX-License-Identifier: Apache-2.0
#include "standin_pictures.h"

#include <turbojpeg.h>

#include <cstring>
#include <map>

namespace standin {
namespace {

constexpr std::uint8_t between_rows = 0xee;

Bytes encode_gradient(int width, int height) {
    Bytes pixels(std::size_t(width) * std::size_t(height) * 3);
    std::size_t at = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            pixels[at++] = std::uint8_t(x * 255 / width);
            pixels[at++] = std::uint8_t(y * 255 / height);
            pixels[at++] = 120;
        }
    tjhandle encoder = tjInitCompress();
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    tjCompress2(encoder, pixels.data(), width, 0, height, TJPF_RGB, &jpeg, &size, TJSAMP_422, 80,
                TJFLAG_FASTDCT);
    Bytes bytes(jpeg, jpeg + size);
    tjFree(jpeg);
    tjDestroy(encoder);
    return bytes;
}

std::string camera(const char* location, int width, int height, const char* place) {
    return std::string("{\"Location\":\"") + location +
           "\",\"SensorWidth\":" + std::to_string(width) +
           ",\"SensorHeight\":" + std::to_string(height) +
           ",\"MetricRadius\":1.7,\"Intrinsics\":{\"ModelType\":"
           "\"CALIBRATION_LensDistortionModelBrownConrady\",\"ModelParameters\":"
           "[0.5,0.5,0.5,0.5,0,0,0,0,0,0,0,0,0,0]},\"Rt\":{\"Rotation\":[1,0,0,0,1,0,0,0,1],"
           "\"Translation\":" +
           place + "}}";
}

}  // namespace

Bytes depth_picture(int width, int height, int stride, int frame) {
    Bytes bytes(std::size_t(stride) * std::size_t(height), between_rows);
    const int left = (frame * 8) % width;
    for (int y = 0; y < height; ++y) {
        std::uint8_t* row = bytes.data() + std::size_t(y) * std::size_t(stride);
        for (int x = 0; x < width; ++x) {
            const bool box = x >= left && x < left + width / 8 && y > height / 3 && y < height / 2;
            const int value = x == 0 && y == 0 ? frame : box ? 900 : 1500 + y;
            row[2 * x] = std::uint8_t(value);
            row[2 * x + 1] = std::uint8_t(value >> 8);
        }
    }
    return bytes;
}

Bytes color_picture(int width, int height, int frame) {
    static std::map<int, Bytes> of_width;
    Bytes& same = of_width[width];
    if (same.empty())
        same = encode_gradient(width, height);
    const std::uint8_t comment[] = {
        0xff, 0xfe, 0, 4, std::uint8_t(frame >> 8), std::uint8_t(frame)};
    Bytes bytes = same;
    bytes.insert(bytes.begin() + 2, std::begin(comment), std::end(comment));
    return bytes;
}

std::string calibration() {
    return "{\"CalibrationInformation\":{\"Cameras\":[" +
           camera("CALIBRATION_CameraLocationD0", 1024, 1024, "[0,0,0]") + "," +
           camera("CALIBRATION_CameraLocationPV0", 4096, 3072, "[-0.032,0,0]") + "]}}";
}

}  // namespace standin
