// SPDX-License-Identifier: Apache-2.0
#include "cases/foreign_files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/dicom_elements.h"
#include "cases/foreign_answer.h"
#include "cases/quoted_path.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mesh_area_bytes = std::size_t(512) << 20;
constexpr std::size_t picture_area_bytes =
    64 + 3 * std::size_t(medical::max_picture_side) * medical::max_picture_side;
constexpr std::size_t slice_area_bytes =
    max_slice_head + 2 * std::size_t(medical::max_volume_side) * medical::max_volume_side;

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0)
            close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    int get() const { return number_; }

private:
    int number_;
};

std::string lower_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return extension;
}

// A number that two places can be trusted with, such as "2.1 GB".
std::string in_gigabytes(std::uintmax_t bytes) {
    return std::to_string(bytes / 1'000'000'000) + "." + std::to_string(bytes / 100'000'000 % 10) +
           " GB";
}

void require_size(const fs::path& file, std::size_t limit, const char* advice) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed))
        throw Error(quoted_path(file) + " is not a regular file.");
    const std::uintmax_t size = fs::file_size(file, failed);
    if (failed)
        throw Error("The size of " + quoted_path(file) + " cannot be found out.");
    if (size > limit)
        throw Error(quoted_path(file) + " is " + in_gigabytes(size) + " large, and at most " +
                    std::to_string(limit >> 20) + " MiB are read; " + advice + ".");
}

struct Reply {
    Answer what;
    ByteView content;  // in the shared memory, until the next request
};

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
            return "holds no grey image of 8 or 16 bits (it may be a map, a mask or a dose); "
                   "export it as such an image";
        case Answer::no_dicom:
            return "is no DICOM file, whatever its name says";
        case Answer::no_picture:
            return "is neither PNG nor JPEG, whatever its name says; save it as one of them";
        case Answer::no_mesh:
            return "is no surface of the format that its name says; export it again";
        case Answer::no_triangles:
            return "holds no triangles";
        case Answer::other_buffer:
            return "keeps its corners in another file; export it as one file (.glb)";
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

// Such a file is left out: without it nothing else is wrong.
bool is_not_for_us(Answer what) {
    switch (what) {
        case Answer::no_image:
        case Answer::color:
        case Answer::many_frames:
        case Answer::other_samples:
        case Answer::no_dicom:
        case Answer::no_picture:
        case Answer::no_mesh:
        case Answer::no_triangles:
        case Answer::other_buffer:
        case Answer::skin:
        case Answer::polygons:
        case Answer::no_places:
            return true;
        default:
            return false;
    }
}

[[noreturn]] void refuse(const fs::path& file, Answer what) {
    if (is_not_for_us(what))
        throw NotForUs(file, reason_of(what));
    throw Error(quoted_path(file) + " " + reason_of(what) + ".");
}

}  // namespace

// A file in memory whose content is exchanged while a child holds it open.
class DicomFiles::Input {
public:
    Input() : memory_(memfd_create("theatron", MFD_CLOEXEC)) {
        if (memory_.get() < 0)
            throw Error("Cannot make the memory that a reader reads from.");
    }
    int descriptor() const { return memory_.get(); }

    void load(const fs::path& path) {
        const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
        if (file.get() < 0 || ftruncate(memory_.get(), 0) != 0)
            throw Error("Cannot open " + quoted_path(path) + ": " + std::strerror(errno) + ".");
        buffer_.resize(1 << 20);
        std::size_t done = 0;
        while (true) {
            const ssize_t count = ::read(file.get(), buffer_.data(), buffer_.size());
            if (count < 0)
                throw Error("Cannot read " + quoted_path(path) + ": " + std::strerror(errno) + ".");
            if (count == 0)
                return;
            done += std::size_t(count);
            // It may grow while it is read.
            if (done > max_dicom_file_bytes ||
                write(memory_, buffer_.data(), std::size_t(count), done - std::size_t(count)))
                throw Error("Cannot take " + quoted_path(path) + " into memory.");
        }
    }

private:
    static bool write(const Descriptor& to, const char* data, std::size_t size, std::size_t at) {
        return pwrite(to.get(), data, size, off_t(at)) != ssize_t(size);
    }

    Descriptor memory_;
    std::vector<char> buffer_;
};

DicomFiles::DicomFiles() : input_(std::make_unique<Input>()) {}
DicomFiles::~DicomFiles() = default;

