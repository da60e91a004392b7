// SPDX-License-Identifier: Apache-2.0
#include "cases/share_case.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "cases/case_folder.h"
#include "cases/quoted_path.h"
#include "files/file_bytes.h"
#include "medical/mesh_measures.h"
#include "medical/picture.h"
#include "medical/slice.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

void extend(std::optional<medical::Box>& all, const medical::Box& box) {
    if (!all) {
        all = box;
        return;
    }
    Vec3 &low = all->low_mm, &high = all->high_mm;
    low = {std::min(low.x, box.low_mm.x), std::min(low.y, box.low_mm.y),
           std::min(low.z, box.low_mm.z)};
    high = {std::max(high.x, box.high_mm.x), std::max(high.y, box.high_mm.y),
            std::max(high.z, box.high_mm.z)};
}

}  // namespace

ShareableCase share_case(const fs::path& folder, const HashOf& hash_of, std::uint64_t max_bytes) {
    const medical::Case manifest = read_finished_manifest(folder);
    if (manifest.parts.empty() && manifest.series.empty() && manifest.pictures.empty())
        throw Error("The case in " + quoted_path(folder) +
                    " has neither parts nor series nor pictures.");
    ShareableCase shared;
    const auto take = [&](const fs::path& file) {
        std::error_code failed;
        const auto size = fs::file_size(file, failed);
        if (failed || size > max_bytes - shared.bytes)
            throw Error("The case in " + quoted_path(folder) +
                        " is too large to be offered beside the others: there is room for " +
                        std::to_string(max_bytes >> 20) + " MiB.");
        auto bytes = std::make_shared<const Bytes>(
            files::read_file(file, std::size_t(max_bytes - shared.bytes)));
        shared.bytes += bytes->size();
        return bytes;
    };
    const auto keep = [&](std::shared_ptr<const Bytes> bytes) {
        const medical::SharedContent named{hash_of(*bytes), bytes->size()};
        shared.content[named.hash] = std::move(bytes);
        return named;
    };
    medical::SharedCase& about = shared.description;
    about.name = manifest.name;
    about.deidentified = manifest.deidentified;
    about.license = manifest.license;
    about.credit = manifest.credit;
    std::optional<medical::Box> box;
    for (const medical::Part& part : manifest.parts) {
        const fs::path file = file_of(folder, part);
        auto bytes = take(file);
        const auto mesh = medical::decode_mesh(*bytes);
        if (!mesh || mesh->triangles.empty())
            throw Error(quoted_path(file) +
                        " is no mesh that can be drawn; import the case again.");
        extend(box, medical::box_of(*mesh));
        about.parts.push_back({part.name, part.role, part.color,
                               std::uint8_t(std::lround(std::clamp(part.opacity, 0.0, 1.0) * 255)),
                               keep(std::move(bytes))});
    }
    for (const medical::Series& series : manifest.series) {
        const fs::path file = file_of(folder, series);
        auto bytes = take(file);
        const auto volume = medical::decode_volume(*bytes);
        if (!volume)
            throw Error(quoted_path(file) + " is no series of images; import the case again.");
        if (!shared.window) {
            const auto range = medical::slice_range(volume->grid, medical::Orientation::axial);
            shared.window = volume->window;
            shared.middle_slice_mm = range.first_mm + range.step_mm * (range.count / 2);
        }
        if (manifest.parts.empty())
            extend(box, medical::box_of(volume->grid));
        about.series.push_back({series.name, series.modality, keep(std::move(bytes)),
                                std::uint16_t(series.missing_slices.size())});
    }
    for (const medical::CasePicture& picture : manifest.pictures) {
        const fs::path file = file_of(folder, picture);
        auto bytes = take(file);
        if (!medical::decode_picture(*bytes))
            throw Error(quoted_path(file) + " is no picture of a case; import the case again.");
        about.pictures.push_back({picture.name, keep(std::move(bytes))});
    }
    if (box)
        about.middle_mm = (box->low_mm + box->high_mm) * 0.5;
    auto description = std::make_shared<const Bytes>(medical::encode_shared_case(about));
    shared.id = hash_of(*description);
    shared.bytes += description->size();
    shared.content[shared.id] = std::move(description);
    return shared;
}

}  // namespace theatron::cases
