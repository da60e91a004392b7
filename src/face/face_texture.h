// SPDX-License-Identifier: Apache-2.0
// Photos laid into the texture of a face's skin.
//
// Each photo gives the light of the texels that it sees, with how well it sees them. Light is
// linear. Texels that no photo shows are taken from the other side of the face, and smoothly from
// round them where that is not seen, either. Pure.
#pragma once

#include <optional>

#include "face/face_mesh.h"
#include "face/linear_light.h"
#include "image/image.h"

namespace theatron::face {

inline constexpr int texture_side = 512;
inline constexpr std::size_t texel_count = std::size_t(texture_side) * texture_side;

// The place of the skin that each texel shows.
class TextureMap {
public:
    static constexpr std::uint32_t nothing = 0xffffffff;
    struct Texel {
        std::uint32_t triangle = nothing;
        float of_b = 0, of_c = 0;  // shares of its second and third corner
    };

    // The model is taken at rest; its halves should be alike.
    explicit TextureMap(const MorphModel& model);

    const std::vector<Texel>& texels() const { return texels_; }
    bool shows_skin(std::size_t texel) const { return texels_[texel].triangle != nothing; }
    // The texel of the same place on the other side; `nothing` if there is none near it. Both of
    // a place of the skin.
    std::uint32_t mirrored(std::size_t texel) const { return mirrored_[texel]; }

private:
    std::vector<Texel> texels_;
    std::vector<std::uint32_t> mirrored_;
};

struct TexturePart {
    std::vector<Light> light;    // of each texel
    std::vector<float> weights;  // 0: not seen, to 1
};

// The skin as a photo shows it. `mesh` is the face as it was in the photo, of the map's model.
TexturePart unwrap_photo(const TextureMap& map, const FaceMesh& mesh, const FaceCamera& camera,
                         ColorView photo);

// The median of each part's pixels in a photo; nullopt if fewer than 20 are seen.
std::array<std::optional<Rgb>, part_count> colors_of_parts(const FaceMesh& mesh,
                                                           const FaceCamera& camera,
                                                           ColorView photo);

// All texels of a face from those that are seen.
std::vector<Light> completed(const TextureMap& map, const TexturePart& seen);
// The same for another photo of that face: made as bright as the first one was, and with the first
// one's texels where it sees nothing.
std::vector<Light> completed(const TexturePart& seen, const TexturePart& first,
                             const std::vector<Light>& first_completed);

ColorImage texture_of(const std::vector<Light>& light);

}  // namespace theatron::face
