// SPDX-License-Identifier: Apache-2.0
#include "cases/foreign_reply.h"

#include "base/error.h"
#include "base/small_letters.h"
#include "cases/foreign_files.h"
#include "cases/quoted_path.h"

namespace theatron::cases {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& file) {
    return in_small_letters(file.extension().string());
}

namespace {

// A number that two places can be trusted with, such as "2.1 GB".
std::string in_gigabytes(std::uintmax_t bytes) {
    return std::to_string(bytes / 1'000'000'000) + "." + std::to_string(bytes / 100'000'000 % 10) +
           " GB";
}

// Such a file is left out: without it nothing else is wrong.
bool is_not_for_us(Answer what) {
    switch (what) {
        case Answer::no_image:
        case Answer::color:
        case Answer::many_frames:
        case Answer::other_samples:
        case Answer::dose:
        case Answer::map:
        case Answer::segmentation:
        case Answer::document:
        case Answer::no_dicom:
        case Answer::no_picture:
        case Answer::no_mesh:
        case Answer::no_triangles:
        case Answer::hidden:
        case Answer::skin:
        case Answer::polygons:
        case Answer::no_places:
            return true;
        default:
            return false;
    }
}

}  // namespace

void require_size(const fs::path& file, std::size_t limit, const char* advice) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed))
        throw Error(quoted_path(file) + " is not a regular file.");
    const std::uintmax_t size = fs::file_size(file, failed);
    if (failed)
        throw Error("The size of " + quoted_path(file) + " cannot be found out.");
    if (size == 0)
        throw NotForUs(file, "is empty; copy it again if it should hold something");
    if (size > limit)
        throw Error(quoted_path(file) + " is " + in_gigabytes(size) + " large, and at most " +
                    std::to_string(limit >> 20) + " MiB are read; " + advice + ".");
}

Reply reply_of(sandbox::Child& child) {
    const ByteView message = child.receive();
    if (message.size() != 9)
        child.refuse("no answer");
    const auto bytes = load_le<std::uint64_t>(message.data() + 1);
    if (bytes > child.area().size())
        child.refuse("more bytes than there are");
    return {Answer(message[0]), child.area().first(std::size_t(bytes))};
}

const char* reason_of(Answer what) {
    switch (what) {
        case Answer::no_image:
            return "holds no image";
        case Answer::cut_off:
            return "is cut off before its pixels end; copy it again";
        case Answer::color:
            return "is a picture in colour, not a grey image of a series; save it as PNG or JPEG "
                   "to show it";
        case Answer::many_frames:
            return "holds several images in one file without a place of each, which is not "
                   "supported; export one file per image";
        case Answer::other_samples:
            return "has pixels of neither 8 nor 16 bits (it may be a map, a mask or a dose); "
                   "export it as "
                   "an image of 16 bits, or save a picture of it (PNG, JPEG)";
        case Answer::dose:
            return "holds a radiation dose and no image; save a picture of it (PNG, JPEG) to show "
                   "it";
        case Answer::map:
            return "holds computed values (a parametric map) and no image of a scanner; save a "
                   "picture of it (PNG, JPEG) to show it";
        case Answer::segmentation:
            return "holds a segmentation as DICOM, which is not read; export it as a label map "
                   "(NIfTI, NRRD) or as surfaces (STL)";
        case Answer::document:
            return "holds a surface as a DICOM document, which is not read; save it as a file of "
                   "its own (STL, OBJ)";
        case Answer::no_dicom:
            return "is no DICOM file, whatever its name says";
        case Answer::no_picture:
            return "is neither PNG nor JPEG, whatever its name says; save it as one of them";
        case Answer::no_mesh:
            return "is no surface of the format that its name says; export it again";
        case Answer::no_triangles:
            return "holds no triangles";
        case Answer::hidden:
            return "holds no surface that is visible in it (KHR_node_visibility); show the "
                   "surfaces and export it again";
        case Answer::skin:
            return "is bent by a skeleton (a skin of glTF), which is not read; export it with its "
                   "shape applied";
        case Answer::polygons:
            return "has facets that are no triangles; export it with triangles";
        case Answer::no_places:
            return "gives its corners no x, y and z; export it again";
        case Answer::lacks:
            return "holds fewer triangles than it announces: it is cut off or damaged; export it "
                   "again";
        case Answer::more:
            return "holds more triangles than it announces; export it again";
        case Answer::compression:
            return "is damaged, or compressed in a way that is not supported";
        case Answer::too_large:
            return "holds more than is read of one file";
        default:
            return "is damaged; export it again";
    }
}

void refuse(const fs::path& file, Answer what) {
    if (is_not_for_us(what))
        throw NotForUs(file, reason_of(what));
    throw Error(quoted_path(file) + " " + reason_of(what) + ".");
}

NotForUs::NotForUs(const fs::path& file, std::string reason)
    : Error(quoted_path(file) + " " + reason + "."), reason_(std::move(reason)) {}

}  // namespace theatron::cases
