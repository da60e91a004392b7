// SPDX-License-Identifier: Apache-2.0
#include "cases/foreign_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/descriptor.h"
#include "base/error.h"
#include "base/outside_text.h"
#include "cases/dicom_elements.h"
#include "cases/exchanged_file.h"
#include "cases/foreign_reply.h"
#include "cases/quoted_path.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t picture_area_bytes =
    64 + 3 * std::size_t(medical::max_picture_side) * medical::max_picture_side;
constexpr std::size_t slice_area_bytes =
    max_slice_head + 2 * std::size_t(medical::max_volume_side) * medical::max_volume_side;

}  // namespace

DicomFiles::DicomFiles() : input_(std::make_unique<ExchangedFile>()) {}
DicomFiles::~DicomFiles() = default;

std::vector<DicomSlice> DicomFiles::read(const fs::path& file) {
    constexpr std::string_view subject = "a DICOM file";
    require_size(file, max_dicom_file_bytes, "export one image per file");
    identifiers_.clear();
    constexpr std::uintmax_t least_bytes = 132;  // before the first element
    std::error_code unknown;
    if (fs::file_size(file, unknown) < least_bytes)
        throw NotForUs(file, "is too short for a DICOM file");
    input_->load(file, max_dicom_file_bytes);
    try {
        if (!child_) {
            sandbox::Limits limits;
            limits.memory_bytes = max_reader_memory_bytes;
            limits.area_bytes = slice_area_bytes;
            child_ = std::make_unique<sandbox::Child>("dicom", input_->descriptor(),
                                                      std::string(subject), limits);
        }
        std::vector<DicomSlice> slices;
        std::size_t samples = 0;
        while (true) {
            const std::byte request{1};
            child_->send({&request, 1});
            const Reply reply = reply_of(*child_);
            // The child can still change the shared memory: a copy is checked, not that itself.
            const Bytes copy(reply.content.begin(), reply.content.end());
            if (reply.what != Answer::content && reply.what != Answer::content_and_more) {
                if (!copy.empty()) {
                    Result<std::vector<Identifier>> identifiers = decode_identifiers(copy);
                    if (!identifiers)
                        child_->refuse("impossible texts");
                    identifiers_ = std::move(*identifiers);
                }
                refuse(file, reply.what);
            }
            Result<DicomSlice> slice = decode_dicom_slice(copy);
            if (!slice)
                throw Error(quoted_path(file) +
                            " describes an image with an impossible size, place or scale of "
                            "values; export it again.");
            if (slices.empty())
                identifiers_ = slice->identifiers;
            samples += slice->samples.size();
            slices.push_back(std::move(*slice));
            if (reply.what == Answer::content)
                return slices;
            if (samples > medical::max_volume_samples || slices.size() > std::size_t(max_frames))
                throw Error(quoted_path(file) + " " + reason_of(Answer::too_large) + ".");
        }
    } catch (const NotForUs&) {
        throw;
    } catch (const Error& error) {
        // The child does not know which file it had.
        const std::string text = error.what();
        if (text.size() > subject.size() && text.compare(1, subject.size() - 1, subject, 1) == 0)
            throw Error("The DICOM file " + quoted_path(file) + text.substr(subject.size()));
        throw;
    }
}

bool is_dicom_file(const fs::path& path) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    std::byte head[132];
    const ssize_t size = file.get() >= 0 ? ::read(file.get(), head, sizeof(head)) : 0;
    const std::string extension = lower_extension(path);
    const std::string inner = extension == ".gz" ? lower_extension(path.stem()) : extension;
    return inner == ".dcm" || inner == ".ima" ||
           begins_as_dicom(ByteView(head, std::size_t(std::max<ssize_t>(size, 0))));
}

bool is_picture_file(const fs::path& file) {
    const std::string extension = lower_extension(file);
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

ColorImage read_picture_file(const fs::path& path) {
    require_size(path, max_picture_file_bytes, "save it with fewer pixels");
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    if (file.get() < 0)
        throw Error("Cannot open " + quoted_path(path) + ": " + std::strerror(errno) + ".");
    sandbox::Limits limits;
    limits.memory_bytes = max_reader_memory_bytes;
    limits.area_bytes = picture_area_bytes;
    limits.answer = 60s;
    sandbox::Child child("picture", file.get(), "the picture " + quoted_path(path), limits);
    const std::byte request{1};
    child.send({&request, 1});
    const Reply reply = reply_of(child);
    if (reply.what == Answer::compression)
        throw NotForUs(path, "has colours for printing (CMYK); save it with RGB colours");
    // A picture stands for itself: without a damaged one nothing else is wrong.
    if (reply.what != Answer::content)
        throw NotForUs(path, reason_of(reply.what));
    const Bytes copy(reply.content.begin(), reply.content.end());
    Result<ColorImage> picture = medical::decode_picture(copy);
    if (!picture)
        child.refuse("an impossible picture");
    return std::move(*picture);
}

}  // namespace theatron::cases