std::vector<DicomSlice> DicomFiles::read(const fs::path& file) {
    constexpr std::string_view subject = "a DICOM file";
    require_size(file, max_dicom_file_bytes, "export one image per file");
    identifiers_.clear();
    constexpr std::uintmax_t least_bytes = 132;  // before the first element
    std::error_code unknown;
    if (fs::file_size(file, unknown) < least_bytes)
        throw NotForUs(file, "is too short for a DICOM file");
    input_->load(file);
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

NotForUs::NotForUs(const fs::path& file, std::string reason)
    : Error(quoted_path(file) + " " + reason + "."), reason_(std::move(reason)) {}

bool is_dicom_file(const fs::path& path) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    std::byte head[132];
    const ssize_t size = file.get() >= 0 ? ::read(file.get(), head, sizeof(head)) : 0;
    const std::string extension = lower_extension(path);
    const std::string inner = extension == ".gz" ? lower_extension(path.stem()) : extension;
    return inner == ".dcm" || inner == ".ima" ||
           begins_as_dicom(ByteView(head, std::size_t(std::max<ssize_t>(size, 0))));
}

bool is_mesh_file(const fs::path& file) {
    const std::string extension = lower_extension(file);
    return extension == ".stl" || extension == ".obj" || extension == ".ply" || extension == ".glb";
}

std::vector<NamedMesh> read_mesh_file(const fs::path& path) {
    require_size(path, max_mesh_file_bytes, "simplify the surface in the program that wrote it");
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    if (file.get() < 0)
        throw Error("Cannot open " + quoted_path(path) + ": " + std::strerror(errno) + ".");
    sandbox::Limits limits;
    limits.memory_bytes = max_reader_memory_bytes;
    limits.area_bytes = mesh_area_bytes;
    limits.cpu_seconds = 60;
    limits.answer = 120s;
    sandbox::Child child("mesh", file.get(), "the file " + quoted_path(path), limits);
    child.send(as_bytes(lower_extension(path).substr(1)));

    std::vector<NamedMesh> meshes;
    while (meshes.size() < max_meshes_in_file) {
        const Reply reply = reply_of(child);
        if (reply.what == Answer::end)
            break;
        const std::string name(reinterpret_cast<const char*>(reply.content.data()),
                               std::min<std::size_t>(reply.content.size(), 100));
        if (reply.what == Answer::extension)
            throw NotForUs(path, "needs the glTF extension '" + clean_text(name, 60) +
                                     "', which is not read; export it without");
        if (reply.what == Answer::property)
            throw Error(quoted_path(path) + " has an impossible '" + clean_text(name, 60) +
                        "' (a property of glTF); export it again.");
        if (reply.what != Answer::content)
            refuse(path, reply.what);
        // The child can still change the shared memory: a copy is checked, not the memory itself.
        const Bytes copy(reply.content.begin(), reply.content.end());
        Result<NamedMesh> mesh = decode_named_mesh(copy);
        if (!mesh)
            throw Error(quoted_path(path) +
                        " has impossible vertices or triangles; export it again.");
        meshes.push_back(std::move(*mesh));
        const std::byte next{1};
        child.send({&next, 1});
    }
    if (meshes.empty())
        refuse(path, Answer::no_triangles);
    return meshes;
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
    if (reply.what != Answer::content)
        refuse(path, reply.what);
    const Bytes copy(reply.content.begin(), reply.content.end());
    Result<ColorImage> picture = medical::decode_picture(copy);
    if (!picture)
        child.refuse("an impossible picture");
    return std::move(*picture);
}

Result<NamedMesh> decode_named_mesh(ByteView bytes) {
    ByteReader reader(bytes);
    NamedMesh named;
    const ByteView name = reader.get_bytes(reader.get<std::uint8_t>());
    named.name = clean_text({reinterpret_cast<const char*>(name.data()), name.size()}, 64);
    const std::size_t vertices = reader.get<std::uint32_t>(),
                      triangles = reader.get<std::uint32_t>();
    if (!reader.ok())
        return Status::truncated;
    if (vertices > max_loose_vertices || triangles > medical::max_mesh_triangles)
        return Status::too_large;
    if (reader.rest().size() != 12 * (vertices + triangles))
        return Status::size_mismatch;
    named.mesh.positions.resize(vertices);
    const std::byte* at = reader.rest().data();
    for (medical::Vec3f& p : named.mesh.positions) {
        std::memcpy(&p, at, 12);
        at += 12;
        if (!(std::abs(p.x) <= 1e6f && std::abs(p.y) <= 1e6f && std::abs(p.z) <= 1e6f))
            return Status::malformed;
    }
    named.mesh.triangles.resize(triangles);
    for (medical::Triangle& t : named.mesh.triangles)
        for (std::uint32_t& v : t) {
            v = load_le<std::uint32_t>(at);
            at += 4;
            if (v >= vertices)
                return Status::malformed;
        }
    return named;
}

}  // namespace theatron::cases
