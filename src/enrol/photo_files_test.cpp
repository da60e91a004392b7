// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_files.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <string>

#include "base/error.h"
#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::enrol {
namespace {

// A JPEG file, 16 pixels wide and 8 high, white on its left half, with this EXIF orientation.
Bytes half_white(int orientation) {
    ColorImage image({16, 8});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            image.view().row(y)[x] = {255, 255, 255};
    const tjhandle encoder = tjInitCompress();
    unsigned char* data = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder, reinterpret_cast<unsigned char*>(image.pixels.data()), 16, 0, 8,
                          TJPF_RGB, &data, &size, TJSAMP_444, 95, 0),
              0);
    const auto bytes = std::as_bytes(std::span(data, size));
    Bytes file(bytes.begin(), bytes.end());
    tjFree(data);
    tjDestroy(encoder);
    std::string exif(
        "\xff\xe1\0\x22"
        "Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\0\0\0\0\0\0\0",
        36);
    exif[29] = char(orientation);
    const ByteView segment = as_bytes(std::string_view(exif));
    file.insert(file.begin() + 2, segment.begin(), segment.end());
    return file;
}

class PhotoFiles : public ::testing::Test {
protected:
    ColorImage read(const Bytes& file) {
        const std::string path = (folder.path() / "photo.jpg").string();
        files::write_file(path, file);
        return read_photo(path);
    }
    testing::TemporaryFolder folder;
};

TEST_F(PhotoFiles, APhotoThatLiesOnItsSideIsTurned) {
    const ColorImage as_stored = read(half_white(1));
    EXPECT_EQ(as_stored.size, (Size{16, 8}));
    EXPECT_GT(as_stored.view().row(4)[2].g, 200);
    // 6: its left side is to be above.
    const ColorImage turned = read(half_white(6));
    EXPECT_EQ(turned.size, (Size{8, 16}));
    EXPECT_GT(turned.view().row(2)[4].g, 200);
    EXPECT_LT(turned.view().row(13)[4].g, 50);
}

TEST_F(PhotoFiles, AnythingElseIsRefusedByName) {
    try {
        (void)read(Bytes(100, std::byte{7}));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("photo.jpg"), std::string::npos);
    }
}

}  // namespace
}  // namespace theatron::enrol
