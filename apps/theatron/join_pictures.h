// SPDX-License-Identifier: Apache-2.0
// The pictures that `theatron join` draws without a window and writes into files.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "room_lines.h"
#include "session/renderer_choice.h"
#include "viewer/offscreen_view_native.h"

namespace theatron::app {

// Both throw Error with one sentence. A picture is written at the end, so an impossible file name
// is reported at the beginning; an empty name is none.
Size parse_size(const std::string& text);
void check_picture_file(const std::string& file);

class JoinPicture {
public:
    virtual ~JoinPicture() = default;
    // Takes over new cameras and frames, again and again.
    virtual void take(client::Participant& participant, RoomLines& room) = 0;
    // Throws Error if no picture came from the host.
    virtual void write() = 0;
    // Adds the facts that the picture shows to the figures.
    virtual void add_to(nlohmann::json&) const {}
};

struct ViewPicture {
    Size size;
    viewer::ViewChoice view;
    std::string renderer;
    viewer::RoomChoice room;
    std::vector<viewer::SeenPerson> people;
    std::string color_file, depth_file;  // empty: not wanted
    bool stereo = false;
};

// The newest pictures of all cameras from one viewpoint.
class OffscreenPicture : public JoinPicture {
public:
    explicit OffscreenPicture(ViewPicture wanted);
    // The picture's viewpoint is this person's head for others, and a head that a line `stand` has
    // placed is the picture's viewpoint. Follows the host's renderer command.
    void take(client::Participant& participant, RoomLines& room) override;
    void write() override;
    // "still_seconds": the age of a picture that is covered since no camera's is newer; null: it is
    // not.
    void add_to(nlohmann::json& json) const override;

private:
    std::string drawn_with() const;

    const ViewPicture wanted_;
    session::RendererChoice renderer_;
    viewer::OffscreenView scene_;
    // Heads: of the viewpoint, which is shown to others; of a line `stand` that came later.
    std::optional<Pose> first_head_, stood_at_;
};

}  // namespace theatron::app
