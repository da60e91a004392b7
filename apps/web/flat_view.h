// SPDX-License-Identifier: Apache-2.0
// The 2D view: one camera's colour as it is, for a computer that cannot draw the room. It needs no
// GL. People are heard and seen in the panels; one's own place in the room is told to nobody.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/statistics.h"
#include "client/participant.h"
#include "viewer/facts.h"

namespace theatron::web {

// For the page's one thread.
class FlatView {
public:
    // More pixels are left out: the canvas shows them anyway, and the computer is slow.
    static constexpr int most_flat_width = 640;
    // As often as page/graphics.js asks for a picture.
    static constexpr double pictures_per_second = 5;

    // `participant` must outlive the view.
    explicit FlatView(client::Participant& participant) : participant_(participant) {}

    // The camera after the present one; the first one with colour after the last.
    void next_camera();
    // Takes over new frames. True if the camera's picture is another one: see pixels(). Throws
    // Error if the host refused this participant.
    bool take(TimePoint now);
    // Red, green, blue and 255, row by row from above.
    const Bytes& pixels() const { return pixels_; }
    Size size() const { return size_; }

    // Facts for the user, and the content of the panels without what only the room shows.
    viewer::Facts facts(TimePoint now);
    nlohmann::json state(const viewer::Facts& facts, const std::string& address) const;
    void note(const std::string& text, TimePoint now);

private:
    std::string camera_name() const;

    client::Participant& participant_;
    // Colour that came late is shown with the time of the depth image that brought it.
    struct Picture {
        std::shared_ptr<const ColorImage> color;
        TimePoint captured;
    };
    std::map<CameraId, Picture> newest_;
    std::optional<TimePoint> shown_captured_;
    std::optional<CameraId> camera_;
    bool changed_ = false;
    Bytes pixels_;
    Size size_;
    std::uint64_t pictures_ = 0;
    RateWindow drawn_;
    std::string notice_;
    TimePoint notice_until_;
};

}  // namespace theatron::web
