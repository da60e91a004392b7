// SPDX-License-Identifier: Apache-2.0
// The head of a person who shows their own face (face/enrolled_face.h), on the bust of people.h.
//
// In the frame of the head, as figure_meshes.h. Pure.
#pragma once

#include <array>
#include <vector>

#include "face/enrolled_face.h"
#include "image/image.h"
#include "render/scene_frame.h"
#include "room/figure_meshes.h"

namespace theatron::room {

// The expression of a face at one moment.
struct ShownFace {
    face::Emotions emotions{};
    face::DirectChannels direct;
    bool operator==(const ShownFace& other) const;
};

class OwnHead {
public:
    // The skin's pictures, all of one size; an empty one is as that of Emotion::neutral, which is
    // not empty.
    using Textures = std::array<ColorImage, face::emotion_count>;
    // Precondition: as face::parse_sent_face() gives it.
    OwnHead(face::EnrolledFace face, Textures textures);

    // By face::HeadPart; parts without triangles are empty.
    std::array<render::MeshData, face::part_count> meshes(const ShownFace& shown) const;
    // Linear.
    Vec3 color(face::HeadPart part) const;

    Size texture_size() const { return textures_[std::size_t(face::Emotion::neutral)].size; }
    // The shares of the six pictures, rounded, so that a face which hardly changes keeps its skin.
    using Shares = std::array<std::uint16_t, face::emotion_count>;
    static constexpr unsigned whole_share = 256;  // the sum of all
    Shares shares(const face::Emotions& emotions) const;
    void blend(const Shares& shares, ColorImage& out) const;

    // False: it is a face alone, behind which back() is needed.
    bool is_whole() const { return is_whole_; }
    // In the colour of the skin, in the frame of the head.
    render::MeshData back() const { return back_mesh(back_, 0.06); }
    // Places and sizes of the bust's parts with which they meet this head; the neck is that below a
    // whole one, in the frame of the body.
    struct Part {
        Pose place;
        double scale = 1;
    };
    const Part& cap() const { return cap_; }
    const Part& neck() const { return neck_; }
    Part neck_in_cloud() const;
    // The pupils are so far before the head's origin, that of a bust.
    double pupils_before_m() const { return pupils_before_m_; }

private:
    Vec3 in_head(const float* mm) const;
    Vec3 dressed(const float* mm) const;
    void measure_back();
    void measure_neck();
    void measure_cap();
    void hide_what_clothes_cover();

    face::EnrolledFace face_;
    Textures textures_;
    Vec3 eyes_mm_;
    bool is_whole_ = false;
    double pupils_before_m_ = 0;
    BackSizes back_ = usual_back_widths;
    Part cap_, neck_;
    // The first vertex at the same place: they were parted for the texture, and have one normal.
    std::vector<std::uint32_t> same_place_;
    std::vector<bool> is_hidden_;  // triangles below cap and collar
};

}  // namespace theatron::room
